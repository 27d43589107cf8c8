// SPDX-License-Identifier: BSD-3-Clause
// Between two steps, vtkTransportTemporalInterpolator moves mass on straight lines with constant
// speed: a translation has one velocity, and the total mass is linear in time.
#include "TemporalTest.h"

namespace
{

constexpr Place start = { 12.0, 14.0 };
constexpr Place shift = { 16.0, 8.0 };
constexpr double width = 2.5; // the whole blob stays within the image

// The mean of a component of the particles' velocities, by mass.
double meanVelocity(vtkTransportTemporalInterpolator* filter, std::size_t axis)
{
  const Values velocities = particleValues(filter, "Velocity");
  const Values masses = particleValues(filter, "Mass");
  double sum = 0.0;
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    sum += masses[i] * velocities[3 * i + axis];
  }
  return sum / sumOf(masses);
}

// A blob that moves by whole cells, also at a quarter, the half and three quarters of the way.
void checkTranslation(Checks& checks)
{
  constexpr double length = 2.0;
  for (const bool cells : { true, false })
  {
    for (const int method : temporalMethods)
    {
      const bool isOptimal = method == vtkTransportTemporalInterpolator::OPTIMAL;
      ImageSeries series({ makeBlob(start[0], start[1], width, 1.0, cells),
                           makeBlob(start[0] + shift[0], start[1] + shift[1], width, 1.0, cells) },
        { 1.0, 1.0 + length });
      auto filter = makeInterpolator(series, method);
      for (const double part : { 0.25, 0.5, 0.75 })
      {
        const Place now = { start[0] + part * shift[0], start[1] + part * shift[1] };
        const Values found = densityAt(filter, 1.0 + part * length);
        const Values truth = imageValues(makeBlob(now[0], now[1], width, 1.0, cells), "Density");
        CHECK_NEAR(checks, relativeDifference(found, truth), 0.0, isOptimal ? 0.02 : 0.1);
        CHECK_NEAR(checks, sumOf(found) / sumOf(truth), 1.0, 1e-12);
        const Place centroid = centroidOf(found);
        for (std::size_t axis = 0; axis < 2; ++axis)
        {
          CHECK_NEAR(checks, centroid[axis], now[axis], 0.05);
          CHECK_NEAR(checks, meanVelocity(filter, axis), shift[axis] / length, 0.05);
        }
        CHECK(checks, meanVelocity(filter, 2) == 0.0);
      }
      const double truth = shift[0] * shift[0] + shift[1] * shift[1];
      vtkImageData* density = filter->GetDensity();
      CHECK_NEAR(checks, fieldValue(density, "TransportCost") / truth, 1.0, 0.02);
      const double bound = fieldValue(density, "TransportCostLowerBound");
      CHECK(checks,
        isOptimal ? bound <= truth * (1.0 + 1e-9) && bound >= 0.98 * truth : std::isnan(bound));
    }
  }
}

// Each particle is where its velocity takes it from where it was.
void checkStraightWays(Checks& checks)
{
  for (const int method : temporalMethods)
  {
    ImageSeries series(movingBlobs(), { 1.0, 3.0, 4.0 });
    auto filter = makeInterpolator(series, method);
    filter->UpdateTimeStep(1.25);
    const Values before = coordinates(filter->GetParticles());
    const Values velocities = particleValues(filter, "Velocity");
    vtkDataArray* vectors = filter->GetParticles()->GetPointData()->GetVectors();
    CHECK(checks, vectors && vectors->GetName() == std::string("Velocity"));
    for (const double time : { 2.0, 2.875 })
    {
      filter->UpdateTimeStep(time);
      Values expected = before;
      for (std::size_t i = 0; i < expected.size(); ++i)
      {
        expected[i] += (time - 1.25) * velocities[i];
      }
      CHECK(checks, particleValues(filter, "Velocity") == velocities);
      CHECK_NEAR(
        checks, largestDifference(coordinates(filter->GetParticles()), expected), 0.0, 1e-11);
    }
  }
}

// That of the first step and that of the second, by the parts of the way.
void checkMass(Checks& checks)
{
  const Images blobs = movingBlobs();
  ImageSeries series(blobs, { 1.0, 3.0, 4.0 });
  auto filter = makeInterpolator(series);
  Values masses;
  for (const auto& blob : blobs)
  {
    masses.push_back(sumOf(imageValues(blob, "Density")));
  }
  for (const double part : { 0.0, 0.125, 0.5, 1.0 })
  {
    for (const std::size_t first : { 0, 1 })
    {
      const double time = first == 0 ? 1.0 + 2.0 * part : 3.0 + part;
      const double truth = (1.0 - part) * masses[first] + part * masses[first + 1];
      CHECK_NEAR(checks, sumOf(densityAt(filter, time)) / truth, 1.0, 1e-12);
      CHECK_NEAR(checks, sumOf(particleValues(filter, "Mass")) / truth, 1.0, 1e-12);
      CHECK_NEAR(checks, fieldValue(filter->GetDensity(), "TotalMass") / truth, 1.0, 1e-12);
      CHECK_NEAR(checks, fieldValue(filter->GetParticles(), "TotalMass") / truth, 1.0, 1e-12);
    }
  }
}

// On a line and in a volume, in cells of different widths, half of the way.
void checkDimensions(Checks& checks)
{
  constexpr int side = 20;
  for (const int depth : { 1, side })
  {
    const auto boxAt = [=](vtkIdType low) {
      auto image = makeImage(
        side + 1, depth == 1 ? 1 : side + 1, depth == 1 ? 1 : side + 1, true, [=](vtkIdType i) {
          bool isInside = true;
          for (vtkIdType rest = i, axis = 0; axis < (depth == 1 ? 1 : 3); ++axis, rest /= side)
          {
            isInside = isInside && rest % side >= low && rest % side < low + 8;
          }
          return isInside ? 2.0 : 0.0;
        });
      image->SetSpacing(0.5, 1.0, 2.0);
      return image;
    };
    ImageSeries series({ boxAt(2), boxAt(10) }, { 0.0, 0.5 });
    auto filter = makeInterpolator(series);
    const Values truth = imageValues(boxAt(6), "Density");
    CHECK_NEAR(checks, relativeDifference(densityAt(filter, 0.25), truth), 0.0, 0.1);
    CHECK_NEAR(checks, meanVelocity(filter, 0), 8.0, 0.2);
    CHECK_NEAR(checks, meanVelocity(filter, 1), depth == 1 ? 0.0 : 16.0, 0.4);
    CHECK_NEAR(checks, meanVelocity(filter, 2), depth == 1 ? 0.0 : 32.0, 0.8);
  }
}

// A blob that spreads in its place has widths that are linear in time.
void checkSpreading(Checks& checks)
{
  ImageSeries series({ makeBlob(24, 24, 4.0), makeBlob(24, 24, 7.0, 16.0 / 49.0) }, { 0.0, 1.0 });
  auto filter = makeInterpolator(series);
  const Values truth = imageValues(makeBlob(24, 24, 5.5, 16.0 / (5.5 * 5.5)), "Density");
  CHECK_NEAR(checks, relativeDifference(densityAt(filter, 0.5), truth), 0.0, 0.05);
}

} // namespace

int TestTemporalMotion(int, char*[])
{
  return runChecks(
    { checkTranslation, checkStraightWays, checkMass, checkDimensions, checkSpreading });
}
