// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Triangles/AreaPreservingParameterization.h"

#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Triangles/TriangleInput.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Parameterization/AreaPreservingMap.h"
#include "Surfaces/Seams/CutSurfaceMap.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <optional>

namespace RectifiedTransport::Bridge
{

namespace
{

// Texture coordinates are single precision in ParaView; this array has them in double precision.
constexpr const char* exactName = "AreaPreservingExact";

// The values of the property Seams.
enum SeamsChoice
{
  AutomaticSeams,
  NoSeams
};

// By the points of the output; 0 0 for those that no triangle with area has. SurfaceT::PointOf
// gives the place in `positions` of a point of the output.
// Shape of the array: points of the output x 2, in [0, 1]^2.
template <class ArrayT, class SurfaceT>
vtkSmartPointer<ArrayT> coordinatesArray(
  const std::string& name, const SurfaceT& surface, vtkIdType points, ConstPointSpan<2> positions)
{
  auto array = newArray<ArrayT>(name, 2, points);
  auto* next = array->GetPointer(0);
  for (vtkIdType i = 0; i < points; ++i)
  {
    const std::int64_t point = surface.PointOf(i);
    for (int axis = 0; axis < 2; ++axis)
    {
      *next++ = static_cast<typename ArrayT::ValueType>(point < 0 ? 0.0 : positions[point][axis]);
    }
  }
  return array;
}

// Adds the conformal map, which keeps angles, and the area-preserving one to the points (paper,
// Section 5.4), the latter also as the active texture coordinates.
template <class SurfaceT>
void attachCoordinates(const SurfaceT& surface, ConstPointSpan<2> conformal,
  ConstPointSpan<2> positions, vtkPolyData* output)
{
  const vtkIdType points = output->GetNumberOfPoints();
  vtkPointData* data = output->GetPointData();
  data->AddArray(coordinatesArray<vtkDoubleArray>("Conformal", surface, points, conformal));
  data->AddArray(coordinatesArray<vtkDoubleArray>(exactName, surface, points, positions));
  data->AddArray(coordinatesArray<vtkFloatArray>("AreaPreserving", surface, points, positions));
  data->SetActiveTCoords("AreaPreserving"); // SetTCoords would remove the input's
}

// The figures of the whole surface as field data, one value each.
void attachFigures(const MapDistortion& figures, vtkPolyData* output)
{
  addFieldValue(output, "AreaDistortionRMS", figures.AreaRootMeanSquare);
  addFieldValue(output, "AngleDistortionMean", figures.AngleMean);
  addFieldValue(output, "FlippedCount", static_cast<double>(figures.Flipped));
}

// The arrays of the cells; those that are no triangles with area are not distorted.
class CellDistortions
{
public:
  CellDistortions(vtkIdType cells, ConstPointSpan<2> positions)
    : Cells(cells)
    , Positions(positions)
    // Area distortion: the share of the square over the share of the surface, 1 if areas are kept.
    // Angle distortion: the quotient of the singular values of the map, 1 if angles are kept. Cells
    // that are not measured keep these values.
    , Area(make<vtkDoubleArray>("AreaDistortion", 1.0))
    , Angle(make<vtkDoubleArray>("AngleDistortion", 1.0))
    , Flipped(make<vtkUnsignedCharArray>("Flipped", 0))
  {
  }

  // cellOf(triangle) is the cell that a triangle is.
  template <class CellOf>
  void Measure(const MeasuredTriangles& triangles, const CellOf& cellOf, Progress& progress)
  {
    // Triangles have different cells, so that threads write to different tuples.
    constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
    double* areas = this->Area->GetPointer(0);
    double* angles = this->Angle->GetPointer(0);
    unsigned char* flipped = this->Flipped->GetPointer(0);
    progress.ForEach(triangles.Surface.NumberOfTriangles, grain, [&](std::int64_t triangle) {
      const TriangleDistortion found = distortionOf(triangles, this->Positions, triangle);
      const vtkIdType cell = cellOf(triangle);
      areas[cell] = found.Area;
      angles[cell] = found.Angle;
      flipped[cell] = found.IsFlipped ? 1 : 0;
    });
  }

  // Repeated triangles have the values of the first ones.
  void Repeat(const std::vector<RepeatedTriangle>& repeated, vtkIdType firstCell)
  {
    // A triangle with the places of one before has no place of its own in the disk.
    for (const RepeatedTriangle& one : repeated)
    {
      const vtkIdType cell = firstCell + static_cast<vtkIdType>(one.Triangle);
      const vtkIdType from = firstCell + static_cast<vtkIdType>(one.First);
      this->Area->SetValue(cell, this->Area->GetValue(from));
      this->Angle->SetValue(cell, this->Angle->GetValue(from));
      this->Flipped->SetValue(cell, this->Flipped->GetValue(from));
    }
  }

  void Attach(vtkCellData* cells) const
  {
    cells->AddArray(this->Area);
    cells->AddArray(this->Angle);
    cells->AddArray(this->Flipped);
  }

private:
  template <class ArrayT>
  vtkSmartPointer<ArrayT> make(const char* name, typename ArrayT::ValueType value) const
  {
    auto array = newArray<ArrayT>(name, 1, this->Cells);
    std::fill_n(array->GetPointer(0), this->Cells, value);
    return array;
  }

  const vtkIdType Cells;
  const ConstPointSpan<2> Positions;
  const vtkSmartPointer<vtkDoubleArray> Area;
  const vtkSmartPointer<vtkDoubleArray> Angle;
  const vtkSmartPointer<vtkUnsignedCharArray> Flipped;
};

// The figures of a repaired surface are those of its own cells: in the disk a triangle may have
// been cut where a point lies on its side.
MapDistortion measureCells(const TriangleInput& read, const DiskTriangles& surface,
  const AreaPreservingMap& map, CellDistortions& distortions, Progress& progress)
{
  const auto cellOf = [&read](std::int64_t triangle) {
    return read.FirstCell() + static_cast<vtkIdType>(triangle);
  };
  // Triangles of the disk are those of the input in their order: map.Distortion has been measured
  // on them.
  if (!surface.IsRepaired())
  {
    distortions.Measure(measuredTriangles(surface.Disk()), cellOf, progress);
    return map.Distortion;
  }
  // Three points a given triangle, for which GivenTriangles finds the points of the disk.
  const LargeBuffer<std::int64_t> corners = read.Corners(progress);
  const GivenTriangles given(surface.Repaired(), corners.data());
  const MeasuredTriangles triangles{ given.Surface(), given.AreaShares() };
  distortions.Measure(
    triangles, [&](std::int64_t triangle) { return cellOf(given.Given(triangle)); }, progress);
  distortions.Repeat(surface.Repaired().Repeated(), read.FirstCell());
  return measureDistortion(triangles, map.Positions, progress);
}

// Calls map() with the memory of the flow asked for before: 40 bytes for each of Resolution x
// Resolution cells, 200 a point (see mapAreaPreserving).
template <class Map>
auto withFlowMemory(std::int64_t points, int resolution, const Map& map)
{
  const std::string cells = std::to_string(resolution);
  return withRequiredMemory(
    { "the flow of " + std::to_string(points) + " points on " + cells + " x " + cells +
        " cells (see Resolution)",
      40.0 * resolution * resolution + 200.0 * static_cast<double>(points) },
    map);
}

// Which point of the input each point is, and which component each cell; -1 for cells that are no
// triangles with area.
void attachOrigins(const CutOpenSurface& surface, vtkIdType firstCell, vtkPolyData* output)
{
  const vtkIdType points = output->GetNumberOfPoints();
  auto origins = newArray<vtkIdTypeArray>("PointIds", 1, points);
  for (vtkIdType i = 0; i < points; ++i)
  {
    origins->SetValue(i, static_cast<vtkIdType>(surface.OriginOf(i)));
  }
  output->GetPointData()->AddArray(origins);
  const vtkIdType cells = output->GetNumberOfCells();
  auto components = newArray<vtkIntArray>("Component", 1, cells);
  // Vertices and lines come first among the cells, and have no component.
  std::fill_n(components->GetPointer(0), cells, -1);
  for (std::int64_t triangle = 0; triangle < surface.Given().NumberOfTriangles; ++triangle)
  {
    components->SetValue(firstCell + static_cast<vtkIdType>(triangle),
      static_cast<int>(surface.Cut().DiskOf(triangle)));
  }
  output->GetCellData()->AddArray(components);
}

} // namespace

void AreaPreservingParameterization::Check() const
{
  // The upper limit keeps the tables of the square at 10.7 GB.
  requireThat(this->Resolution >= 1 && this->Resolution <= AreaPreservingOptions::MaximumResolution,
    "Resolution", this->Resolution, "from 1 to 16384");
  requireChoice("Seams", this->Seams, SeamsTexts);
  this->Corners.Check();
}

ParameterizationReport AreaPreservingParameterization::Run(
  vtkPolyData* input, Progress& progress, vtkPolyData* output) const
{
  // The weights are estimates for large surfaces; the map takes most of the time in any case.
  Stages stages(progress, { { "triangles", 5 }, { "disk", 5 }, { "map", 90 } });
  // The text completes the error for an input without polygons.
  TriangleInput triangles(input,
    this->Seams == AutomaticSeams ? "it must be a surface" : "it must be a disk",
    stages["triangles"]);
  // A disk is mapped as it is. Whatever else the input is, holes, handles or several components, is
  // found by the attempt to make a disk of it.
  std::optional<DiskTriangles> disk;
  try
  {
    disk.emplace(triangles.Disk(stages["disk"]));
  }
  catch (const NoDiskSurface& defect)
  {
    // The defect names what is wrong and where; with seams it is no error.
    if (this->Seams == NoSeams)
    {
      throw;
    }
    // After cutting, there may be several disks, and points on seams are there twice: four point
    // ids do not say which corners are meant.
    if (!this->Corners.Points.empty())
    {
      throw Failure(std::string(defect.what()) +
        "; or give no Corners, which only a disk can have: " + "then it is cut along seams");
    }
  }
  return disk ? this->MapDisk(triangles, *disk, stages["map"], output)
              : this->MapOpened(triangles, stages["map"], output);
}

ParameterizationReport AreaPreservingParameterization::MapDisk(const TriangleInput& read,
  const DiskTriangles& surface, Progress& progress, vtkPolyData* output) const
{
  // Two steps (paper, Section 5.4): the conformal map to a rectangle, scaled to the unit square,
  // then the flow from the density that the surface's areas have there to the uniform one.
  const DiskMesh& disk = surface.Disk();
  Stages stages(progress,
    { { "conformal map", 30 }, { "area-preserving map", 55 }, { "triangles", 2 },
      { "distortion", 5 } });
  const ConformalMap conformal =
    mapDisk(disk, this->Corners.Of(surface.Repaired()), stages["conformal map"]);
  const AreaPreservingMap map = withFlowMemory(disk.NumberOfPoints(), this->Resolution, [&]() {
    return mapAreaPreserving(
      disk, conformal.Square, { this->Resolution, this->Polish }, stages["area-preserving map"]);
  });

  // The output has the input's points, so that their arrays are shared; its cells are the
  // triangles.
  const vtkSmartPointer<vtkPolyData> triangles = read.Triangulated(stages["triangles"]);
  CellDistortions distortions(triangles->GetNumberOfCells(), map.Positions);
  const MapDistortion figures = measureCells(read, surface, map, distortions, stages["distortion"]);
  // Arrays of the map come after those of the input, and replace arrays of their names.
  output->CopyStructure(triangles);
  output->GetFieldData()->PassData(triangles->GetFieldData());
  output->GetCellData()->PassData(triangles->GetCellData());
  distortions.Attach(output->GetCellData());
  output->GetPointData()->PassData(triangles->GetPointData());
  attachCoordinates(surface, conformal.Square.Positions, map.Positions, output);
  attachFigures(figures, output);
  return { disk.NumberOfTriangles(), countCollapsed(disk, conformal.Square.Corners), figures,
    this->Polish, false, read.RepairWarning(surface.Repaired().Repairs()) };
}

ParameterizationReport AreaPreservingParameterization::MapOpened(
  TriangleInput& read, Progress& progress, vtkPolyData* output) const
{
  Stages stages(progress, { { "seams", 40 }, { "map", 45 }, { "distortion", 3 }, { "output", 2 } });
  // As for a disk, but each component is cut open, and each disk has a square of its own in an
  // atlas. Points on seams become several, so that arrays of points are copied.
  CutOpenSurface surface = read.Opened(stages["seams"]);
  const CutSurface& cut = surface.Cut();
  const CutSurfaceMap map = withFlowMemory(cut.NumberOfPoints(), this->Resolution, [&]() {
    return mapCutSurface(cut, { this->Resolution, this->Polish }, stages["map"]);
  });

  const CutTriangles given(cut, surface.Given());
  const MeasuredTriangles triangles = given.Measured();
  // The squares leave gaps in the unit square. Distortions compare shares of areas, so that
  // positions are scaled until the surface covers an area of 1.
  const std::vector<Point<2>> scaled = scaledToUnitArea(map);
  CellDistortions distortions(
    read.FirstCell() + static_cast<vtkIdType>(surface.Given().NumberOfTriangles), scaled);
  distortions.Measure(
    triangles,
    [&](std::int64_t triangle) {
      return read.FirstCell() + static_cast<vtkIdType>(given.Given(triangle));
    },
    stages["distortion"]);
  distortions.Repeat(cut.Repeated(), read.FirstCell());
  const MapDistortion figures = measureDistortion(triangles, scaled, stages["distortion"]);
  // After the map: triangles without area choose among the copies of their points by their
  // positions.
  surface.PlaceDegenerate(map.Positions);
  read.CopyOpened(surface, stages["output"], output);
  distortions.Attach(output->GetCellData());
  attachOrigins(surface, read.FirstCell(), output);
  attachCoordinates(surface, map.Conformal, map.Positions, output);
  attachFigures(figures, output);
  return { triangles.Surface.NumberOfTriangles, map.Collapsed, figures, this->Polish, true,
    read.RepairWarning(cut.Cuts(), cut.Cuts().NonManifoldEdges) };
}

void layFlat(vtkPolyData* surface, vtkPolyData* flat)
{
  // Two doubles a point: u and v become x and y of the flat surface, z = 0.
  const double* next =
    vtkDoubleArray::SafeDownCast(surface->GetPointData()->GetArray(exactName))->GetPointer(0);
  const vtkIdType count = surface->GetNumberOfPoints();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i, next += 2)
  {
    points->SetPoint(i, next[0], next[1], 0.0);
  }
  flat->ShallowCopy(surface);
  flat->SetPoints(points);
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(flat->GetPointData()),
         static_cast<vtkDataSetAttributes*>(flat->GetCellData()) })
  {
    // Normals and tangents of the surface in space would light the flat one wrongly. As arrays they
    // stay.
    data->SetActiveAttribute(-1, vtkDataSetAttributes::NORMALS);
    data->SetActiveAttribute(-1, vtkDataSetAttributes::TANGENTS);
  }
}

} // namespace RectifiedTransport::Bridge
