// SPDX-License-Identifier: BSD-3-Clause
// Seeds that are given on port 1.
#include "TestData.h"

#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkMatrix3x3.h"
#include "vtkStructuredGrid.h"
#include "vtkUniformSeedSource.h"

#include <algorithm>
#include <limits>

namespace
{

std::vector<double> seedPositions(vtkTransportSampler* sampler)
{
  return arrayValues(pointArray(sampler->GetOutput(), "SeedPosition"));
}

// Given back as seeds, in another order, the sampler's own seeds end where they ended.
void checkRoundTrip(Checks& checks, int depth)
{
  auto image = makeImage(13, 9, depth, true, bumpy);
  image->SetSpacing(0.7, 0.3, 1.9);
  image->SetOrigin(-11.0, 5.0, 2.0);
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  const double direction[9] = { c, 0, s, 0, 1, 0, -s, 0, c };
  image->SetDirectionMatrix(direction);
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(700);
  const std::vector<double> expected = sampleCoordinates(sampler);
  std::vector<double> seeds = seedPositions(sampler);

  std::vector<double> reversed(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    reversed[seeds.size() - 3 - i + 2 * (i % 3)] = seeds[i];
  }
  sampler->SetSeedsData(makePoints(reversed));
  sampler->SetNumberOfParticles(0); // not used
  const std::vector<double> backwards = sampleCoordinates(sampler);
  CHECK(checks, seedPositions(sampler) == reversed);
  double largest = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    largest =
      std::max(largest, std::abs(backwards[seeds.size() - 3 - i + 2 * (i % 3)] - expected[i]));
  }
  // The flow may enlarge the rounding of a seed by way of physical space.
  CHECK_NEAR(checks, largest, 0.0, 1e-7);
  CHECK(checks, messages.Warnings.empty() && messages.Errors.empty());

  // Time 0 is the seeds, to the last bit.
  sampler->SetFlowTime(0.0);
  CHECK(checks, sampleCoordinates(sampler) == reversed);
  CHECK(checks, fieldValue(sampler->GetOutput(), "TransportCost") == 0.0);
  sampler->SetSeedsConnection(nullptr);
  sampler->SetNumberOfParticles(700);
  CHECK(checks, sampleCoordinates(sampler) == seeds);
}

// One warning counts the seeds outside; they start at the border.
void checkOutside(Checks& checks)
{
  auto image = makeImage(5, 4, 1, true, bumpy); // [0,4] x [0,3], z = 0
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputData(image);
  sampler->SetSeedsData(makePoints({ 1, 1, 0, -2, 1, 0, 1, 9, 0, 2, 2, 0.5, 4, 3, 0, 5, 5, 5 }));
  sampler->Update();
  CHECK(checks, messages.Errors.empty());
  CHECK(checks, messages.Warnings.size() == 1);
  CHECK(checks, contains(messages.Warnings[0], "4 of 6 seeds outside the domain"));
  CHECK(checks,
    seedPositions(sampler) ==
      std::vector<double>({ 1, 1, 0, 0, 1, 0, 1, 3, 0, 2, 2, 0, 4, 3, 0, 4, 3, 0 }));

  // One that misses the border by its last bit is on it, without a warning.
  messages.Clear();
  sampler->SetSeedsData(makePoints({ std::nextafter(4.0, 5.0), 1, 0, 2, -1e-300, 0 }));
  sampler->Update();
  CHECK(checks, messages.Warnings.empty());
  CHECK(checks, seedPositions(sampler) == std::vector<double>({ 4, 1, 0, 2, 0, 0 }));

  // Single precision misses a border, without a warning.
  image->SetOrigin(0.1, 0.7, 0.3);
  image->SetSpacing(0.1, 0.1, 1.0);
  double bounds[6];
  image->GetBounds(bounds);
  messages.Clear();
  sampler->SetSeedsData(
    makePoints({ bounds[0], bounds[2], bounds[4], bounds[1], bounds[3], bounds[5] }, true));
  sampler->Update();
  CHECK(checks, messages.Warnings.empty());
  for (std::size_t i = 0; i < 6; ++i)
  {
    const double x = seedPositions(sampler)[i];
    CHECK(checks, x >= bounds[2 * (i % 3)] && x <= bounds[2 * (i % 3) + 1]);
  }
}

void checkNotFinite(Checks& checks)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(makeImage(5, 4, 1, true, bumpy));
  std::vector<double> x(30000, 1.0);
  x[3 * 8500 + 1] = nan;
  x[3 * 41] = infinity;
  x[3 * 41 + 2] = nan;
  sampler->SetSeedsData(makePoints(x));
  ErrorTest(checks, sampler)
    .Expect({ "Seeds has 2 points that are NaN or infinite", "first at index 41" }, __LINE__);
}

// Data of the seeds goes with the particles; the sampler's own arrays replace namesakes.
void checkData(Checks& checks)
{
  auto seeds = makePoints({ 1, 1, 0, 2, 2, 0, 3, 1, 0 });
  vtkNew<vtkFloatArray> colour;
  colour->SetName("Colour");
  colour->SetNumberOfTuples(3);
  colour->Fill(0.5);
  seeds->GetPointData()->SetScalars(colour);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("SeedId");
  ids->SetNumberOfTuples(3);
  ids->Fill(77);
  seeds->GetPointData()->AddArray(ids);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(makeImage(5, 4, 1, true, bumpy));
  sampler->SetSeedsData(seeds);
  sampler->Update();
  vtkPointData* data = sampler->GetOutput()->GetPointData();
  CHECK(checks, data->GetScalars() == colour);
  CHECK(checks, data->GetArray("SeedId")->GetComponent(2, 0) == 2.0);
  CHECK(checks, data->GetNumberOfArrays() == 6); // with the image's
  sampler->OutputPathsOn();
  sampler->Update();
  CHECK(checks, sampler->GetOutput()->GetCellData()->GetArray("Colour") == colour);
}

// Any point set will do, also an empty one; a source may be connected.
void checkKinds(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputData(makeImage(5, 4, 3, true, bumpy));
  vtkNew<vtkStructuredGrid> grid;
  grid->SetDimensions(1, 2, 2);
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 4; ++i)
  {
    points->InsertNextPoint(1.0, i % 2 + 0.5, i / 2 + 0.5);
  }
  grid->SetPoints(points);
  sampler->SetSeedsData(grid);
  sampler->Update();
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 4);
  vtkNew<vtkPolyData> empty;
  sampler->SetSeedsData(empty);
  sampler->Update();
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 0);
  vtkNew<vtkUniformSeedSource> source;
  source->SetDimension(3);
  source->SetBounds(0, 4, 0, 3, 0, 2);
  source->SetNumberOfPoints(321);
  sampler->SetSeedsConnection(source->GetOutputPort());
  sampler->Update();
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 321);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

} // namespace

int TestSamplerSeeds(int, char*[])
{
  Checks checks;
  checkRoundTrip(checks, 1);
  checkRoundTrip(checks, 6);
  checkOutside(checks);
  checkNotFinite(checks);
  checkData(checks);
  checkKinds(checks);
  return checks.Result();
}
