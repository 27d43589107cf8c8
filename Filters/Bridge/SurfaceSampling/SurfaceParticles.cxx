// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SurfaceSampling/SurfaceParticles.h"

#include "Bridge/Density/CostModel.h"
#include "Bridge/Points/ParticleCells.h"
#include "Bridge/Points/SampledArrays.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PlacedTriangles.h"
#include "Bridge/Surface/SurfaceInput.h"
#include "Core/Parallel/Stages.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

// To sample the surface's arrays, relative to Cost::Write.
double costOfArrays(vtkPolyData* surface)
{
  return 2.0 *
    (1.0 + surface->GetPointData()->GetNumberOfArrays() +
      surface->GetCellData()->GetNumberOfArrays());
}

Eigen::Vector3d normalOf(const TriangleSurface& surface, std::int64_t triangle)
{
  const std::int64_t* corners = surface.Triangles + 3 * triangle;
  const ConstPointSpan<3> points = surface.Points;
  const auto corner = [&](int i) { return Eigen::Map<const Eigen::Vector3d>(points[corners[i]]); };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
}

// The arrays SeedId, Mass, CellId and Normal. Returns the points.
vtkSmartPointer<vtkDoubleArray> writeParticles(const SurfaceInput& input,
  const PlacedTriangles& surface, const LargeBuffer<PlaceOnTriangle>& places, double totalMass,
  Progress& progress, vtkPolyData* output)
{
  const std::int64_t count = places.size();
  auto points = newArray<vtkDoubleArray>("Points", 3, count);
  auto ids = newArray<vtkIdTypeArray>("SeedId", 1, count);
  auto masses = newArray<vtkDoubleArray>("Mass", 1, count);
  auto cells = newArray<vtkIdTypeArray>("CellId", 1, count);
  auto normals = newArray<vtkDoubleArray>("Normal", 3, count);
  vtkIdType* id = ids->GetPointer(0);
  double* mass = masses->GetPointer(0);
  vtkIdType* cell = cells->GetPointer(0);
  double* point = points->GetPointer(0);
  double* normal = normals->GetPointer(0);
  const double share = totalMass / static_cast<double>(count);
  const TriangleSurface triangles = surface.Surface();
  progress.For(count, Grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const PlaceOnTriangle& place = places.data()[i];
      const PointWeights in = surface.InCell(place);
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        Eigen::Vector3d at;
        surface.Triangulated()->GetPoint(static_cast<vtkIdType>(in.Points[corner]), at.data());
        x += in.Weights[corner] * at;
      }
      Eigen::Map<Eigen::Vector3d>(point + 3 * i) = x;
      Eigen::Map<Eigen::Vector3d>(normal + 3 * i) = normalOf(triangles, place.Triangle);
      id[i] = i;
      mass[i] = share;
      cell[i] = input.InputCellOf(surface.InputCellOf(place.Triangle));
    }
  });
  vtkPointData* data = output->GetPointData();
  data->AddArray(ids);
  data->AddArray(masses);
  data->AddArray(cells);
  data->SetNormals(normals);
  return points;
}

class PlacesOnSurface : public SampledPlaces
{
public:
  PlacesOnSurface(const PlacedTriangles& surface, const LargeBuffer<PlaceOnTriangle>& places)
    : Surface(surface)
    , Places(places)
  {
  }

  std::int64_t Count() const override { return this->Places.size(); }
  SampledPlace Find(std::int64_t place) const override
  {
    const PlaceOnTriangle& on = this->Places.data()[place];
    SampledPlace found{};
    found.Count = 3;
    const PointWeights in = this->Surface.InCell(on);
    std::copy_n(in.Points.data(), 3, found.Points);
    std::copy_n(in.Weights.data(), 3, found.Weights);
    found.Cell = this->Surface.CellOf(on.Triangle);
    return found;
  }

private:
  const PlacedTriangles& Surface;
  const LargeBuffer<PlaceOnTriangle>& Places;
};

} // namespace

void writeSurfaceParticles(const SurfaceInput& input, const PlacedTriangles& surface,
  const LargeBuffer<PlaceOnTriangle>& places, double totalMass, Progress& progress,
  vtkPolyData* output)
{
  Stages stages(progress,
    { { "points", 1 }, { "cells", 1 }, { "arrays", costOfArrays(surface.Triangulated()) } });
  const vtkSmartPointer<vtkDoubleArray> points =
    writeParticles(input, surface, places, totalMass, stages["points"], output);
  setParticles(output, points, 1, stages["cells"]);
  sampleArrays({ { surface.Triangulated() }, "input surface", true },
    PlacesOnSurface(surface, places), stages["arrays"], output->GetPointData());
  addFieldValue(output, "TotalMass", totalMass);
}

double costOfSurfaceParticles(double particles, vtkPolyData* surface)
{
  return Cost::Write * particles * (2.0 + costOfArrays(surface));
}

} // namespace RectifiedTransport::Bridge
