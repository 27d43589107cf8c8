// SPDX-License-Identifier: BSD-3-Clause
// By how much the mass in the image of a box, or its area, changes with a map that changes.
#ifndef RectifiedTransport_SweptMass_h
#define RectifiedTransport_SweptMass_h

#include "Core/Flow/Steps/BlockSurface.h"
#include "Core/Geometry/ImageMeasure.h"
#include "Core/Tables/BoxShare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class SweptMass
{
public:
  // For areas the density is one.
  SweptMass(const TableView<Dimension>& tables, const BlockSurface<Dimension>& surface, bool isArea)
    : Tables(tables)
    , Surface(surface)
    , IsArea(isArea)
  {
    for (const std::int64_t cells : tables.Cells)
    {
      this->Cells *= static_cast<double>(cells);
    }
  }

  // What the sides of a block's image sweep over, outwards, on a straight way from one place to
  // another, in cells of the mean density. Of the images of the points of its surface.
  double Between(const Point<Dimension>* before, const Point<Dimension>* after) const
  {
    double mass = 0.0;
    for (const auto& side : this->Surface.Sides())
    {
      // Its axes are the side's and the way, which has the place of the side's axis after an even
      // number of exchanges.
      Corners swept;
      for (std::size_t corner = 0; corner < side.Points.size(); ++corner)
      {
        swept[corner] = before[side.Points[corner]];
        swept[corner + side.Points.size()] = after[side.Points[corner]];
      }
      // An odd number of exchanges of axes, and a low side, each change the sign.
      const bool isTurned = (Dimension - 1 - side.Axis) % 2 != (side.IsHigh ? 0 : 1);
      mass += (isTurned ? -1.0 : 1.0) * this->Swept(swept);
    }
    return mass;
  }

private:
  using Corners = std::array<Point<Dimension>, 1 << Dimension>;

  // The mass, or area, that a part of a side sweeps over between both places.
  double Swept(const Corners& corners) const
  {
    if (this->IsArea)
    {
      return imageMeasure<Dimension>(corners.data());
    }
    if constexpr (Dimension == 2)
    {
      // By Gauss's theorem: what neighbours sweep over has the other two edges the other way round.
      return this->Below(corners[0], corners[1]) - this->Below(corners[2], corners[3]);
    }
    return this->MassIn(corners);
  }

  // The integral over an edge of the mass below it along axis 0, which is linear in each cell.
  double Below(const Point<Dimension>& from, const Point<Dimension>& to) const
  {
    // Where the edge crosses the grid's planes, in parts of its length.
    std::vector<double> cuts{ 0.0, 1.0 };
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double length = to[axis] - from[axis];
      const double last = std::max(from[axis], to[axis]);
      for (double plane = std::floor(std::min(from[axis], to[axis])) + 1.0; plane < last;
           plane += 1.0)
      {
        cuts.push_back((plane - from[axis]) / length);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    double sum = 0.0;
    for (std::size_t i = 1; i < cuts.size(); ++i)
    {
      // The midpoint rule is exact for what is linear between cuts.
      const double middle = 0.5 * (cuts[i - 1] + cuts[i]);
      const double y = from[1] + middle * (to[1] - from[1]);
      const double row = std::min(std::floor(y), this->Tables.Size[1] - 1.0);
      sum += (cuts[i] - cuts[i - 1]) *
        boxShare<Dimension>(
          this->Tables, { 0.0, row }, { from[0] + middle * (to[0] - from[0]), row + 1.0 });
    }
    return sum * this->Cells * (to[1] - from[1]);
  }

  // Along the side in pieces, each with the mean density about it: the density may jump.
  double MassIn(const Corners& swept) const
  {
    constexpr int pieces = 4;
    constexpr int all = Dimension == 1 ? 1 : Dimension == 2 ? pieces : pieces * pieces;
    double mass = 0.0;
    for (int piece = 0; piece < all; ++piece)
    {
      Corners part{};
      for (int corner = 0; corner < 1 << Dimension; ++corner)
      {
        for (int from = 0; from < 1 << Dimension; ++from)
        {
          // Pieces divide the side alone, so a corner of a piece mixes corners of the same end of
          // the way.
          double weight = (corner ^ from) >> (Dimension - 1) == 0 ? 1.0 : 0.0;
          for (int axis = 0, rest = piece; axis < Dimension - 1; ++axis, rest /= pieces)
          {
            const double u = static_cast<double>(rest % pieces + (corner >> axis & 1)) / pieces;
            weight *= (from >> axis & 1) != 0 ? u : 1.0 - u;
          }
          for (int axis = 0; axis < Dimension; ++axis)
          {
            part[static_cast<std::size_t>(corner)][axis] +=
              weight * swept[static_cast<std::size_t>(from)][axis];
          }
        }
      }
      mass += imageMeasure<Dimension>(part.data()) * this->MeanAbout(part);
    }
    return mass;
  }

  // The mean density in the box about points, at least a cell wide; of a graded table interpolated.
  double MeanAbout(const Corners& points) const
  {
    Point<Dimension> low = points[0];
    Point<Dimension> high = points[0];
    double volume = 1.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      for (const Point<Dimension>& point : points)
      {
        low[axis] = std::min(low[axis], point[axis]);
        high[axis] = std::max(high[axis], point[axis]);
      }
      // Widens the box about its middle to a cell, within the domain.
      const double missing = std::max(0.0, 1.0 - (high[axis] - low[axis]));
      low[axis] = std::max(0.0, low[axis] - 0.5 * missing);
      high[axis] = std::min(this->Tables.Size[axis], high[axis] + 0.5 * missing);
      volume *= high[axis] - low[axis];
    }
    return boxShare<Dimension>(this->Tables, low, high) * this->Cells / volume;
  }

  const TableView<Dimension>& Tables;
  const BlockSurface<Dimension>& Surface;
  const bool IsArea;
  double Cells = 1.0;
};

} // namespace RectifiedTransport

#endif
