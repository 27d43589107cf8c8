// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Pipeline/OutputInformation.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationInformationVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <set>

namespace RectifiedTransport::Bridge
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

void publishTimes(
  vtkInformationVector** inputVector, int numberOfPorts, vtkInformationVector* outputVector)
{
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
  const std::vector<double> range =
    ends.empty() ? std::vector<double>() : std::vector<double>{ *ends.begin(), *ends.rbegin() };
  announceTimes(outputVector, range, { steps.begin(), steps.end() });
}

namespace
{

// No numbers remove the key.
void setNumbers(
  vtkInformation* info, vtkInformationDoubleVectorKey* key, const std::vector<double>& numbers)
{
  info->Set(key, numbers.empty() ? nullptr : numbers.data(), static_cast<int>(numbers.size()));
}

} // namespace

void announceTimes(vtkInformationVector* outputVector, const std::vector<double>& range,
  const std::vector<double>& steps)
{
  for (int i = 0; i < outputVector->GetNumberOfInformationObjects(); ++i)
  {
    setNumbers(outputVector->GetInformationObject(i), Pipeline::TIME_STEPS(), steps);
    setNumbers(outputVector->GetInformationObject(i), Pipeline::TIME_RANGE(), range);
  }
}

void stampTime(vtkInformationVector* outputVector, double time)
{
  for (int i = 0; i < outputVector->GetNumberOfInformationObjects(); ++i)
  {
    vtkDataObject* data = vtkDataObject::GetData(outputVector, i);
    data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
}

void removeArrayInformation(vtkInformationVector* outputVector)
{
  for (int i = 0; i < outputVector->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* output = outputVector->GetInformationObject(i);
    output->Remove(vtkDataObject::POINT_DATA_VECTOR());
    output->Remove(vtkDataObject::CELL_DATA_VECTOR());
  }
}

void clearImages(vtkInformationVector* outputVector)
{
  for (int i = 0; i < outputVector->GetNumberOfInformationObjects(); ++i)
  {
    if (vtkImageData* image = vtkImageData::GetData(outputVector, i))
    {
      image->SetExtent(0, -1, 0, -1, 0, -1);
      image->GetPointData()->Initialize();
    }
  }
}

} // namespace RectifiedTransport::Bridge
