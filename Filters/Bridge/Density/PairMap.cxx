// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/PairMap.h"

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/Stages.h"

#include <cmath>

namespace RectifiedTransport::Bridge
{

template <int D>
PlacedDensity<D> placeDensity(
  const ImageGrid& box, const ImageGrid& grid, const DensitySource<D>& density)
{
  constexpr double rounding = 1e-9; // of the sides
  const LengthScale scale(box);
  const Point<D> lengths = box.Lengths<D>();
  const GridSize<D> cells = box.Size<D>();
  const GridSize<D> own = grid.Size<D>();
  Point<D> corner{};
  PlacedDensity<D> placed{ density, {}, {} };
  for (Point<D>* end : { &placed.Low, &placed.High })
  {
    double x[3];
    grid.ToPhysical<D>(corner.data(), x);
    box.ToIndex<D>(x, end->data());
    for (int axis = 0; axis < D; ++axis)
    {
      double part = (*end)[axis] / static_cast<double>(cells[axis]);
      part = std::abs(part) < rounding ? 0.0 : std::abs(part - 1.0) < rounding ? 1.0 : part;
      (*end)[axis] = part * scale.ToUnits(lengths[axis]);
      corner[axis] = static_cast<double>(own[axis]);
    }
  }
  return placed;
}

template <int D>
OptimalMemory memoryOfPair(const GridSize<D>& source, const GridSize<D>& target,
  const OptimalNeeds& needs, const Ranks& ranks)
{
  return OptimalMemory::Of<D>("between densities of " + describeSize<D>(source) + " and " +
      describeSize<D>(target) + " cells",
    source, target, needs, ranks);
}

template <int D>
std::unique_ptr<OptimalMap<D>> solvePair(const ImageGrid& box, const PlacedDensity<D>& source,
  InputDensity& target, const PairMapOptions& given, Progress& progress)
{
  OptimalMapOptions options;
  options.Tolerance = given.Optimal.Tolerance;
  options.LeastIterations = given.LeastIterations;
  options.RefineBound = given.RefinesBound;
  const OptimalMemory memory = memoryOfPair<D>(source.Source.Size, target.Grid().Size<D>(),
    { given.Optimal, given.Samples }, progress.Group());
  memory.Require();
  Stages stages(progress, { { "reading", 15 }, { "solution", 85 } });
  target.Prepare(FlowTables::Whole, stages["reading"]);
  return withMemory(memory.Purpose, memory.Bytes, [&]() {
    auto map = std::make_unique<OptimalMap<D>>(
      source, placeDensity<D>(box, target.Grid(), target.Source<D>()), options, stages["reading"]);
    target.ReleaseGathered();
    map->Solve(stages["solution"]);
    return map;
  });
}

template PlacedDensity<1> placeDensity<1>(
  const ImageGrid&, const ImageGrid&, const DensitySource<1>&);
template PlacedDensity<2> placeDensity<2>(
  const ImageGrid&, const ImageGrid&, const DensitySource<2>&);
template PlacedDensity<3> placeDensity<3>(
  const ImageGrid&, const ImageGrid&, const DensitySource<3>&);
template OptimalMemory memoryOfPair<1>(
  const GridSize<1>&, const GridSize<1>&, const OptimalNeeds&, const Ranks&);
template OptimalMemory memoryOfPair<2>(
  const GridSize<2>&, const GridSize<2>&, const OptimalNeeds&, const Ranks&);
template OptimalMemory memoryOfPair<3>(
  const GridSize<3>&, const GridSize<3>&, const OptimalNeeds&, const Ranks&);
template std::unique_ptr<OptimalMap<1>> solvePair<1>(
  const ImageGrid&, const PlacedDensity<1>&, InputDensity&, const PairMapOptions&, Progress&);
template std::unique_ptr<OptimalMap<2>> solvePair<2>(
  const ImageGrid&, const PlacedDensity<2>&, InputDensity&, const PairMapOptions&, Progress&);
template std::unique_ptr<OptimalMap<3>> solvePair<3>(
  const ImageGrid&, const PlacedDensity<3>&, InputDensity&, const PairMapOptions&, Progress&);

} // namespace RectifiedTransport::Bridge
