// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDensityAlgorithm.h"

#include "Bridge/PropertyCheck.h"

#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

VTK_ABI_NAMESPACE_BEGIN

namespace
{
const char* const NegativeValuesTexts[] = { "Error", "Clamp" };
}

//------------------------------------------------------------------------------
vtkDensityAlgorithm::vtkDensityAlgorithm()
  : Component(-1)
  , InvertDensity(false)
  , NegativeValues(NEGATIVE_VALUES_ERROR)
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
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
    return this->RequestInformation(request, inputVector, outputVector);
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    return this->RequestUpdateExtent(request, inputVector, outputVector);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->RequestData(request, inputVector, outputVector);
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
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputVector[port]->GetInformationObject(i);
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
  return 1;
}

//------------------------------------------------------------------------------
void vtkDensityAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Component: " << this->Component << "\n";
  os << indent << "InvertDensity: " << (this->InvertDensity ? "On" : "Off") << "\n";
  os << indent << "NegativeValues: " << this->GetNegativeValuesAsString() << "\n";
}
VTK_ABI_NAMESPACE_END
