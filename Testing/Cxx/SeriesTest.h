// SPDX-License-Identifier: BSD-3-Clause
// Series of images, for filters that request several time steps.
#ifndef SeriesTest_h
#define SeriesTest_h

#include "TestData.h"
#include "TestSource.h"
#include "TimesTest.h"

#include "vtkMatrix3x3.h"

#include <algorithm>
#include <utility>

using Images = std::vector<vtkSmartPointer<vtkImageData>>;

// A source that has an image for each time step, and a record of the times that are requested.
class ImageSeries
{
public:
  // Without times the source announces none, and always gives the first image.
  ImageSeries(Images images, Times times)
    : Steps(std::move(images))
    , StepTimes(std::move(times))
  {
    this->Source->Publish = [this](vtkInformation* output) {
      vtkImageData* first = this->Steps.front();
      output->Set(Pipeline::WHOLE_EXTENT(), first->GetExtent(), 6);
      output->Set(vtkDataObject::ORIGIN(), first->GetOrigin(), 3);
      output->Set(vtkDataObject::SPACING(), first->GetSpacing(), 3);
      output->Set(vtkDataObject::DIRECTION(), first->GetDirectionMatrix()->GetData(), 9);
      output->Remove(Pipeline::TIME_STEPS());
      output->Remove(Pipeline::TIME_RANGE());
      if (!this->StepTimes.empty())
      {
        publishTimes(output, this->StepTimes);
      }
    };
    this->Source->Make = [this](vtkInformation* output) { return this->Make(output); };
  }
  ImageSeries(const ImageSeries&) = delete;
  ImageSeries& operator=(const ImageSeries&) = delete;

  vtkAlgorithmOutput* Port() { return this->Source->GetOutputPort(); }
  // To be called after a change of the steps or their times.
  void Modified() { this->Source->Modified(); }

  Images Steps;
  Times StepTimes;
  Times Requested;

private:
  vtkSmartPointer<vtkDataObject> Make(vtkInformation* output)
  {
    auto image = vtkSmartPointer<vtkImageData>::New();
    if (this->StepTimes.empty())
    {
      image->ShallowCopy(this->Steps.front());
      return image;
    }
    const double time = output->Has(Pipeline::UPDATE_TIME_STEP())
      ? output->Get(Pipeline::UPDATE_TIME_STEP())
      : this->StepTimes.front();
    this->Requested.push_back(time);
    const auto found = std::find(this->StepTimes.begin(), this->StepTimes.end(), time);
    const auto step = found == this->StepTimes.end() ? 0 : found - this->StepTimes.begin();
    image->ShallowCopy(this->Steps[static_cast<std::size_t>(step)]);
    image->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return image;
  }

  vtkNew<ImageSource> Source;
};

#endif
