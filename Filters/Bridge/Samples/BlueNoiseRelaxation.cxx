// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Samples/BlueNoiseRelaxation.h"

#include "Bridge/Data/SeedInput.h"
#include "Bridge/Plan/DensityQueries.h"
#include "Bridge/Plan/FlowCosts.h"
#include "Core/Messages/Failure.h"
#include "Core/Quality/BlockCorrelation.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

// Points in a range of a thread.
constexpr std::int64_t seedGrain = std::int64_t{ 1 } << 14;

// The bytes that the core takes while it runs.
double coreMemory(bool byTransport, int dimension, double cells, double points)
{
  // About the most bytes: moments of the density's rows for integrals over polygons; the power
  // diagram with the factors of its linear systems; the neighbours within reach of a Gaussian.
  constexpr double rowMoments = 18.0; // a cell of the density
  constexpr double diagram = 2048.0;  // a point
  const double neighbours = dimension == 2 ? 2500.0 : 4600.0;
  return byTransport ? rowMoments * cells + diagram * points : neighbours * points;
}

// The points of a set in index space, where they are no ghosts, and all of them in physical space.
template <int D>
class PlacedPoints
{
public:
  PlacedPoints(const ImageGrid& grid, const NonGhostPoints& counted)
    : Grid(grid)
    , Counted(counted)
  {
  }

  // Returns how many points were moved to the domain.
  std::int64_t Read(vtkPointSet* input, const std::string& purpose, Progress& progress)
  {
    // Two sets of coordinates: 3 doubles for each point in physical space, ghosts among them, and D
    // for each counted one in index space, which the core moves.
    const vtkIdType count = input->GetNumberOfPoints();
    const std::int64_t coordinates = this->Counted.Count() * D;
    this->Points = newArray<vtkDoubleArray>("Points", 3, count);
    withMemory({ purpose, static_cast<double>(coordinates) * sizeof(double) },
      [&]() { this->Index = LargeBuffer<double>(coordinates); });
    return readSeeds<D>(input, this->Counted, "input point set", this->Grid, progress,
      this->Relaxed(), { this->Points->GetPointer(0), count });
  }

  PointSpan<D> Relaxed() { return { this->Index.data(), this->Counted.Count() }; }

  // Points that are where they were keep their coordinates to the last bit.
  void Write(vtkPointSet* output, Progress& progress)
  {
    double* points = this->Points->GetPointer(0);
    const PointSpan<D> relaxed = this->Relaxed();
    progress.ForEach(relaxed.size(), seedGrain, [&](std::int64_t i) {
      double* x = points + 3 * this->Counted.Point(i);
      // The same conversion as in Read gives the same bits, so that a point that was not moved is
      // found by equality. To index space and back would change its last bits.
      double before[D];
      this->Grid.template ToIndex<D>(x, before);
      this->Grid.template ClampToDomain<D>(before);
      if (!std::equal(before, before + D, relaxed[i]))
      {
        this->Grid.template ToPhysical<D>(relaxed[i], x);
      }
    });
    // The output shares its cells and arrays with the input; only its points are new.
    vtkNew<vtkPoints> moved;
    moved->SetData(this->Points);
    output->SetPoints(moved);
  }

private:
  const ImageGrid& Grid;
  const NonGhostPoints& Counted;
  vtkSmartPointer<vtkDoubleArray> Points;
  LargeBuffer<double> Index;
};

// The lengths of a cell's sides in the longest of them: squares of the lengths may be no doubles,
// and only ratios matter.
template <int D>
Point<D> cellLengths(const ImageGrid& grid)
{
  // The relaxation measures distances in physical space, but works on index space.
  Point<D> lengths = grid.Lengths<D>();
  const GridSize<D> size = grid.Size<D>();
  for (std::size_t a = 0; a < D; ++a)
  {
    lengths[a] /= static_cast<double>(size[a]);
  }
  const double longest = *std::max_element(lengths.begin(), lengths.end());
  for (double& length : lengths)
  {
    length /= longest;
  }
  return lengths;
}

template <int D>
RelaxationReport relaxPoints(const BlueNoiseRelaxation& settings, const InputDensity& density,
  const SharedFlow* flow, PointSpan<D> points, const Context& context)
{
  const Point<D> spacing = cellLengths<D>(density.Grid());
  try
  {
    // Power diagrams exist here only in the plane; Run has refused them in 3D.
    if constexpr (D == 2)
    {
      if (settings.ByTransport)
      {
        return relaxByTransport(density.Source<2>(), spacing, points, settings.Options, context);
      }
    }
    return relaxByRepulsion<D>(
      density.Source<D>(), flow->Flow<D>(), spacing, points, settings.Options, context);
  }
  // The core knows values and indices; the input knows the names that a user recognizes.
  catch (const InvalidDensity& invalid)
  {
    density.ThrowInvalid(invalid.Summary());
  }
  catch (const NoEqualMasses&)
  {
    throw Failure("The " + density.GetName() + " has no cells of equal mass, as Method " +
      "OptimalTransport needs them, that were found for these " + std::to_string(points.size()) +
      " points: they are too far from distributed like it; start from Sample Density");
  }
}

template <int D>
BlueNoiseRelaxation::Report relax(const BlueNoiseRelaxation& settings, InputDensity& density,
  vtkPointSet* input, const NonGhostPoints& counted, FlowCache& cache, Progress& progress,
  vtkPointSet* output)
{
  const auto cells = static_cast<double>(density.Grid().NumberOfCells());
  const auto count = static_cast<double>(counted.Count());
  const double all = static_cast<double>(input->GetNumberOfPoints());
  Stages stages(progress,
    { { "tables", settings.ByTransport ? 0.0 : Cost::tables(cache, density) },
      { "density", Cost::Reading * cells }, { "points", Cost::Seed * all },
      { "relaxation", Cost::Relaxation * count * (settings.Options.MaximumIterations + 1.0) },
      { "output", Cost::Seed * count } });
  // All memory is asked for before tables are built, which may take long.
  const std::string purpose = "the relaxation of " + std::to_string(counted.Count()) +
    " points in " + std::to_string(density.Grid().NumberOfCells()) + " cells of the density";
  const double bytes = coreMemory(settings.ByTransport, D, cells, count);
  requireMemory({ purpose, bytes + sizeof(double) * (3.0 * all + D * count) });

  const SharedFlow* flow = nullptr;
  if (!settings.ByTransport)
  {
    flow = &cache.Update(density, stages["tables"]);
  }
  // Tables of another density would only take memory.
  else if (cache.IsOutdated(density))
  {
    cache.Release();
  }
  density.Prepare(FlowTables::Whole, stages["density"]);
  if (settings.ByTransport)
  {
    // A physical mass that is no double is an error here, too.
    massOf(density, stages["density"]);
  }
  PlacedPoints<D> points(density.Grid(), counted);
  BlueNoiseRelaxation::Report report;
  report.PointsMoved = points.Read(input, purpose, stages["points"]);
  // Ghosts alone: nothing moves, and there is no energy.
  if (counted.Count() > 0)
  {
    report.Correlation = correlateBlocks<D>(density.Source<D>(), points.Relaxed()).Value();
    withMemory({ purpose, bytes }, [&]() {
      report.Energy =
        relaxPoints<D>(settings, density, flow, points.Relaxed(), stages["relaxation"]).Energy;
    });
  }
  points.Write(output, stages["output"]);
  return report;
}

} // namespace

BlueNoiseRelaxation::Report BlueNoiseRelaxation::Run(InputDensity& density, vtkPointSet* input,
  const NonGhostPoints& counted, FlowCache& cache, Progress& progress, vtkPointSet* output) const
{
  const int dimension = density.Grid().Dimension();
  if (dimension == 1)
  {
    throw Failure("The density has 1 dimension; Relax Blue Noise needs 2 or 3");
  }
  if (this->ByTransport && dimension == 3)
  {
    throw Failure(
      "The density has 3 dimensions; Method OptimalTransport needs 2 (use GaussianBlueNoise)");
  }
  return dimension == 2 ? relax<2>(*this, density, input, counted, cache, progress, output)
                        : relax<3>(*this, density, input, counted, cache, progress, output);
}

} // namespace RectifiedTransport::Bridge
