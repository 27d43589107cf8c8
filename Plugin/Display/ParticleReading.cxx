// SPDX-License-Identifier: BSD-3-Clause
#include "Display/ParticleReading.h"

#include "Display/ProxyTexts.h"

#include "vtkDataObject.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

namespace RectifiedTransport
{

namespace
{

vtkPVDataInformation* dataOf(vtkSMProxy* filter, const char* input)
{
  vtkSMPropertyHelper helper(filter, input, true);
  auto* source = vtkSMSourceProxy::SafeDownCast(helper.GetAsProxy());
  if (!source)
  {
    return nullptr;
  }
  if (source->GetDataInformation(helper.GetOutputPort())->GetNumberOfPoints() == 0)
  {
    source->UpdatePipeline();
  }
  return source->GetDataInformation(helper.GetOutputPort());
}

// -1 where there is none.
int associationOf(vtkPVDataInformation* data, const char* array)
{
  for (const int association : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    if (data->GetArrayInformation(array, association))
    {
      return association;
    }
  }
  return -1;
}

bool isReader(vtkSMProxy* filter)
{
  return filter && !hintElements(filter, "ReadAsParticles").empty();
}

// The name of a source's input that is a density of particles; nullptr for other sources.
const char* densityInput(vtkSMProxy* source)
{
  const char* name = source->GetXMLName();
  return isReader(source)                             ? "Density"
    : name && std::string(name) == "TransportSampler" ? "Input"
                                                      : nullptr;
}

} // namespace

void takeDensityOfParticles(vtkSMProxy* filter)
{
  if (!isReader(filter) || vtkSMPropertyHelper(filter, "Density").GetAsProxy())
  {
    return;
  }
  const char* name = nullptr;
  vtkSMProxy* source = filter;
  while (!name && (source = vtkSMPropertyHelper(source, "Input", true).GetAsProxy()))
  {
    name = densityInput(source);
  }
  if (name)
  {
    vtkSMPropertyHelper density(source, name);
    vtkSMPropertyHelper(filter, "Density").Set(density.GetAsProxy(), density.GetOutputPort());
  }
}

std::vector<std::string> unsetReading(vtkSMProxy* filter, vtkMTimeType time)
{
  std::vector<std::string> unset;
  if (isReader(filter))
  {
    for (const char* name : { "DensityArray", "Component", "InvertDensity", "ValidRange" })
    {
      if (filter->GetProperty(name)->GetMTime() <= time)
      {
        unset.emplace_back(name);
      }
    }
  }
  return unset;
}

void readAsParticles(vtkSMProxy* filter, const std::vector<std::string>& properties)
{
  vtkPVDataInformation* particles = dataOf(filter, "Input");
  vtkPVDataInformation* density = dataOf(filter, "Density");
  if (!particles || !density)
  {
    return;
  }
  const auto recorded = [particles](const char* name) {
    return particles->GetArrayInformation(name, vtkDataObject::FIELD);
  };
  vtkPVArrayInformation* names = recorded("DensityArrayName");
  vtkPVArrayInformation* component = recorded("DensityComponent");
  vtkPVArrayInformation* inverted = recorded("DensityInverted");
  vtkPVArrayInformation* range = recorded("DensityRange");
  // Particles of several densities have a value for each.
  if (!names || !component || !inverted || !range || names->GetNumberOfStringValues() != 1)
  {
    return;
  }
  const char* array = names->GetStringValue(0);
  const int association = associationOf(density, array);
  if (association < 0)
  {
    return;
  }
  for (const std::string& name : properties)
  {
    vtkSMPropertyHelper property(filter, name.c_str());
    if (name == "DensityArray")
    {
      property.SetInputArrayToProcess(association, array);
    }
    else if (name == "Component")
    {
      property.Set(static_cast<int>(component->GetComponentRange(0)[0]));
    }
    else if (name == "InvertDensity")
    {
      property.Set(static_cast<int>(inverted->GetComponentRange(0)[0]));
    }
    else
    {
      property.Set(range->GetComponentRange(0), 2);
    }
  }
  filter->UpdateVTKObjects();
}

} // namespace RectifiedTransport
