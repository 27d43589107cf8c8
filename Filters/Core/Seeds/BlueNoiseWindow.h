// SPDX-License-Identifier: BSD-3-Clause
// A window on the periodic repetition of the blue-noise tile (BlueNoise.h).
#ifndef RectifiedTransport_BlueNoiseWindow_h
#define RectifiedTransport_BlueNoiseWindow_h

#include "Core/Geometry/Points.h"
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Progress.h"
#include "Core/Seeds/BlueNoiseTile.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
using WindowMatrix = Eigen::Matrix<double, Dimension, Dimension>;

// Row a is the direction of the window's axis a in the tile's axes.
template <int Dimension>
WindowMatrix<Dimension> windowAxes();

template <>
inline WindowMatrix<2> windowAxes<2>()
{
  // The slope is the golden ratio, the number that rationals approximate worst: lines of this
  // direction come close to closing on the torus latest.
  constexpr double cosine = 0.85065080835203993;
  constexpr double sine = 0.52573111211913361;
  return (WindowMatrix<2>() << cosine, sine, -sine, cosine).finished();
}

template <>
inline WindowMatrix<3> windowAxes<3>()
{
  // The rotation of an integer quaternion. It was selected from 20,000 random ones: its three axes
  // and three planes are farthest from those that close on the torus after a few periods.
  constexpr double a = 69.0;
  constexpr double b = 60.0;
  constexpr double c = 128.0;
  constexpr double d = 540.0;
  constexpr double n = a * a + b * b + c * c + d * d;
  return (WindowMatrix<3>() << (a * a + b * b - c * c - d * d) / n, 2.0 * (b * c - a * d) / n,
    2.0 * (b * d + a * c) / n, 2.0 * (b * c + a * d) / n, (a * a - b * b + c * c - d * d) / n,
    2.0 * (c * d - a * b) / n, 2.0 * (b * d - a * c) / n, 2.0 * (c * d + a * b) / n,
    (a * a - b * b - c * c + d * d) / n)
    .finished();
}

// Applies one of the symmetries of the square or the cube: permutes and flips the columns.
template <int Dimension>
WindowMatrix<Dimension> withWindowSymmetry(WindowMatrix<Dimension> axes, std::uint64_t choice)
{
  for (int a = 0; a < Dimension; ++a)
  {
    const int other = a + static_cast<int>(choice % (Dimension - a));
    choice /= Dimension - a;
    const double sign = choice % 2 == 0 ? 1.0 : -1.0;
    choice /= 2;
    axes.col(a).swap(axes.col(other));
    axes.col(a) *= sign;
  }
  return axes;
}

// A window on the periodic repetition of the tile. Its coordinates v are the distances from its
// corner along its axes, relative to the sides of the window that holds `count` points on average.
// A point lies in the window of size s if every v is in [0, s]; s is close to 1 when the window
// holds `count`.
template <int Dimension>
class BlueNoiseWindow
{
  static constexpr int NumberOfPoints = BlueNoiseTile<Dimension>::NumberOfPoints;
  static constexpr int PointsPerTileSide = Dimension == 2 ? 64 : 16;
  // The tile is searched in 2^TileLevel bins an axis.
  static constexpr int TileLevel = Dimension == 2 ? 4 : 3;
  static constexpr int BinsPerTile = 1 << (TileLevel * Dimension);

public:
  BlueNoiseWindow(const Point<Dimension>& lengths, std::int64_t count, std::uint64_t randomSeed,
    Progress& progress)
    : Work(progress)
    , Count(count)
    , Axes(
        withWindowSymmetry<Dimension>(windowAxes<Dimension>(), randomWord(randomSeed, Dimension)))
  {
    for (int a = 0; a < Dimension; ++a)
    {
      // The window's area in tiles is count / NumberOfPoints, with the box's proportions.
      double power = static_cast<double>(count) / NumberOfPoints;
      for (int b = 0; b < Dimension; ++b)
      {
        power *= lengths[a] / lengths[b];
      }
      this->Sides[a] = root<Dimension>(power);
      this->Corner[a] = unitReal(randomWord(randomSeed, a));
      this->Below[a] = 0.0;
      this->Above[a] = 0.0;
      for (int b = 0; b < Dimension; ++b)
      {
        // v = ToWindow x for offsets x from the corner, in tiles.
        this->ToWindow(a, b) = this->Axes(a, b) / this->Sides[a];
        this->Below[a] += std::min(this->ToWindow(a, b), 0.0);
        this->Above[a] += std::max(this->ToWindow(a, b), 0.0);
      }
    }
    this->PrepareTile();
  }

  // Finds the window of Count points.
  void FindSize()
  {
    // Collects the points between the sizes 1 - margin, which should hold fewer than `count`, and 1
    // + margin, which should hold more, and selects the count-th. The fluctuation of the number of
    // points in a window grows with its surface.
    double surface = 0.0;
    for (double side : this->Sides)
    {
      surface += 2.0 * static_cast<double>(this->Count) / (side * PointsPerTileSide);
    }
    double margin =
      (8.0 + 2.0 * std::sqrt(surface)) / (Dimension * static_cast<double>(this->Count));
    while (!this->Select(margin))
    {
      margin *= 2.0;
    }
  }

  // Calls visit(point) for each point, in their order.
  template <class VisitPoint>
  void Emit(const VisitPoint& visit) const
  {
    const double scale = 1.0 / this->Size;
    const double* tile = this->Tile.data();
    const auto emit = [&](const Point<Dimension>& origin, int i) {
      Point<Dimension> point;
      for (int a = 0; a < Dimension; ++a)
      {
        point[a] = std::min((origin[a] + tile[i * Dimension + a]) * scale, 1.0);
      }
      visit(point);
    };
    // If several points are exactly at the border, only as many as are missing belong to the
    // window.
    std::int64_t ties = this->Ties;
    this->Visit(
      this->LastSize, this->LastSize,
      [&](const Point<Dimension>& origin, int first, int last) {
        for (int i = first; i < last; ++i)
        {
          emit(origin, i);
        }
      },
      [&](const Point<Dimension>& origin, int first, int last) {
        for (int i = first; i < last; ++i)
        {
          const double size = this->SizeThatHolds(origin, i);
          if (size < this->LastSize || (size == this->LastSize && ties-- > 0))
          {
            emit(origin, i);
          }
        }
      });
  }

private:
  using Cell = std::array<std::int64_t, Dimension>;

  // Projects the tile's points to the window's axes, and counts the points of its bins: the first
  // TileLevel bits of the coordinates, interleaved, are the bin in Morton order.
  void PrepareTile()
  {
    this->Tile.resize(NumberOfPoints * Dimension);
    std::fill(std::begin(this->BinStart), std::end(this->BinStart), 0);
    const std::uint16_t* coordinates = BlueNoiseTile<Dimension>::Coordinates;
    for (int i = 0; i < NumberOfPoints; ++i, coordinates += Dimension)
    {
      int bin = 0;
      for (int bit = 15; bit > 15 - TileLevel; --bit)
      {
        for (int a = Dimension - 1; a >= 0; --a)
        {
          bin = bin << 1 | (coordinates[a] >> bit & 1);
        }
      }
      ++this->BinStart[bin + 1];
      Point<Dimension> fraction;
      for (int a = 0; a < Dimension; ++a)
      {
        fraction[a] = coordinates[a] * 0x1p-16;
      }
      for (int a = 0; a < Dimension; ++a)
      {
        this->Tile[i * Dimension + a] = this->Project(a, fraction);
      }
    }
    for (int bin = 0; bin < BinsPerTile; ++bin)
    {
      this->BinStart[bin + 1] += this->BinStart[bin];
    }
  }

  // Written out, because Eigen's product may add in another order, which would change bits.
  double Project(int a, const Point<Dimension>& vector) const
  {
    double sum = 0.0;
    for (int b = 0; b < Dimension; ++b)
    {
      sum += this->ToWindow(a, b) * vector[b];
    }
    return sum;
  }

  // Finds the cube of tiles, a power of two on a side, that contains the window of size `outer`.
  void PlaceRoot(double outer)
  {
    // The bounding box of the window in tiles, rounded down at its lower corner.
    double extent = 0.0;
    for (int b = 0; b < Dimension; ++b)
    {
      double lowest = this->Corner[b];
      double highest = this->Corner[b];
      for (int a = 0; a < Dimension; ++a)
      {
        const double step = this->Axes(a, b) * this->Sides[a] * outer;
        lowest += std::min(step, 0.0);
        highest += std::max(step, 0.0);
      }
      this->Root[b] = static_cast<std::int64_t>(std::floor(lowest)) * (1 << TileLevel);
      extent = std::max(extent, highest - std::floor(lowest));
    }
    this->RootLevel = TileLevel;
    for (double side = 1.0; side <= extent; side *= 2.0)
    {
      ++this->RootLevel;
    }
    for (int a = 0; a < Dimension; ++a)
    {
      // Larger than rounding: a bin counts as inside or outside only if each of its points does.
      this->Slack[a] = 1e-12 * (1.0 + (this->Above[a] - this->Below[a]) * extent);
    }
  }

  // Finds the size that holds exactly Count points, if it lies within `margin` of 1.
  bool Select(double margin)
  {
    const double inner = 1.0 - margin;
    const double outer = 1.0 + margin;
    this->PlaceRoot(outer);
    std::int64_t inside = 0;
    std::vector<double> band;
    this->Visit(
      inner, outer, [&](const Point<Dimension>&, int first, int last) { inside += last - first; },
      [&](const Point<Dimension>& origin, int first, int last) {
        for (int i = first; i < last; ++i)
        {
          const double size = this->SizeThatHolds(origin, i);
          if (size <= inner)
          {
            ++inside;
          }
          else if (size <= outer)
          {
            band.push_back(size);
          }
        }
      });
    // The window of Count points ends at the missing-th point of the band.
    const std::int64_t missing = this->Count - inside;
    // The inner window must hold fewer than Count points, and the outer one more.
    if (missing < 1 || missing >= static_cast<std::int64_t>(band.size()))
    {
      return false;
    }
    const auto last = band.begin() + (missing - 1);
    std::nth_element(band.begin(), last, band.end());
    this->LastSize = *last;
    this->Ties = missing - std::count_if(band.begin(), last, [&](double s) { return s < *last; });
    // The window ends in the middle between the last point inside and the first one outside, so
    // that points have similar distances to the upper and the lower faces.
    const double next = *std::min_element(last + 1, band.end());
    this->Size = *last + 0.5 * (next - *last);
    return true;
  }

  // The size of the smallest window that contains a point of a tile.
  double SizeThatHolds(const Point<Dimension>& origin, int i) const
  {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = 0.0;
    for (int a = 0; a < Dimension; ++a)
    {
      const double v = origin[a] + this->Tile[i * Dimension + a];
      lowest = std::min(lowest, v);
      highest = std::max(highest, v);
    }
    return lowest < 0.0 ? std::numeric_limits<double>::infinity() : highest;
  }

  // Calls whole(origin, first, last) for ranges of the tile at `origin` that lie in the window of
  // size `inner`, and part(...) for the others that overlap the window of size `outer`.
  template <class Whole, class Part>
  void Visit(double inner, double outer, Whole&& whole, Part&& part) const
  {
    this->VisitCell(this->Root, this->RootLevel, 0, inner, outer, whole, part);
  }

  // A cell is a cube of 2^level bins on a side; `code` is its place in the tile's Morton order.
  template <class Whole, class Part>
  void VisitCell(const Cell& cell, int level, int code, double inner, double outer, Whole& whole,
    Part& part) const
  {
    constexpr double binSide = 1.0 / (1 << TileLevel);
    const double side = static_cast<double>(std::int64_t(1) << level) * binSide;
    Point<Dimension> offset;
    for (int b = 0; b < Dimension; ++b)
    {
      offset[b] = static_cast<double>(cell[b]) * binSide - this->Corner[b];
    }
    // The bounds of the cell along each axis of the window: those of a corner plus the extent of a
    // tile.
    bool inside = true;
    for (int a = 0; a < Dimension; ++a)
    {
      const double v = this->Project(a, offset);
      const double lowest = v + side * this->Below[a];
      const double highest = v + side * this->Above[a];
      if (highest < -this->Slack[a] || lowest > outer + this->Slack[a])
      {
        return;
      }
      inside = inside && lowest >= this->Slack[a] && highest <= inner - this->Slack[a];
    }
    if (level == 0 || (inside && level <= TileLevel))
    {
      const int first = this->BinStart[code << (level * Dimension)];
      const int last = this->BinStart[(code + 1) << (level * Dimension)];
      this->Work.Add(last - first);
      const Point<Dimension> origin = this->TileOrigin(cell);
      if (inside)
      {
        whole(origin, first, last);
      }
      else
      {
        part(origin, first, last);
      }
      return;
    }
    for (int child = 0; child < 1 << Dimension; ++child)
    {
      Cell corner = cell;
      for (int a = 0; a < Dimension; ++a)
      {
        corner[a] += static_cast<std::int64_t>(child >> a & 1) << (level - 1);
      }
      const int childCode = level > TileLevel ? 0 : code << Dimension | child;
      this->VisitCell(corner, level - 1, childCode, inner, outer, whole, part);
    }
  }

  Point<Dimension> TileOrigin(const Cell& cell) const
  {
    Point<Dimension> offset;
    for (int b = 0; b < Dimension; ++b)
    {
      offset[b] = static_cast<double>(cell[b] >> TileLevel) - this->Corner[b];
    }
    Point<Dimension> origin;
    for (int a = 0; a < Dimension; ++a)
    {
      origin[a] = this->Project(a, offset);
    }
    return origin;
  }

  Progress& Work;
  std::int64_t Count;
  WindowMatrix<Dimension> Axes;
  WindowMatrix<Dimension> ToWindow;
  Point<Dimension> Sides;  // sides of the window of size 1, in tiles
  Point<Dimension> Corner; // corner of the window, in the tile at the origin
  Point<Dimension> Below;  // extent along v of a tile from its corner, <= 0
  Point<Dimension> Above;  // the same, >= 0
  Point<Dimension> Slack;
  std::vector<double> Tile; // v of the tile's points, from the tile's corner
  int BinStart[BinsPerTile + 1];
  Cell Root;
  int RootLevel;
  double LastSize = 0.0; // the smallest size that contains the last point
  std::int64_t Ties = 0; // points of exactly that size to take
  double Size = 0.0;     // size of the window that becomes the unit box
};

} // namespace RectifiedTransport

#endif
