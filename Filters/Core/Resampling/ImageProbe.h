// SPDX-License-Identifier: BSD-3-Clause
// Where points lie among the points and cells of an image.
#ifndef RectifiedTransport_ImageProbe_h
#define RectifiedTransport_ImageProbe_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/Points.h"
#include "Core/Resampling/ProbeLocations.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace RectifiedTransport
{

// Linear between the image's points. The domain of a point array is half a spacing larger: places
// beyond the points are clamped to the nearest place between them.
template <int D>
class ImageProbe : public ProbeLocations
{
public:
  // `places` are physical, in the image's domain. Points and cells are numbered within the part of
  // the image that an extent of points gives.
  ImageProbe(const ImageGrid& grid, const std::array<int, 6>& part, ConstPointSpan<3> places)
    : Points(grid.WithValuesOn(false))
    , Places(places)
  {
    int axis = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      if (grid.IsAxis(a))
      {
        this->Start[axis] = part[2 * a] - grid.Extent()[2 * a];
        this->PartCells[axis] = part[2 * a + 1] - part[2 * a];
        ++axis;
      }
    }
  }

  std::int64_t Count() const override { return this->Places.size(); }
  ProbeLocation Find(std::int64_t place) const override
  {
    ProbeLocation found{};
    this->FindBlock(place, 1, &found);
    return found;
  }
  void FindBlock(std::int64_t first, std::int64_t count, ProbeLocation* found) const override
  {
    const GridSize<D> cells = this->Points.template Size<D>();
    for (std::int64_t i = 0; i < count; ++i)
    {
      double index[D];
      this->Points.template ToIndex<D>(this->Places[first + i], index);
      this->FindAt(index, cells, found[i]);
    }
  }

private:
  // x = clamped index along each axis; cell = its whole part, part = the rest. Points on a face
  // have fewer than 2^D points with weights above 0.
  void FindAt(const double* index, const GridSize<D>& cells, ProbeLocation& found) const
  {
    double parts[D];
    std::int64_t steps[D];
    std::int64_t cellStep = 1;
    std::int64_t pointStep = 1;
    bool isBetween = true; // points along every axis
    found.Set = 0;
    found.Cell = 0;
    found.Points[0] = 0;
    for (int a = 0; a < D; ++a)
    {
      // Places beyond the points are clamped to the border.
      const double x = std::clamp(index[a], 0.0, static_cast<double>(cells[a]));
      const auto cell = std::min(static_cast<std::int64_t>(x), cells[a] - 1);
      const std::int64_t inPart = cell - this->Start[a];
      parts[a] = x - static_cast<double>(cell);
      steps[a] = pointStep;
      isBetween = isBetween && parts[a] > 0.0 && parts[a] < 1.0;
      found.Cell += inPart * cellStep;
      found.Points[0] += inPart * pointStep;
      cellStep *= this->PartCells[a];
      pointStep *= this->PartCells[a] + 1;
    }
    found.Weights[0] = 1.0;
    if (isBetween)
    {
      found.Count = 1 << D;
      for (int a = 0; a < D; ++a)
      {
        // Each axis doubles the points: 2^D in the end.
        divide(1 << a, 1 << a, parts[a], steps[a], found);
      }
      return;
    }
    found.Count = 1;
    for (int a = 0; a < D; ++a)
    {
      // A weight of 0 would not remove values that are not finite.
      const int before = parts[a] < 1.0 ? found.Count : 0;
      if (parts[a] > 0.0)
      {
        divide(found.Count, before, parts[a], steps[a], found);
        found.Count += before;
      }
    }
  }

  // Divides the weights of the first points between them and the next points along an axis, which
  // are appended.
  static void divide(int count, int before, double part, std::int64_t step, ProbeLocation& found)
  {
    for (int i = 0; i < count; ++i)
    {
      found.Points[before + i] = found.Points[i] + step;
      found.Weights[before + i] = found.Weights[i] * part;
    }
    for (int i = 0; i < before; ++i)
    {
      found.Weights[i] *= 1.0 - part;
    }
  }

  const ImageGrid Points;  // its grid cells are the image's cells
  GridSize<D> Start{};     // first cell of the part in the image, along its axes
  GridSize<D> PartCells{}; // cells of the part
  const ConstPointSpan<3> Places;
};

} // namespace RectifiedTransport

#endif
