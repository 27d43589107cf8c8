// SPDX-License-Identifier: BSD-3-Clause
// Tables: tiles give what whole tables give, but for the error of both; what is kept of them from
// run to run never outlives the density that they read.
#include "MapTest.h"
#include "QualityTest.h"

#include "vtkTransportInterpolator.h"
#include "vtkTransportSampler.h"

#include <functional>

namespace
{

constexpr int side = 60;

vtkSmartPointer<vtkImageData> density(double factor = 1.0)
{
  const auto smooth = smoothDensity(side, side - 7, 8);
  return makeImage<vtkDoubleArray>(
    side, side - 7, 8, false, [=](vtkIdType i) { return factor * smooth(i); });
}

Values displacementsOf(vtkDataSetAttributes* data)
{
  return arrayValues(data->GetArray("Displacement"));
}

// `values` reads what comes out of the filter.
template <class Filter>
void expectTheSame(Checks& checks, Filter* filter, const std::function<Values()>& values, int line)
{
  filter->SetTablesToWhole();
  filter->Update();
  const Values whole = values();
  const vtkMTimeType built = filter->GetTableBuildTime();
  filter->SetTablesToTiled();
  filter->Update();
  const Values tiled = values();
  checks.That(filter->GetTableBuildTime() > built, "filter->GetTableBuildTime() > built", line);
  const double difference = largestDifference(whole, tiled);
  checks.That(difference > 0.0, "difference > 0.0", line); // other bits
  checks.That(difference < 0.25, "difference < 0.25", line);
  filter->SetTablesToAuto(); // of a small density
  filter->Update();
  checks.That(
    largestDifference(whole, values()) == 0.0, "largestDifference(whole, values()) == 0.0", line);
}

void checkFilters(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(density());
  sampler->SetNumberOfParticles(3000);
  expectTheSame(
    checks, sampler.Get(), [&]() { return displacementsOf(sampler->GetOutput()->GetPointData()); },
    __LINE__);

  vtkNew<vtkTransportMap> map;
  map->SetInputData(density());
  for (const int direction :
    { vtkTransportMap::UNIFORM_TO_DENSITY, vtkTransportMap::DENSITY_TO_UNIFORM })
  {
    map->SetDirection(direction);
    double cost[2];
    for (const int tables : { vtkTransportMap::TABLES_WHOLE, vtkTransportMap::TABLES_TILED })
    {
      map->SetTables(tables);
      map->Update();
      cost[tables == vtkTransportMap::TABLES_TILED ? 1 : 0] =
        fieldValue(map->GetOutput(), "TransportCost");
    }
    CHECK_NEAR(checks, cost[1] / cost[0], 1.0, 1e-3);
    expectTheSame(
      checks, map.Get(), [&]() { return displacementsOf(map->GetOutput()->GetPointData()); },
      __LINE__);
  }

  vtkNew<vtkTransportSampler> points;
  points->SetInputData(density());
  points->SetNumberOfParticles(2000);
  points->Update();
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputData(points->GetOutput());
  warp->SetDensityData(density());
  expectTheSame(
    checks, warp.Get(), [&]() { return displacementsOf(warp->GetOutput()->GetPointData()); },
    __LINE__);

  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(points->GetOutput());
  quality->SetDensityData(density());
  Values figures[2];
  for (const int tables : { vtkTransportQuality::TABLES_WHOLE, vtkTransportQuality::TABLES_TILED })
  {
    quality->SetTables(tables);
    figures[tables == vtkTransportQuality::TABLES_TILED ? 1 : 0] = runQuality(quality);
  }
  CHECK(checks, figures[0] != figures[1]); // other bits
  for (std::size_t i = 0; i < figures[0].size(); ++i)
  {
    CHECK_NEAR(checks, figures[1][i], figures[0][i], 1e-6 * std::abs(figures[0][i]));
  }

  vtkNew<vtkTransportInterpolator> morph;
  morph->SetParticlesPerCell(1);
  morph->SetInputData(density());
  morph->SetTargetData(makeImage(side, side - 7, 8, false, bumpy));
  expectTheSame(
    checks, morph.Get(), [&]() { return coordinates(morph->GetParticles()); }, __LINE__);
}

Values fresh(vtkImageData* image, int particles)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetTablesToTiled();
  sampler->SetNumberOfParticles(particles);
  sampler->SetInputData(image);
  sampler->Update();
  return displacementsOf(sampler->GetOutput()->GetPointData());
}

// The density moves, changes in place, or goes between two runs.
void checkKept(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetTablesToTiled();
  sampler->SetNumberOfParticles(1000);
  auto image = density();
  const auto run = [&](int particles) {
    sampler->SetNumberOfParticles(particles);
    sampler->Update();
    return displacementsOf(sampler->GetOutput()->GetPointData());
  };
  sampler->SetInputData(image);
  CHECK(checks, run(1000) == fresh(image, 1000));
  const vtkMTimeType built = sampler->GetTableBuildTime();
  CHECK(checks, run(700) == fresh(image, 700));
  image = density(); // of the same content elsewhere
  sampler->SetInputData(image);
  CHECK(checks, run(500) == fresh(image, 500));
  CHECK(checks, sampler->GetTableBuildTime() == built);

  // Another filter's tiles are its own, and read its own image.
  vtkNew<vtkTransportSampler> other;
  other->SetTablesToTiled();
  other->SetNumberOfParticles(500);
  auto copy = density();
  other->SetInputData(copy);
  other->Update();
  auto* values = vtkDoubleArray::SafeDownCast(copy->GetPointData()->GetScalars());
  values->FillValue(1.0);
  CHECK(checks, run(501) == fresh(image, 501));

  values = vtkDoubleArray::SafeDownCast(image->GetPointData()->GetScalars());
  values->SetValue(11, 300.0);
  values->Modified();
  image->Modified();
  CHECK(checks, run(500) == fresh(image, 500));
  CHECK(checks, sampler->GetTableBuildTime() > built);
}

} // namespace

int TestTables(int, char*[])
{
  return runChecks({ checkFilters, checkKept });
}
