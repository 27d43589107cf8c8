// SPDX-License-Identifier: BSD-3-Clause
// Each direction of the map by itself against the flow to 1e-4 cell. There and back would hide an
// error that both share.
#include "MapTest.h"

#include "../../Core/Oracle.h"

namespace
{

// Mean distance in cells from the oracle's displacement, which is independent of images.
double meanError(vtkTransportMap* map, const RectifiedTransport::Oracle<2>& oracle, int nx, int ny,
  const double spacing[3])
{
  map->Update();
  const Values displacement = imageValues(map->GetOutput(), "Displacement");
  double sum = 0.0;
  for (int i = 0; i < nx * ny; ++i)
  {
    const std::array<double, 2> x = { i % nx + 0.5, i / nx + 0.5 };
    const std::array<double, 2> end = map->GetDirection() == vtkTransportMap::UNIFORM_TO_DENSITY
      ? oracle.Forward(x)
      : oracle.Backward(x);
    const double* d = displacement.data() + 3 * i;
    sum += std::hypot(d[0] / spacing[0] + x[0] - end[0], d[2] / spacing[2] + x[1] - end[1]);
  }
  return sum / (nx * ny);
}

} // namespace

int TestMapOracle(int, char*[])
{
  Checks checks;
  constexpr int nx = 40;
  constexpr int ny = 32;
  const auto density = smoothDensity(nx, ny);
  std::vector<double> values;
  for (int i = 0; i < nx * ny; ++i)
  {
    values.push_back(density(i));
  }
  const RectifiedTransport::Oracle<2> oracle(values, { nx, ny });
  auto image = makeImage(nx, 1, ny, false, density);
  const double spacing[3] = { 0.5, 9.0, 3.0 };
  image->SetSpacing(spacing);
  image->SetOrigin(10.0, 20.0, 30.0);
  for (const int direction : { 0, 1 })
  {
    vtkNew<vtkTransportMap> map;
    map->SetInputData(image);
    map->SetDirection(direction);
    const double coarse = meanError(map, oracle, nx, ny, spacing);
    CHECK_NEAR(checks, coarse, 0.0, 0.03);
    map->SetNumberOfSteps(256);
    CHECK_NEAR(checks, meanError(map, oracle, nx, ny, spacing), 0.0, 0.1 * coarse);
    map->SetIntegratorToAdaptive();
    map->SetTolerance(0.001);
    CHECK_NEAR(checks, meanError(map, oracle, nx, ny, spacing), 0.0, 0.02);
  }
  return checks.Result();
}
