// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Parameterization/AreaPreservingParameterization.h"

#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Surface/DiskSurface.h"
#include "Core/Parameterization/AreaPreservingMap.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

// A deviation of 95 % of the area that is worth a warning; the goal is 3 %.
constexpr double AcceptableDeviation = 0.05;

constexpr const char* exactName = "AreaPreservingExact";

// By the points of the output; 0 0 for those that no triangle with area has.
template <class ArrayT>
vtkSmartPointer<ArrayT> coordinatesArray(
  const std::string& name, const DiskSurface& surface, ConstPointSpan<2> positions)
{
  const vtkIdType points = surface.Triangulated()->GetNumberOfPoints();
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

// The arrays of the cells; those that are no triangles with area are not distorted.
class CellDistortions
{
public:
  CellDistortions(const DiskSurface& surface, ConstPointSpan<2> positions)
    : Surface(surface)
    , Positions(positions)
    , Area(make<vtkDoubleArray>("AreaDistortion", 1.0))
    , Angle(make<vtkDoubleArray>("AngleDistortion", 1.0))
    , Flipped(make<vtkUnsignedCharArray>("Flipped", 0))
  {
  }

  // cellOf(triangle) is the cell that a triangle is.
  template <class CellOf>
  void Measure(const MeasuredTriangles& triangles, const CellOf& cellOf, Progress& progress)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
    double* areas = this->Area->GetPointer(0);
    double* angles = this->Angle->GetPointer(0);
    unsigned char* flipped = this->Flipped->GetPointer(0);
    progress.For(
      triangles.Surface.NumberOfTriangles, grain, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t triangle = first; triangle < last; ++triangle)
        {
          const TriangleDistortion found = distortionOf(triangles, this->Positions, triangle);
          const vtkIdType cell = cellOf(triangle);
          areas[cell] = found.Area;
          angles[cell] = found.Angle;
          flipped[cell] = found.IsFlipped ? 1 : 0;
        }
      });
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
    const vtkIdType cells = this->Surface.Triangulated()->GetNumberOfCells();
    auto array = newArray<ArrayT>(name, 1, cells);
    std::fill_n(array->GetPointer(0), cells, value);
    return array;
  }

  const DiskSurface& Surface;
  const ConstPointSpan<2> Positions;
  const vtkSmartPointer<vtkDoubleArray> Area;
  const vtkSmartPointer<vtkDoubleArray> Angle;
  const vtkSmartPointer<vtkUnsignedCharArray> Flipped;
};

// Of a repaired surface the figures are those of its own cells: in the disk a triangle may have
// been cut where a point lies on its side.
MapDistortion measureCells(const DiskSurface& surface, const AreaPreservingMap& map,
  CellDistortions& distortions, Progress& progress)
{
  if (!surface.IsRepaired())
  {
    distortions.Measure(
      measuredTriangles(surface.Disk()),
      [&](std::int64_t triangle) { return surface.CellOf(triangle); }, progress);
    return map.Distortion;
  }
  const GivenTriangles given = surface.GivenWithArea(progress);
  const MeasuredTriangles triangles{ given.Surface(), given.AreaShares() };
  distortions.Measure(
    triangles,
    [&](std::int64_t triangle) {
      return surface.FirstCell() + static_cast<vtkIdType>(given.Given(triangle));
    },
    progress);
  return measureDistortion(triangles, map.Positions, progress.Stage());
}

} // namespace

std::vector<std::string> ParameterizationReport::Warnings() const
{
  std::vector<std::string> warnings;
  if (!this->Repair.empty())
  {
    warnings.push_back(this->Repair);
  }
  const std::int64_t flipped = this->Distortion.Flipped;
  if (flipped > this->Collapsed || (this->Polish && this->Distortion.Area95 > AcceptableDeviation))
  {
    std::ostringstream text;
    text.precision(3);
    text << flipped << " of " << this->Triangles
         << " triangles are flipped and 95 % of the area is within "
         << 100.0 * this->Distortion.Area95 << " % of its share of the square; "
         << (this->Polish ? "a longer boundary helps where the surface is nearly closed, smaller "
                            "triangles help elsewhere"
                          : "Polish is off");
    warnings.push_back(text.str());
  }
  if (this->Collapsed > 0)
  {
    warnings.push_back(collapsedWarning(this->Collapsed, this->Triangles));
  }
  return warnings;
}

void AreaPreservingParameterization::Check() const
{
  requireThat(this->Resolution >= 1 && this->Resolution <= AreaPreservingOptions::MaximumResolution,
    "Resolution", this->Resolution, "from 1 to 16384");
  this->Corners.Check();
}

ParameterizationReport AreaPreservingParameterization::Run(
  vtkPolyData* input, Progress& progress, vtkPolyData* output) const
{
  const DiskSurface surface(input, progress, 0.1);
  const DiskMesh& disk = surface.Disk();
  const auto points = static_cast<double>(disk.NumberOfPoints());
  const std::string purpose = " of " + std::to_string(disk.NumberOfPoints()) + " points";

  progress.BeginStage(0.4);
  const ConformalMap conformal = mapDisk(disk, this->Corners.Of(surface.Repaired()), progress);
  progress.BeginStage(0.95);
  const std::string cells = std::to_string(this->Resolution);
  const double bytes = 40.0 * this->Resolution * this->Resolution + 200.0 * points;
  const std::string flow =
    "the flow" + purpose + " on " + cells + " x " + cells + " cells (see Resolution)";
  requireMemory(flow, bytes);
  const AreaPreservingMap map = withMemory(flow, bytes, [&]() {
    return mapAreaPreserving(
      disk, conformal.Square, { this->Resolution, this->Polish }, progress.Stage());
  });

  progress.BeginStage(1.0);
  CellDistortions distortions(surface, map.Positions);
  const MapDistortion figures = measureCells(surface, map, distortions, progress);
  vtkPolyData* triangles = surface.Triangulated();
  output->CopyStructure(triangles);
  output->GetFieldData()->PassData(triangles->GetFieldData());
  output->GetCellData()->PassData(triangles->GetCellData());
  distortions.Attach(output->GetCellData());
  vtkPointData* data = output->GetPointData();
  data->PassData(triangles->GetPointData());
  data->AddArray(
    coordinatesArray<vtkDoubleArray>("Conformal", surface, conformal.Square.Positions));
  data->AddArray(coordinatesArray<vtkDoubleArray>(exactName, surface, map.Positions));
  data->AddArray(coordinatesArray<vtkFloatArray>("AreaPreserving", surface, map.Positions));
  data->SetActiveTCoords("AreaPreserving"); // SetTCoords would remove the input's
  addFieldValue(output, "AreaDistortionRMS", figures.AreaRootMeanSquare);
  addFieldValue(output, "AngleDistortionMean", figures.AngleMean);
  addFieldValue(output, "FlippedCount", static_cast<double>(figures.Flipped));
  return { disk.NumberOfTriangles(), countCollapsed(disk, conformal.Square.Corners), figures,
    this->Polish, surface.IsRepaired() ? surface.RepairWarning() : "" };
}

void layFlat(vtkPolyData* surface, vtkPolyData* flat)
{
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
    data->SetActiveAttribute(-1, vtkDataSetAttributes::NORMALS);
    data->SetActiveAttribute(-1, vtkDataSetAttributes::TANGENTS);
  }
}

} // namespace RectifiedTransport
