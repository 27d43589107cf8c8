// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Seeds/Seeds.h"

#include "Core/Geometry/LowDiscrepancy.h"
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Messages/PartText.h"
#include "Core/Parallel/Progress.h"
#include "Core/Seeds/BlueNoise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

// Sides are divided by each other, so that each must be positive and finite.
template <int Dimension>
void checkLengths(const Point<Dimension>& lengths)
{
  for (int a = 0; a < Dimension; ++a)
  {
    if (!(lengths[a] > 0.0) || !std::isfinite(lengths[a]))
    {
      std::ostringstream message;
      message << "the sides of the seeds' box must be positive and finite, but side " << a << " is "
              << lengths[a];
      throw std::invalid_argument(message.str());
    }
  }
}

void checkCount(std::int64_t count)
{
  if (count < 0)
  {
    throw std::invalid_argument(
      "the number of seeds must not be negative, but is " + std::to_string(count));
  }
}

template <int Dimension>
void checkGrid(const GridSize<Dimension>& size)
{
  for (int a = 0; a < Dimension; ++a)
  {
    if (size[a] < 0)
    {
      throw std::invalid_argument("the seeds' grid must not have a negative size, but axis " +
        std::to_string(a) + " has " + std::to_string(size[a]));
    }
  }
}

template <int Dimension>
using AxisOrder = std::array<int, Dimension>;

// Returns the axes by length, the shortest first. Equal axes are in descending order, so that rows
// run along axis 0.
template <int Dimension>
AxisOrder<Dimension> shortestFirst(const Point<Dimension>& lengths)
{
  AxisOrder<Dimension> order;
  for (int a = 0; a < Dimension; ++a)
  {
    order[a] = Dimension - 1 - a;
  }
  std::stable_sort(
    order.begin(), order.end(), [&](int a, int b) { return lengths[a] < lengths[b]; });
  return order;
}

// Returns the real number of cubes along axis order[first] if `count` equal cubes fill a box of the
// axes order[first] and after: n = (count * product over later axes of l_first / l_k)^(1 / axes).
template <int Dimension>
double cubesAlong(
  const Point<Dimension>& lengths, const AxisOrder<Dimension>& order, int first, double count)
{
  double power = count;
  for (int k = first + 1; k < Dimension; ++k)
  {
    power *= lengths[order[first]] / lengths[order[k]];
  }
  switch (Dimension - first)
  {
    case 1:
      return power;
    case 2:
      return root<2>(power);
    default:
      return root<3>(power);
  }
}

// Tries both roundings of the ideal number along every axis, the shortest first. Later axes
// compensate for earlier rounding, so that only the last one's rounding remains in the total.
template <int Dimension>
class LatticeChoice
{
public:
  LatticeChoice(const Point<Dimension>& lengths, std::int64_t count)
    : Lengths(lengths)
    , Order(shortestFirst<Dimension>(lengths))
    , Count(static_cast<double>(count))
  {
    GridSize<Dimension> size;
    size.fill(1);
    this->Try(size, 0, this->Count, 0.0);
  }
  const GridSize<Dimension>& Best() const { return this->Size; }

private:
  // Chooses the number along the k-th shortest axis. `remaining` is the number of points for the
  // other axes, `stretch` the sum of relative deviations from cubes so far.
  void Try(GridSize<Dimension> size, int k, double remaining, double stretch)
  {
    if (k == Dimension)
    {
      // 1 % too few or too many points cost as much as cells that are 10 % too long.
      // `remaining` is count / (product of the sizes) here, so the first term is the relative
      // error of the number of points.
      const double cost = std::abs(1.0 / remaining - 1.0) + 0.1 * stretch;
      if (cost < this->Cost)
      {
        this->Cost = cost;
        this->Size = size;
      }
      return;
    }
    // Cubes would have this real number of layers; a whole number must be near it.
    const double ideal = cubesAlong<Dimension>(this->Lengths, this->Order, k, remaining);
    const double lower = std::max(std::floor(ideal), 1.0);
    const double upper = std::max(std::ceil(ideal), 1.0);
    for (double n : { lower, upper })
    {
      size[this->Order[k]] = static_cast<std::int64_t>(n);
      // A box less than one cell thick has one layer of cells at no cost.
      const double ratio = ideal < 1.0 ? 1.0 : std::max(n / ideal, ideal / n);
      this->Try(size, k + 1, remaining / n, stretch + (ratio - 1.0));
    }
  }

  Point<Dimension> Lengths;
  AxisOrder<Dimension> Order;
  double Count;
  double Cost = std::numeric_limits<double>::infinity();
  GridSize<Dimension> Size;
};

// Divides the box into slabs across the shortest axis, with thicknesses in proportion to their
// numbers of points, then slabs into rows and rows into boxes of one point (stratified sampling for
// any count).
template <int Dimension>
class JitteredBoxes
{
public:
  // Makes points from number `firstPoint` on. A point's random word depends only on its number and
  // axis, so that any part of the pattern has the same bits.
  JitteredBoxes(const Point<Dimension>& lengths, std::uint64_t randomSeed, std::int64_t firstPoint,
    PointSpan<Dimension> unitPoints, Progress& progress)
    : Lengths(lengths)
    , Order(shortestFirst<Dimension>(lengths))
    , RandomSeed(randomSeed)
    , FirstPoint(firstPoint)
    , UnitPoints(unitPoints)
    , Work(progress)
  {
  }

  // Points [first, first + count) are those of a part of the box that is not yet divided along
  // order[k] and the axes after it.
  void Fill(int k, std::int64_t first, std::int64_t count) const
  {
    const std::int64_t slabs = this->NumberOfSlabs(k, count);
    // The first slabs have one point more, if the number of points is not a multiple.
    const std::int64_t smaller = count / slabs;
    const std::int64_t larger = count % slabs;
    std::int64_t begin = 0;
    for (std::int64_t slab = 0; slab < slabs; ++slab)
    {
      const std::int64_t size = smaller + (slab < larger ? 1 : 0);
      // Only the points of the wanted part are written; slabs without any are skipped.
      const std::int64_t from = std::max(first + begin, this->FirstPoint);
      const std::int64_t end =
        std::min(first + begin + size, this->FirstPoint + this->UnitPoints.size());
      for (std::int64_t i = from; i < end; ++i)
      {
        const int axis = this->Order[k];
        // Uniform in [0, 1), from the point's number and the axis.
        const double jitter =
          unitReal(randomWord(this->RandomSeed, static_cast<std::uint64_t>(i) * Dimension + axis));
        // The slab is [begin, begin + size) / count of the box, so that the measure of every box is
        // 1 / count.
        const double place = static_cast<double>(begin) + jitter * static_cast<double>(size);
        this->UnitPoints[i - this->FirstPoint][axis] = place / static_cast<double>(count);
      }
      // Slabs that hold none of the wanted points are not divided further, so that a part costs
      // only its own share.
      if (from < end)
      {
        if (k + 1 < Dimension)
        {
          this->Fill(k + 1, first + begin, size);
        }
        this->Work.Add(end - from);
      }
      begin += size;
    }
  }

private:
  // The slabs' number makes boxes as near to cubes as possible.
  std::int64_t NumberOfSlabs(int k, std::int64_t count) const
  {
    if (k + 1 == Dimension)
    {
      return count;
    }
    const double ideal =
      cubesAlong<Dimension>(this->Lengths, this->Order, k, static_cast<double>(count));
    return std::min(count, std::max<std::int64_t>(1, std::llround(ideal)));
  }

  Point<Dimension> Lengths;
  AxisOrder<Dimension> Order;
  std::uint64_t RandomSeed;
  std::int64_t FirstPoint;
  PointSpan<Dimension> UnitPoints;
  Progress& Work;
};

// Independent uniform coordinates from a counter-based generator, which can begin at any point.
template <int Dimension>
void generateRandom(
  std::uint64_t randomSeed, std::int64_t first, PointSpan<Dimension> unitPoints, Progress& progress)
{
  // Coordinate a of point i is random word number Dimension * i + a.
  std::uint64_t counter = static_cast<std::uint64_t>(first) * Dimension;
  for (std::int64_t i = 0; i < unitPoints.size() * Dimension; ++i)
  {
    unitPoints.data()[i] = unitReal(randomWord(randomSeed, counter++));
    progress.Add(1);
  }
}

// Additive recurrence x_n = frac(x_0 + n * alpha_a) in 64-bit integers, whose overflow is the
// fractional part.
template <int Dimension>
void generateLowDiscrepancy(
  std::uint64_t randomSeed, std::int64_t first, PointSpan<Dimension> unitPoints, Progress& progress)
{
  for (int a = 0; a < Dimension; ++a)
  {
    // A random shift by the seed, and the step times the first number.
    std::uint64_t fraction = randomWord(randomSeed, static_cast<std::uint64_t>(a)) +
      static_cast<std::uint64_t>(first) * lowDiscrepancyStep<Dimension>(a);
    for (std::int64_t i = 0; i < unitPoints.size(); ++i)
    {
      fraction += lowDiscrepancyStep<Dimension>(a);
      unitPoints[i][a] = unitReal(fraction);
      progress.Add(1);
    }
  }
}

// Throws unless the pattern has `points` seeds from number `first` on.
void requirePart(std::int64_t first, std::int64_t points, double all)
{
  if (first < 0 || static_cast<double>(points) > all - static_cast<double>(first))
  {
    throw std::invalid_argument("there are " + describeCount(all) + " seeds, not " +
      std::to_string(points) + " from number " + std::to_string(first) + " on");
  }
}

// Throws unless there is memory for one seed in each cell.
template <int Dimension>
void requireAllCells(const GridSize<Dimension>& size, std::int64_t points)
{
  checkGrid<Dimension>(size);
  const double cells = numberOfCells<Dimension>(size);
  if (static_cast<double>(points) != cells)
  {
    throw std::invalid_argument("there is memory for " + std::to_string(points) +
      " seeds, but the grid has " + describeCount(cells) + " cells");
  }
}

// Calls visit(cell) for the cells of a grid from number `first` on, axis 0 fastest.
template <int Dimension, class F>
void visitCells(const GridSize<Dimension>& size, std::int64_t first, std::int64_t points,
  const Context& context, F&& visit)
{
  checkGrid<Dimension>(size);
  requirePart(first, points, numberOfCells<Dimension>(size));
  Progress progress(context);
  progress.Expect(points);
  // The first cell's indices; the others follow by increments with carries.
  GridSize<Dimension> cell{};
  for (int a = 0; a < Dimension && points > 0; ++a)
  {
    cell[a] = first % size[a];
    first /= size[a];
  }
  for (std::int64_t i = 0; i < points; ++i)
  {
    visit(cell);
    for (int a = 0; a < Dimension && ++cell[a] == size[a]; ++a)
    {
      cell[a] = 0;
    }
    progress.Add(1);
  }
}

// Makes a point in each cell of a grid from number `first` on, axis 0 fastest: at placeIn() within
// the cell along each axis.
template <int Dimension, class Place>
void generateInCells(const GridSize<Dimension>& size, std::int64_t first,
  PointSpan<Dimension> unitPoints, const Context& context, Place placeIn)
{
  double* point = unitPoints.data();
  const auto write = [&](const GridSize<Dimension>& cell) {
    for (int a = 0; a < Dimension; ++a)
    {
      *point++ = (static_cast<double>(cell[a]) + placeIn()) / static_cast<double>(size[a]);
    }
  };
  visitCells<Dimension>(size, first, unitPoints.size(), context, write);
}

} // namespace

template <int Dimension>
GridSize<Dimension> latticeSize(const Point<Dimension>& lengths, std::int64_t count)
{
  checkLengths<Dimension>(lengths);
  checkCount(count);
  if (count == 0)
  {
    return GridSize<Dimension>{};
  }
  return LatticeChoice<Dimension>(lengths, count).Best();
}

template <int Dimension>
void generateSeeds(SeedPattern pattern, const Point<Dimension>& lengths, std::uint64_t randomSeed,
  PointSpan<Dimension> unitPoints, const Context& context)
{
  generateSeedsFrom<Dimension>(
    pattern, lengths, unitPoints.size(), randomSeed, 0, unitPoints, context);
}

template <int Dimension>
void generateSeedsFrom(SeedPattern pattern, const Point<Dimension>& lengths, std::int64_t count,
  std::uint64_t randomSeed, std::int64_t first, PointSpan<Dimension> unitPoints,
  const Context& context)
{
  checkLengths<Dimension>(lengths);
  checkCount(count);
  requirePart(first, unitPoints.size(), static_cast<double>(count));
  if (unitPoints.size() == 0)
  {
    return;
  }
  Progress progress(context);
  // Blue noise in 2D is made, cut and relaxed at its border, in 3D only made and cut: each step
  // counts all seeds.
  constexpr int unitsOfBlueNoise = Dimension == 2 ? 3 : 2;
  progress.Expect(
    pattern == SeedPattern::BlueNoise ? unitsOfBlueNoise * count : Dimension * unitPoints.size());
  switch (pattern)
  {
    case SeedPattern::BlueNoise:
      return generateBlueNoise<Dimension>(lengths, count, randomSeed, first, unitPoints, progress);
    case SeedPattern::Jittered:
      return JitteredBoxes<Dimension>(lengths, randomSeed, first, unitPoints, progress)
        .Fill(0, 0, count);
    case SeedPattern::LowDiscrepancy:
      return generateLowDiscrepancy<Dimension>(randomSeed, first, unitPoints, progress);
    case SeedPattern::Random:
      return generateRandom<Dimension>(randomSeed, first, unitPoints, progress);
    // A lattice is no pattern of an exact count.
    case SeedPattern::Lattice:
      break;
  }
  throw std::invalid_argument(
    "a lattice of seeds has a grid's number of points: use latticeSize and generateLattice");
}

template <int Dimension>
void generateLattice(
  const GridSize<Dimension>& size, PointSpan<Dimension> unitPoints, const Context& context)
{
  requireAllCells<Dimension>(size, unitPoints.size());
  generateLatticeFrom<Dimension>(size, 0, unitPoints, context);
}

// Seeds are at the centres of the cells, in fractions of the box.
template <int Dimension>
void generateLatticeFrom(const GridSize<Dimension>& size, std::int64_t first,
  PointSpan<Dimension> unitPoints, const Context& context)
{
  generateInCells<Dimension>(size, first, unitPoints, context, []() { return 0.5; });
}

template <int Dimension>
void generateJitteredLattice(const GridSize<Dimension>& size, std::uint64_t randomSeed,
  PointSpan<Dimension> unitPoints, const Context& context)
{
  requireAllCells<Dimension>(size, unitPoints.size());
  generateJitteredLatticeFrom<Dimension>(size, randomSeed, 0, unitPoints, context);
}

// The counter begins with the words of the first cell, so that a part has the bits of the whole.
template <int Dimension>
void generateJitteredLatticeFrom(const GridSize<Dimension>& size, std::uint64_t randomSeed,
  std::int64_t first, PointSpan<Dimension> unitPoints, const Context& context)
{
  const auto jitter = [&, counter = static_cast<std::uint64_t>(first) * Dimension]() mutable {
    return unitReal(randomWord(randomSeed, counter++));
  };
  generateInCells<Dimension>(size, first, unitPoints, context, jitter);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(latticeSize);

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(generateSeeds);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(generateSeedsFrom);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(generateLattice);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(generateLatticeFrom);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(generateJitteredLattice);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(generateJitteredLatticeFrom);

} // namespace RectifiedTransport
