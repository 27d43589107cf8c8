// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Seeds/WindowBorder.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace RectifiedTransport
{

namespace
{

// The ratio of a step to the displacement to the centroid, so that one sweep is enough. Below 2 the
// energy does not grow (over-relaxed Lloyd's method). A centroid divides no chord of its convex
// cell worse than 1 : 2, so that steps with 1.5 end in the cell.
constexpr double relaxation = 1.5;
// The least distance that moves leave, in mean spacings: 0.86 of the spacing of the hexagonal
// lattice, sqrt(2 / sqrt(3)).
constexpr double smallestSpacing = 0.86 * 1.0745699318235418;
// The layers of bins, which are at least a mean spacing wide: those with seeds that move (a second
// layer would cost as much again for a twentieth of the gain), and those with seeds that bound
// their cells.
constexpr std::int64_t movedBins = 1;
constexpr std::int64_t knownBins = 3;

using Bin = std::array<std::int64_t, 2>;

// Returns the sides of the box in mean spacings.
Point<2> sidesOf(const Point<2>& lengths, std::int64_t count)
{
  Point<2> sides;
  for (std::size_t a = 0; a < 2; ++a)
  {
    sides[a] = std::sqrt(static_cast<double>(count) * (lengths[a] / lengths[1 - a]));
  }
  return sides;
}

// Bins are at least a mean spacing wide.
Bin binsOf(const Point<2>& sides)
{
  Bin bins;
  for (std::size_t a = 0; a < 2; ++a)
  {
    bins[a] = std::max(static_cast<std::int64_t>(sides[a]), std::int64_t{ 1 });
  }
  return bins;
}

// Lengths are in mean spacings. Seeds are found by bins. Only the bins near the faces exist: the
// grid has a hole, so that memory is O(sqrt(count)).
class WindowBorder
{
public:
  WindowBorder(const Point<2>& lengths, std::int64_t count, Progress& progress)
    : Work(progress)
    , Sides(sidesOf(lengths, count))
    , Bins(binsOf(this->Sides))
  {
    for (std::size_t a = 0; a < 2; ++a)
    {
      this->BinSides[a] = this->Sides[a] / static_cast<double>(this->Bins[a]);
      this->BinsPerSpacing[a] = static_cast<double>(this->Bins[a]) / this->Sides[a];
      this->Hole[a] = std::max(this->Bins[a] - 2 * knownBins, std::int64_t{ 0 });
    }
    const Bin last = { this->Bins[0] - 1, this->Bins[1] - 1 };
    this->Heads.assign(static_cast<std::size_t>(this->IndexOf(last) + 1), -1);
    const double area = this->BinSides[0] * this->BinSides[1];
    const double expected = static_cast<double>(this->Heads.size()) * area;
    // Even patterns have about one seed per unit of area, with small deviations.
    this->Seeds.reserve(static_cast<std::size_t>(1.02 * expected + 32.0));
  }

  // Call it in the order of the numbers; seeds that are not at the border change nothing.
  void Add(std::int64_t id, const double* x)
  {
    const Point<2> place = { x[0] * this->Sides[0], x[1] * this->Sides[1] };
    const Bin bin = this->BinOf(place);
    const std::int64_t depth = this->Depth(bin);
    if (depth < knownBins) // false for a seed next to the hole that rounding puts into it
    {
      this->Seeds.push_back({ place, id, this->Head(bin), depth < movedBins });
      this->Head(bin) = static_cast<std::int64_t>(this->Seeds.size()) - 1;
    }
  }

  // Gauss-Seidel: each seed moves before the next cell is made.
  void Relax()
  {
    for (std::size_t i = 0; i < this->Seeds.size(); ++i)
    {
      if (this->Seeds[i].Moves)
      {
        this->Move(i);
        this->Work.Add(1);
      }
    }
  }

  // Writes the moved seeds among those from number `first` on.
  void Write(std::int64_t first, PointSpan<2> unitPoints) const
  {
    for (const Seed& seed : this->Seeds)
    {
      const std::int64_t i = seed.Id - first;
      for (std::size_t a = 0; a < 2 && seed.Moves && i >= 0 && i < unitPoints.size(); ++a)
      {
        unitPoints[i][a] = std::clamp(seed.X[a] / this->Sides[a], 0.0, 1.0);
      }
    }
  }

private:
  // The seeds of a bin are a linked list through the array of all seeds.
  struct Seed
  {
    Point<2> X;
    std::int64_t Id;
    std::int64_t Next; // next seed in the same bin; -1 for none
    bool Moves;
  };
  // Returns how many bins are between a bin and the nearest face.
  std::int64_t Depth(const Bin& bin) const
  {
    return std::min({ bin[0], bin[1], this->Bins[0] - 1 - bin[0], this->Bins[1] - 1 - bin[1] });
  }

  // Numbers the bins that are not in the hole, row by row.
  std::int64_t IndexOf(const Bin& bin) const
  {
    const std::int64_t rows = std::clamp(bin[1] - knownBins, std::int64_t{ 0 }, this->Hole[1]);
    const bool isBehind = bin[0] >= knownBins && bin[1] >= knownBins && rows < this->Hole[1];
    return bin[1] * this->Bins[0] + bin[0] - this->Hole[0] * (rows + (isBehind ? 1 : 0));
  }
  std::int64_t& Head(const Bin& bin)
  {
    return this->Heads[static_cast<std::size_t>(this->IndexOf(bin))];
  }
  // A seed on the upper face is in the last bin.
  Bin BinOf(const Point<2>& x) const
  {
    Bin bin;
    for (std::size_t a = 0; a < 2; ++a)
    {
      const auto place = static_cast<std::int64_t>(x[a] * this->BinsPerSpacing[a]);
      bin[a] = std::clamp(place, std::int64_t{ 0 }, this->Bins[a] - 1);
    }
    return bin;
  }

  // Moves a seed by 3/2 of the way to the centroid of its cell, or by the part of it that keeps the
  // least distance to other seeds.
  void Move(std::size_t seed)
  {
    Point<2>& x = this->Seeds[seed].X;
    this->Cut(seed);
    // The centroid relative to the seed.
    const Point<2> centroid = this->Cell.Centroid();
    if (!std::isfinite(centroid[0]) || !std::isfinite(centroid[1]))
    {
      return; // seeds are so near that the area of the cell has no digits
    }
    const Point<2> step = { relaxation * centroid[0], relaxation * centroid[1] };
    const double part = this->FreePart(seed, step);
    const Bin before = this->BinOf(x);
    x = { x[0] + part * step[0], x[1] + part * step[1] };
    const Bin after = this->BinOf(x);
    if (after != before)
    {
      this->Relink(seed, before, after);
    }
  }

  // Clips the Voronoi cell of a seed out of the rectangle.
  void Cut(std::size_t seed)
  {
    const Point<2>& x = this->Seeds[seed].X;
    this->Cell.Begin({ -x[0], -x[1] }, { this->Sides[0] - x[0], this->Sides[1] - x[1] });
    this->VisitNear(
      seed, [this]() { return this->Cell.SquaredReach(); },
      [this](const Point<2>& other) { this->Cell.Cut(other); });
  }

  // Returns the largest part of a step that keeps the distance to all other seeds.
  double FreePart(std::size_t seed, const Point<2>& step)
  {
    const double square = step[0] * step[0] + step[1] * step[1];
    const double reach = std::sqrt(square) + smallestSpacing;
    double part = 1.0;
    this->VisitNear(
      seed, [reach]() { return reach * reach; },
      [&step, &part, square](const Point<2>& other) {
        const double distance = other[0] * other[0] + other[1] * other[1];
        // Seeds that are nearer already may keep their distance.
        const double least = std::min(smallestSpacing * smallestSpacing, distance);
        const double along = step[0] * other[0] + step[1] * other[1];
        // The first solution of |part step - other|^2 = least.
        const double discriminant = along * along - square * (distance - least);
        if (along > 0.0 && discriminant > 0.0)
        {
          part = std::min(part, (along - std::sqrt(discriminant)) / square);
        }
      });
    return part;
  }

  // Calls visit(other), relative to the seed, for all other seeds within the reach and for some
  // more. The reach may fall during the visits, as the cell shrinks.
  template <class Reach, class Visit>
  void VisitNear(std::size_t seed, const Reach& squaredReach, const Visit& visit)
  {
    const Bin centre = this->BinOf(this->Seeds[seed].X);
    const std::int64_t farthest = std::max(this->Bins[0], this->Bins[1]);
    for (std::int64_t ring = 0; ring < farthest; ++ring)
    {
      // Seeds nearer than that are in previous rings.
      const auto seen = static_cast<double>(std::max(ring - 1, std::int64_t{ 0 }));
      if (seen * seen >= squaredReach())
      {
        break;
      }
      this->VisitRing(seed, centre, ring, squaredReach, visit);
    }
  }

  // Visits the bins on a square ring; rows between its ends have two bins only.
  template <class Reach, class Visit>
  void VisitRing(std::size_t seed, const Bin& centre, std::int64_t ring, const Reach& squaredReach,
    const Visit& visit)
  {
    const Point<2>& x = this->Seeds[seed].X;
    for (std::int64_t j = std::max(centre[1] - ring, std::int64_t{ 0 });
         j <= std::min(centre[1] + ring, this->Bins[1] - 1); ++j)
    {
      const double rowDistance = this->DistanceFromBin(1, j, x[1]);
      if (rowDistance * rowDistance >= squaredReach())
      {
        continue;
      }
      const bool isWhole = ring == 0 || j == centre[1] - ring || j == centre[1] + ring;
      for (std::int64_t i = centre[0] - ring; i <= centre[0] + ring; i += isWhole ? 1 : 2 * ring)
      {
        const double distance = this->DistanceFromBin(0, i, x[0]);
        if (distance * distance + rowDistance * rowDistance >= squaredReach() || i < 0 ||
          i >= this->Bins[0] || this->Depth({ i, j }) >= knownBins)
        {
          continue;
        }
        for (std::int64_t k = this->Head({ i, j }); k >= 0;)
        {
          const Seed& other = this->Seeds[static_cast<std::size_t>(k)];
          if (static_cast<std::size_t>(k) != seed)
          {
            visit(Point<2>{ other.X[0] - x[0], other.X[1] - x[1] });
          }
          k = other.Next;
        }
      }
    }
  }

  // Returns the distance to a bin along an axis; 0 within it.
  double DistanceFromBin(std::size_t axis, std::int64_t bin, double x) const
  {
    const double low = static_cast<double>(bin) * this->BinSides[axis];
    return std::max({ low - x, x - (low + this->BinSides[axis]), 0.0 });
  }

  // Moves a seed to another bin's list.
  void Relink(std::size_t seed, const Bin& before, const Bin& after)
  {
    const auto id = static_cast<std::int64_t>(seed);
    std::int64_t* link = &this->Head(before);
    while (*link != id)
    {
      link = &this->Seeds[static_cast<std::size_t>(*link)].Next;
    }
    *link = this->Seeds[seed].Next;
    this->Seeds[seed].Next = this->Head(after);
    this->Head(after) = id;
  }

  Progress& Work;
  const Point<2> Sides;
  const Bin Bins; // number of bins along each axis
  Point<2> BinSides;
  Point<2> BinsPerSpacing;
  Bin Hole; // number of bins in the hole along each axis
  std::vector<Seed> Seeds;
  std::vector<std::int64_t> Heads; // first seed of each bin; -1 for none
  SeedCell Cell;
};

} // namespace

// The band is as wide as the bins that WindowBorder knows, in units of the rectangle's sides.
BorderBand::BorderBand(const Point<2>& lengths, std::int64_t count)
{
  const Bin bins = binsOf(sidesOf(lengths, count));
  for (std::size_t a = 0; a < 2; ++a)
  {
    this->Low[a] = static_cast<double>(knownBins) / static_cast<double>(bins[a]);
    this->High[a] = 1.0 - this->Low[a];
  }
}

void relaxBorder(const Point<2>& lengths, std::int64_t count, const std::vector<BorderSeed>& border,
  std::int64_t first, PointSpan<2> unitPoints, Progress& progress)
{
  WindowBorder all(lengths, count, progress);
  for (const BorderSeed& seed : border)
  {
    all.Add(seed.Number, seed.UnitPoint.data());
  }
  progress.Add(count);
  all.Relax();
  all.Write(first, unitPoints);
}

} // namespace RectifiedTransport
