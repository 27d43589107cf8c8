// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/PlaceOwners.h"

#include "Core/Geometry/Dispatch.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

PlaceOwners::PlaceOwners(const ImageGrid& grid, const ImagePieces* pieces, const Ranks& ranks)
  : Grid(grid)
{
  std::vector<Extent> extents;
  if (pieces)
  {
    extents = grid.IsOnPoints() ? pieces->Points() : pieces->Cells();
    const auto withData = std::count_if(
      extents.begin(), extents.end(), [](const Extent& extent) { return !isEmpty(extent); });
    if (withData > 1 && std::find(extents.begin(), extents.end(), grid.Extent()) != extents.end())
    {
      extents.clear();
    }
  }
  if (extents.empty())
  {
    extents = dividedExtent(grid.Extent(), ranks.Count());
  }
  this->Own = extents[static_cast<std::size_t>(ranks.Own())];
  const bool onPoints = grid.IsOnPoints();
  for (const Extent& extent : extents)
  {
    LatticePart<3> box{ {}, { 1, 1, 1 } };
    std::size_t axis = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      if (grid.IsAxis(a))
      {
        const std::int64_t start = grid.Extent()[2 * a];
        box.Low[axis] = extent[2 * a] - start;
        box.Cells[axis] = extent[2 * a + 1] - extent[2 * a] + (onPoints ? 1 : 0);
        ++axis;
      }
    }
    this->Boxes.push_back(isEmpty(extent) ? LatticePart<3>{} : box);
  }
  // A table of the owners of all parts, unless pieces are so irregular that there are too many.
  std::size_t parts = 1;
  for (std::size_t a = 0; a < 3; ++a)
  {
    std::vector<std::int64_t>& cut = this->Cut[a];
    for (const LatticePart<3>& box : this->Boxes)
    {
      cut.push_back(box.Low[a]);
      cut.push_back(box.End(static_cast<int>(a)));
    }
    std::sort(cut.begin(), cut.end());
    cut.erase(std::unique(cut.begin(), cut.end()), cut.end());
    parts *= cut.size();
  }
  constexpr std::size_t mostParts = std::size_t{ 1 } << 20;
  if (parts > mostParts)
  {
    return;
  }
  this->Owners.assign(parts, 0);
  for (std::size_t rank = this->Boxes.size(); rank-- > 0;)
  {
    const LatticePart<3>& box = this->Boxes[rank];
    for (std::size_t part = 0; part < parts; ++part)
    {
      std::size_t rest = part;
      GridSize<3> cell{};
      for (std::size_t a = 0; a < 3; ++a)
      {
        cell[a] = this->Cut[a][rest % this->Cut[a].size()];
        rest /= this->Cut[a].size();
      }
      if (box.Contains(cell))
      {
        this->Owners[part] = static_cast<int>(rank);
      }
    }
  }
}

template <int D>
int PlaceOwners::Find(const double* place) const
{
  double index[3] = { 0.0, 0.0, 0.0 };
  this->Grid.ToIndex<D>(place, index);
  const GridSize<D> size = this->Grid.Size<D>();
  GridSize<3> cell{ 0, 0, 0 };
  for (int a = 0; a < D; ++a)
  {
    const double inside = std::clamp(index[a], 0.0, static_cast<double>(size[a] - 1));
    cell[static_cast<std::size_t>(a)] = static_cast<std::int64_t>(inside);
  }
  if (this->Owners.empty())
  {
    const auto owner = std::find_if(this->Boxes.begin(), this->Boxes.end(),
      [&](const LatticePart<3>& box) { return box.Contains(cell); });
    return owner == this->Boxes.end() ? 0 : static_cast<int>(owner - this->Boxes.begin());
  }
  std::size_t part = 0;
  for (std::size_t a = 3; a-- > 0;)
  {
    const std::vector<std::int64_t>& cut = this->Cut[a];
    const auto above = std::upper_bound(cut.begin(), cut.end(), cell[a]);
    const auto below =
      static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, above - cut.begin() - 1));
    part = part * cut.size() + below;
  }
  return this->Owners[part];
}

int PlaceOwners::OwnerOf(const double* place) const
{
  const auto find = dispatchDimension(
    this->Grid.Dimension(), &PlaceOwners::Find<1>, &PlaceOwners::Find<2>, &PlaceOwners::Find<3>);
  return (this->*find)(place);
}

} // namespace RectifiedTransport::Bridge
