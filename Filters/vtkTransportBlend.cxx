// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportBlend.h"

#include "Bridge/Blend/DensityBlend.h"
#include "Bridge/Density/DensityImage.h"
#include "Bridge/Image/CommonGrid.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Settings/FlowSettings.h"
#include "Bridge/Settings/SplatSettings.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
vtkImplementSplatPropertiesMacro(vtkTransportBlend);

namespace
{
using namespace RectifiedTransport;

const char* const MassModeTexts[] = { "Linear", "Geometric", "Source", "Normalize" };

struct GivenInput
{
  vtkDataObject* Data;
  int Port;
};

// The leaves of composite data that are not null; other data are one block.
void gatherBlocks(vtkDataObject* data, std::vector<vtkDataObject*>& blocks)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    blocks.push_back(data);
    return;
  }
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    blocks.push_back(leaves->GetCurrentDataObject());
  }
}

// The blocks of composite inputs are inputs of their own.
std::vector<GivenInput> gatherInputs(vtkInformationVector** inputVector, int numberOfPorts)
{
  std::vector<GivenInput> inputs;
  for (int port = 0; port < numberOfPorts; ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      std::vector<vtkDataObject*> blocks;
      gatherBlocks(vtkDataObject::GetData(inputVector[port], i), blocks);
      for (vtkDataObject* block : blocks)
      {
        inputs.push_back({ block, port });
      }
    }
  }
  return inputs;
}
} // namespace

//------------------------------------------------------------------------------
vtkTransportBlend::vtkTransportBlend()
  : Dimensions{ 0, 0, 0 }
  , ParticlesPerCell(1)
  , MassMode(MASS_LINEAR)
{
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkTransportBlend::~vtkTransportBlend() = default;

//------------------------------------------------------------------------------
const char* vtkTransportBlend::GetMassModeAsString()
{
  return choiceText(MassModeTexts, this->MassMode);
}

//------------------------------------------------------------------------------
vtkImageData* vtkTransportBlend::GetDensity()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
vtkPolyData* vtkTransportBlend::GetParticles()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
int vtkTransportBlend::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkImageData" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
RectifiedTransport::BlendSettings vtkTransportBlend::GetBlendSettings()
{
  requireThat(
    this->ParticlesPerCell >= 1, "ParticlesPerCell", this->ParticlesPerCell, "at least 1");
  requireChoice("MassMode", this->MassMode, MassModeTexts);
  return { { this->Dimensions[0], this->Dimensions[1], this->Dimensions[2] },
    this->ParticlesPerCell, static_cast<RectifiedTransport::MassMode>(this->MassMode),
    this->GetFlowSettings().Options(), this->GetSplatSettings().Options() };
}

//------------------------------------------------------------------------------
int vtkTransportBlend::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  std::vector<NamedGrid> grids;
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputVector[port]->GetInformationObject(i);
      vtkDataObject* data = vtkDataObject::GetData(input);
      if (vtkCompositeDataSet::SafeDownCast(data))
      {
        // Its information has no extents of blocks: they are known if the blocks are there already.
        std::vector<vtkDataObject*> blocks;
        gatherBlocks(data, blocks);
        for (vtkDataObject* block : blocks)
        {
          if (auto* image = vtkImageData::SafeDownCast(block))
          {
            int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
            this->FindDensityArray(image, port, association);
            const bool onPoints = association != vtkDataObject::FIELD_ASSOCIATION_CELLS;
            grids.push_back({ gridOf(image, onPoints), "" });
          }
        }
        continue;
      }
      grids.push_back({ announcedGrid(input, this->IsDensityOnPoints(input, port)), "" });
    }
  }
  for (const NamedGrid& grid : grids)
  {
    if (grid.Grid.IsEmpty())
    {
      return 1;
    }
  }
  if (grids.empty())
  {
    return 1;
  }
  announceDensity(commonGrid(grids, this->Dimensions), outputVector->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
std::vector<BlendInput> vtkTransportBlend::ReadInputs(
  vtkInformationVector** inputVector, const char* const* names)
{
  const std::vector<GivenInput> allGiven = gatherInputs(inputVector, this->GetNumberOfInputPorts());
  std::vector<BlendInput> inputs;
  for (const GivenInput& given : allGiven)
  {
    inputs.emplace_back();
    BlendInput& input = inputs.back();
    const std::size_t number = inputs.size();
    input.Name = names
      ? names[number - 1]
      : "Input " + std::to_string(number) + " of " + std::to_string(allGiven.size());
    input.PositionName = names ? input.Name + "Position" : "";
    try
    {
      input.Density = this->ReadDensity(given.Data, given.Port);
    }
    catch (const Failure& failure)
    {
      throw Failure(input.Name, failure);
    }
    if (!input.Density)
    {
      return {};
    }
  }
  return inputs;
}

//------------------------------------------------------------------------------
void vtkTransportBlend::WarnOfMoved(std::int64_t particles)
{
  if (particles > 0)
  {
    vtkWarningMacro(<< particles << (particles == 1 ? " particle" : " particles")
                    << " in empty cells moved to the nearest cell with mass (more "
                       "NumberOfSteps may spare them that)");
  }
}

//------------------------------------------------------------------------------
void vtkTransportBlend::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "ParticlesPerCell: " << this->ParticlesPerCell << "\n";
  os << indent << "MassMode: " << this->GetMassModeAsString() << "\n";
  this->GetSplatSettings().Print(os, indent);
}
VTK_ABI_NAMESPACE_END
