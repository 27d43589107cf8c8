// SPDX-License-Identifier: BSD-3-Clause
// Where the points go, against what is known: separable densities, whose map is the cumulative sum
// of each axis; a uniform density; points off the plane and beyond the border.
#include "WarpTest.h"

#include "vtkTransportSampler.h"

namespace
{

// A density that is a product of one factor an axis, and the exact map of it to uniform.
class Separable
{
public:
  explicit Separable(const std::vector<int>& cells)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      std::vector<double> factor;
      for (int i = 0; a < cells.size() && i < cells[a]; ++i)
      {
        factor.push_back(0.3 + bumpy(i + 5 * static_cast<vtkIdType>(a)) / 23.0);
      }
      this->Factors[a] = factor;
    }
  }

  // On the cells, with uneven spacings and an origin.
  vtkSmartPointer<vtkImageData> Image() const
  {
    const auto count = [this](int a) { return static_cast<int>(this->Factors[a].size()); };
    const int nx = count(0);
    const int ny = std::max(count(1), 1);
    auto image = makeImage(nx + 1, count(1) + 1, count(2) + 1, true, [&](vtkIdType i) {
      const std::size_t cell[3] = { static_cast<std::size_t>(i % nx),
        static_cast<std::size_t>(i / nx % ny), static_cast<std::size_t>(i / nx / ny) };
      double product = 1.0;
      for (int a = 0; a < 3; ++a)
      {
        product *= this->Factors[a].empty() ? 1.0 : this->Factors[a][cell[a]];
      }
      return product;
    });
    image->SetOrigin(-7.0, 3.0, 2.0);
    image->SetSpacing(0.5, 0.25, 2.0);
    return image;
  }

  // Physical to physical.
  std::vector<double> Exact(std::vector<double> x, vtkImageData* image) const
  {
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      const int a = static_cast<int>(i % 3);
      if (!this->Factors[a].empty())
      {
        const double origin = image->GetOrigin()[a];
        const double spacing = image->GetSpacing()[a];
        x[i] = origin + spacing * this->Forward(a, (x[i] - origin) / spacing);
      }
    }
    return x;
  }

private:
  // The cumulative share of an axis at a place in cells, in cells.
  double Forward(int a, double place) const
  {
    const std::vector<double>& factor = this->Factors[a];
    double below = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < factor.size(); ++i)
    {
      all += factor[i];
      below += factor[i] * std::clamp(place - static_cast<double>(i), 0.0, 1.0);
    }
    return static_cast<double>(factor.size()) * below / all;
  }

  std::vector<double> Factors[3];
};

// The error falls with the steps, and is a small part of a cell in the end.
void checkSeparable(Checks& checks, const std::vector<int>& cells)
{
  const Separable separable(cells);
  auto image = separable.Image();
  double bounds[6];
  image->GetBounds(bounds);
  const std::vector<double> x = randomCoordinates(bounds, 500);
  const std::vector<double> exact = separable.Exact(x, image);
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages messages(warp);
  warp->SetInputData(makePoints(x));
  warp->SetDensityData(image);
  const auto meanError = [&](int steps) {
    warp->SetNumberOfSteps(steps);
    const std::vector<double> found = warpCoordinates(warp);
    double sum = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      sum += std::abs(found[i] - exact[i]) / image->GetSpacing()[i % 3];
    }
    return sum / static_cast<double>(x.size() / 3);
  };
  const double coarse = meanError(32);
  CHECK_NEAR(checks, coarse, 0.0, 0.2);
  CHECK_NEAR(checks, meanError(256), 0.0, coarse / 4.0);
  CHECK_NEAR(checks, meanError(2000), 0.0, 0.01);
  CHECK(checks, largestDifference(exact, x) > 0.3); // there is something to find
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

// What makes it density-equalizing: a region's area becomes its share of the mass. No factor of the
// density is known here; regions are squares of cells, with outlines of many points.
void checkAreas(Checks& checks)
{
  constexpr int columns = 48;
  constexpr int rows = 40;
  constexpr int side = 8;
  constexpr int perSide = 64;
  const auto density = [](vtkIdType i) {
    const double x = static_cast<double>(i % columns) - 12.0;
    const double y = static_cast<double>(i / columns) - 25.0;
    return 0.2 + 3.0 * std::exp(-(x * x + y * y + x * y) / 90.0) + bumpy(i) / 40.0;
  };
  auto image = makeImage(columns + 1, rows + 1, 1, true, density);
  double total = 0.0;
  std::vector<double> masses((columns / side) * (rows / side));
  for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
  {
    const auto block = i / columns / side * (columns / side) + i % columns / side;
    masses[static_cast<std::size_t>(block)] += density(i);
    total += density(i);
  }
  std::vector<double> outlines;
  for (std::size_t block = 0; block < masses.size(); ++block)
  {
    const double x = static_cast<double>(block % (columns / side)) * side;
    const double y = static_cast<double>(block / (columns / side)) * side;
    for (int i = 0; i < 4 * perSide; ++i)
    {
      const double s = side * static_cast<double>(i % perSide) / perSide;
      const double around[4][2] = { { s, 0 }, { side, s }, { side - s, side }, { 0, side - s } };
      outlines.insert(
        outlines.end(), { x + around[i / perSide][0], y + around[i / perSide][1], 0 });
    }
  }
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputData(makePoints(outlines));
  warp->SetDensityData(image);
  warp->SetNumberOfSteps(400);
  const std::vector<double> found = warpCoordinates(warp);
  const auto area = [](const double* x) {
    double sum = 0.0;
    for (int i = 0; i < 4 * perSide; ++i)
    {
      const double* a = x + 3 * i;
      const double* b = x + 3 * ((i + 1) % (4 * perSide));
      sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return sum;
  };
  for (std::size_t block = 0; block < masses.size(); ++block)
  {
    const double expected = columns * rows * masses[block] / total;
    CHECK_NEAR(checks, area(found.data() + 12 * perSide * block), expected, 0.01 * expected);
  }
}

void checkUniform(Checks& checks)
{
  for (const int depth : { 1, 8 })
  {
    auto image = makeImage(10, 12, depth, false, [](vtkIdType) { return 3.5; });
    const double bounds[6] = { -0.5, 9.5, -0.5, 11.5, -0.5, depth - 0.5 };
    const std::vector<double> x = randomCoordinates(bounds, 300);
    vtkNew<vtkDensityEqualizingWarp> warp;
    warp->SetInputData(makePoints(x));
    warp->SetDensityData(image);
    const double coarse = largestDifference(warpCoordinates(warp), x);
    CHECK_NEAR(checks, coarse, 0.0, 0.05);
    warp->SetNumberOfSteps(512);
    CHECK_NEAR(checks, largestDifference(warpCoordinates(warp), x), 0.0, 1e-3);
  }
}

// Blend is the straight line between where points were and where the whole map puts them.
void checkBlend(Checks& checks)
{
  auto image = makeImage(14, 11, 1, true, bumpy);
  const double bounds[6] = { 0, 13, 0, 10, 0, 0 };
  const std::vector<double> x = randomCoordinates(bounds, 200);
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputData(makePoints(x));
  warp->SetDensityData(image);
  const std::vector<double> whole = warpCoordinates(warp);
  CHECK(checks, largestDifference(whole, x) > 0.5);
  for (const double blend : { 0.0, 1e-3, 0.25, 1.0 })
  {
    warp->SetBlend(blend);
    const std::vector<double> found = warpCoordinates(warp);
    const std::vector<double> moved = displacements(warp);
    std::vector<double> expected = x;
    std::vector<double> difference = found;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      expected[i] += blend * (whole[i] - x[i]);
      difference[i] -= x[i];
    }
    CHECK_NEAR(checks, largestDifference(found, expected), 0.0, 1e-12);
    CHECK_NEAR(checks, largestDifference(moved, difference), 0.0, 1e-12);
  }
  warp->SetBlend(0.0);
  CHECK(checks, warpCoordinates(warp) == x);
}

// Beyond the border and off the plane: as the nearest point of the border, with the same offset.
void checkOutside(Checks& checks)
{
  auto image = makeImage(9, 7, 1, true, bumpy); // [0,8] x [0,6], z = 0
  const std::vector<double> inside = { 3, 2, 0, 0, 4, 0, 5, 6, 0, 8, 6, 0, 2.5, 0, 0 };
  const std::vector<double> offset = { 0, 0, 7, -2, 0, 0, 0, 3, -1, 1, 2, 0, 0, -1e-7, 0 };
  std::vector<double> outside = inside;
  for (std::size_t i = 0; i < inside.size(); ++i)
  {
    outside[i] += offset[i];
  }
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages messages(warp);
  warp->SetDensityData(image);
  warp->SetInputData(makePoints(inside));
  std::vector<double> expected = warpCoordinates(warp);
  CHECK(checks, messages.Warnings.empty());
  CHECK(checks, std::abs(expected[0] - 3.0) > 0.1);
  // The border is mapped to itself, and its corners stay.
  CHECK_NEAR(checks, expected[3], 0.0, 0.01);
  CHECK_NEAR(checks, expected[7], 6.0, 0.01);
  CHECK_NEAR(checks, expected[9], 8.0, 0.01);
  for (std::size_t i = 0; i < inside.size(); ++i)
  {
    expected[i] += offset[i];
  }
  warp->SetInputData(makePoints(outside));
  CHECK_NEAR(checks, largestDifference(warpCoordinates(warp), expected), 0.0, 1e-12);
  // Height is no offset from the border, and neither is what single precision misses.
  CHECK(checks, messages.Warnings.size() == 1);
  CHECK(checks, contains(messages.Warnings[0], "3 of 5 points outside the domain of the density"));
  CHECK(checks, messages.Errors.empty());
}

// A density of one dimension moves points along its axis alone, whatever the direction of it.
void checkLine(Checks& checks)
{
  auto image = makeImage(21, 1, 1, true, bumpy);
  const double direction[9] = { 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1 };
  image->SetDirectionMatrix(direction);
  const double bounds[6] = { 0, 12, 0, 16, -5, 5 };
  const std::vector<double> x = randomCoordinates(bounds, 100);
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages messages(warp);
  warp->SetDensityData(image);
  warp->SetInputData(makePoints(x));
  warp->Update();
  const std::vector<double> moved = displacements(warp);
  double along = 0.0;
  double across = 0.0;
  for (std::size_t i = 0; i < moved.size(); i += 3)
  {
    along = std::max(along, std::abs(0.6 * moved[i] + 0.8 * moved[i + 1]));
    across = std::max(across, std::hypot(0.8 * moved[i] - 0.6 * moved[i + 1], moved[i + 2]));
  }
  CHECK(checks, along > 0.2);
  CHECK_NEAR(checks, across, 0.0, 1e-12);
  CHECK(checks, messages.Warnings.empty());
}

// Particles of a density go back to their seeds. (Errors that both ways share cancel.)
void checkWayBack(Checks& checks)
{
  auto image = makeImage(30, 20, 5, true, bumpy);
  image->SetSpacing(0.4, 1.5, 0.9);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(500);
  sampler->SetNumberOfSteps(200);
  sampler->Update();
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputData(sampler->GetOutput());
  warp->SetDensityData(image);
  warp->SetNumberOfSteps(200);
  const std::vector<double> found = warpCoordinates(warp);
  vtkDataArray* seeds = pointArray(sampler->GetOutput(), "SeedPosition");
  double sum = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const auto point = static_cast<vtkIdType>(i / 3);
    sum += std::abs(found[i] - seeds->GetComponent(point, static_cast<int>(i % 3)));
  }
  CHECK_NEAR(checks, sum / static_cast<double>(found.size()), 0.0, 0.02);
}

} // namespace

int TestWarpAnalytic(int, char*[])
{
  Checks checks;
  checkSeparable(checks, { 60 });
  checkSeparable(checks, { 40, 25 });
  checkSeparable(checks, { 16, 12, 14 });
  checkAreas(checks);
  checkUniform(checks);
  checkBlend(checks);
  checkOutside(checks);
  checkLine(checks);
  checkWayBack(checks);
  return checks.Result();
}
