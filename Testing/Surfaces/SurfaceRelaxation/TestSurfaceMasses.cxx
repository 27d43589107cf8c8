// SPDX-License-Identifier: BSD-3-Clause
// The masses of a surface that was read: of points, of cells, without ghosts; what is refused.
#include "Surfaces/Mesh/AllTriangles.h"
#include "Surfaces/SurfaceRelaxation/SurfaceMasses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <class T>
LargeBuffer<T> bufferOf(const std::vector<T>& values)
{
  LargeBuffer<T> copy(static_cast<std::int64_t>(values.size()));
  std::copy(values.begin(), values.end(), copy.data());
  return copy;
}

// A square of side 2 as two triangles, which are cells 1 and 2: cell 0 is a line.
class Square
{
public:
  Square()
    : Surface(bufferOf<double>({ 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0 }),
        bufferOf<std::int64_t>({ 0, 1, 2, 0, 2, 3 }), nullptr, this->Work)
  {
  }

  SurfaceMasses Masses(const ReadDensity& density)
  {
    return SurfaceMasses(this->Surface, density, this->Work);
  }

  std::string Refusal(const ReadDensity& density)
  {
    try
    {
      this->Masses(density);
    }
    catch (const std::runtime_error& error)
    {
      return error.what();
    }
    return "";
  }

private:
  Progress Work{ Context() };
  AllTriangles Surface;
};

ReadDensity densityOf(const std::vector<double>& values, bool onPoints)
{
  ReadDensity density;
  density.Values = values.data();
  density.OnPoints = onPoints;
  density.First = onPoints ? 0 : 1;
  density.Last = static_cast<std::int64_t>(values.size());
  density.Name = "The density array 'd'";
  density.CellOf = [](std::int64_t triangle) { return triangle + 1; };
  return density;
}

TEST(SurfaceMasses, AreAreasTimesDensities)
{
  Square square;
  EXPECT_EQ(square.Masses({}).Total(), 4.0);
  const std::vector<double> ofPoints{ 1.0, 2.0, 3.0, 5.0 };
  EXPECT_NEAR(square.Masses(densityOf(ofPoints, true)).Total(), 2.0 * 2.0 + 2.0 * 3.0, 1e-14);
  const std::vector<double> ofCells{ -1.0, 2.0, 6.0 }; // the line's does not count
  const SurfaceMasses masses = square.Masses(densityOf(ofCells, false));
  EXPECT_NEAR(masses.Total(), 16.0, 1e-14);
  EXPECT_NEAR(masses.Values()[1] / masses.Values()[0], 3.0, 1e-14);
  EXPECT_EQ(masses.Density().OfTriangles[1], 1.0);
}

TEST(SurfaceMasses, GhostsHaveNone)
{
  Square square;
  const std::vector<double> ofCells{ 0.0, 2.0, -6.0 };
  ReadDensity density = densityOf(ofCells, false);
  density.IsGhost = [](std::int64_t cell) { return cell == 2; };
  EXPECT_NEAR(square.Masses(density).Total(), 4.0, 1e-14);
  const std::vector<double> nothing{ 1.0, 0.0, 1.0 };
  density.Values = nothing.data();
  EXPECT_EQ(square.Refusal(density),
    "The density array 'd' has a total mass of zero (duplicate and blanked ghosts carry none); at "
    "least one value must be positive");
}

TEST(SurfaceMasses, RefusesWhatIsNoDensity)
{
  Square square;
  const std::vector<double> negative{ 1.0, -2.0, 1.0, -3.0 };
  EXPECT_EQ(square.Refusal(densityOf(negative, true)),
    "The density array 'd' has 2 negative values, the first at index 1 (-2); a density must not be "
    "negative");
  const std::vector<double> infinite{ 1.0, 1.0, std::numeric_limits<double>::infinity() };
  EXPECT_EQ(square.Refusal(densityOf(infinite, false)),
    "The density array 'd' has 1 value that is NaN or infinite, the first at index 2 (inf); every "
    "value must be finite");
  const std::vector<double> huge{ 0.0, 1e308, 1e308 };
  EXPECT_EQ(square.Refusal(densityOf(huge, false)),
    "The density array 'd' has a total mass past the largest double; its values must be smaller");
}

} // namespace
} // namespace RectifiedTransport
