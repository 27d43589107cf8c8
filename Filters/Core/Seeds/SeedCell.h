// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cell of one seed in a rectangle.
#ifndef RectifiedTransport_SeedCell_h
#define RectifiedTransport_SeedCell_h

#include "Core/Geometry/Points.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

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

} // namespace RectifiedTransport

#endif
