// SPDX-License-Identifier: BSD-3-Clause
// Where points lie among the points and cells of an image.
#ifndef RectifiedTransport_PlacesInImage_h
#define RectifiedTransport_PlacesInImage_h

#include "Bridge/Points/SampledArrays.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/Points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace RectifiedTransport
{

// Between the image's points linearly, beyond them as at the nearest place between them: the domain
// of a point array is half a spacing larger.
template <int D>
class PlacesInImage : public SampledPlaces
{
public:
  // `places` are physical, in the image's domain. The numbers of points and cells are those in a
  // part of the image: of the points of an extent.
  PlacesInImage(const ImageGrid& grid, const std::array<int, 6>& part, ConstPointSpan<3> places)
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
  PlacesInImage(const ImageGrid& grid, ConstPointSpan<3> places)
    : PlacesInImage(grid, grid.Extent(), places)
  {
  }

  std::int64_t Count() const override { return this->Places.size(); }
  SampledPlace Find(std::int64_t place) const override
  {
    const GridSize<D> cells = this->Points.template Size<D>();
    double index[D];
    this->Points.template ToIndex<D>(this->Places[place], index);
    SampledPlace found{ { 0 }, { 1.0 }, 1, 0 };
    vtkIdType cellStep = 1;
    vtkIdType pointStep = 1;
    for (int a = 0; a < D; ++a)
    {
      const double x = std::clamp(index[a], 0.0, static_cast<double>(cells[a]));
      const auto cell = std::min(static_cast<std::int64_t>(x), cells[a] - 1);
      const double part = x - static_cast<double>(cell);
      const std::int64_t inPart = cell - this->Start[a];
      found.Cell += static_cast<vtkIdType>(inPart) * cellStep;
      for (int i = 0; i < found.Count; ++i)
      {
        found.Points[i] += static_cast<vtkIdType>(inPart) * pointStep;
      }
      // A weight of 0 would not keep out values that are not finite.
      const int before = part < 1.0 ? found.Count : 0;
      if (part > 0.0)
      {
        for (int i = 0; i < found.Count; ++i)
        {
          found.Points[before + i] = found.Points[i] + pointStep;
          found.Weights[before + i] = found.Weights[i] * part;
        }
        for (int i = 0; i < before; ++i)
        {
          found.Weights[i] *= 1.0 - part;
        }
        found.Count += before;
      }
      cellStep *= static_cast<vtkIdType>(this->PartCells[a]);
      pointStep *= static_cast<vtkIdType>(this->PartCells[a] + 1);
    }
    return found;
  }

private:
  const ImageGrid Points; // its grid cells are the image's cells
  GridSize<D> Start{};
  GridSize<D> PartCells{};
  const ConstPointSpan<3> Places;
};

} // namespace RectifiedTransport

#endif
