// SPDX-License-Identifier: BSD-3-Clause
// With TrackParticles, vtkTransportTemporalInterpolator follows the same particles through all
// steps.
#include "TemporalTest.h"

namespace
{

constexpr int blocks = 6; // along each axis

// The masses of blocks of a density.
Values blockMasses(const Values& density)
{
  constexpr int width = blobSide / blocks;
  Values masses(blocks * blocks, 0.0);
  for (std::size_t i = 0; i < density.size(); ++i)
  {
    masses[i % blobSide / width + blocks * (i / blobSide / width)] += density[i];
  }
  return masses;
}

vtkSmartPointer<vtkTransportTemporalInterpolator> makeTracking(
  ImageSeries& series, int method = vtkTransportTemporalInterpolator::OPTIMAL)
{
  auto filter = makeInterpolator(series, method);
  filter->TrackParticlesOn();
  return filter;
}

Values meanOf(const Values& a, const Values& b)
{
  Values mean = a;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    mean[i] = 0.5 * (a[i] + b[i]);
  }
  return mean;
}

// Numbers and shares of the mass stay; positions are linear in time within an interval, and at a
// step as dense as the step.
void checkParticles(Checks& checks)
{
  const Images steps = movingBlobs();
  for (const int method : temporalMethods)
  {
    ImageSeries series(steps, blobTimes);
    auto filter = makeTracking(series, method);
    std::vector<Values> positions;
    Values numbers;
    for (const double time : { 0.0, 0.5, 1.0, 1.5, 2.0 })
    {
      const Values density = densityAt(filter, time);
      positions.push_back(coordinates(filter->GetParticles()));
      const Values seeds = particleValues(filter, "SeedId");
      CHECK(checks, !seeds.empty() && (numbers.empty() || seeds == numbers));
      numbers = seeds;
      for (std::size_t i = 0; i < seeds.size(); ++i)
      {
        CHECK(checks, seeds[i] == static_cast<double>(i));
      }
      const Values masses = particleValues(filter, "Mass");
      CHECK(checks, masses == Values(masses.size(), masses[0]));
      if (time == std::floor(time))
      {
        const Values truth = imageValues(steps[static_cast<std::size_t>(time)], "Density");
        CHECK_NEAR(checks, sumOf(masses) / sumOf(truth), 1.0, 1e-9);
        CHECK_NEAR(checks, relativeDifference(blockMasses(density), blockMasses(truth)), 0.0, 0.03);
      }
    }
    CHECK_NEAR(
      checks, largestDifference(positions[1], meanOf(positions[0], positions[2])), 0.0, 1e-9);
    CHECK_NEAR(
      checks, largestDifference(positions[3], meanOf(positions[2], positions[4])), 0.0, 1e-9);
  }
}

// A blob that only moves, in two directions: every particle keeps its place in it.
void checkTranslations(Checks& checks)
{
  ImageSeries series(
    { makeBlob(12, 14, 2.5), makeBlob(22, 14, 2.5), makeBlob(28, 32, 2.5) }, blobTimes);
  auto filter = makeTracking(series);
  filter->UpdateTimeStep(0.0);
  const Values before = coordinates(filter->GetParticles());
  filter->UpdateTimeStep(2.0);
  const Values after = coordinates(filter->GetParticles());
  double squared = 0.0;
  for (std::size_t i = 0; i < before.size(); i += 3)
  {
    squared +=
      std::pow(after[i] - before[i] - 16.0, 2) + std::pow(after[i + 1] - before[i + 1] - 18.0, 2);
  }
  CHECK_NEAR(checks, std::sqrt(3.0 * squared / static_cast<double>(before.size())), 0.0, 0.5);
}

// A late time is as after those before it.
void checkOrder(Checks& checks)
{
  ImageSeries series(movingBlobs(), blobTimes);
  auto late = makeTracking(series);
  const Values found = outputsAt(late, 1.75);
  CHECK(checks, series.Requested == blobTimes);
  auto played = makeTracking(series);
  for (const double time : { 0.0, 1.5, 0.25 })
  {
    played->UpdateTimeStep(time);
  }
  CHECK(checks, outputsAt(played, 1.75) == found);
  // The samples of the first step count as one.
  CHECK(checks, played->GetNumberOfMaps() == 3 && late->GetNumberOfMaps() == 3);
}

// A change of an early step, of a property and of what is read of the steps.
void checkChanges(Checks& checks)
{
  ImageSeries series(movingBlobs(), blobTimes);
  auto filter = makeTracking(series);
  Values before = outputsAt(filter, 1.5);
  series.Modified();
  CHECK(checks, outputsAt(filter, 1.5) == before && filter->GetNumberOfMaps() == 3);
  int method = vtkTransportTemporalInterpolator::OPTIMAL;
  int particles = 1;
  bool inverts = false;
  const auto isAsNew = [&]() {
    filter->SetMethod(method);
    filter->SetParticlesPerCell(particles);
    filter->SetInvertDensity(inverts);
    const Values now = outputsAt(filter, 1.5);
    ImageSeries other(series.Steps, blobTimes);
    auto fresh = makeTracking(other, method);
    fresh->SetParticlesPerCell(particles);
    fresh->SetInvertDensity(inverts);
    const bool isSame = now != before && now == outputsAt(fresh, 1.5);
    before = now;
    return isSame;
  };
  expectAfterEach(checks, isAsNew, true,
    { { "the first step",
        [&]() {
          series.Steps[0] = makeBlob(8, 20);
          series.Modified();
        } },
      { "Method", [&]() { method = vtkTransportTemporalInterpolator::RECTIFIED_FLOW; } },
      { "ParticlesPerCell", [&]() { particles = 2; } },
      { "InvertDensity", [&]() { inverts = true; } } },
    __LINE__);
}

// Particles cannot disappear on the way; without TrackParticles mass can.
void checkNoMass(Checks& checks)
{
  ImageSeries series({ makeBlob(12, 14), makeBlob(12, 14, 5.0, 0.0), makeBlob(34, 34) }, blobTimes);
  auto filter = makeTracking(series);
  requestTime(filter, 1.5);
  ErrorTest test(checks, filter);
  test.Expect(
    "Time step 2 of 3 (t = 1) has no mass, and TrackParticles follows particles through all "
    "steps; TrackParticles Off lets mass appear and disappear",
    __LINE__);
  filter->TrackParticlesOff();
  test.ExpectNone(__LINE__);
  CHECK(checks, filter->GetParticles()->GetNumberOfPoints() > 0);
  CHECK(checks, pointArray(filter->GetParticles(), "SeedId") == nullptr);
}

} // namespace

int TestTemporalIdentity(int, char*[])
{
  return runChecks({ checkParticles, checkTranslations, checkOrder, checkChanges, checkNoMass });
}
