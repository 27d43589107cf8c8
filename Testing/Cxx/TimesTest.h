// SPDX-License-Identifier: BSD-3-Clause
// Filters that choose a time, as those of VTK do.
#ifndef TimesTest_h
#define TimesTest_h

#include "vtkDataObject.h"
#include "vtkImageAlgorithm.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <vector>

using Pipeline = vtkStreamingDemandDrivenPipeline;
using Times = std::vector<double>;

inline void publishTimes(vtkInformation* output, const Times& times)
{
  const double range[2] = { times.front(), times.back() };
  output->Set(Pipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
  output->Set(Pipeline::TIME_RANGE(), range, 2);
}

// How a filter chooses a time.
enum class Choice
{
  Pass,   // passes the request
  One,    // has one time, and requests it
  Kept,   // the same, and keeps its data; runs once more for the time of the pipeline
  Shifted // has all times, earlier by `Time`
};

class TimeFilter : public vtkImageAlgorithm
{
public:
  static TimeFilter* New();
  vtkTypeMacro(TimeFilter, vtkImageAlgorithm);
  Choice How = Choice::Pass;
  double Time = 0.0;
  bool Fails = false;

protected:
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    this->Cache = nullptr;
    vtkInformation* input = inputs[0]->GetInformationObject(0);
    Times times(static_cast<std::size_t>(input->Length(Pipeline::TIME_STEPS())), this->Time);
    for (std::size_t i = 0; i < times.size() && this->How == Choice::Shifted; ++i)
    {
      times[i] = input->Get(Pipeline::TIME_STEPS(), static_cast<int>(i)) - this->Time;
    }
    if (this->How != Choice::Pass)
    {
      publishTimes(outputs->GetInformationObject(0), times);
    }
    return 1;
  }
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    vtkInformation* input = inputs[0]->GetInformationObject(0);
    vtkInformation* output = outputs->GetInformationObject(0);
    if (this->How == Choice::Shifted && output->Has(Pipeline::UPDATE_TIME_STEP()))
    {
      input->Set(
        Pipeline::UPDATE_TIME_STEP(), output->Get(Pipeline::UPDATE_TIME_STEP()) + this->Time);
    }
    if (this->How == Choice::One && output->Has(Pipeline::UPDATE_TIME_STEP()))
    {
      input->Set(Pipeline::UPDATE_TIME_STEP(), this->Time);
    }
    if (this->How == Choice::Kept && !this->Cache)
    {
      this->PipelineTime = input->Get(Pipeline::UPDATE_TIME_STEP());
      input->Set(Pipeline::UPDATE_TIME_STEP(), this->Time);
    }
    else if (this->How == Choice::Kept && this->IsFirst)
    {
      input->Set(Pipeline::UPDATE_TIME_STEP(), this->PipelineTime);
    }
    return 1;
  }
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    vtkImageData* input = vtkImageData::GetData(inputs[0]);
    vtkImageData* output = vtkImageData::GetData(outputs);
    output->ShallowCopy(input);
    if (this->Fails)
    {
      vtkErrorMacro("It fails");
      return 0;
    }
    vtkInformation* information = output->GetInformation();
    if (this->How == Choice::Shifted)
    {
      information->Set(vtkDataObject::DATA_TIME_STEP(),
        input->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()) - this->Time);
    }
    if (this->How != Choice::Kept)
    {
      return 1;
    }
    if (!this->Cache)
    {
      this->Cache = vtkSmartPointer<vtkImageData>::New();
      this->Cache->DeepCopy(input);
      this->IsFirst = true;
      request->Set(Pipeline::CONTINUE_EXECUTING(), 1);
    }
    else if (this->IsFirst)
    {
      this->IsFirst = false;
      request->Remove(Pipeline::CONTINUE_EXECUTING());
    }
    output->ShallowCopy(this->Cache);
    return 1;
  }

private:
  vtkSmartPointer<vtkImageData> Cache;
  double PipelineTime = 0.0;
  bool IsFirst = false;
};
inline TimeFilter* TimeFilter::New()
{
  VTK_STANDARD_NEW_BODY(TimeFilter);
}

inline vtkSmartPointer<TimeFilter> choose(vtkAlgorithm* source, Choice how, double time = 0.0)
{
  auto filter = vtkSmartPointer<TimeFilter>::New();
  filter->How = how;
  filter->Time = time;
  filter->SetInputConnection(source->GetOutputPort());
  return filter;
}

#endif
