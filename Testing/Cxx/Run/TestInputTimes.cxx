// SPDX-License-Identifier: BSD-3-Clause
// Filters of two inputs follow the time of either.
#include "TestSource.h"
#include "WarpTest.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkEqualMassCells.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkTransportInterpolator.h"
#include "vtkTransportQuality.h"
#include "vtkVariant.h"

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

void publish(vtkInformation* output, const std::vector<double>& times)
{
  const double range[2] = { times.front(), times.back() };
  output->Set(Pipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
  output->Set(Pipeline::TIME_RANGE(), range, 2);
}

double askedTime(vtkInformation* output)
{
  return output->Has(Pipeline::UPDATE_TIME_STEP()) ? output->Get(Pipeline::UPDATE_TIME_STEP())
                                                   : 0.0;
}

// A density that is another one at every time.
vtkSmartPointer<ImageSource> makeTimedImages()
{
  auto source = vtkSmartPointer<ImageSource>::New();
  source->Publish = [](vtkInformation* output) {
    const int extent[6] = { 0, 8, 0, 6, 0, 0 };
    output->Set(Pipeline::WHOLE_EXTENT(), extent, 6);
    publish(output, { 0.0, 1.0, 3.0 });
  };
  source->Make = [](vtkInformation* output) {
    const auto time = static_cast<vtkIdType>(askedTime(output));
    return makeImage(9, 7, 1, true, [=](vtkIdType i) { return bumpy(i + 5 * time); });
  };
  return source;
}

// A point that moves.
vtkSmartPointer<PointSource> makeTimedPoints()
{
  auto source = vtkSmartPointer<PointSource>::New();
  source->Publish = [](vtkInformation* output) { publish(output, { 0.5, 1.0 }); };
  source->Make = [](vtkInformation* output) {
    return makePoints({ 3.0 + askedTime(output), 2, 0, 4, 2, 0 });
  };
  return source;
}

void expectTimes(
  Checks& checks, vtkAlgorithm* filter, const std::vector<double>& expected, int line)
{
  filter->UpdateInformation();
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* output = filter->GetOutputInformation(port);
    std::vector<double> times(static_cast<std::size_t>(output->Length(Pipeline::TIME_STEPS())));
    if (!times.empty())
    {
      output->Get(Pipeline::TIME_STEPS(), times.data());
    }
    checks.That(times == expected, "time steps", line);
    const double* range = output->Get(Pipeline::TIME_RANGE());
    checks.That(expected.empty()
        ? range == nullptr
        : range && range[0] == expected.front() && range[1] == expected.back(),
      "time range", line);
  }
}

// A density that changes under points that do not, and the reverse.
void checkWarp(Checks& checks)
{
  auto images = makeTimedImages();
  int runs = 0;
  images->Make = [&runs, make = images->Make](vtkInformation* output) {
    ++runs;
    return make(output);
  };
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputData(makePoints({ 3, 2, 0 }));
  warp->SetDensityConnection(images->GetOutputPort());
  expectTimes(checks, warp, { 0.0, 1.0, 3.0 }, __LINE__);
  std::vector<double> last;
  for (const double time : { 0.0, 1.0, 3.0 })
  {
    warp->UpdateTimeStep(time);
    const std::vector<double> found = displacements(warp);
    CHECK(checks, !found.empty() && found != last);
    last = found;
    vtkInformation* information = warp->GetOutput()->GetInformation();
    CHECK(checks, information->Get(vtkDataObject::DATA_TIME_STEP()) == time);
  }
  CHECK(checks, runs == 3);

  auto points = makeTimedPoints();
  warp->SetInputConnection(points->GetOutputPort());
  expectTimes(checks, warp, { 0.0, 0.5, 1.0, 3.0 }, __LINE__);

  // The tables of a density that stays are kept, and the times of an input go with it.
  warp->SetDensityData(makeImage(9, 7, 1, true, bumpy));
  expectTimes(checks, warp, { 0.5, 1.0 }, __LINE__);
  warp->UpdateTimeStep(0.5);
  const vtkMTimeType built = warp->GetTableBuildTime();
  last = displacements(warp);
  warp->UpdateTimeStep(1.0);
  CHECK(checks, displacements(warp) != last && warp->GetTableBuildTime() == built);
  warp->SetInputData(makePoints({ 3, 2, 0 }));
  expectTimes(checks, warp, {}, __LINE__);
}

void checkQuality(Checks& checks)
{
  auto images = makeTimedImages();
  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(makePoints({ 3, 2, 0, 4, 2, 0 }));
  quality->SetDensityConnection(images->GetOutputPort());
  quality->SetBlockSize(2);
  expectTimes(checks, quality, { 0.0, 1.0, 3.0 }, __LINE__);
  double last = -1.0;
  for (const double time : { 0.0, 1.0, 3.0 })
  {
    quality->UpdateTimeStep(time);
    const double found = quality->GetOutput()->GetValueByName(0, "DensityError").ToDouble();
    CHECK(checks, found != last);
    last = found;
  }
}

void checkRelaxation(Checks& checks)
{
  auto images = makeTimedImages();
  vtkNew<vtkBlueNoiseRelaxation> relaxation;
  relaxation->SetInputData(makePoints({ 3, 2, 0, 4, 2, 0, 5, 4, 0 }));
  relaxation->SetDensityConnection(images->GetOutputPort());
  relaxation->SetMaximumIterations(3);
  expectTimes(checks, relaxation, { 0.0, 1.0, 3.0 }, __LINE__);
  Values last;
  for (const double time : { 0.0, 1.0, 3.0 })
  {
    relaxation->UpdateTimeStep(time);
    const Values found = coordinates(relaxation->GetOutput());
    CHECK(checks, found != last);
    last = found;
  }
  auto points = makeTimedPoints();
  relaxation->SetInputConnection(points->GetOutputPort());
  expectTimes(checks, relaxation, { 0.0, 0.5, 1.0, 3.0 }, __LINE__);
}

// Seeds that move sample a density that stays.
void checkSampler(Checks& checks)
{
  auto seeds = makeTimedPoints();
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(makeImage(9, 7, 1, true, bumpy));
  expectTimes(checks, sampler, {}, __LINE__);
  sampler->SetSeedsConnection(seeds->GetOutputPort());
  expectTimes(checks, sampler, { 0.5, 1.0 }, __LINE__);
  sampler->UpdateTimeStep(0.5);
  const std::vector<double> last = coordinates(sampler->GetOutput());
  sampler->UpdateTimeStep(1.0);
  CHECK(checks, coordinates(sampler->GetOutput()) != last);
}

// Every output follows, whichever is asked.
void checkOutputs(Checks& checks)
{
  auto images = makeTimedImages();
  auto points = makeTimedPoints();
  vtkNew<vtkTransportInterpolator> morph;
  morph->SetInputData(makeImage(9, 7, 1, true, bumpy));
  morph->SetTargetConnection(images->GetOutputPort());
  expectTimes(checks, morph, { 0.0, 1.0, 3.0 }, __LINE__);
  vtkNew<vtkEqualMassCells> cells;
  cells->SetInputConnection(points->GetOutputPort());
  cells->SetDomainConnection(images->GetOutputPort());
  cells->SetResolution(16);
  expectTimes(checks, cells, { 0.0, 0.5, 1.0, 3.0 }, __LINE__);
  for (const double time : { 0.5, 1.0 })
  {
    vtkStreamingDemandDrivenPipeline::SafeDownCast(cells->GetExecutive())
      ->GetOutputInformation(1)
      ->Set(Pipeline::UPDATE_TIME_STEP(), time);
    cells->Update(1);
    CHECK(checks, cells->GetSites()->GetPoint(0)[0] == 3.0 + time);
  }
}

// A time that another consumer has requested of a source, without data yet, stays requested.
void checkRequested(Checks& checks)
{
  auto images = makeTimedImages();
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputData(makePoints({ 3, 2, 0 }));
  warp->SetDensityConnection(images->GetOutputPort());
  images->UpdateInformation();
  images->GetOutputInformation(0)->Set(Pipeline::UPDATE_TIME_STEP(), 3.0);
  warp->UpdateInformation();
  images->Update();
  CHECK(checks, images->GetOutput()->GetCellData()->GetScalars()->GetTuple1(1) == bumpy(16));
}

} // namespace

int TestInputTimes(int, char*[])
{
  return runChecks(
    { checkWarp, checkQuality, checkRelaxation, checkSampler, checkOutputs, checkRequested });
}
