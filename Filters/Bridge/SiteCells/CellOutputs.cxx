// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/CellOutputs.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Data/TupleCopy.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"
#include "Core/SiteCells/SiteColors.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// The input's points in double precision.
vtkSmartPointer<vtkPoints> doublePoints(vtkPoints* points)
{
  // The output shares the input's points: neither changes them.
  if (points->GetDataType() == VTK_DOUBLE)
  {
    return points;
  }
  auto copy = vtkSmartPointer<vtkPoints>::New();
  copy->SetDataTypeToDouble();
  copy->DeepCopy(points);
  return copy;
}

// The vector is empty afterwards.
template <class ArrayT>
vtkSmartPointer<ArrayT> moveToArray(const char* name, std::vector<std::int64_t>& values)
{
  using Value = typename ArrayT::ValueType;
  // vtkIdType may have 32 bits; where it has 64, the values are the same. One value a tuple.
  auto array = newArray<ArrayT>(name, 1, static_cast<vtkIdType>(values.size()));
  std::transform(values.begin(), values.end(), array->GetPointer(0),
    [](std::int64_t value) { return static_cast<Value>(value); });
  values = std::vector<std::int64_t>();
  return array;
}

// The vector is empty afterwards.
void movePoints(std::vector<Point<3>>& from, vtkPolyData* to)
{
  // Three doubles a point. The vector is freed before arrays of cells are made.
  const auto count = static_cast<vtkIdType>(from.size());
  auto coordinates = newArray<vtkDoubleArray>("Points", 3, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    std::copy_n(from[static_cast<std::size_t>(i)].data(), 3, coordinates->GetPointer(3 * i));
  }
  from = std::vector<Point<3>>();
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  to->SetPoints(points);
}

using Colors = std::vector<std::uint8_t>;

template <int D>
Colors colorsOf(
  const ImageGrid& grid, const std::int64_t* labels, vtkIdType sites, Progress& progress)
{
  return colourSiteCells<D>(grid.Size<D>(), labels, sites, progress);
}

// Adds an array of byteOf(id) of each element.
template <class ByteOf>
void addBytes(const char* name, vtkCellData* data, Progress& progress, const ByteOf& byteOf)
{
  auto* ids = SiteIdArray::SafeDownCast(data->GetScalars());
  const vtkIdType count = ids->GetNumberOfTuples();
  auto bytes = newArray<vtkUnsignedCharArray>(name, 1, count);
  const std::int64_t* labels = ids->GetPointer(0);
  constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
  progress.For(count, grain, [&](std::int64_t first, std::int64_t last) {
    std::transform(labels + first, labels + last, bytes->GetPointer(first), byteOf);
  });
  data->AddArray(bytes);
}

} // namespace

std::array<vtkDataObject*, 4> CellOutputs::All() const
{
  return { this->Labels, this->Sites, this->Outlines, this->Polygons };
}

void writeSites(vtkPointSet* sites, vtkPointSet* output)
{
  // Also the cells, so that sites that are vertices of vtkPolyData are drawn as before.
  output->CopyStructure(sites);
  output->SetPoints(doublePoints(sites->GetPoints()));
  output->GetPointData()->PassData(sites->GetPointData());
  output->GetCellData()->PassData(sites->GetCellData());
}

void addStatistics(
  const CellOutputs& outputs, const std::function<double(const SiteCellStatistics&)>& measure)
{
  // One tuple for each site: mass in units of the density's mass or of area, centroid in physical
  // space, and the site's part of the cost, mean |x - site|^2 or of another norm.
  const vtkIdType count = outputs.Sites->GetNumberOfPoints();
  auto masses = newArray<vtkDoubleArray>("CellMass", 1, count);
  auto centroids = newArray<vtkDoubleArray>("CellCentroid", 3, count);
  auto costs = newArray<vtkDoubleArray>("CellCost", 1, count);
  const double cost = measure(SiteCellStatistics{
    masses->GetPointer(0), { centroids->GetPointer(0), count }, costs->GetPointer(0) });
  // Added after `measure` has returned: an error leaves no array without values.
  outputs.Sites->GetPointData()->AddArray(masses);
  outputs.Sites->GetPointData()->AddArray(centroids);
  outputs.Sites->GetPointData()->AddArray(costs);
  // Every output has the cost: users look at one of them alone.
  for (vtkDataObject* output : outputs.All())
  {
    addFieldValue(output, "TransportCost", cost);
  }
}

template <int Dimension>
void writeOutlines(SiteCellOutlines<Dimension> outlines, vtkPolyData* output)
{
  movePoints(outlines.Points, output);
  const auto faces = static_cast<vtkIdType>(outlines.SiteIds.size());
  // All faces have equally many corners, 1, 2 or 4, so that face i begins at i times that number.
  // The last offset is the length of the connectivity, as vtkCellArray requires.
  const auto offsets = newArray<vtkIdTypeArray>("Offsets", 1, faces + 1);
  for (vtkIdType i = 0; i <= faces; ++i)
  {
    offsets->SetValue(i, i * SiteCellOutlines<Dimension>::Corners);
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, moveToArray<vtkIdTypeArray>("Connectivity", outlines.CornerIds));
  // The border of a cell is points in 1D, lines in 2D and quads in 3D.
  if constexpr (Dimension == 1)
  {
    output->SetVerts(cells);
  }
  else if constexpr (Dimension == 2)
  {
    output->SetLines(cells);
  }
  else
  {
    output->SetPolys(cells);
  }
  output->GetCellData()->SetScalars(moveToArray<SiteIdArray>("SiteId", outlines.SiteIds));
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(writeOutlines);

void writePolygons(SiteCellPolygons polygons, const CellOutputs& outputs, Progress& progress)
{
  movePoints(polygons.Points, outputs.Polygons);
  vtkNew<vtkCellArray> cells;
  // First is one longer than the number of polygons, as vtkCellArray's offsets are.
  cells->SetData(moveToArray<vtkIdTypeArray>("Offsets", polygons.First),
    moveToArray<vtkIdTypeArray>("Connectivity", polygons.CornerIds));
  outputs.Polygons->SetPolys(cells);
  auto* data = outputs.Polygons->GetCellData();
  const auto ids = moveToArray<SiteIdArray>("SiteId", polygons.SiteIds);
  // A site may have several polygons, so that its global id would not be unique among cells. Its
  // ghost flags mean points, not cells.
  data->CopyGlobalIdsOff();
  data->CopyFieldOff(vtkDataSetAttributes::GhostArrayName());
  // Each polygon gets all arrays of its site.
  copyTuples(
    { outputs.Sites->GetPointData(), outputs.Sites->GetNumberOfPoints(), "point",
      "input point set" },
    cells->GetNumberOfCells(),
    [&ids](vtkIdType polygon) { return static_cast<vtkIdType>(ids->GetValue(polygon)); }, data,
    progress);
  data->AddArray(ids);
  data->SetActiveScalars(ids->GetName()); // SetScalars would remove the sites' scalars
}

void addSiteColors(vtkImageData* labels, vtkPolyData* polygons, vtkIdType sites, Progress& progress)
{
  const ImageGrid grid = gridOf(labels, false);
  vtkCellData* data = labels->GetCellData();
  auto* ids = SiteIdArray::SafeDownCast(data->GetScalars());
  constexpr double eachSite = 120.0; // a dozen neighbours
  const Colors ofSites = withMemory({ "the neighbours of the " + std::to_string(sites) + " sites",
                                      static_cast<double>(sites) * eachSite },
    [&]() {
      return dispatchDimension(grid.Dimension(), colorsOf<1>, colorsOf<2>, colorsOf<3>)(
        grid, ids->GetPointer(0), sites, progress);
    });
  const auto colorOf = [&](std::int64_t id) { // 0 for elements of no site
    return id < 0 ? std::uint8_t{ 0 } : ofSites[static_cast<std::size_t>(id)];
  };
  addBytes("SiteColor", data, progress, colorOf);
  if (polygons->GetNumberOfCells() > 0)
  {
    addBytes("SiteColor", polygons->GetCellData(), progress, colorOf);
  }
  const std::int64_t* const pixels = ids->GetPointer(0);
  if (std::any_of(
        pixels, pixels + ids->GetNumberOfTuples(), [](std::int64_t id) { return id < 0; }))
  {
    addBytes(vtkDataSetAttributes::GhostArrayName(), data, progress, [](std::int64_t id) {
      return static_cast<unsigned char>(id < 0 ? vtkDataSetAttributes::HIDDENCELL : 0);
    });
  }
}

} // namespace RectifiedTransport::Bridge
