// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/PiecesDensity.h"

#include "Bridge/Density/DensityImage.h"
#include "Bridge/Ranks/ImagePieces.h"

#include "vtkImageData.h"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// The values of a box, by the numbers of the whole grid.
template <int Dimension>
class BoxOfDensity final : public DensityValues
{
public:
  BoxOfDensity(std::unique_ptr<DensityImage> box, const GridSize<Dimension>& size,
    const GridSize<Dimension>& low, const GridSize<Dimension>& high)
    : Box(std::move(box))
    , Size(size)
    , Low(low)
    , High(high)
  {
  }

  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    std::int64_t number = 0;
    std::int64_t cells = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      number += (first % this->Size[axis] - this->Low[axis]) * cells;
      first /= this->Size[axis];
      cells *= this->High[axis] - this->Low[axis];
    }
    this->Box->Values().Read(number, count, values);
  }

private:
  const std::unique_ptr<DensityImage> Box;
  const GridSize<Dimension> Size;
  const GridSize<Dimension> Low;
  const GridSize<Dimension> High;
};

} // namespace

template <int Dimension>
std::unique_ptr<const DensityValues> PiecesDensity<Dimension>::Gather(
  const GridSize<Dimension>& low, const GridSize<Dimension>& high) const
{
  const ImageGrid& grid = this->Density.Grid();
  Extent extent = grid.Extent();
  bool hasCells = true;
  std::size_t axis = 0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (!grid.IsAxis(a))
    {
      continue;
    }
    const int start = extent[2 * a];
    extent[2 * a] = start + static_cast<int>(low[axis]);
    extent[2 * a + 1] = start + static_cast<int>(high[axis]) - (grid.IsOnPoints() ? 1 : 0);
    hasCells = hasCells && low[axis] < high[axis];
    ++axis;
  }
  if (!hasCells)
  {
    extent = { 0, -1, 0, -1, 0, -1 };
  }
  std::unique_ptr<DensityImage> box = this->Density.GatherBox(extent);
  if (!hasCells)
  {
    return std::make_unique<DensityArray<Dimension, double>>(nullptr, GridSize<Dimension>{});
  }
  return std::make_unique<BoxOfDensity<Dimension>>(
    std::move(box), grid.Size<Dimension>(), low, high);
}

template class PiecesDensity<1>;
template class PiecesDensity<2>;
template class PiecesDensity<3>;

} // namespace RectifiedTransport
