// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDensityAlgorithm.h"

#include "Bridge/DensityImage.h"
#include "Bridge/GuardedRun.h"
#include "Bridge/PropertyCheck.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <set>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace
{
// The executive hands on the first input's times alone; the outputs change with those of all.
void publishTimes(
  vtkInformationVector** inputVector, int numberOfPorts, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  std::set<double> steps;
  std::set<double> ends;
  for (int port = 0; port < numberOfPorts; ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputVector[port]->GetInformationObject(i);
      if (input->Has(Pipeline::TIME_STEPS()))
      {
        const double* times = input->Get(Pipeline::TIME_STEPS());
        steps.insert(times, times + input->Length(Pipeline::TIME_STEPS()));
      }
      if (input->Has(Pipeline::TIME_RANGE()))
      {
        const double* range = input->Get(Pipeline::TIME_RANGE());
        ends.insert(range, range + input->Length(Pipeline::TIME_RANGE()));
      }
    }
  }
  const std::vector<double> times(steps.begin(), steps.end());
  for (int i = 0; i < outputVector->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* output = outputVector->GetInformationObject(i);
    if (!times.empty())
    {
      output->Set(Pipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    }
    if (!ends.empty())
    {
      const double range[2] = { *ends.begin(), *ends.rbegin() };
      output->Set(Pipeline::TIME_RANGE(), range, 2);
    }
  }
}

const char* const NegativeValuesTexts[] = { "Error", "Clamp" };

// The names of the arrays that there are to choose from.
std::string listArrays(vtkDataSetAttributes* attributes, const char* owner)
{
  std::string list;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = attributes->GetArray(i))
    {
      const char* name = array->GetName();
      list += (list.empty() ? "" : ", ") + std::string(name ? name : "(no name)");
    }
  }
  return list.empty() ? std::string("no ") + owner + " arrays" : list + " (" + owner + ")";
}

// What is meant where no name is given, as by a host that has not seen the data yet: the active
// scalars of the points, else of the cells, else the only array that there is.
vtkDataArray* defaultArray(vtkImageData* image, int& association)
{
  vtkDataArray* only = nullptr;
  int count = 0;
  for (const int owner :
    { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
  {
    vtkDataSetAttributes* attributes = image->GetAttributes(owner);
    if (vtkDataArray* scalars = attributes->GetScalars())
    {
      association = owner;
      return scalars;
    }
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = attributes->GetArray(i);
      if (array && array != attributes->GetArray(vtkDataSetAttributes::GhostArrayName()))
      {
        association = owner;
        only = array;
        ++count;
      }
    }
  }
  return count == 1 ? only : nullptr;
}
} // namespace

//------------------------------------------------------------------------------
vtkDensityAlgorithm::vtkDensityAlgorithm(int densityPort)
  : Component(-1)
  , InvertDensity(false)
  , NegativeValues(NEGATIVE_VALUES_ERROR)
  , DensityPort(densityPort)
{
  this->SetInputArrayToProcess(0, densityPort, 0,
    vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkDensityAlgorithm::~vtkDensityAlgorithm() = default;

//------------------------------------------------------------------------------
const char* vtkDensityAlgorithm::GetNegativeValuesAsString()
{
  return RectifiedTransport::choiceText(NegativeValuesTexts, this->NegativeValues);
}

//------------------------------------------------------------------------------
void vtkDensityAlgorithm::SetInputData(int port, vtkDataObject* input)
{
  this->SetInputDataInternal(port, input);
}

//------------------------------------------------------------------------------
vtkTypeBool vtkDensityAlgorithm::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->RequestDataObject(request, inputVector, outputVector);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    publishTimes(inputVector, this->GetNumberOfInputPorts(), outputVector);
    return this->RequestInformation(request, inputVector, outputVector);
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    return this->RequestUpdateExtent(request, inputVector, outputVector);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return RectifiedTransport::runGuarded(
      this, outputVector, [&]() { return this->RequestData(request, inputVector, outputVector); });
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkDensityAlgorithm::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1; // the executive makes what the ports' information names
}

//------------------------------------------------------------------------------
int vtkDensityAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

//------------------------------------------------------------------------------
int vtkDensityAlgorithm::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    vtkDensityAlgorithm::RequestWhole(inputVector[port]);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkDensityAlgorithm::RequestWhole(vtkInformationVector* port)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int i = 0; i < port->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* input = port->GetInformationObject(i);
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    if (input->Has(Pipeline::WHOLE_EXTENT()))
    {
      int extent[6];
      input->Get(Pipeline::WHOLE_EXTENT(), extent);
      input->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
    }
  }
}

//------------------------------------------------------------------------------
RectifiedTransport::DensityImage* vtkDensityAlgorithm::NewDensity(
  vtkInformationVector** inputVector)
{
  return this->NewDensity(vtkDataObject::GetData(inputVector[this->DensityPort], 0));
}

//------------------------------------------------------------------------------
RectifiedTransport::DensityImage* vtkDensityAlgorithm::NewDensity(
  vtkDataObject* input, int arrayIndex)
{
  RectifiedTransport::requireChoice("NegativeValues", this->NegativeValues, NegativeValuesTexts);
  vtkImageData* image = vtkImageData::SafeDownCast(input);
  if (input && !image)
  {
    // Of a composite input; the executive refuses others.
    throw RectifiedTransport::Failure(std::string("The density has a block of type ") +
      input->GetClassName() + "; it must be a vtkImageData, as Resample To Image makes one of it");
  }
  if (!image || image->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  vtkInformation* choice = this->GetInputArrayInformation(arrayIndex);
  int association = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  if (association != vtkDataObject::FIELD_ASSOCIATION_POINTS &&
    association != vtkDataObject::FIELD_ASSOCIATION_CELLS &&
    association != vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS)
  {
    throw RectifiedTransport::Failure("The field association of the density array is " +
      std::to_string(association) + "; it must be 0 (points), 1 (cells) or 3 (points, then cells)");
  }
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  vtkAbstractArray* chosen = this->FindDensityArray(image, arrayIndex, association);
  vtkDataArray* array = vtkDataArray::SafeDownCast(chosen);
  if (!array)
  {
    throw RectifiedTransport::Failure(
      (chosen ? "The density array '" + std::string(name ? name : "") + "' is not numeric"
          : name && *name ? "The input image has no density array '" + std::string(name) + "'"
                          : std::string("The input image has no active scalars for a density")) +
      "; it has " + listArrays(image->GetPointData(), "point") + " and " +
      listArrays(image->GetCellData(), "cell"));
  }
  RectifiedTransport::DensityRules rules;
  rules.Component = this->Component;
  rules.Invert = this->InvertDensity != 0;
  rules.ClampNegative = this->NegativeValues == NEGATIVE_VALUES_CLAMP;
  return new RectifiedTransport::DensityImage(
    image, array, association == vtkDataObject::FIELD_ASSOCIATION_POINTS, rules);
}

//------------------------------------------------------------------------------
vtkAbstractArray* vtkDensityAlgorithm::FindDensityArray(
  vtkImageData* image, int arrayIndex, int& association)
{
  vtkInformation* choice = this->GetInputArrayInformation(arrayIndex);
  association = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  vtkAbstractArray* chosen = this->GetInputAbstractArrayToProcess(arrayIndex, image, association);
  return chosen || (name && *name) ? chosen : defaultArray(image, association);
}

//------------------------------------------------------------------------------
void vtkDensityAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Component: " << this->Component << "\n";
  os << indent << "InvertDensity: " << (this->InvertDensity ? "On" : "Off") << "\n";
  os << indent << "NegativeValues: " << this->GetNegativeValuesAsString() << "\n";
  os << indent << "DensityPort: " << this->DensityPort << "\n";
}
VTK_ABI_NAMESPACE_END
