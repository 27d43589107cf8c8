// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SurfaceSampling/SurfaceSampler.h"

#include "Bridge/Density/CostModel.h"
#include "Bridge/Points/ParticleCells.h"
#include "Bridge/Points/SampledArrays.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Run/StepReport.h"
#include "Bridge/Run/WarningLimit.h"
#include "Bridge/Surface/DiskSurface.h"
#include "Bridge/Surface/SurfaceInput.h"
#include "Bridge/SurfaceSampling/SurfaceMasses.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Parameterization/AreaPreservingMap.h"
#include "Core/SurfaceSampling/SurfaceSamples.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

// Nanoseconds, as measured on one thread.
double costOfMap(double points)
{
  return 40.0 * std::pow(points, 1.5);
}

Eigen::Vector3d normalOf(const DiskMesh& disk, std::int64_t triangle)
{
  const std::int64_t* corners = disk.Triangle(triangle);
  const ConstPointSpan<3> points = disk.Surface().Points;
  const auto corner = [&](int i) { return Eigen::Map<const Eigen::Vector3d>(points[corners[i]]); };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
}

// The arrays SeedId, Mass, CellId and Normal. Returns the points.
vtkSmartPointer<vtkDoubleArray> writeParticles(const SurfaceInput& input,
  const DiskSurface& surface, const LargeBuffer<PlaceOnTriangle>& places, double totalMass,
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
  const DiskMesh& disk = surface.Disk();
  progress.For(count, Grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const PlaceOnTriangle& place = places.data()[i];
      const std::array<std::int64_t, 3> corners = surface.CornersOf(place.Triangle);
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        Eigen::Vector3d at;
        surface.Triangulated()->GetPoint(static_cast<vtkIdType>(corners[corner]), at.data());
        x += place.Weights[corner] * at;
      }
      Eigen::Map<Eigen::Vector3d>(point + 3 * i) = x;
      Eigen::Map<Eigen::Vector3d>(normal + 3 * i) = normalOf(disk, place.Triangle);
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
  PlacesOnSurface(const DiskSurface& surface, const LargeBuffer<PlaceOnTriangle>& places)
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
    std::copy_n(this->Surface.CornersOf(on.Triangle).data(), 3, found.Points);
    std::copy_n(on.Weights.data(), 3, found.Weights);
    found.Cell = this->Surface.CellOf(on.Triangle);
    return found;
  }

private:
  const DiskSurface& Surface;
  const LargeBuffer<PlaceOnTriangle>& Places;
};

} // namespace

void SurfaceSampler::Check() const
{
  requireThat(
    this->NumberOfParticles >= 1, "NumberOfParticles", this->NumberOfParticles, "at least 1");
  requireThat(this->Resolution >= 1 && this->Resolution <= AreaPreservingOptions::MaximumResolution,
    "Resolution", this->Resolution, "from 1 to 16384");
  this->Corners.Check();
}

std::vector<std::string> SurfaceSamplingReport::Warnings() const
{
  std::vector<std::string> warnings;
  if (!this->Repair.empty())
  {
    warnings.push_back(this->Repair);
  }
  if (isWorthWarning(this->Moved, this->Particles))
  {
    warnings.push_back(std::to_string(this->Moved) + " of " + std::to_string(this->Particles) +
      " particles in empty cells moved to the nearest cell with mass (more NumberOfSteps may spare "
      "them that)");
  }
  if (!this->Steps.empty())
  {
    warnings.push_back(this->Steps);
  }
  if (this->IsAreaPreserving)
  {
    std::ostringstream text;
    text.precision(2);
    text
      << "The conformal map squeezes much of the surface into few cells: the particles come from "
         "the area-preserving map instead, which shears their pattern (a longer boundary helps)";
    if (this->PatchError > SurfaceSamples::AcceptableError)
    {
      text << "; their numbers in patches of the surface are still wrong by "
           << 100.0 * this->PatchError << " %";
    }
    warnings.push_back(text.str());
  }
  if (this->Collapsed > 0)
  {
    warnings.push_back(collapsedWarning(this->Collapsed, this->Triangles));
  }
  return warnings;
}

SurfaceSamplingReport SurfaceSampler::Run(const SurfaceInput& given, const SurfaceDensity& density,
  Progress& progress, vtkPolyData* output) const
{
  vtkPolyData* input = given.Get();
  SurfaceSamplingOptions options;
  options.NumberOfSamples = this->NumberOfParticles;
  options.Resolution = this->Resolution;
  options.Pattern = this->Pattern;
  options.RandomSeed = static_cast<std::uint64_t>(this->RandomSeed);
  options.Flow = this->Flow;
  const auto size = static_cast<double>(input->GetNumberOfPoints());
  const auto asked = static_cast<double>(this->NumberOfParticles);
  const double cells = static_cast<double>(this->Resolution) * this->Resolution;
  const auto arrays = static_cast<double>(
    input->GetPointData()->GetNumberOfArrays() + input->GetCellData()->GetNumberOfArrays());
  const auto ends = stageEnds({ 1500.0 * size, costOfMap(size), 50.0 * size,
    30.0 * cells + 1500.0 * size + (1000.0 + Cost::flow(this->Flow, 2)) * asked,
    Cost::Write * asked, Cost::Write * asked, 2.0 * Cost::Write * asked * (1.0 + arrays) });
  const std::string particles =
    std::to_string(this->NumberOfParticles) + " particles (see NumberOfParticles)";
  constexpr double bytesOfParticle =
    9 * sizeof(double) + 4 * sizeof(vtkIdType) + sizeof(PlaceOnTriangle);
  requireMemory(particles, asked * bytesOfParticle);

  const DiskSurface surface(input, progress, ends[0]);
  const DiskMesh& disk = surface.Disk();
  progress.BeginStage(ends[1]);
  const ConformalMap map = mapDisk(disk, this->Corners.Of(surface.Repaired()), progress);
  progress.BeginStage(ends[2]);
  const SurfaceMasses masses(input, surface, density, progress);

  const GridSize<2> grid = flatGrid(map.AspectRatio, this->Resolution);
  const double tables = numberOfCells<2>(grid) * sizeof(double) + RectifiedFlow<2>::MemoryFor(grid);
  const std::string flow = "the flow on " + std::to_string(grid[0]) + " x " +
    std::to_string(grid[1]) + " cells (see Resolution)";
  requireMemory(flow, tables);
  progress.BeginStage(ends[3]);
  const SurfaceSamples samples = withMemory(flow + " and " + particles,
    tables + asked * bytesOfParticle + 80.0 * static_cast<double>(disk.NumberOfTriangles()),
    [&]() { return sampleSurface(disk, map, masses.Values(), options, progress.Stage()); });

  progress.BeginStage(ends[4]);
  const vtkSmartPointer<vtkDoubleArray> points =
    writeParticles(given, surface, samples.Places, masses.Total(), progress, output);
  progress.BeginStage(ends[5]);
  setParticles(output, points, 1, progress);
  sampleArrays({ { surface.Triangulated() }, "input surface", true },
    PlacesOnSurface(surface, samples.Places), progress, ends[6], output->GetPointData());
  addFieldValue(output, "TotalMass", masses.Total());
  addFieldValue(output, "MovedParticles", static_cast<double>(samples.Flow.MovedToMass));
  addSteps(output, { samples.Flow });
  return { samples.Places.size(), samples.Flow.MovedToMass,
    stepWarning(samples.Flow, this->Flow, FlowDirection::Forward), disk.NumberOfTriangles(),
    countCollapsed(disk, map.Square.Corners), samples.PatchError, samples.IsAreaPreserving,
    surface.IsRepaired() ? surface.RepairWarning() : "" };
}

} // namespace RectifiedTransport
