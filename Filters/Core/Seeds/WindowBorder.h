// SPDX-License-Identifier: BSD-3-Clause
// The border of a rectangle that was cut out of an even pattern of the plane. The cut leaves seeds
// too close to a face or too far from it.
#ifndef RectifiedTransport_WindowBorder_h
#define RectifiedTransport_WindowBorder_h

#include "Core/Geometry/Points.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// A convex polygon that contains the seed, which is the origin.
class SeedCell
{
public:
  // Begins with the rectangle.
  void Begin(const Point<2>& low, const Point<2>& high)
  {
    this->Corners = { low, { high[0], low[1] }, high, { low[0], high[1] } };
    this->FindRadius();
  }

  // Cuts away the half-plane that is nearer to another seed, which must not be at the origin.
  void Cut(const Point<2>& other)
  {
    // The bisector is at half the distance: other . x = |other|^2 / 2.
    const double square = other[0] * other[0] + other[1] * other[1];
    if (square >= this->SquaredReach())
    {
      return;
    }
    this->Excess.clear();
    bool isCut = false;
    for (const Point<2>& x : this->Corners)
    {
      this->Excess.push_back(other[0] * x[0] + other[1] * x[1] - 0.5 * square);
      isCut = isCut || this->Excess.back() > 0.0;
    }
    if (isCut)
    {
      this->KeepInside();
    }
  }

  // A farther seed cannot cut the cell: twice the radius, squared.
  double SquaredReach() const { return 4.0 * this->SquaredRadius; }

  Point<2> Centroid() const
  {
    // The centroid as an integral over triangles from the seed: sum of cross (a + b) / (3 sum of
    // cross), where cross is twice a triangle's area.
    double area = 0.0;
    Point<2> moment{};
    for (std::size_t k = 0; k < this->Corners.size(); ++k)
    {
      const Point<2>& a = this->Corners[k];
      const Point<2>& b = this->Corners[this->After(k)];
      const double cross = a[0] * b[1] - a[1] * b[0];
      area += cross;
      moment[0] += cross * (a[0] + b[0]);
      moment[1] += cross * (a[1] + b[1]);
    }
    return { moment[0] / (3.0 * area), moment[1] / (3.0 * area) };
  }

private:
  std::size_t After(std::size_t corner) const
  {
    return corner + 1 < this->Corners.size() ? corner + 1 : 0;
  }

  // Clips by the half-plane (Sutherland and Hodgman).
  void KeepInside()
  {
    this->Clipped.clear();
    for (std::size_t k = 0; k < this->Corners.size(); ++k)
    {
      const Point<2>& a = this->Corners[k];
      const Point<2>& b = this->Corners[this->After(k)];
      const double from = this->Excess[k];
      const double to = this->Excess[this->After(k)];
      if (from <= 0.0)
      {
        this->Clipped.push_back(a);
      }
      if ((from > 0.0) != (to > 0.0))
      {
        const double part = from / (from - to);
        this->Clipped.push_back({ a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]) });
      }
    }
    this->Corners.swap(this->Clipped);
    this->FindRadius();
  }

  void FindRadius()
  {
    this->SquaredRadius = 0.0;
    for (const Point<2>& x : this->Corners)
    {
      this->SquaredRadius = std::max(this->SquaredRadius, x[0] * x[0] + x[1] * x[1]);
    }
  }

  std::vector<Point<2>> Corners; // counter-clockwise
  std::vector<Point<2>> Clipped;
  std::vector<double> Excess; // excess of each corner beyond the bisector
  double SquaredRadius = 0.0;
};

// The band of the seeds that move or bound the cells of those that move, for `count` seeds.
class BorderBand
{
public:
  BorderBand(const Point<2>& lengths, std::int64_t count);
  bool Holds(const double* unitPoint) const
  {
    return unitPoint[0] < this->Low[0] || unitPoint[0] > this->High[0] ||
      unitPoint[1] < this->Low[1] || unitPoint[1] > this->High[1];
  }

private:
  Point<2> Low;
  Point<2> High;
};

struct BorderSeed
{
  std::int64_t Number;
  Point<2> UnitPoint;
};

// Moves the seeds within a mean spacing of the faces of a rectangle of sides `lengths` towards the
// centroids of their Voronoi cells (Lloyd's method, over-relaxed). The other seeds and the order
// stay. This lowers the mean squared distance of the rectangle to the nearest seed. No two seeds
// come nearer to each other than 0.86 of the spacing of the hexagonal lattice, or than they were if
// that is less. Seeds are moved one after the other on the calling thread.
//
// `border` has all seeds of the band, by their numbers; unitPoints are the seeds from number
// `first` on, out of `count`. There is at least one seed, and no two coincide. Seeds that move
// should have their neighbours within two mean spacings, as in any even pattern: seeds farther
// inside are ignored. Takes O(sqrt(count)) memory and time; O(count) in strips, where all are at
// the border. Adds the number of seeds and of moved seeds to the progress. Throws Cancelled.
void relaxBorder(const Point<2>& lengths, std::int64_t count, const std::vector<BorderSeed>& border,
  std::int64_t first, PointSpan<2> unitPoints, Progress& progress);

} // namespace RectifiedTransport

#endif
