// SPDX-License-Identifier: BSD-3-Clause
// Regions between rings on grids: areas of each cell against an exact sum over trapezoids, rings
// that cross, touch, are there twice or lie in each other; slabs; work that grows with the edges.
#include "Core/Geometry/ExactOrientation.h"
#include "Core/Overlap/RegionCoverage.h"
#include "Core/Overlap/RegionOutlines.h"
#include "Core/Overlap/RingCrossings.h"
#include "Core/Parallel/Progress.h"

#include "TestRings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace RectifiedTransport
{
namespace
{

using Values = std::vector<double>;

std::vector<OutlineEdge> outlinesOf(const std::vector<Ring>& all, const Values& values)
{
  Progress progress{ Context() };
  return regionOutlines(ringsOf(all), values, progress);
}

Values covered(const std::vector<Ring>& all, const Values& values, const GridSize<2>& size,
  std::int64_t slabs = 1)
{
  const std::vector<OutlineEdge> edges = outlinesOf(all, values);
  Values sums(static_cast<std::size_t>(numberOfCells<2>(size)), 0.0);
  for (std::int64_t s = 0; s < slabs; ++s)
  {
    const GridSlab<2> slab{ size, size[1] * s / slabs, size[1] * (s + 1) / slabs, sums.data() };
    RegionCoverage coverage(slab);
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
      coverage.Add(edges[i].From, edges[i].To);
      if (i + 1 == edges.size() || edges[i + 1].Ring != edges[i].Ring)
      {
        coverage.Finish(values[static_cast<std::size_t>(edges[i].Ring)]);
      }
    }
  }
  return sums;
}

// What is inside of an odd number of rings, as trapezoids between all heights where an edge begins
// or crosses another.
class Trapezoids
{
public:
  explicit Trapezoids(const std::vector<Ring>& all)
  {
    for (const Ring& ring : all)
    {
      for (std::size_t i = 0; i < ring.size(); ++i)
      {
        const Point<2>& a = ring[i];
        const Point<2>& b = ring[(i + 1) % ring.size()];
        this->Heights.insert(a[1]);
        if (a[1] != b[1])
        {
          this->Edges.push_back(a[1] < b[1] ? Edge{ a, b } : Edge{ b, a });
        }
      }
    }
    for (const Edge& e : this->Edges)
    {
      for (const Edge& f : this->Edges)
      {
        if (e.Slope() != f.Slope())
        {
          this->Heights.insert(
            (f.A[0] - f.Slope() * f.A[1] - e.A[0] + e.Slope() * e.A[1]) / (e.Slope() - f.Slope()));
        }
      }
    }
  }

  // Also at the lines of a grid.
  void Divide(const GridSize<2>& size)
  {
    for (std::int64_t j = 0; j <= size[1]; ++j)
    {
      this->Heights.insert(static_cast<double>(j));
    }
    for (const Edge& e : this->Edges)
    {
      for (std::int64_t i = 0; i <= size[0] && e.Slope() != 0.0; ++i)
      {
        this->Heights.insert(e.A[1] + (static_cast<double>(i) - e.A[0]) / e.Slope());
      }
    }
  }

  // Calls visit(y, height, from, to) of each, with its middle.
  template <class Visit>
  void ForEach(const Visit& visit) const
  {
    for (auto low = this->Heights.begin(); std::next(low) != this->Heights.end(); ++low)
    {
      const double y = 0.5 * (*low + *std::next(low));
      Values x;
      for (const Edge& e : this->Edges)
      {
        if (e.A[1] < y && y < e.B[1])
        {
          x.push_back(e.A[0] + (y - e.A[1]) * e.Slope());
        }
      }
      std::sort(x.begin(), x.end());
      for (std::size_t k = 0; k + 1 < x.size(); k += 2)
      {
        visit(y, *std::next(low) - *low, x[k], x[k + 1]);
      }
    }
  }

private:
  struct Edge // upward
  {
    Point<2> A;
    Point<2> B;
    double Slope() const { return (this->B[0] - this->A[0]) / (this->B[1] - this->A[1]); }
  };

  std::vector<Edge> Edges;
  std::set<double> Heights;
};

Values expected(const std::vector<Ring>& all, const GridSize<2>& size)
{
  Trapezoids trapezoids(all);
  trapezoids.Divide(size);
  Values sums(static_cast<std::size_t>(numberOfCells<2>(size)), 0.0);
  trapezoids.ForEach([&](double y, double height, double from, double to) {
    for (std::int64_t i = 0; i < size[0] && y > 0.0 && y < static_cast<double>(size[1]); ++i)
    {
      const double length =
        std::min(to, static_cast<double>(i + 1)) - std::max(from, static_cast<double>(i));
      sums[static_cast<std::size_t>(i + size[0] * static_cast<std::int64_t>(std::floor(y)))] +=
        std::max(length, 0.0) * height;
    }
  });
  return sums;
}

double evenOddArea(const std::vector<Ring>& all)
{
  double area = 0.0;
  Trapezoids(all).ForEach(
    [&area](double, double height, double from, double to) { area += (to - from) * height; });
  return area;
}

void expectEqual(const Values& found, const Values& right, double tolerance = 1e-10)
{
  ASSERT_EQ(found.size(), right.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    ASSERT_NEAR(found[i], right[i], tolerance) << "cell " << i;
  }
}

double sumOf(const Values& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

Ring randomRing(int points, const GridSize<2>& size, bool onLattice, std::mt19937& engine)
{
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Ring ring;
  for (int i = 0; i < points; ++i)
  {
    Point<2> x{ unit(engine) * static_cast<double>(size[0]),
      unit(engine) * static_cast<double>(size[1]) };
    if (onLattice)
    {
      x = { std::round(x[0]), std::round(x[1]) };
    }
    ring.push_back(x);
  }
  return ring;
}

Ring star(int points, double x, double y, double radius, double depth, unsigned int seed)
{
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Values angles;
  for (int i = 0; i < points; ++i)
  {
    angles.push_back(unit(engine) * 2.0 * std::acos(-1.0));
  }
  std::sort(angles.begin(), angles.end());
  Ring ring;
  for (const double angle : angles)
  {
    const double r = radius * (1.0 - depth * unit(engine));
    ring.push_back({ x + r * std::cos(angle), y + r * std::sin(angle) });
  }
  return ring;
}

const GridSize<2> someSize{ 9, 7 };

TEST(Regions, OfRandomRingsAreEvenOdd)
{
  std::mt19937 engine(5);
  for (int i = 0; i < 400; ++i)
  {
    std::vector<Ring> rings;
    for (int r = 0; r <= i % 4; ++r)
    {
      rings.push_back(randomRing(3 + (i + r) % 11, someSize, i % 2 == 1, engine));
    }
    SCOPED_TRACE(i);
    expectEqual(covered(rings, Values(rings.size(), 1.0), someSize), expected(rings, someSize));
  }
}

// With binned edges.
TEST(Regions, OfManyCrossingEdgesAreEvenOdd)
{
  std::mt19937 engine(17);
  for (const bool onLattice : { false, true })
  {
    const std::vector<Ring> rings{ randomRing(90, someSize, onLattice, engine),
      star(120, 4.0, 3.0, 3.0, 0.9, 3), star(150, 5.0, 3.5, 3.0, 0.5, 4) };
    expectEqual(
      covered(rings, Values(rings.size(), 1.0), someSize), expected(rings, someSize), 1e-8);
  }
}

TEST(Regions, WithAHoleDrawnAsAKeyholeLoseIt)
{
  const Ring keyhole{ { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 }, { 0, 0 }, { 1, 1 }, { 1, 3 },
    { 3, 3 }, { 3, 1 }, { 1, 1 } };
  const Values sums = covered({ keyhole }, { 2.0 }, { 4, 4 });
  EXPECT_NEAR(sumOf(sums), 24.0, 1e-12);
  EXPECT_EQ(sums[5], 0.0); // nothing at all
  EXPECT_EQ(sums[0], 2.0);
  // The other way round, and from another corner.
  Ring reversed(keyhole.rbegin(), keyhole.rend());
  std::rotate(reversed.begin(), reversed.begin() + 3, reversed.end());
  expectEqual(covered({ reversed }, { 2.0 }, { 4, 4 }), sums);
}

TEST(Regions, DoNotHaveSpikes)
{
  const Ring spiked{ { 0, 0 }, { 4, 0 }, { 4, 1 }, { 6, 1.5 }, { 4, 1 }, { 1, 1 }, { 1, 4 },
    { 0, 4 } };
  const Values sums = covered({ spiked }, { 1.0 }, { 6, 4 });
  EXPECT_NEAR(sumOf(sums), 7.0, 1e-12);
  EXPECT_EQ(sums[10], 0.0);
  EXPECT_EQ(sums[11], 0.0);
  const Ring line{ { 1, 1 }, { 3, 2 }, { 5, 3 }, { 3, 2 } };
  EXPECT_EQ(sumOf(covered({ line }, { 1.0 }, { 6, 4 })), 0.0);
  const Ring twice{ { 1, 1 }, { 3, 1 }, { 3, 3 }, { 1, 3 }, { 1, 1 }, { 3, 1 }, { 3, 3 },
    { 1, 3 } };
  EXPECT_NEAR(sumOf(covered({ twice }, { 1.0 }, { 6, 4 })), 0.0, 1e-12);
}

Ring square(double low, double high, bool reversed = false)
{
  Ring ring{ { low, low }, { high, low }, { high, high }, { low, high } };
  if (reversed)
  {
    std::reverse(ring.begin(), ring.end());
  }
  return ring;
}

// The area of each ring's region.
Values areasOf(const std::vector<Ring>& rings, const Values& values)
{
  Values areas(rings.size(), 0.0);
  const std::vector<OutlineEdge> edges = outlinesOf(rings, values);
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j)
  {
    while (j < edges.size() && edges[j].Ring == edges[i].Ring)
    {
      ++j;
    }
    areas[static_cast<std::size_t>(edges[i].Ring)] =
      sizeOfRegion(edges.data() + i, edges.data() + j).Area;
  }
  return areas;
}

TEST(Regions, InEachOtherAreHolesAndIslands)
{
  for (const bool reversed : { false, true })
  {
    const std::vector<Ring> nested{ square(0, 8), square(1, 7, reversed), square(2, 5),
      square(3, 4, reversed) };
    EXPECT_EQ(areasOf(nested, { 3, 3, 3, 3 }), Values({ 28, 0, 8, 0 }));
    EXPECT_EQ(areasOf(nested, { 3, 9, 5, 7 }), Values({ 28, 0, 8, 0 }));
  }
  // A hole, and the region that fills it, in any order.
  EXPECT_EQ(
    areasOf({ square(0, 4), square(1, 3), square(1, 3, true) }, { 3, 3, 5 }), Values({ 12, 0, 4 }));
  EXPECT_EQ(
    areasOf({ square(1, 3), square(0, 4), square(1, 3) }, { 5, 3, 3 }), Values({ 4, 12, 0 }));
  // Neighbours share an edge.
  const Ring beside{ { 4, 0 }, { 6, 0 }, { 6, 4 }, { 4, 4 } };
  EXPECT_EQ(areasOf({ square(0, 4), beside }, { 3, 5 }), Values({ 16, 8 }));
  EXPECT_EQ(areasOf({ beside, square(0, 4) }, { 3, 3 }), Values({ 8, 16 }));
}

TEST(Regions, HaveTheSameBitsInSlabs)
{
  const GridSize<2> size{ 40, 37 };
  const std::vector<Ring> rings{ star(500, 20, 18, 17.0, 0.8, 1) };
  const Values whole = covered(rings, { 1.5 }, size);
  EXPECT_EQ(covered(rings, { 1.5 }, size, 5), whole);
  EXPECT_NEAR(sumOf(whole), 1.5 * std::abs(windingArea(ringsOf(rings), 0)), 1e-9);
}

TEST(Regions, BeyondTheGridAreNotAdded)
{
  for (const double value : covered({ square(-3, 30) }, { 2.0 }, { 5, 4 }))
  {
    EXPECT_EQ(value, 2.0);
  }
  const Ring slanted{ { -4, 1 }, { 3, -6 }, { 12, 3 }, { 5, 9 } };
  expectEqual(covered({ slanted }, { 1.0 }, someSize), expected({ slanted }, someSize));
}

TEST(Regions, FarSmallerThanACellKeepTheirArea)
{
  Ring small = star(30, 0.0, 0.0, 1e-6, 0.5, 9);
  for (Point<2>& x : small)
  {
    x = { x[0] + 3.25, x[1] + 2.75 };
  }
  const double area = std::abs(windingArea(ringsOf({ small }), 0));
  const Values sums = covered({ small }, { 1.0 }, someSize);
  EXPECT_NEAR(sumOf(sums), area, 1e-6 * area);
  EXPECT_EQ(sums[3 + 9 * 2], sumOf(sums));
}

TEST(Regions, CentroidIsThatOfTheArea)
{
  const std::vector<OutlineEdge> edges = outlinesOf({ square(0, 4), square(2, 4) }, { 1, 1 });
  const RegionSize size = sizeOfRegion(edges.data(), edges.data() + edges.size());
  EXPECT_NEAR(size.Area, 12.0, 1e-12);
  EXPECT_NEAR(size.Centroid[0], (16.0 * 2.0 - 4.0 * 3.0) / 12.0, 1e-12);
}

// Against all pairs, whatever touches.
// Edges on each other cross in an order in which three lines can.
TEST(Regions, WithEdgesOnEachOtherAreEvenOdd)
{
  const std::vector<Ring> rings{ { { 2, 1 }, { 0, 2 }, { 2, 1 } },
    { { 0, 3 }, { 3, 3 }, { 2, 1 }, { 4, 1 }, { 4, 3 }, { 1, 3 }, { 1, 1 }, { 4, 3 } } };
  EXPECT_NEAR(evenOddArea(rings), 5.0, 1e-12);
  EXPECT_NEAR(sumOf(areasOf(rings, { 1.0, 1.0 })), 5.0, 1e-12);
  std::mt19937 engine(1);
  std::uniform_int_distribution<int> points(3, 9);
  std::uniform_int_distribution<std::size_t> many(1, 3);
  // As they are, and turned so that rounding moves the edges from each other.
  for (const double turned : { 0.0, 0.1 })
  {
    for (int i = 0; i < 10000; ++i)
    {
      std::vector<Ring> drawn(many(engine));
      for (Ring& ring : drawn)
      {
        ring = randomRing(points(engine), { 4, 4 }, true, engine);
        for (Point<2>& x : ring)
        {
          x = turned > 0.0
            ? Point<2>{ turned * (0.8 * x[0] - 0.6 * x[1]), turned * (0.6 * x[0] + 0.8 * x[1]) }
            : x;
        }
      }
      ASSERT_NEAR(sumOf(areasOf(drawn, Values(drawn.size(), 1.0))), evenOddArea(drawn), 1e-11) << i;
    }
  }
}

TEST(RingSweep, FindsWhetherEdgesCross)
{
  std::mt19937 engine(31);
  int crossed = 0;
  constexpr int runs = 4000;
  for (int i = 0; i < runs; ++i)
  {
    std::vector<Ring> all{ randomRing(3 + i % 6, { 4, 4 }, i % 2 == 1, engine) };
    if (i % 3 == 0)
    {
      all.push_back(randomRing(3 + i % 2, { 3, 5 }, i % 2 == 1, engine));
    }
    const Rings rings = ringsOf(all);
    Progress progress{ Context() };
    const bool doCross = !findCrossings(rings, progress).empty();
    crossed += doCross ? 1 : 0;
    ASSERT_EQ(haveCrossings(rings, progress), doCross) << i;
  }
  EXPECT_GT(crossed, runs / 5);
  EXPECT_LT(crossed, runs * 4 / 5);
}

TEST(RingSweep, FindsTheOneCrossingOfManyEdges)
{
  Ring spiky = star(20000, 0.0, 0.0, 1.0, 0.3, 2);
  Progress progress{ Context() };
  EXPECT_FALSE(haveCrossings(ringsOf({ spiky }), progress));
  std::swap(spiky[7000], spiky[7001]);
  const Rings rings = ringsOf({ spiky });
  EXPECT_EQ(haveCrossings(rings, progress), !findCrossings(rings, progress).empty());
  std::swap(spiky[7000], spiky[7003]);
  EXPECT_TRUE(haveCrossings(ringsOf({ spiky }), progress));
}

TEST(ExactOrientation, AgreesWithIntegersAndIsNeverZero)
{
  std::mt19937 engine(23);
  std::uniform_int_distribution<int> few(0, 3);
  for (int i = 0; i < 3000; ++i)
  {
    std::array<NumberedPoint, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
    {
      p[k] = { { 0.1 + few(engine) * 0.3, few(engine) / 3.0 }, static_cast<std::int64_t>(k) };
    }
    const bool isLeft = turnsLeft(p[0], p[1], p[2]);
    EXPECT_EQ(isLeft, turnsLeft(p[1], p[2], p[0]));
    EXPECT_NE(isLeft, turnsLeft(p[0], p[2], p[1]));
  }
  // A last digit that the product of differences does not have.
  const double tiny = std::ldexp(1.0, -52);
  const NumberedPoint a{ { 1.0, 1.0 }, 0 };
  const NumberedPoint b{ { 3.0, 3.0 }, 1 };
  EXPECT_TRUE(turnsLeft(a, b, { { 2.0, 2.0 + 2.0 * tiny }, 2 }));
  EXPECT_FALSE(turnsLeft(a, b, { { 2.0, 2.0 - 2.0 * tiny }, 2 }));
}

} // namespace
} // namespace RectifiedTransport
