// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Parameterization/AreaPreservingParameterization.h"

#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Surface/DiskConformalMap.h"
#include "Bridge/Surface/DiskSurface.h"
#include "Core/Parameterization/AreaPreservingMap.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
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

vtkSmartPointer<vtkDoubleArray> coordinatesArray(
  const std::string& name, const std::vector<Point<2>>& positions)
{
  auto array = newArray<vtkDoubleArray>(name, 2, static_cast<vtkIdType>(positions.size()));
  const ConstPointSpan<2> points(positions);
  std::copy_n(points.data(), 2 * points.size(), array->GetPointer(0));
  return array;
}

// The arrays of the cells; those that are no triangles of the disk are not distorted.
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

  void Measure(Progress& progress)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
    const DiskMesh& disk = this->Surface.Disk();
    const vtkIdType offset = this->Surface.CellOf(0);
    double* areas = this->Area->GetPointer(offset);
    double* angles = this->Angle->GetPointer(offset);
    unsigned char* flipped = this->Flipped->GetPointer(offset);
    progress.For(disk.NumberOfTriangles(), grain, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t triangle = first; triangle < last; ++triangle)
      {
        const TriangleDistortion found = distortionOf(disk, this->Positions, triangle);
        areas[triangle] = found.Area;
        angles[triangle] = found.Angle;
        flipped[triangle] = found.IsFlipped ? 1 : 0;
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

} // namespace

std::vector<std::string> ParameterizationReport::Warnings() const
{
  std::vector<std::string> warnings;
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
  const ConformalMap conformal = mapDisk(disk, this->Corners.Of(disk), progress);
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
  distortions.Measure(progress);
  vtkPolyData* triangles = surface.Triangulated();
  output->CopyStructure(triangles);
  output->GetFieldData()->PassData(triangles->GetFieldData());
  output->GetCellData()->PassData(triangles->GetCellData());
  distortions.Attach(output->GetCellData());
  vtkPointData* data = output->GetPointData();
  data->PassData(triangles->GetPointData());
  data->AddArray(coordinatesArray("Conformal", conformal.Square.Positions));
  data->AddArray(coordinatesArray("AreaPreserving", map.Positions));
  data->SetActiveTCoords("AreaPreserving"); // SetTCoords would remove the input's
  addFieldValue(output, "AreaDistortionRMS", map.Distortion.AreaRootMeanSquare);
  addFieldValue(output, "AngleDistortionMean", map.Distortion.AngleMean);
  addFieldValue(output, "FlippedCount", static_cast<double>(map.Distortion.Flipped));
  return { disk.NumberOfTriangles(), countCollapsed(disk, conformal.Square.Corners), map.Distortion,
    this->Polish };
}

} // namespace RectifiedTransport
