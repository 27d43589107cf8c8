// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportInterpolator.h"

#include "Bridge/Ensembles/DensityBlend.h"
#include "Bridge/Run/Inputs/SeparateInputs.h"
#include "Bridge/Run/Pipeline/OutputInformation.h"
#include "Bridge/Run/Settings/TargetArray.h"
#include "Core/Messages/PropertyCheck.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportInterpolator);

namespace
{
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;
using Pipeline = vtkStreamingDemandDrivenPipeline;

// Bounds the list of time steps, which hosts display.
constexpr int MaximumNumberOfTimeSteps = 1000000;

// RequestInformation leaves out a number that RequestData refuses, with its message.
bool isNumberOfTimeSteps(int count)
{
  return count >= 2 && count <= MaximumNumberOfTimeSteps;
}
} // namespace

//------------------------------------------------------------------------------
vtkTransportInterpolator::vtkTransportInterpolator()
  : vtkTransportBlend(false)
{
  this->AddDensityPort(PORT_PARTITIONED_DENSITY);
  this->AddDensityPort(PORT_PARTITIONED_DENSITY);
  vtkTransportInterpolator::SetInputArrayToProcess(
    1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "");
}

//------------------------------------------------------------------------------
void vtkTransportInterpolator::SetInputArrayToProcess(
  int idx, int port, int connection, int fieldAssociation, const char* name)
{
  const auto [index, arrayPort] = targetArray(idx, port);
  this->Superclass::SetInputArrayToProcess(index, arrayPort, connection, fieldAssociation, name);
}

//------------------------------------------------------------------------------
int vtkTransportInterpolator::RequestUpdateTime(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  this->RequestFirstTime(inputVector);
  return 1;
}

//------------------------------------------------------------------------------
// With PublishTime, the time that is requested downstream is the parameter of the blend, from 0 to
// 1. Requesting it from the inputs would read other data for each parameter: their first time
// stands for the data, the first step or, without steps, the begin of the range.
void vtkTransportInterpolator::RequestFirstTime(vtkInformationVector** inputVector)
{
  if (!this->PublishTime)
  {
    return;
  }
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    vtkInformation* input = inputVector[port]->GetInformationObject(0);
    if (!input)
    {
      continue;
    }
    // Without a requested time a source with other consumers would keep the time of their last
    // request.
    if (input->Has(Pipeline::TIME_STEPS()) && input->Length(Pipeline::TIME_STEPS()) > 0)
    {
      input->Set(Pipeline::UPDATE_TIME_STEP(), input->Get(Pipeline::TIME_STEPS(), 0));
    }
    else if (input->Has(Pipeline::TIME_RANGE()))
    {
      input->Set(Pipeline::UPDATE_TIME_STEP(), input->Get(Pipeline::TIME_RANGE(), 0));
    }
    else
    {
      input->Remove(Pipeline::UPDATE_TIME_STEP());
    }
  }
  SeparateInputs::RequestFirstTimes(this, inputVector);
}

//------------------------------------------------------------------------------
int vtkTransportInterpolator::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (this->PublishTime && isNumberOfTimeSteps(this->NumberOfTimeSteps))
  {
    std::vector<double> steps;
    for (int i = 0; i < this->NumberOfTimeSteps; ++i)
    {
      steps.push_back(i / (this->NumberOfTimeSteps - 1.0));
    }
    announceTimes(outputVector, { 0.0, 1.0 }, steps);
  }
  return this->Superclass::RequestInformation(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkTransportInterpolator::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->RequestFirstTime(inputVector);
  return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
// The pipeline's time, clamped to [0, 1], if it is published and requested; else the property.
double vtkTransportInterpolator::FindParameter(
  vtkInformation* request, vtkInformationVector* outputVector)
{
  const int port = std::max(0, request->Get(Pipeline::FROM_OUTPUT_PORT()));
  vtkInformation* output = outputVector->GetInformationObject(port);
  if (!this->PublishTime || !output->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    return this->Parameter;
  }
  const double time = output->Get(Pipeline::UPDATE_TIME_STEP());
  requireThat(!std::isnan(time), "The pipeline's time", time, "a number");
  return std::clamp(time, 0.0, 1.0);
}

//------------------------------------------------------------------------------
int vtkTransportInterpolator::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireThat(
    this->Parameter >= 0.0 && this->Parameter <= 1.0, "Parameter", this->Parameter, "from 0 to 1");
  requireThat(isNumberOfTimeSteps(this->NumberOfTimeSteps), "NumberOfTimeSteps",
    this->NumberOfTimeSteps, "from 2 to 1000000");
  // Linear weights 1 - s and s of the two maps from the uniform measure give the blend at s
  // (Section 3.4).
  const double parameter = this->FindParameter(request, outputVector);
  BlendSettings settings = this->GetBlendSettings();
  settings.ComparesEnds = true;
  static const char* const names[] = { "Source", "Target" };
  this->BlendInputs(inputVector, outputVector, settings, names, { 1.0 - parameter, parameter });
  if (this->PublishTime)
  {
    stampTime(outputVector, parameter);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportInterpolator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Parameter: " << this->Parameter << "\n";
  os << indent << "PublishTime: " << (this->PublishTime ? "On" : "Off") << "\n";
  os << indent << "NumberOfTimeSteps: " << this->NumberOfTimeSteps << "\n";
}
VTK_ABI_NAMESPACE_END
