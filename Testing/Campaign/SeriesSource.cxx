// SPDX-License-Identifier: BSD-3-Clause
#include "SeriesSource.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Campaign
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

class SeriesSource : public vtkAlgorithm
{
public:
  static SeriesSource* New();
  vtkTypeMacro(SeriesSource, vtkAlgorithm);

  std::vector<SeriesStep> Steps;

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* output = outputs->GetInformationObject(0);
    if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
    {
      const auto made = vtkSmartPointer<vtkDataObject>::Take(this->Steps[0].Data->NewInstance());
      output->Set(vtkDataObject::DATA_OBJECT(), made);
    }
    else if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
    {
      this->Announce(output);
    }
    else if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
    {
      const SeriesStep& step = this->StepFor(output);
      vtkDataObject* data = output->Get(vtkDataObject::DATA_OBJECT());
      data->ShallowCopy(step.Data);
      data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), step.Time);
    }
    return 1;
  }

protected:
  SeriesSource()
  {
    this->SetNumberOfInputPorts(0);
    this->SetNumberOfOutputPorts(1);
  }

  int FillOutputPortInformation(int, vtkInformation* information) override
  {
    information->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
    return 1;
  }

private:
  void Announce(vtkInformation* output) const
  {
    vtkTrivialProducer::FillOutputDataInformation(this->Steps[0].Data, output);
    std::vector<double> times;
    for (const SeriesStep& step : this->Steps)
    {
      times.push_back(step.Time);
    }
    const auto ends = std::minmax_element(times.begin(), times.end());
    const double range[2] = { *ends.first, *ends.second };
    output->Set(Pipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    output->Set(Pipeline::TIME_RANGE(), range, 2);
    output->Set(CAN_HANDLE_PIECE_REQUEST(), 1);
  }

  const SeriesStep& StepFor(vtkInformation* output) const
  {
    if (!output->Has(Pipeline::UPDATE_TIME_STEP()))
    {
      return this->Steps[0];
    }
    const double time = output->Get(Pipeline::UPDATE_TIME_STEP());
    const auto distance = [=](const SeriesStep& step) {
      const double way = std::abs(step.Time - time);
      return std::isnan(way) ? std::numeric_limits<double>::infinity() : way;
    };
    return *std::min_element(this->Steps.begin(), this->Steps.end(),
      [&](const SeriesStep& a, const SeriesStep& b) { return distance(a) < distance(b); });
  }
};

vtkStandardNewMacro(SeriesSource);

} // namespace

vtkSmartPointer<vtkAlgorithm> newSeries(const std::vector<SeriesStep>& steps)
{
  const auto source = vtkSmartPointer<SeriesSource>::New();
  source->Steps = steps;
  return source;
}

} // namespace Campaign
