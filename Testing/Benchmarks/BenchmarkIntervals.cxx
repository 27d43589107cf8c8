// SPDX-License-Identifier: BSD-3-Clause
// Transport Temporal Interpolator on one thread: a time in an interval that is new, and in one that
// is kept.
#include "BenchmarkInputs.h"
#include "FilterRuns.h"
#include "OptimalPairs.h"

#include <vtkImageAlgorithm.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTransportTemporalInterpolator.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// Two images, at the times 0 and 1.
class PairSeries : public vtkImageAlgorithm
{
public:
  static PairSeries* New();
  vtkTypeMacro(PairSeries, vtkImageAlgorithm);

  std::array<vtkSmartPointer<vtkImageData>, 2> Steps;

protected:
  PairSeries() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    const double times[2] = { 0.0, 1.0 };
    vtkInformation* information = outputs->GetInformationObject(0);
    information->Set(
      vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), this->Steps[0]->GetExtent(), 6);
    information->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, 2);
    information->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), times, 2);
    return 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* information = outputs->GetInformationObject(0);
    const double time = information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    vtkImageData* output = vtkImageData::GetData(outputs);
    output->ShallowCopy(this->Steps[time < 0.5 ? 0 : 1]);
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return 1;
  }
};
vtkStandardNewMacro(PairSeries);

// `isNew`: the first step is another one each time.
template <int D>
void interpolate(benchmark::State& state, const std::string& name, bool isNew)
{
  const OptimalPair<D> pair = optimalPair<D>(name, state.range(0));
  const TestDensity<D> source = pair.Source();
  const TestDensity<D> target = pair.Target();
  vtkNew<PairSeries> series;
  series->Steps = { newImage<D>(source.Size, source.Values),
    newImage<D>(target.Size, target.Values) };
  vtkDataArray* first = series->Steps[0]->GetCellData()->GetScalars();
  const auto place = static_cast<vtkIdType>(
    std::max_element(source.Values.begin(), source.Values.end()) - source.Values.begin());
  vtkNew<vtkTransportTemporalInterpolator> filter;
  filter->SetThreadingToSerial();
  filter->SetInputConnection(series->GetOutputPort());
  filter->UpdateTimeStep(0.25);
  int count = 0;
  for (auto _ : state)
  {
    ++count;
    if (isNew)
    {
      first->SetComponent(place, 0, first->GetComponent(place, 0) * 0.999);
      first->Modified();
      series->Modified();
    }
    filter->UpdateTimeStep(isNew ? 0.5 : 0.5 + 0.01 * (count % 40));
  }
}

template <int D>
void addIntervals(const std::string& name, const std::vector<std::int64_t>& sides)
{
  for (const bool isNew : { true, false })
  {
    const std::string start = "Intervals" + std::to_string(D) + "D/";
    benchmark::RegisterBenchmark((start + (isNew ? "new/" : "kept/") + name).c_str(),
      [=](benchmark::State& state) { interpolate<D>(state, name, isNew); })
      ->ArgsProduct({ sides })
      ->Unit(benchmark::kMillisecond);
  }
}

const bool areRegistered = []() {
  addIntervals<2>("blobs", { 128, 256, 512 });
  addIntervals<2>("star_ring", { 128, 256, 512 });
  addIntervals<3>("blobs", { 64 });
  addIntervals<3>("animal_ring", { 64 });
  return true;
}();

} // namespace
} // namespace RectifiedTransport
