// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Triangles/SurfaceSampler.h"

#include "Bridge/Run/CostModel.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/StepReport.h"
#include "Bridge/Triangles/SurfaceDensityArray.h"
#include "Bridge/Triangles/SurfaceInput.h"
#include "Bridge/Triangles/SurfaceParticles.h"
#include "Bridge/Triangles/TriangleInput.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Parameterization/AreaPreservingMap.h"
#include "Surfaces/SurfaceRelaxation/SurfaceRelaxation.h"

#include "vtkPolyData.h"

#include <cmath>
#include <stdexcept>

namespace RectifiedTransport::Bridge
{

namespace
{

// Nanoseconds, as measured on one thread. The conformal map factorizes the sparse matrix of a
// planar graph, for which nested dissection takes O(n^1.5) operations.
double costOfMap(double points)
{
  return 40.0 * std::pow(points, 1.5);
}

} // namespace

void SurfaceSampler::Check() const
{
  // Steps of the flow and the seed are checked where all filters with a flow check them.
  const std::int64_t number = this->Options.NumberOfSamples;
  const std::int64_t resolution = this->Options.Resolution;
  requireThat(number >= 1, "NumberOfParticles", number, "at least 1");
  requireThat(this->RelaxationIterations >= 0 && this->RelaxationIterations <= MostIterations,
    "RelaxationIterations", this->RelaxationIterations, "from 0 to 1000");
  requireThat(resolution >= 1 && resolution <= AreaPreservingOptions::MaximumResolution,
    "Resolution", resolution, "from 1 to 16384");
  this->Corners.Check();
}

SurfaceSamplingReport SurfaceSampler::Run(const SurfaceInput& input,
  const SurfaceDensityArray& density, Progress& progress, vtkPolyData* output) const
{
  return this->Method == SurfaceMethod::Flow ? this->Transport(input, density, progress, output)
                                             : this->Relax(input, density, progress, output);
}

// Relaxation works on the surface itself, so it takes any surface, in any number of components. The
// weights of the stages are nanoseconds, as measured on one thread.
SurfaceSamplingReport SurfaceSampler::Relax(const SurfaceInput& given,
  const SurfaceDensityArray& density, Progress& progress, vtkPolyData* output) const
{
  vtkPolyData* input = given.Get();
  SurfaceRelaxationOptions options;
  options.NumberOfSamples = this->Options.NumberOfSamples;
  options.Iterations = this->RelaxationIterations;
  options.RandomSeed = this->Options.RandomSeed;
  const auto size = static_cast<double>(input->GetNumberOfPoints());
  const auto asked = static_cast<double>(this->Options.NumberOfSamples);
  Stages stages(progress,
    { { "input", 250.0 * size }, { "triangles", 250.0 * size }, { "masses", 50.0 * size },
      { "relaxation", 2000.0 * size + (3000.0 + 500.0 * this->RelaxationIterations) * asked },
      { "particles", costOfSurfaceParticles(asked, input) } });
  const std::string particles =
    std::to_string(this->Options.NumberOfSamples) + " particles (see NumberOfParticles)";
  const double bytes = asked * BytesOfSurfaceParticle;
  // Asked for before the surface is read: NumberOfParticles may be far too large.
  requireMemory({ particles, bytes });

  TriangleInput read(input, "it must be a surface", stages["input"]);
  const AllTriangles surface = read.Whole(stages["triangles"]);
  // Coordinates are in units of the surface's size, and so is their rounding; points that differ by
  // less are one, which closes the edges between triangles.
  options.Rounding = surface.Rounding();
  // Shape: one mass a triangle, the density integrated over its area. `relative` gives values at
  // points or of triangles, or neither for the density 1.
  const SurfaceMasses masses = density.MassesOf(read, surface, stages["masses"]);
  const SurfaceDensityValues relative = masses.Density();
  const TriangleSurface triangles = surface.Surface();
  const SurfaceRelaxation samples =
    withMemory({ "the relaxation of " + particles,
                 bytes +
                   memoryForSurfaceRelaxation(triangles.Points.size(), triangles.NumberOfTriangles,
                     relative.AtPoints || relative.OfTriangles, this->Options.NumberOfSamples) },
      [&]() {
        try
        {
          return relaxOnSurface(triangles, relative, options, stages["relaxation"]);
        }
        catch (const std::invalid_argument&) // all else was checked before
        {
          throw Failure("The input surface has no area: each of its " +
            std::to_string(triangles.NumberOfTriangles) +
            " triangles is lower than 1e-12 of its length, or nothing beside the bounds");
        }
      });
  writeSurfaceParticles(
    { given, read, surface, samples.Places }, masses.Total(), stages["particles"], output);
  SurfaceSamplingReport report;
  // A relaxed set has no steps and no map, so that the other numbers stay 0.
  report.Particles = samples.Places.size();
  RepairCounts repairs; // nothing else that is wrong changes the result
  repairs.Repeated = surface.Repeated();
  repairs.TJunctions = samples.TJunctions;
  report.Repair = repairWarning(repairs);
  return report;
}

// The flow needs a disk: the conformal map takes it to a rectangle of the map's aspect ratio, where
// the mass of the triangles is a density on a grid of Resolution cells. Seeds that are uniform in
// the rectangle follow the flow to that density, and the inverse map puts them on triangles.
SurfaceSamplingReport SurfaceSampler::Transport(const SurfaceInput& given,
  const SurfaceDensityArray& density, Progress& progress, vtkPolyData* output) const
{
  vtkPolyData* input = given.Get();
  const auto size = static_cast<double>(input->GetNumberOfPoints());
  const auto asked = static_cast<double>(this->Options.NumberOfSamples);
  const FlowOptions& flowOptions = this->Options.Flow;
  const auto resolution = static_cast<double>(this->Options.Resolution);
  Stages stages(progress,
    { { "input", 700.0 * size }, { "triangles", 800.0 * size }, { "map", costOfMap(size) },
      { "masses", 50.0 * size },
      { "flow",
        30.0 * resolution * resolution + 1500.0 * size +
          (1000.0 + Cost::flow(flowOptions, 2)) * asked },
      { "particles", costOfSurfaceParticles(asked, input) } });
  const std::string particles =
    std::to_string(this->Options.NumberOfSamples) + " particles (see NumberOfParticles)";
  constexpr double bytesOfParticle = BytesOfSurfaceParticle + sizeof(PlaceOnTriangle);
  requireMemory({ particles, asked * bytesOfParticle });

  TriangleInput read(input, "it must be a disk", stages["input"]);
  const DiskTriangles surface = read.Disk(stages["triangles"]);
  const DiskMesh& disk = surface.Disk();
  const ConformalMap map = mapDisk(disk, this->Corners.Of(surface.Repaired()), stages["map"]);
  const SurfaceMasses masses = density.MassesOf(read, surface, stages["masses"]);

  // Cells are as near to squares as possible: the flow commutes with a scaling of each axis, but
  // its errors are counted in cells.
  const GridSize<2> grid = flatGrid(map.AspectRatio, this->Options.Resolution);
  const double tables = memoryForSurfaceFlow(grid);
  const std::string flow = "the flow on " + std::to_string(grid[0]) + " x " +
    std::to_string(grid[1]) + " cells (see Resolution)";
  requireMemory({ flow, tables });
  const SurfaceSamples samples = withMemory(
    { flow + " and " + particles,
      tables + asked * bytesOfParticle + 80.0 * static_cast<double>(disk.NumberOfTriangles()) },
    [&]() { return sampleSurface(disk, map, masses.Values(), this->Options, stages["flow"]); });

  writeSurfaceParticles(
    { given, read, surface, samples.Places }, masses.Total(), stages["particles"], output);
  // Particles that ended in a cell of the grid without mass, and were moved to the nearest one with
  // mass.
  addFieldValue(output, "MovedParticles", static_cast<double>(samples.Flow.MovedToMass));
  addSteps(output, { samples.Flow });
  return { samples.Places.size(), samples.Flow.MovedToMass,
    stepWarning(samples.Flow, flowOptions, FlowDirection::Forward, true), disk.NumberOfTriangles(),
    countCollapsed(disk, map.Square.Corners), samples.PatchError, samples.IsAreaPreserving,
    read.RepairWarning(surface.Repaired().Repairs()) };
}

} // namespace RectifiedTransport::Bridge
