// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/SiteCellOutlines.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t noSite = -1; // the label outside of the domain; a node without a point

// Visits the layers of pixels along the last axis. Only two planes of nodes store the numbers of
// their points, so that memory grows with a layer, not with the image.
template <int Dimension>
class Outlines
{
public:
  Outlines(const ImageGrid& grid, const std::int64_t* labels)
    : Grid(grid)
    , Size(grid.Size<Dimension>())
    , Mirrored(grid.IsMirrored())
    , Labels(labels)
  {
    // The nodes of a plane across the last axis; -1 until a node has a point.
    std::int64_t nodes = 1;
    for (int a = 0; a < Dimension - 1; ++a)
    {
      this->LayerPixels *= this->Size[a];
      nodes *= this->Size[a] + 1;
    }
    this->Lower.assign(static_cast<std::size_t>(nodes), noSite);
    this->Upper = this->Lower;
  }

  // Call it once. Throws Cancelled.
  SiteCellOutlines<Dimension> Find(Progress& progress)
  {
    const std::int64_t layers = this->Size[Dimension - 1] + 1;
    constexpr std::int64_t pixels = std::int64_t{ 1 } << 16;
    progress.ForEachInOrder(
      layers, 1, [this](std::int64_t layer) { this->AddLayer(layer); }, pixels / this->LayerPixels);
    return std::move(this->Found);
  }

private:
  // Cells and nodes have three indices; those beyond the dimension are 0.
  using Cell = std::int64_t[3];
  static constexpr int Corners = SiteCellOutlines<Dimension>::Corners;

  // Returns the label of a cell; -1 outside the domain, so that the border of the domain is an
  // outline, too.
  std::int64_t LabelAt(const Cell& cell) const
  {
    std::int64_t pixel = 0;
    for (int a = Dimension; a-- > 0;)
    {
      if (cell[a] < 0 || cell[a] >= this->Size[a])
      {
        return noSite;
      }
      pixel = pixel * this->Size[a] + cell[a];
    }
    return this->Labels[pixel];
  }

  // Adds the faces of a layer of pixels: those across the other axes, and those on its lower plane.
  // The last layer is beyond the domain and has only the latter.
  void AddLayer(std::int64_t layer)
  {
    Cell cell = { 0, 0, 0 };
    cell[Dimension - 1] = layer;
    this->LowerPlane = layer;
    if (layer < this->Size[Dimension - 1])
    {
      this->AddSides(cell);
    }
    for (std::int64_t pixel = 0; pixel < this->LayerPixels; ++pixel)
    {
      this->Place(pixel, cell);
      this->AddFace(cell, Dimension - 1);
    }
    // The upper plane becomes the lower one of the next layer, and its points stay shared.
    std::swap(this->Lower, this->Upper);
    std::fill(this->Upper.begin(), this->Upper.end(), noSite);
  }

  // Adds the faces across the other axes, which lie between the two planes of nodes; the last pixel
  // along an axis also adds the face at the upper border.
  void AddSides(Cell& cell)
  {
    for (std::int64_t pixel = 0; pixel < this->LayerPixels; ++pixel)
    {
      this->Place(pixel, cell);
      for (int axis = 0; axis < Dimension - 1; ++axis)
      {
        this->AddFace(cell, axis);
        if (cell[axis] + 1 == this->Size[axis])
        {
          ++cell[axis];
          this->AddFace(cell, axis);
          --cell[axis];
        }
      }
    }
  }

  // Sets the indices of a pixel within its layer.
  void Place(std::int64_t pixel, Cell& cell) const
  {
    for (int a = 0; a < Dimension - 1; ++a)
    {
      cell[a] = pixel % this->Size[a];
      pixel /= this->Size[a];
    }
  }

  // Adds the face between a pixel and the one before it along an axis, once for each label, turned
  // outwards.
  void AddFace(const Cell& cell, int axis)
  {
    Cell before = { cell[0], cell[1], cell[2] };
    --before[axis];
    const std::int64_t below = this->LabelAt(before);
    const std::int64_t above = this->LabelAt(cell);
    if (below == above)
    {
      return;
    }
    // The right-handed order about the axis faces outwards for the cell below, and the reverse
    // order for the cell above.
    // Both labels use the same points, in opposite orders.
    std::int64_t corners[Corners];
    this->FindCorners(cell, axis, corners);
    // A mirrored grid reverses the orientation of all faces.
    if (this->Mirrored)
    {
      std::reverse(corners, corners + Corners);
    }
    if (below != noSite)
    {
      this->Append(corners, below);
    }
    if (above != noSite)
    {
      std::reverse(corners, corners + Corners);
      this->Append(corners, above);
    }
  }

  // Adds a face to the outline of a site's cell.
  void Append(const std::int64_t* corners, std::int64_t site)
  {
    this->Found.CornerIds.insert(this->Found.CornerIds.end(), corners, corners + Corners);
    this->Found.SiteIds.push_back(site);
  }

  // Finds the corners of a face, in a right-handed order about the axis.
  void FindCorners(const Cell& cell, int axis, std::int64_t* corners)
  {
    if constexpr (Dimension == 1)
    {
      corners[0] = this->PointAt(cell);
    }
    else if constexpr (Dimension == 2)
    {
      Cell node = { cell[0], cell[1], 0 };
      corners[axis] = this->PointAt(node);
      ++node[1 - axis];
      corners[1 - axis] = this->PointAt(node);
    }
    else
    {
      // Cyclic axes keep the quad right-handed for every axis.
      const int first = (axis + 1) % 3;
      const int second = (axis + 2) % 3;
      Cell node = { cell[0], cell[1], cell[2] };
      corners[0] = this->PointAt(node);
      ++node[first];
      corners[1] = this->PointAt(node);
      ++node[second];
      corners[2] = this->PointAt(node);
      --node[first];
      corners[3] = this->PointAt(node);
    }
  }

  // Returns the number of a node's point, which is new at the first call.
  std::int64_t PointAt(const Cell& node)
  {
    std::int64_t number = 0;
    for (int a = Dimension - 1; a-- > 0;)
    {
      number = number * (this->Size[a] + 1) + node[a];
    }
    auto& plane = node[Dimension - 1] == this->LowerPlane ? this->Lower : this->Upper;
    std::int64_t& point = plane[static_cast<std::size_t>(number)];
    if (point == noSite)
    {
      // A node's indices are its coordinates in index space.
      double index[Dimension];
      std::copy_n(node, Dimension, index);
      Point<3> x;
      this->Grid.template ToPhysical<Dimension>(index, x.data());
      point = static_cast<std::int64_t>(this->Found.Points.size());
      this->Found.Points.push_back(x);
    }
    return point;
  }

  const ImageGrid& Grid;
  const GridSize<Dimension> Size;
  const bool Mirrored;
  const std::int64_t* Labels;
  std::int64_t LayerPixels = 1;
  std::int64_t LowerPlane = 0;
  std::vector<std::int64_t> Lower;
  std::vector<std::int64_t> Upper;
  SiteCellOutlines<Dimension> Found;
};

} // namespace

template <int Dimension>
SiteCellOutlines<Dimension> outlineSiteCells(
  const ImageGrid& grid, const std::int64_t* labels, const Context& context)
{
  Progress progress(context);
  return Outlines<Dimension>(grid, labels).Find(progress);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(outlineSiteCells);

} // namespace RectifiedTransport
