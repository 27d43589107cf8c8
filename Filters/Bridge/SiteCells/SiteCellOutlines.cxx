// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/SiteCellOutlines.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/SiteCells/SiteLabels.h"
#include "Core/Parallel/Progress.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t nobody = -1; // outside of the domain

// The vector is empty afterwards.
template <class ArrayT, class Value>
vtkSmartPointer<ArrayT> moveToArray(const char* name, int components, std::vector<Value>& values)
{
  const auto tuples = static_cast<vtkIdType>(values.size()) / components;
  auto array = newArray<ArrayT>(name, components, tuples);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  values = std::vector<Value>();
  return array;
}

// Goes through the layers of pixels along the last axis. Of the nodes only those of two planes have
// their points' numbers at hand.
template <int D>
class Outlines
{
public:
  Outlines(const ImageGrid& geometry, const std::int64_t* labels)
    : Geometry(geometry)
    , Size(geometry.Size<D>())
    , Mirrored(geometry.IsMirrored())
    , Labels(labels)
  {
    std::int64_t nodes = 1;
    for (int a = 0; a < D - 1; ++a)
    {
      this->LayerPixels *= this->Size[a];
      nodes *= this->Size[a] + 1;
    }
    this->Lower.assign(static_cast<std::size_t>(nodes), nobody);
    this->Upper = this->Lower;
  }

  void Run(Progress& progress)
  {
    const std::int64_t layers = this->Size[D - 1] + 1;
    constexpr std::int64_t pixels = std::int64_t{ 1 } << 16;
    progress.ForInOrder(
      layers, 1,
      [this](std::int64_t first, std::int64_t last) {
        for (std::int64_t layer = first; layer < last; ++layer)
        {
          this->AddLayer(layer);
        }
      },
      pixels / this->LayerPixels);
  }

  void Write(vtkPolyData* output)
  {
    const auto faces = static_cast<vtkIdType>(this->SiteIds.size());
    vtkNew<vtkPoints> points;
    points->SetData(moveToArray<vtkDoubleArray>("Points", 3, this->Points));
    output->SetPoints(points);
    const auto offsets = newArray<vtkIdTypeArray>("Offsets", 1, faces + 1);
    for (vtkIdType i = 0; i <= faces; ++i)
    {
      offsets->SetValue(i, i * Corners);
    }
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, moveToArray<vtkIdTypeArray>("Connectivity", 1, this->CornerIds));
    if constexpr (D == 1)
    {
      output->SetVerts(cells);
    }
    else if constexpr (D == 2)
    {
      output->SetLines(cells);
    }
    else
    {
      output->SetPolys(cells);
    }
    output->GetCellData()->SetScalars(moveToArray<SiteIdArray>("SiteId", 1, this->SiteIds));
  }

private:
  using Cell = std::int64_t[3];
  static constexpr int Corners = D == 1 ? 1 : 2 * (D - 1); // of a face

  std::int64_t LabelAt(const Cell& cell) const
  {
    std::int64_t pixel = 0;
    for (int a = D; a-- > 0;)
    {
      if (cell[a] < 0 || cell[a] >= this->Size[a])
      {
        return nobody;
      }
      pixel = pixel * this->Size[a] + cell[a];
    }
    return this->Labels[pixel];
  }

  void AddLayer(std::int64_t layer)
  {
    Cell cell = { 0, 0, 0 };
    cell[D - 1] = layer;
    this->LowerPlane = layer;
    if (layer < this->Size[D - 1])
    {
      this->AddSides(cell);
    }
    for (std::int64_t pixel = 0; pixel < this->LayerPixels; ++pixel)
    {
      this->Place(pixel, cell);
      this->AddFace(cell, D - 1);
    }
    std::swap(this->Lower, this->Upper);
    std::fill(this->Upper.begin(), this->Upper.end(), nobody);
  }

  // The faces across the other axes, between the two planes of nodes.
  void AddSides(Cell& cell)
  {
    for (std::int64_t pixel = 0; pixel < this->LayerPixels; ++pixel)
    {
      this->Place(pixel, cell);
      for (int axis = 0; axis < D - 1; ++axis)
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

  void Place(std::int64_t pixel, Cell& cell) const
  {
    for (int a = 0; a < D - 1; ++a)
    {
      cell[a] = pixel % this->Size[a];
      pixel /= this->Size[a];
    }
  }

  // The face between a pixel and the one before it along an axis.
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
    vtkIdType corners[Corners];
    this->FindCorners(cell, axis, corners);
    if (this->Mirrored)
    {
      std::reverse(corners, corners + Corners);
    }
    if (below != nobody)
    {
      this->Append(corners, below);
    }
    if (above != nobody)
    {
      std::reverse(corners, corners + Corners);
      this->Append(corners, above);
    }
  }

  void Append(const vtkIdType* corners, std::int64_t site)
  {
    this->CornerIds.insert(this->CornerIds.end(), corners, corners + Corners);
    this->SiteIds.push_back(site);
  }

  // The corners of a face, in an order that turns right-handed about the axis.
  void FindCorners(const Cell& cell, int axis, vtkIdType* corners)
  {
    if constexpr (D == 1)
    {
      corners[0] = this->PointAt(cell);
    }
    else if constexpr (D == 2)
    {
      Cell node = { cell[0], cell[1], 0 };
      corners[axis] = this->PointAt(node);
      ++node[1 - axis];
      corners[1 - axis] = this->PointAt(node);
    }
    else
    {
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

  vtkIdType PointAt(const Cell& node)
  {
    std::int64_t number = 0;
    for (int a = D - 1; a-- > 0;)
    {
      number = number * (this->Size[a] + 1) + node[a];
    }
    auto& plane = node[D - 1] == this->LowerPlane ? this->Lower : this->Upper;
    std::int64_t& point = plane[static_cast<std::size_t>(number)];
    if (point == nobody)
    {
      double index[D];
      std::copy_n(node, D, index);
      double x[3];
      this->Geometry.template ToPhysical<D>(index, x);
      point = static_cast<std::int64_t>(this->Points.size() / 3);
      this->Points.insert(this->Points.end(), x, x + 3);
    }
    return static_cast<vtkIdType>(point);
  }

  const ImageGrid& Geometry;
  const GridSize<D> Size;
  const bool Mirrored;
  const std::int64_t* Labels;
  std::int64_t LayerPixels = 1;
  std::int64_t LowerPlane = 0;
  std::vector<std::int64_t> Lower;
  std::vector<std::int64_t> Upper;
  // VTK's own arrays end the program when there is no memory for them to grow.
  std::vector<double> Points;
  std::vector<vtkIdType> CornerIds;
  std::vector<std::int64_t> SiteIds; // of the faces
};

} // namespace

template <int D>
void outlineSiteCells(
  const ImageGrid& geometry, const std::int64_t* labels, Progress& progress, vtkPolyData* output)
{
  Outlines<D> outlines(geometry, labels);
  outlines.Run(progress);
  outlines.Write(output);
}

template void outlineSiteCells<1>(const ImageGrid&, const std::int64_t*, Progress&, vtkPolyData*);
template void outlineSiteCells<2>(const ImageGrid&, const std::int64_t*, Progress&, vtkPolyData*);
template void outlineSiteCells<3>(const ImageGrid&, const std::int64_t*, Progress&, vtkPolyData*);

} // namespace RectifiedTransport
