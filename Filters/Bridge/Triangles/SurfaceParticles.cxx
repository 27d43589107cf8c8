// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Triangles/SurfaceParticles.h"

#include "Bridge/Data/ArraySampling.h"
#include "Bridge/Data/Cells/ParticleCells.h"
#include "Bridge/Run/CostModel.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Stages.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <Eigen/Geometry>

#include <algorithm>

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
vtkSmartPointer<vtkDoubleArray> writeParticles(
  const SurfacePlaces& on, double totalMass, Progress& progress, vtkPolyData* output)
{
  const TriangleDomain& surface = on.Surface;
  const LargeBuffer<PlaceOnTriangle>& places = on.Places;
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
  progress.ForEach(count, Grain, [&](std::int64_t i) {
    const PlaceOnTriangle& place = places.data()[i];
    const PointWeights in = surface.InGiven(place);
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      Eigen::Vector3d at;
      on.Triangles.Input()->GetPoint(static_cast<vtkIdType>(in.Points[corner]), at.data());
      x += in.Weights[corner] * at;
    }
    Eigen::Map<Eigen::Vector3d>(point + 3 * i) = x;
    Eigen::Map<Eigen::Vector3d>(normal + 3 * i) = normalOf(triangles, place.Triangle);
    id[i] = i;
    mass[i] = share;
    cell[i] = on.Input.InputCellOf(on.CellOf(place));
  });
  vtkPointData* data = output->GetPointData();
  data->AddArray(ids);
  data->AddArray(masses);
  data->AddArray(cells);
  data->SetNormals(normals);
  return points;
}

class SurfaceProbe : public ProbeLocations
{
public:
  explicit SurfaceProbe(const SurfacePlaces& on)
    : On(on)
  {
  }

  std::int64_t Count() const override { return this->On.Places.size(); }
  ProbeLocation Find(std::int64_t place) const override
  {
    const PlaceOnTriangle& on = this->On.Places.data()[place];
    ProbeLocation found{};
    found.Count = 3;
    const PointWeights in = this->On.Surface.InGiven(on);
    std::copy_n(in.Points.data(), 3, found.Points);
    std::copy_n(in.Weights.data(), 3, found.Weights);
    found.Cell = this->On.CellOf(on);
    return found;
  }

private:
  const SurfacePlaces On;
};

} // namespace

void writeSurfaceParticles(
  const SurfacePlaces& on, double totalMass, Progress& progress, vtkPolyData* output)
{
  vtkPolyData* input = on.Triangles.Input();
  Stages stages(progress, { { "points", 1 }, { "cells", 1 }, { "arrays", costOfArrays(input) } });
  const vtkSmartPointer<vtkDoubleArray> points =
    writeParticles(on, totalMass, stages["points"], output);
  setParticles(output, points, 1, stages["cells"]);
  sampleArrays({ { input }, "input surface", true }, SurfaceProbe(on), stages["arrays"],
    output->GetPointData());
  activateMass(output);
  addFieldValue(output, "TotalMass", totalMass);
}

double costOfSurfaceParticles(double particles, vtkPolyData* surface)
{
  return Cost::Write * particles * (2.0 + costOfArrays(surface));
}

} // namespace RectifiedTransport::Bridge
