// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Distributed/PlaceOwners.h"

#include "Core/Geometry/Dispatch.h"

#include <algorithm>

namespace RectifiedTransport
{

// If a rank has the whole and others also have parts of it, each place has several holders; the
// division into pieces then shares the work.
PlaceOwners::PlaceOwners(const ImageGrid& grid, std::vector<Extent> held,
  const std::vector<Extent>& divided, const Ranks& ranks)
  : Grid(grid)
{
  const auto withData =
    std::count_if(held.begin(), held.end(), [](const Extent& extent) { return !isEmpty(extent); });
  const bool isWhole =
    withData > 1 && std::find(held.begin(), held.end(), grid.Extent()) != held.end();
  if (held.empty() || isWhole)
  {
    held = divided;
  }
  this->Own = held[static_cast<std::size_t>(ranks.Own())];
  for (const Extent& extent : held)
  {
    const int owner = grid.IsOnPoints() ? OfPoints : OfCells;
    this->Boxes.push_back(latticePartOf<3>(tuplesOf(extent, owner, grid.Extent()), grid));
    GridSize<3>& cells = this->Boxes.back().Cells;
    std::fill(cells.begin() + grid.Dimension(), cells.end(), 1); // they are no axes
  }
  // A table of the owners of all parts between the cuts that boxes make along each axis, unless
  // pieces are so irregular that there are too many.
  std::size_t parts = 1;
  for (std::size_t a = 0; a < 3; ++a)
  {
    std::vector<std::int64_t>& cut = this->Cut[a];
    for (const LatticePart<3>& box : this->Boxes)
    {
      // Boxes begin and end at cuts only: a part between two cuts of each axis is in a box or not.
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
  // Lower ranks come last and win.
  for (std::size_t rank = this->Boxes.size(); rank-- > 0;)
  {
    const LatticePart<3>& box = this->Boxes[rank];
    for (std::size_t part = 0; part < parts; ++part)
    {
      std::size_t rest = part;
      GridSize<3> cell{};
      for (std::size_t a = 0; a < 3; ++a)
      {
        // The first cell of a part stands for the part.
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
// The grid cell of the nearest place of the domain; its parts along the axes by binary search.
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
    // The last cut that is not above the cell begins its part.
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

} // namespace RectifiedTransport
