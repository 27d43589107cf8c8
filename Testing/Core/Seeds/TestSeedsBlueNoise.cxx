// SPDX-License-Identifier: BSD-3-Clause
// Whether the blue noise is one: spacing, spectrum, faces of the box, thin boxes.
#include "Core/Seeds/BlueNoiseTile.h"
#include "TestSeeds.h"

#include <cmath>
#include <complex>
#include <limits>
#include <numeric>

namespace RectifiedTransport
{
namespace
{

// Nearest-neighbour distances in the box of sides `lengths`, relative to those of the hexagonal or
// face-centred cubic lattice.
struct Spacing
{
  double Smallest;
  double Mean;
};

template <int Dimension>
class NeighbourGrid
{
public:
  NeighbourGrid(const std::vector<double>& points, const Point<Dimension>& lengths)
    : Points(points)
    , Lengths(lengths)
    , Next(points.size() / Dimension)
  {
    double volume = 1.0;
    for (double length : lengths)
    {
      volume *= length;
    }
    const double count = static_cast<double>(this->Next.size());
    this->Largest = Dimension == 1 ? volume / count
      : Dimension == 2             ? std::sqrt(2.0 / std::sqrt(3.0) * volume / count)
                                   : std::cbrt(std::sqrt(2.0) * volume / count);
    std::size_t cells = 1;
    for (int a = 0; a < Dimension; ++a)
    {
      this->Size[a] = std::max(1, static_cast<int>(lengths[a] / this->Largest));
      cells *= this->Size[a];
    }
    this->Head.assign(cells, -1);
    for (std::size_t i = 0; i < this->Next.size(); ++i)
    {
      int& head = this->Head[this->Index(this->CellOf(i))];
      this->Next[i] = head;
      head = static_cast<int>(i);
    }
  }

  Spacing Measure() const
  {
    Spacing spacing = { std::numeric_limits<double>::infinity(), 0.0 };
    for (std::size_t i = 0; i < this->Next.size(); ++i)
    {
      const double distance = this->Nearest(i) / this->Largest;
      spacing.Smallest = std::min(spacing.Smallest, distance);
      spacing.Mean += distance / static_cast<double>(this->Next.size());
    }
    return spacing;
  }

private:
  using Cell = std::array<int, Dimension>;

  Cell CellOf(std::size_t i) const
  {
    Cell cell;
    for (int a = 0; a < Dimension; ++a)
    {
      const int c = static_cast<int>(this->Points[i * Dimension + a] * this->Size[a]);
      cell[a] = std::min(c, this->Size[a] - 1);
    }
    return cell;
  }

  std::size_t Index(const Cell& cell) const
  {
    std::size_t index = 0;
    for (int a = 0; a < Dimension; ++a)
    {
      index = index * this->Size[a] + cell[a];
    }
    return index;
  }

  // Cells are at least as wide as the largest possible distance in the plane or space; in boxes
  // thinner than that, neighbours may be farther away.
  double Nearest(std::size_t i) const
  {
    const Cell centre = this->CellOf(i);
    for (int reach = 1;; reach *= 2)
    {
      double squared = std::numeric_limits<double>::infinity();
      double covered = std::numeric_limits<double>::infinity();
      Cell lowest;
      Cell highest;
      for (int a = 0; a < Dimension; ++a)
      {
        lowest[a] = std::max(centre[a] - reach, 0);
        highest[a] = std::min(centre[a] + reach, this->Size[a] - 1);
        if (lowest[a] > 0 || highest[a] < this->Size[a] - 1)
        {
          covered = std::min(covered, reach * this->Lengths[a] / this->Size[a]);
        }
      }
      Cell cell = lowest;
      for (bool more = true; more;)
      {
        for (int j = this->Head[this->Index(cell)]; j >= 0; j = this->Next[j])
        {
          if (j != static_cast<int>(i))
          {
            squared = std::min(squared, this->SquaredDistance(i, j));
          }
        }
        int a = 0;
        for (; a < Dimension && ++cell[a] > highest[a]; ++a)
        {
          cell[a] = lowest[a];
        }
        more = a < Dimension;
      }
      if (squared <= covered * covered)
      {
        return std::sqrt(squared);
      }
    }
  }

  double SquaredDistance(std::size_t i, std::size_t j) const
  {
    double squared = 0.0;
    for (int a = 0; a < Dimension; ++a)
    {
      const double difference =
        (this->Points[i * Dimension + a] - this->Points[j * Dimension + a]) * this->Lengths[a];
      squared += difference * difference;
    }
    return squared;
  }

  const std::vector<double>& Points;
  Point<Dimension> Lengths;
  std::vector<int> Next;
  std::vector<int> Head;
  Cell Size;
  double Largest;
};

template <int Dimension>
Spacing spacing(SeedPattern pattern, const Point<Dimension>& lengths, std::int64_t count,
  std::uint64_t randomSeed)
{
  const auto points = seeds<Dimension>(pattern, lengths, count, randomSeed);
  return NeighbourGrid<Dimension>(points, lengths).Measure();
}

template <int Dimension>
void expectSpacing(const Point<Dimension>& lengths, std::int64_t count, int numberOfSeeds,
  double smallest, double mean)
{
  SCOPED_TRACE(testing::Message() << testing::PrintToString(lengths) << ", " << count);
  for (int seed = 1; seed <= numberOfSeeds; ++seed)
  {
    const Spacing found = spacing<Dimension>(SeedPattern::BlueNoise, lengths, count, 7919 * seed);
    EXPECT_GE(found.Smallest, smallest) << "seed " << 7919 * seed;
    EXPECT_GE(found.Mean, mean) << "seed " << 7919 * seed;
  }
}

// The project's promise is 0.65 and 0.85.
constexpr double smallest2D = 0.83;
constexpr double mean2D = 0.88;

TEST(BlueNoise, KeepsItsSpacingInTheRectangle)
{
  const Point<2> boxes[] = { { 1.0, 1.0 }, { 4.0, 3.0 }, { 1.0, 3.0 }, { 10.0, 1.0 },
    { 1.0, 100.0 } };
  for (const Point<2>& lengths : boxes)
  {
    for (std::int64_t count : { 100, 101, 127, 200, 333, 1000 })
    {
      // Two rows in a strip are less than a hexagonal lattice.
      const bool isStrip = static_cast<double>(count) < 2.5 * lengths[1] / lengths[0];
      expectSpacing<2>(lengths, count, 25, smallest2D, isStrip ? 0.86 : mean2D);
    }
    expectSpacing<2>(lengths, 4096, 8, smallest2D, mean2D);
    expectSpacing<2>(lengths, 8192, 4, smallest2D, mean2D);
    expectSpacing<2>(lengths, 40000, 1, smallest2D, mean2D);
    expectSpacing<2>(lengths, 100000, 1, smallest2D, mean2D);
  }
}

TEST(BlueNoise, KeepsItsSpacingForEveryCount)
{
  for (std::int64_t count = 100; count < 700; ++count)
  {
    expectSpacing<2>({ 1.5, 1.0 }, count, 1, smallest2D, mean2D);
  }
}

TEST(BlueNoise, KeepsItsSpacingInStrips)
{
  // On both sides of the thickness where one dimension goes.
  expectSpacing<2>({ 40000.0, 4.0 }, 8192, 4, 0.85, 0.9);
  for (double aspect : { 150.0, 245.0, 255.0, 400.0, 1e6 })
  {
    expectSpacing<2>({ aspect, 1.0 }, 100, 20, 0.7, 0.9);
    expectSpacing<2>({ 1.0, 10.0 * aspect }, 1000, 4, 0.7, 0.9);
  }
}

TEST(BlueNoise, KeepsItsSpacingInTheBox)
{
  const Point<3> boxes[] = { { 1.0, 1.0, 1.0 }, { 4.0, 3.0, 2.0 }, { 10.0, 1.0, 10.0 },
    { 100.0, 1.0, 1.0 }, { 100.0, 100.0, 1.0 }, { 1.0, 1000.0, 3.0 } };
  for (const Point<3>& lengths : boxes)
  {
    expectSpacing<3>(lengths, 100, 10, 0.8, 0.84);
    expectSpacing<3>(lengths, 1000, 4, 0.8, 0.84);
    expectSpacing<3>(lengths, 8192, 1, 0.8, 0.84);
  }
}

TEST(BlueNoise, IsEvenlySpacedOnTheLine)
{
  for (std::int64_t count : { 2, 10, 1000 })
  {
    expectSpacing<1>({ 3.0 }, count, 10, 0.5, 0.55);
  }
}

TEST(BlueNoise, SpacingTellsOtherPatternsApart)
{
  const Spacing random = spacing<2>(SeedPattern::Random, { 1.0, 1.0 }, 1000, 1);
  EXPECT_NEAR(random.Mean, 0.465, 0.03); // 1/2 of the mean spacing for independent points
  EXPECT_LT(random.Smallest, 0.1);
  EXPECT_LT(spacing<2>(SeedPattern::Jittered, { 1.0, 1.0 }, 1000, 1).Mean, 0.7);
  // A square lattice in the centres of unit cells: 1 over the hexagonal 1.0746.
  std::vector<double> lattice(200);
  generateLattice<2>({ 10, 10 }, { lattice.data(), 100 });
  EXPECT_NEAR(NeighbourGrid<2>(lattice, { 1.0, 1.0 }).Measure().Mean, 0.9306, 1e-4);
}

// |sum of exp(-2 pi i k x)|^2 / count in the unit square; 1 on average for independent points.
class Spectrum
{
public:
  Spectrum(const std::vector<double>& points, int largest)
    : Largest(largest)
    , Side(2 * largest + 1)
    , Sums(Side * Side)
  {
    const std::size_t count = points.size() / 2;
    std::vector<std::complex<double>> waves[2];
    for (std::size_t i = 0; i < count; ++i)
    {
      for (int a = 0; a < 2; ++a)
      {
        waves[a].resize(this->Side);
        for (int k = -largest; k <= largest; ++k)
        {
          waves[a][k + largest] = std::polar(1.0, -2.0 * std::acos(-1.0) * k * points[2 * i + a]);
        }
      }
      for (int y = 0; y < this->Side; ++y)
      {
        for (int x = 0; x < this->Side; ++x)
        {
          this->Sums[y * this->Side + x] += waves[0][x] * waves[1][y];
        }
      }
    }
    this->Scale = 1.0 / static_cast<double>(count);
  }

  double operator()(int x, int y) const
  {
    return this->Scale *
      std::norm(this->Sums[(y + this->Largest) * this->Side + x + this->Largest]);
  }

private:
  int Largest;
  int Side;
  std::vector<std::complex<double>> Sums;
  double Scale;
};

TEST(BlueNoise, HasABlueAndIsotropicSpectrum)
{
  // 50 is the frequency of the mean spacing of 2500 points.
  constexpr int largest = 60;
  const Spectrum spectrum(seeds<2>(SeedPattern::BlueNoise, { 1.0, 1.0 }, 2500, 3), largest);
  double low = 0.0;
  int lowWaves = 0;
  constexpr int sectors = 12;
  double sector[sectors] = {};
  int sectorWaves[sectors] = {};
  std::vector<double> radial(largest + 1, 0.0);
  std::vector<int> radialWaves(largest + 1, 0);
  for (int y = 0; y <= largest; ++y)
  {
    for (int x = -largest; x <= largest; ++x)
    {
      const double radius = std::hypot(x, y);
      if (radius < 1.0 || radius >= largest)
      {
        continue;
      }
      const double power = spectrum(x, y);
      radial[static_cast<int>(radius)] += power;
      ++radialWaves[static_cast<int>(radius)];
      if (radius < 25.0)
      {
        low += power;
        ++lowWaves;
      }
      if (radius > 47.0 && radius < 57.0)
      {
        const int s = static_cast<int>(std::atan2(y, x) / std::acos(-1.0) * sectors) % sectors;
        sector[s] += power;
        ++sectorWaves[s];
      }
    }
  }
  EXPECT_LT(low / lowWaves, 0.06); // what the cut at the faces leaves
  double ring = 0.0;
  for (int s = 0; s < sectors; ++s)
  {
    ring += sector[s] / sectorWaves[s] / sectors;
  }
  for (int s = 0; s < sectors; ++s)
  {
    EXPECT_NEAR(sector[s] / sectorWaves[s], ring, 0.35 * ring) << "sector " << s;
  }
  for (int r = 1; r < largest; ++r)
  {
    // A lattice's would be hundreds.
    EXPECT_LT(radial[r] / radialWaves[r], 6.0) << "frequency " << r;
  }
}

TEST(BlueNoiseTile, IsSpacedAndHasNoPeaks)
{
  constexpr int count = BlueNoiseTile<2>::NumberOfPoints;
  std::vector<double> tile(2 * count);
  for (int i = 0; i < 2 * count; ++i)
  {
    tile[i] = BlueNoiseTile<2>::Coordinates[i] * 0x1p-16;
  }
  const Spacing spacing = NeighbourGrid<2>(tile, { 1.0, 1.0 }).Measure();
  EXPECT_GE(spacing.Smallest, 0.87);
  EXPECT_GE(spacing.Mean, 0.91);

  // A lattice has the number of its points; 69 is the frequency of the hexagonal one.
  constexpr int largest = 80;
  const Spectrum spectrum(tile, largest);
  for (int y = 0; y <= largest; ++y)
  {
    for (int x = -largest; x <= largest; ++x)
    {
      if (x != 0 || y != 0)
      {
        ASSERT_LE(spectrum(x, y), 0.02 * count) << x << ", " << y;
      }
    }
  }
}

// The box of `count` points ends half way between the last of them and the first outside: the one
// that the box of count + 1 has besides, in another unit. Returns where the two are, in the first
// box's unit.
std::array<double, 2> lastAndNext(
  const Point<3>& lengths, std::int64_t count, std::uint64_t randomSeed)
{
  double unit = 1.0;
  std::array<double, 2> largest{};
  for (int more = 0; more < 2; ++more)
  {
    const auto points = seeds<3>(SeedPattern::BlueNoise, lengths, count + more, randomSeed);
    largest[more] = *std::max_element(points.begin(), points.end());
    // The same point is the nearest to the corner in both.
    double nearest = 3.0;
    for (std::size_t i = 0; i < points.size(); i += 3)
    {
      nearest = std::min(nearest, std::accumulate(points.begin() + i, points.begin() + i + 3, 0.0));
    }
    unit = more == 0 ? nearest : unit / nearest;
  }
  return { largest[0], largest[1] * unit };
}

// In 3D: in 2D windows end there too, but the points at their faces move.
TEST(BlueNoise, EndsHalfWayToTheNextPoint)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    for (const std::int64_t count : { 100, 101, 1000 })
    {
      const auto [last, next] = lastAndNext({ 1.0, 2.0, 1.5 }, count, seed);
      EXPECT_LT(last, 1.0) << count << ", seed " << seed;
      EXPECT_NEAR(1.0 - last, next - 1.0, 1e-11) << count << ", seed " << seed;
    }
  }
}

// Seeds at a face stand in rows as those of a relaxed pattern do, the first half a row from it:
// within half a mean spacing of the face their share says where that row is, not how dense it is
// (it is 1.13). Layers that hold whole rows have the share of a uniform density.
TEST(BlueNoise, IsAsDenseAtTheFacesAsInside)
{
  constexpr int count = 400;
  constexpr int numberOfSeeds = 500;
  const std::array<double, 2> layersAndTolerances[] = { { 1.0, 0.02 }, { 2.0, 0.01 },
    { 3.0, 0.01 } };
  double share[3][4] = {};
  for (int seed = 0; seed < numberOfSeeds; ++seed)
  {
    const auto points = seeds<2>(SeedPattern::BlueNoise, { 1.0, 1.0 }, count, seed);
    for (int layer = 0; layer < 3; ++layer)
    {
      const double thickness = layersAndTolerances[layer][0] / std::sqrt(count);
      for (int i = 0; i < 2 * count; ++i)
      {
        share[layer][i % 2] += points[i] < thickness ? 1.0 : 0.0;
        share[layer][2 + i % 2] += points[i] > 1.0 - thickness ? 1.0 : 0.0;
      }
    }
  }
  for (int layer = 0; layer < 3; ++layer)
  {
    const auto& [spacings, tolerance] = layersAndTolerances[layer];
    for (double found : share[layer])
    {
      EXPECT_NEAR(found / (spacings * std::sqrt(count) * numberOfSeeds), 1.0, tolerance)
        << spacings;
    }
  }
}

} // namespace
} // namespace RectifiedTransport
