// SPDX-License-Identifier: BSD-3-Clause
// Where the samples of vtkTransportMap lie and what its vectors mean: planes, one dimension,
// extents, spacings, directions, points and cells, other numbers of samples.
#include "MapTest.h"

#include "vtkMath.h"

#include <array>
#include <numeric>

namespace
{

struct Map
{
  Values Displacement;
  Values Divergence;
  Values Determinant;
  Values Places;
  double Cost;
  double Mass;
};

Map mapOf(vtkImageData* image, int direction = 0, std::array<int, 3> samples = { 0, 0, 0 })
{
  vtkNew<vtkTransportMap> map;
  map->SetInputData(image);
  map->SetDirection(direction);
  map->SetSampleDimensions(samples.data());
  map->Update();
  vtkImageData* output = map->GetOutput();
  return { imageValues(output, "Displacement"), imageValues(output, "Divergence"),
    imageValues(output, "JacobianDeterminant"), samplePlaces(output),
    fieldValue(output, "TransportCost"), fieldValue(output, "TotalMass") };
}

// One row or rectangle of cells in every orientation gives the same map, its axes permuted.
void checkPlanes(Checks& checks)
{
  struct Plane
  {
    std::array<int, 3> Cells;
    std::array<int, 3> Reference;
    std::array<int, 3> Axes; // which component of the image's vectors is x, y, z of the reference's
  };
  const Plane planes[] = { { { 11, 0, 6 }, { 11, 6, 0 }, { 0, 2, 1 } },
    { { 0, 11, 6 }, { 11, 6, 0 }, { 1, 2, 0 } }, { { 0, 17, 0 }, { 17, 0, 0 }, { 1, 0, 2 } },
    { { 0, 0, 17 }, { 17, 0, 0 }, { 2, 1, 0 } } };
  for (const Plane& plane : planes)
  {
    for (const int direction : { 0, 1 })
    {
      const Map wanted =
        mapOf(unitCells(plane.Reference[0], plane.Reference[1], plane.Reference[2]), direction);
      auto image = unitCells(plane.Cells[0], plane.Cells[1], plane.Cells[2]);
      image->SetOrigin(3.25, -2.0, 8.5);
      const Map map = mapOf(image, direction);
      CHECK(checks, map.Displacement.size() == wanted.Displacement.size());
      Values turned(map.Displacement.size());
      for (std::size_t i = 0; i < turned.size(); ++i)
      {
        turned[i] = map.Displacement[i - i % 3 + plane.Axes[i % 3]];
      }
      CHECK(checks, turned == wanted.Displacement);
      CHECK(checks, map.Divergence == wanted.Divergence);
      CHECK(checks, map.Determinant == wanted.Determinant);
      CHECK_NEAR(checks, map.Cost / wanted.Cost, 1.0, 1e-13);
    }
  }
}

// Displacements are in physical units along physical axes; what is derived does not depend on them.
void checkTransforms(Checks& checks)
{
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const double rotation[9] = { c, -s, 0, s * c, c * c, -s, s * s, s * c, c };
  const double sheer[9] = { 1, 0.5, 0, 0, 1, 0.25, 0, 0, 1 };
  const double flip[9] = { -1, 0, 0, 0, 0, 1, 0, 1, 0 };
  const double spacings[][3] = { { 1, 1, 1 }, { 2.5, 0.5, 2.5 }, { -1, 1, 1 }, { 1, -3, 0.01 } };
  for (const int depth : { 0, 5 })
  {
    for (const int direction : { 0, 1 })
    {
      auto image = unitCells(8, 6, depth);
      const Map reference = mapOf(image, direction);
      image->SetExtent(-5, 3, 10, 16, 2, 2 + depth);
      image->SetOrigin(100.0, -20.0, 3.0);
      for (const double* matrix : { rotation, sheer, flip })
      {
        for (const double* spacing : spacings)
        {
          image->SetDirectionMatrix(matrix);
          image->SetSpacing(spacing);
          const Map map = mapOf(image, direction);
          Values wanted(map.Displacement.size());
          for (std::size_t i = 0; i < wanted.size(); i += 3)
          {
            const double* d = reference.Displacement.data() + i;
            for (int r = 0; r < 3; ++r)
            {
              wanted[i + r] = matrix[3 * r] * spacing[0] * d[0] +
                matrix[3 * r + 1] * spacing[1] * d[1] + matrix[3 * r + 2] * spacing[2] * d[2];
            }
          }
          CHECK_NEAR(checks, largestDifference(map.Displacement, wanted), 0.0, 1e-12);
          CHECK(checks, map.Divergence == reference.Divergence);
          CHECK(checks, map.Determinant == reference.Determinant);
        }
      }
    }
  }
}

// Values on points are those of cells half a spacing around them.
void checkPointsAndCells(Checks& checks)
{
  const auto [cells, points] = makeCellsAndPoints();
  for (const int direction : { 0, 1 })
  {
    for (const std::array<int, 3>& samples :
      { std::array<int, 3>{ 0, 0, 0 }, std::array<int, 3>{ 4, 0, 8 } })
    {
      const Map ofCells = mapOf(cells, direction, samples);
      const Map ofPoints = mapOf(points, direction, samples);
      CHECK(checks, ofCells.Displacement == ofPoints.Displacement);
      CHECK(checks, ofCells.Divergence == ofPoints.Divergence);
      CHECK(checks, ofCells.Determinant == ofPoints.Determinant);
      CHECK(checks, ofCells.Cost == ofPoints.Cost && ofCells.Mass == ofPoints.Mass);
      CHECK_NEAR(checks, largestDifference(ofCells.Places, ofPoints.Places), 0.0, 1e-13);
    }
  }
}

// The sampler takes seeds at the samples' places to where the map says, up to rounding: VTK's
// versions invert the image's matrix to other last bits, and the flow's last boxes are so small
// that seeds moved by 1e-14 arrive up to 2e-9 away (measured here; when moved by 1e-10, 4e-9).
void checkAgainstSampler(Checks& checks, vtkImageData* image, std::array<int, 3> samples)
{
  const Map map = mapOf(image, 0, samples);
  std::size_t count = 1;
  for (int a = 0; a < 3; ++a)
  {
    int dimensions[3];
    image->GetDimensions(dimensions);
    const int values =
      dimensions[a] > 1 && image->GetCellData()->GetScalars() ? dimensions[a] - 1 : dimensions[a];
    count *= static_cast<std::size_t>(samples[a] > 0 ? samples[a] : values);
  }
  CHECK(checks, map.Divergence.size() == count && map.Places.size() == 3 * count);
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputData(image);
  sampler->SetSeedsData(makePoints(map.Places));
  sampler->Update();
  CHECK_NEAR(checks,
    largestDifference(
      arrayValues(pointArray(sampler->GetOutput(), "Displacement")), map.Displacement),
    0.0, 1e-8);
  CHECK_NEAR(checks, fieldValue(sampler->GetOutput(), "TransportCost") / map.Cost, 1.0, 1e-9);
  CHECK(checks, messages.Warnings.empty()); // all lie in the domain
}

void checkSamples(Checks& checks)
{
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  const double rotation[9] = { c, -s, 0, s, c, 0, 0, 0, 1 };
  for (const bool cells : { true, false })
  {
    auto volume = makeImage(12, 9, 7, cells, bumpy);
    auto plane = makeImage(12, 1, 9, cells, bumpy);
    volume->SetExtent(3, 14, -4, 4, 10, 16);
    plane->SetExtent(-3, 8, 5, 5, 0, 8);
    for (const auto& image : { volume, plane })
    {
      image->SetOrigin(5.0, 6.0, -7.0);
      image->SetSpacing(0.5, 1.5, 2.0);
      image->SetDirectionMatrix(rotation);
      const int flat = image == plane ? 1 : 0;
      for (const std::array<int, 3>& samples :
        { std::array<int, 3>{ 0, 0, 0 }, std::array<int, 3>{ 5, flat ? 1 : 3, 4 },
          std::array<int, 3>{ 24, flat ? 0 : 16, 29 }, std::array<int, 3>{ 0, 0, 2 } })
      {
        checkAgainstSampler(checks, image, samples);
      }
    }
  }
}

// The cells, or dual cells, of every output cover the input's domain.
void checkDomain(Checks& checks)
{
  for (const bool cells : { true, false })
  {
    auto image = makeImage(9, 7, 5, cells, bumpy);
    image->SetSpacing(0.5, 2.0, 1.25);
    image->SetExtent(4, 12, 0, 6, -2, 2);
    for (const int n : { 2, 3, 20 })
    {
      vtkNew<vtkTransportMap> map;
      map->SetInputData(image);
      map->SetSampleDimensions(n, n, n);
      map->Update();
      for (int a = 0; a < 3; ++a)
      {
        const auto domain = [&](vtkImageData* of, int side) {
          const double half = cells ? 0.0 : 0.5 * of->GetSpacing()[a];
          return of->GetBounds()[2 * a + side] + (side == 0 ? -half : half);
        };
        CHECK_NEAR(checks, domain(map->GetOutput(), 0), domain(image, 0), 1e-13);
        CHECK_NEAR(checks, domain(map->GetOutput(), 1), domain(image, 1), 1e-13);
      }
    }
  }
}

// The weights of the backward cost are masses of cells, whatever the samples are: halves of cells
// weigh half, and together they give nearly the same cost.
void checkWeights(Checks& checks)
{
  auto image = makeImage(41, 31, 1, true, smoothDensity(40, 30));
  const Map whole = mapOf(image, 1);
  CHECK_NEAR(checks, mapOf(image, 1, { 120, 90, 0 }).Cost / whole.Cost, 1.0, 2e-3);
  CHECK_NEAR(checks, mapOf(image, 1, { 20, 15, 0 }).Cost / whole.Cost, 1.0, 2e-2);

  // All mass in the left half: samples elsewhere do not count.
  auto half = makeImage(41, 31, 1, true, [](vtkIdType i) { return i % 40 < 20 ? 1.0 : 0.0; });
  const Map map = mapOf(half, 1);
  double cost = 0.0;
  for (std::size_t i = 0; i < 1200; ++i)
  {
    const double* d = map.Displacement.data() + 3 * i;
    cost += i % 40 < 20 ? (d[0] * d[0] + d[1] * d[1]) / 600.0 : 0.0;
  }
  CHECK_NEAR(checks, map.Cost / cost, 1.0, 1e-12);
  CHECK_NEAR(checks, map.Cost, 400.0 / 3.0, 1.5); // x goes to 2 x
}

// One cell is an axis, along which nothing can be derived; one point is none.
void checkThinAxes(Checks& checks)
{
  const Map one = mapOf(makeImage(2, 2, 2, true, [](vtkIdType) { return 3.0; }));
  CHECK(checks, one.Divergence == Values({ 0.0 }) && one.Determinant == Values({ 1.0 }));
  CHECK_NEAR(checks, one.Cost, 0.0, 1e-12);
  const Map strip = mapOf(makeImage(6, 2, 1, true, bumpy));
  const Map line = mapOf(makeImage(6, 1, 1, true, bumpy));
  CHECK_NEAR(checks, largestDifference(strip.Divergence, line.Divergence), 0.0, 0.1);
  for (std::size_t i = 0; i < 5; ++i)
  {
    CHECK_NEAR(checks, strip.Determinant[i], 1.0 + strip.Divergence[i], 1e-12);
  }
  const Map column = mapOf(makeImage(7, 9, 5, true, bumpy), 0, { 1, 4, 1 });
  CHECK(checks, column.Divergence.size() == 4);
}

} // namespace

int TestMapGeometry(int, char*[])
{
  return runChecks({ checkPlanes, checkTransforms, checkPointsAndCells, checkSamples, checkDomain,
    checkWeights, checkThinAxes });
}
