// SPDX-License-Identifier: BSD-3-Clause
// vtkTransportTemporalInterpolator makes a map for each interval, once, and requests each step of
// the input once, while the last two intervals are used.
#include "TemporalTest.h"

namespace
{

Images fourBlobs()
{
  Images steps = movingBlobs();
  steps.push_back(makeBlob(12, 14));
  return steps;
}

const Times fourTimes = { 0.0, 1.0, 2.0, 3.0 };

void checkIntervals(Checks& checks)
{
  ImageSeries series(fourBlobs(), fourTimes);
  auto filter = makeInterpolator(series);
  const auto mapsAfter = [&](const Times& times) {
    for (const double time : times)
    {
      filter->UpdateTimeStep(time);
    }
    return filter->GetNumberOfMaps();
  };
  CHECK(checks, mapsAfter({ 0.5 }) == 1);
  CHECK(checks, mapsAfter({ 0.7, 0.0, 0.2 }) == 1);
  CHECK(checks, mapsAfter({ 1.5, 0.2, 1.1, 0.9 }) == 2);
  CHECK(checks, series.Requested == Times({ 0.0, 1.0, 2.0 }));
  CHECK(checks, mapsAfter({ 2.5, 0.5 }) == 3);
  // The second interval is not among the last two any more.
  CHECK(checks, mapsAfter({ 1.5 }) == 4);
}

void checkPlaying(Checks& checks)
{
  ImageSeries series(fourBlobs(), fourTimes);
  auto forwards = makeInterpolator(series);
  auto backwards = makeInterpolator(series);
  std::vector<Values> found;
  for (int i = 0; i <= 12; ++i)
  {
    found.push_back(outputsAt(forwards, 0.25 * i));
  }
  for (int i = 12; i >= 0; --i)
  {
    CHECK(checks, outputsAt(backwards, 0.25 * i) == found[static_cast<std::size_t>(i)]);
  }
  CHECK(checks, forwards->GetNumberOfMaps() == 3 && backwards->GetNumberOfMaps() == 3);
}

// Which properties a map depends on; the output depends on all of them.
void checkProperties(Checks& checks)
{
  ImageSeries series(movingBlobs(), blobTimes);
  auto filter = makeInterpolator(series);
  Values before = outputsAt(filter, 0.4);
  vtkIdType maps = filter->GetNumberOfMaps();
  const auto makesMap = [&]() {
    const Values now = outputsAt(filter, 0.4);
    CHECK(checks, now != before);
    before = now;
    const vtkIdType count = filter->GetNumberOfMaps();
    return std::exchange(maps, count) != count;
  };
  expectAfterEach(checks, makesMap, false,
    { { "NearestCell", [&]() { filter->SetKernelToNearestCell(); } },
      { "TriangularShapedCloud", [&]() { filter->SetKernelToTriangularShapedCloud(); } },
      { "Gaussian", [&]() { filter->SetKernelToGaussian(); } },
      { "Radius", [&]() { filter->SetRadius(2.0); } } },
    __LINE__);
  expectAfterEach(checks, makesMap, true,
    { { "Method", [&]() { filter->SetMethodToRectifiedFlow(); } },
      { "ParticlesPerCell", [&]() { filter->SetParticlesPerCell(4); } },
      { "InvertDensity", [&]() { filter->InvertDensityOn(); } } },
    __LINE__);
  ImageSeries other(movingBlobs(), blobTimes);
  auto fresh = makeInterpolator(other, vtkTransportTemporalInterpolator::RECTIFIED_FLOW);
  fresh->SetKernelToGaussian();
  fresh->SetRadius(2.0);
  fresh->SetParticlesPerCell(4);
  fresh->InvertDensityOn();
  CHECK(checks, outputsAt(fresh, 0.4) == before);
}

// A change of the input counts; another object with the same values is no change.
void checkInput(Checks& checks)
{
  ImageSeries series(movingBlobs(), blobTimes);
  auto filter = makeInterpolator(series);
  const Values before = outputsAt(filter, 0.5);
  series.Steps = movingBlobs();
  series.Modified();
  CHECK(checks, outputsAt(filter, 0.5) == before && filter->GetNumberOfMaps() == 1);
  series.Steps[1] = makeBlob(20, 30);
  series.Modified();
  const Values after = outputsAt(filter, 0.5);
  CHECK(checks, after != before && filter->GetNumberOfMaps() == 2);
  CHECK(checks, densityAt(filter, 1.0) == imageValues(series.Steps[1], "Density"));
  ImageSeries other(series.Steps, blobTimes);
  CHECK(checks, outputsAt(makeInterpolator(other), 0.5) == after);
}

// Other times of the same steps, and other lengths of the same values.
void checkTimesAndLengths(Checks& checks)
{
  ImageSeries series(movingBlobs(), blobTimes);
  auto filter = makeInterpolator(series);
  const Values density = densityAt(filter, 0.5);
  const Values velocities = particleValues(filter, "Velocity");
  series.StepTimes = { 0.0, 8.0, 16.0 };
  series.Modified();
  CHECK(checks, densityAt(filter, 4.0) == density);
  Values slower = particleValues(filter, "Velocity");
  for (double& value : slower)
  {
    value *= 8.0;
  }
  CHECK_NEAR(checks, largestDifference(slower, velocities), 0.0, 1e-12);

  const double mass = sumOf(particleValues(filter, "Mass"));
  for (const auto& step : series.Steps)
  {
    step->SetSpacing(2.0, 3.0, 1.0);
  }
  series.Modified();
  filter->UpdateTimeStep(4.0);
  CHECK_NEAR(checks, sumOf(particleValues(filter, "Mass")) / mass, 6.0, 1e-9);
  const double* bounds = filter->GetDensity()->GetBounds();
  CHECK(checks, bounds[1] == 2.0 * blobSide && bounds[3] == 3.0 * blobSide);
}

} // namespace

int TestTemporalKept(int, char*[])
{
  return runChecks(
    { checkIntervals, checkPlaying, checkProperties, checkInput, checkTimesAndLengths });
}
