// SPDX-License-Identifier: BSD-3-Clause
// Steps of vtkTransportTemporalInterpolator on different grids, and what is announced of the image.
#include "InformationTest.h"
#include "TemporalTest.h"

namespace
{

// Twice as many cells of half the width along each axis.
vtkSmartPointer<vtkImageData> makeFine(double x, double y, double width)
{
  constexpr int side = 2 * blobSide;
  auto image = makeImage(side + 1, side + 1, 1, true, [=](vtkIdType i) {
    return blobValue(0.5 * (static_cast<double>(i % side) + 0.5) - x,
      0.5 * (static_cast<double>(i / side) + 0.5) - y, width);
  });
  image->SetSpacing(0.5, 0.5, 1.0);
  return image;
}

// Between two steps of one box the output has the finer cells, at a step those of the step.
void checkSpacings(Checks& checks)
{
  const Images steps = { makeBlob(12, 14), makeFine(30, 30, 5.0) };
  ImageSeries series(steps, { 0.0, 1.0 });
  auto filter = makeInterpolator(series);
  const double mass = 0.5 *
    (sumOf(imageValues(steps[0], "Density")) + 0.25 * sumOf(imageValues(steps[1], "Density")));
  const Values between = densityAt(filter, 0.5);
  CHECK(checks, filter->GetDensity()->GetDimensions()[0] == 2 * blobSide + 1);
  CHECK_NEAR(checks, 0.25 * sumOf(between) / mass, 1.0, 1e-12);
  // Each of both steps has its own cells; none leaves stripes.
  const Values truth = imageValues(makeFine(21, 22, 5.0), "Density");
  CHECK_NEAR(checks, largestDifference(between, truth), 0.0, 0.05);
  for (const std::size_t step : { 0, 1 })
  {
    CHECK(
      checks, densityAt(filter, static_cast<double>(step)) == imageValues(steps[step], "Density"));
    CHECK(checks, filter->GetDensity()->GetDimensions()[0] == steps[step]->GetDimensions()[0]);
  }
}

// A box that moves with what is in it: the output is on the smallest box that holds both.
void checkBoxes(Checks& checks)
{
  const Images steps = { makeBlob(24, 24), makeBlob(24, 24) };
  steps[1]->SetOrigin(10.0, -6.0, 0.0);
  ImageSeries series(steps, { 0.0, 1.0 });
  auto filter = makeInterpolator(series);
  filter->UpdateTimeStep(0.5);
  const double* bounds = filter->GetDensity()->GetBounds();
  CHECK_NEAR(checks, bounds[0], 0.0, 1e-12);
  CHECK_NEAR(checks, bounds[1], blobSide + 10.0, 1e-12);
  CHECK_NEAR(checks, bounds[2], -6.0, 1e-12);
  CHECK_NEAR(checks, bounds[3], blobSide, 1e-12);
  const Values places = coordinates(filter->GetParticles());
  const Values masses = particleValues(filter, "Mass");
  Place centre = { 0.0, 0.0 };
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    centre[0] += masses[i] * places[3 * i] / sumOf(masses);
    centre[1] += masses[i] * places[3 * i + 1] / sumOf(masses);
  }
  CHECK_NEAR(checks, centre[0], 29.0, 0.05);
  CHECK_NEAR(checks, centre[1], 21.0, 0.05);
}

// Lengths have no preferred unit: in units that are powers of two, not a bit changes.
void checkUnits(Checks& checks)
{
  for (const int method : temporalMethods)
  {
    const auto densityIn = [&](double unit) {
      Images steps = movingBlobs();
      for (const auto& step : steps)
      {
        step->SetSpacing(unit, unit, 1.0);
      }
      ImageSeries series(steps, blobTimes);
      return densityAt(makeInterpolator(series, method), 0.5);
    };
    const Values found = densityIn(1.0);
    CHECK(checks, densityIn(std::ldexp(1.0, -200)) == found);
    CHECK(checks, densityIn(std::ldexp(1.0, 200)) == found);
  }
}

// A direction matrix turns ways and velocities.
void checkDirections(Checks& checks)
{
  Images steps = movingBlobs();
  ImageSeries straight(steps, blobTimes);
  auto filter = makeInterpolator(straight);
  const Values density = densityAt(filter, 0.5);
  const Values velocities = particleValues(filter, "Velocity");
  Images turned = movingBlobs();
  const double matrix[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  for (const auto& step : turned)
  {
    step->SetDirectionMatrix(matrix);
  }
  ImageSeries series(turned, blobTimes);
  auto other = makeInterpolator(series);
  CHECK(checks, densityAt(other, 0.5) == density);
  const Values found = particleValues(other, "Velocity");
  Values wanted = velocities;
  for (std::size_t i = 0; i < wanted.size(); i += 3)
  {
    wanted[i] = -velocities[i + 1];
    wanted[i + 1] = velocities[i];
  }
  CHECK_NEAR(checks, largestDifference(found, wanted), 0.0, 1e-10);
}

void checkAnnounced(Checks& checks)
{
  for (const bool cells : { true, false })
  {
    Images steps = { makeBlob(12, 14, 5.0, 1.0, cells), makeBlob(28, 22, 5.0, 1.0, cells) };
    for (const auto& step : steps)
    {
      step->SetOrigin(1.0, -2.0, 3.0);
      step->SetSpacing(0.5, 2.0, 1.0);
    }
    ImageSeries series(steps, { 0.0, 1.0 });
    auto filter = makeInterpolator(series);
    requestTime(filter, 0.5);
    checkInformation(checks, filter, __LINE__);
  }
}

} // namespace

int TestTemporalGrids(int, char*[])
{
  return runChecks({ checkSpacings, checkBoxes, checkUnits, checkDirections, checkAnnounced });
}
