// SPDX-License-Identifier: BSD-3-Clause
// Masses of triangles: areas times densities of points or triangles, also where triangles were cut.
#include "Surfaces/Mesh/DiskTriangles.h"
#include "Surfaces/SurfaceRelaxation/SurfaceMasses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// A square of side 2: two triangles below y = 1, the second with the last point within its side,
// and three above.
class Square
{
public:
  Square()
    : Triangles(copyOf<double>({ 0, 0, 0, 2, 0, 0, 0, 1, 0, 2, 1, 0, 0, 2, 0, 2, 2, 0, 1, 1, 0 }),
        copyOf<std::int64_t>({ 0, 1, 3, 0, 3, 2, 2, 6, 4, 6, 5, 4, 6, 3, 5 }), 0.0)
    , Disk(this->Triangles, this->Work)
  {
  }

  std::vector<double> ByGiven(
    const SurfaceDensityValues& density, const std::function<bool(std::int64_t)>& isEmpty = nullptr)
  {
    const TriangleMasses made = massesOf(this->Disk, density, isEmpty, this->Work);
    std::vector<double> masses(5, 0.0);
    for (std::int64_t t = 0; t < this->Disk.NumberOfTriangles(); ++t)
    {
      masses[static_cast<std::size_t>(this->Disk.GivenTriangle(t))] += made.Masses.data()[t];
    }
    return masses;
  }

private:
  template <class T>
  static LargeBuffer<T> copyOf(const std::vector<T>& values)
  {
    LargeBuffer<T> copy(static_cast<std::int64_t>(values.size()));
    std::copy(values.begin(), values.end(), copy.data());
    return copy;
  }

  Progress Work{ Context() };
  SurfaceTriangles Triangles;

public:
  const DiskTriangles Disk;
};

void expectNear(const std::vector<double>& found, const std::vector<double>& wanted)
{
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    EXPECT_NEAR(found[i], wanted[i], 1e-14) << i;
  }
}

TEST(TriangleMasses, AreAreasTimesMeansOverGivenTriangles)
{
  Square square;
  ASSERT_EQ(square.Disk.NumberOfTriangles(), 6);
  expectNear(square.ByGiven({}), { 0.25, 0.25, 0.125, 0.25, 0.125 });
  // The point within a side counts only for those triangles that have it.
  const std::vector<double> ofPoints{ 1.0, 2.0, 3.0, 5.0, 0.0, 0.0, 100.0 };
  SurfaceDensityValues density;
  density.AtPoints = ofPoints.data();
  expectNear(square.ByGiven(density),
    { 0.25 * 8.0 / 3.0, 0.25 * 3.0, 0.125 * 103.0 / 3.0, 0.25 * 100.0 / 3.0, 0.125 * 105.0 / 3.0 });
}

TEST(TriangleMasses, EmptyTrianglesHaveNone)
{
  Square square;
  const auto isEmpty = [&](std::int64_t t) { return square.Disk.GivenTriangle(t) == 1; };
  const std::vector<double> ofTriangles{ 1.0, 1.0, 1.0, 1.0, 1.0, 2.0 };
  SurfaceDensityValues density;
  density.OfTriangles = ofTriangles.data();
  const std::vector<double> masses = square.ByGiven(density, isEmpty);
  EXPECT_EQ(masses[1], 0.0);
  EXPECT_NEAR(masses[4], 0.25, 1e-14);
}

} // namespace
} // namespace RectifiedTransport
