// SPDX-License-Identifier: BSD-3-Clause
// The distances of vtkTransportDistance where W2 is known: of translations, of boxes, and on a
// line, where it is an integral.
#include "DistanceTest.h"

namespace
{

// Checks that a matrix is symmetric, with zeros in the diagonal, to the last bit.
void expectSymmetry(Checks& checks, const Matrix& matrix, int line)
{
  for (std::size_t i = 0; i < matrix.size(); ++i)
  {
    checks.That(matrix[i].size() == matrix.size() && matrix[i][i] == 0.0, "zero", line);
    for (std::size_t j = 0; j < matrix.size(); ++j)
    {
      checks.That(matrix[i][j] == matrix[j][i], "symmetry", line);
    }
  }
}

// Checks the first two inputs against W2. Distances are within `tolerance`, as a part of it. Bounds
// that are certified have W2 between them, up to rounding.
void expectDistance(
  Checks& checks, vtkTransportDistance* distance, double truth, double tolerance, int line)
{
  constexpr double rounding = 1e-9;
  const Matrix found = distancesOf(distance);
  checks.Near(found[0][1] / truth, 1.0, tolerance, "W2", line);
  vtkTable* bounds = distance->GetBounds();
  const double lower = columnValues(bounds, "LowerBound")[0];
  const double upper = columnValues(bounds, "UpperBound")[0];
  checks.That(lower <= truth * (1.0 + rounding), "lower bound", line);
  checks.That(lower <= upper, "order of the bounds", line);
  const bool isCertified = distance->GetMethod() == vtkTransportDistance::CERTIFIED;
  checks.That(!isCertified || upper >= truth * (1.0 - rounding), "upper bound", line);
  checks.That(found[0][1] == (isCertified ? lower : upper), "the bound that is taken", line);
}

// All the mass moves by one vector: W2 is its length.
void checkTranslations(Checks& checks)
{
  const std::vector<std::array<double, 2>> places = { { 12, 12 }, { 20, 12 }, { 12, 18 },
    { 24, 26 } };
  for (const int method : distanceMethods)
  {
    const double tolerance = method == vtkTransportDistance::CERTIFIED ? 0.01 : 0.02;
    const Matrix found = distancesOf(makeDistance(makeBells(places), method));
    CHECK(checks, found.size() == places.size());
    expectSymmetry(checks, found, __LINE__);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        const double truth =
          std::hypot(0.5 * (places[i][0] - places[j][0]), 2.0 * (places[i][1] - places[j][1]));
        expectDistance(checks,
          makeDistance(
            { makeBell(places[i][0], places[i][1]), makeBell(places[j][0], places[j][1]) }, method),
          truth, tolerance, __LINE__);
        CHECK_NEAR(checks, found[i][j] / truth, 1.0, tolerance);
      }
    }
  }
}

struct Box
{
  std::array<int, 3> Low;
  std::array<int, 3> High;
};

// Uniform in a box of cells, nothing outside.
vtkSmartPointer<vtkImageData> makeBox(const std::array<int, 3>& size, const Box& box)
{
  const auto points = [&](int axis) { return size[axis] > 1 ? size[axis] + 1 : 1; };
  auto image = makeImage(points(0), points(1), points(2), true, [&](vtkIdType i) {
    const std::array<vtkIdType, 3> cell = { i % size[0], i / size[0] % size[1],
      i / size[0] / size[1] };
    bool isInside = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      isInside = isInside &&
        (size[axis] == 1 || (cell[axis] >= box.Low[axis] && cell[axis] < box.High[axis]));
    }
    return isInside ? 1.0 : 0.0;
  });
  image->SetSpacing(0.5, 1.0, 2.0);
  return image;
}

// Mass moves independently along each axis: by the difference of the centres, and from one width w
// to the other, which adds (w - w')^2 / 12 to the mean square.
double boxDistance(const std::array<int, 3>& size, const Box& a, const Box& b)
{
  const std::array<double, 3> spacing = { 0.5, 1.0, 2.0 };
  double squared = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (size[axis] > 1)
    {
      const double centres = 0.5 * (a.Low[axis] + a.High[axis] - b.Low[axis] - b.High[axis]);
      const double widths = a.High[axis] - a.Low[axis] - b.High[axis] + b.Low[axis];
      squared += spacing[axis] * spacing[axis] * (centres * centres + widths * widths / 12.0);
    }
  }
  return std::sqrt(squared);
}

void checkBoxes(Checks& checks)
{
  const Box near = { { 2, 1, 3 }, { 10, 9, 9 } };
  const Box moved = { { 14, 5, 5 }, { 22, 13, 11 } };
  const Box wide = { { 12, 7, 2 }, { 24, 13, 12 } };
  for (const auto& size : { std::array<int, 3>{ 28, 1, 1 }, std::array<int, 3>{ 28, 16, 1 },
         std::array<int, 3>{ 28, 16, 14 } })
  {
    for (const int method : distanceMethods)
    {
      for (const Box& other : { moved, wide })
      {
        expectDistance(checks, makeDistance({ makeBox(size, near), makeBox(size, other) }, method),
          boxDistance(size, near, other), 0.06, __LINE__);
      }
    }
  }
}

// W2 of two densities on the same cells of a line, of width 1: the root of the integral of the
// squared difference of their quantile functions, both of which are linear between `breaks`.
double lineDistance(const Values& a, const Values& b)
{
  const auto cumulated = [](const Values& density) {
    Values sums(density.size() + 1, 0.0);
    std::partial_sum(density.begin(), density.end(), sums.begin() + 1);
    for (double& sum : sums)
    {
      sum /= std::accumulate(density.begin(), density.end(), 0.0);
    }
    return sums;
  };
  const Values sumsA = cumulated(a);
  const Values sumsB = cumulated(b);
  Values breaks = sumsA;
  breaks.insert(breaks.end(), sumsB.begin(), sumsB.end());
  std::sort(breaks.begin(), breaks.end());
  const auto quantile = [](const Values& sums, double mass) {
    const auto after = std::upper_bound(sums.begin(), sums.end() - 1, mass);
    const auto cell = std::max<std::ptrdiff_t>(after - sums.begin() - 1, 0);
    const double first = sums[static_cast<std::size_t>(cell)];
    return static_cast<double>(cell) +
      (mass - first) / (sums[static_cast<std::size_t>(cell) + 1] - first);
  };
  double squared = 0.0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
  {
    const double width = breaks[i + 1] - breaks[i];
    const double first = quantile(sumsA, breaks[i]) - quantile(sumsB, breaks[i]);
    const double last = quantile(sumsA, breaks[i + 1]) - quantile(sumsB, breaks[i + 1]);
    squared += width * (first * first + first * last + last * last) / 3.0;
  }
  return std::sqrt(squared);
}

void checkLine(Checks& checks)
{
  constexpr int cells = 60;
  const auto rising = [](vtkIdType i) { return bumpy(i) + 2.0 * static_cast<double>(i); };
  const auto falling = [](vtkIdType i) { return bumpy(i) + 3.0 * static_cast<double>(cells - i); };
  const Images images = { makeImage(cells + 1, 1, 1, true, rising),
    makeImage(cells + 1, 1, 1, true, falling) };
  const double truth =
    lineDistance(imageValues(images[0], "Density"), imageValues(images[1], "Density"));
  CHECK(checks, truth > 5.0);
  for (const int method : distanceMethods)
  {
    expectDistance(checks, makeDistance(images, method), truth, 0.01, __LINE__);
  }
}

Images makeNoise(int count)
{
  Images images;
  for (int k = 0; k < count; ++k)
  {
    images.push_back(makeImage(
      13, 13, 1, true, [=](vtkIdType i) { return std::pow(bumpy(i * (k + 3) + 7 * k), 3); }));
  }
  return images;
}

// Linearized distances are those of points in a Euclidean space, and hardly below W2.
void checkMetric(Checks& checks)
{
  const Images images = makeNoise(5);
  const Matrix found = distancesOf(makeDistance(images));
  const Matrix certified = distancesOf(makeDistance(images, vtkTransportDistance::CERTIFIED));
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    for (std::size_t j = 0; j < images.size(); ++j)
    {
      CHECK(checks, found[i][j] >= 0.98 * certified[i][j]);
      CHECK(checks, (i == j) == (found[i][j] == 0.0));
      for (std::size_t middle = 0; middle < images.size(); ++middle)
      {
        CHECK(checks, found[i][j] <= found[i][middle] + found[middle][j] + 1e-12);
      }
    }
  }
}

// The same densities in other units.
Images inUnits(const Images& images, double length, double mass)
{
  Images scaled;
  for (const auto& image : images)
  {
    scaled.push_back(vtkSmartPointer<vtkImageData>::New());
    scaled.back()->DeepCopy(image);
    scaled.back()->SetSpacing(0.5 * length, 2.0 * length, 1.0);
    scaled.back()->SetOrigin(-3.0 * length, 700.0 * length, 5.0);
    vtkDataArray* density = densityOf(scaled.back());
    for (vtkIdType i = 0; i < density->GetNumberOfTuples(); ++i)
    {
      density->SetComponent(i, 0, mass * density->GetComponent(i, 0));
    }
  }
  return scaled;
}

// In units of lengths that are powers of two, not a bit changes. The unit of the masses decides
// which density of a pair is moved to the other one, and the bounds of both ways differ a little.
void checkUnits(Checks& checks)
{
  const Images images = makeBells({ { 12, 12 }, { 20, 12 }, { 24, 26 } });
  for (const int method : distanceMethods)
  {
    const double tolerance = method == vtkTransportDistance::CERTIFIED ? 1e-3 : 1e-6;
    const Matrix found = distancesOf(makeDistance(images, method));
    const Matrix longer = distancesOf(makeDistance(inUnits(images, 0x1p130, 1.0), method));
    const Matrix lighter = distancesOf(makeDistance(inUnits(images, 1.0, 1e-30), method));
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        CHECK(checks, longer[i][j] == 0x1p130 * found[i][j]);
        CHECK_NEAR(checks, lighter[i][j] / found[i][j], 1.0, tolerance);
      }
    }
  }
}

} // namespace

int TestDistanceTruth(int, char*[])
{
  return runChecks({ checkTranslations, checkBoxes, checkLine, checkMetric, checkUnits });
}
