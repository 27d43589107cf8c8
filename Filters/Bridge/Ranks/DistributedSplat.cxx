// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/DistributedSplat.h"

#include "Bridge/Data/DoubleTuples.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Core/Splat/RankSplat.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"

#include <cmath>
#include <sstream>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

// The points of this rank.
template <class Real>
struct OwnPoints
{
  ConstPointSpan<3, Real> Points;
  const double* Masses;
  double MassEach;
  const std::int64_t* Order;
};

// Densities are masses divided by the measure of a cell. On several ranks points go to the ranks of
// their cells and are added in a common order (Order), so that sums do not depend on the number of
// ranks.
template <int D, class Real>
std::int64_t splatIn(const OwnPoints<Real>& own, const SplatTarget& target, const TupleBox& wanted,
  Progress& progress, double* cells)
{
  const ImageGrid& geometry = target.Geometry;
  const GridSize<D> size = geometry.Size<D>();
  const SplatParticles<D, Real> particles{ own.Points, own.Masses, own.MassEach,
    geometry.ToIndexMap<D>() };
  const auto count = static_cast<double>(own.Points.size());
  if (progress.Group().AreSeveral())
  {
    return withMemory(
      { "the exchange of " + std::to_string(own.Points.size()) + " points", 100.0 * count }, [&]() {
        return splatOnRanks<D, Real>(particles, own.Order, size, latticePartOf<D>(wanted, geometry),
          target.Options, 1.0 / target.CellMeasure(), cells, progress);
      });
  }
  return withMemory({ "putting the points in order", 8.0 * count }, [&]() {
    return splatMass<D, Real>(
      particles, size, target.Options, 1.0 / target.CellMeasure(), cells, progress)
      .Outside;
  });
}

template <class Real>
std::int64_t splat(const OwnPoints<Real>& own, const SplatTarget& target, const TupleBox& wanted,
  Progress& progress, double* cells)
{
  return dispatchDimension(target.Geometry.Dimension(), splatIn<1, Real>, splatIn<2, Real>,
    splatIn<3, Real>)(own, target, wanted, progress, cells);
}

} // namespace

void requireFiniteDensity(
  double mass, const SplatTarget& target, const char* what, const char* rule)
{
  const double measure = target.CellMeasure();
  if (!std::isfinite(1.0 / measure) || !std::isfinite(mass / measure))
  {
    std::ostringstream message;
    message << what << " of " << mass
            << " in all make densities past the largest double in cells of " << measure
            << "; make the masses smaller, " << rule;
    throw Failure(message.str());
  }
}

std::int64_t splatDistributed(vtkDataArray* points, const double* masses, double massEach,
  const std::int64_t* order, const SplatTarget& target, const TupleBox& wanted, Progress& progress,
  vtkDoubleArray* cells)
{
  const vtkIdType count = points->GetNumberOfTuples();
  auto* single = vtkAOSDataArrayTemplate<float>::FastDownCast(points);
  const bool areSingle = onAllRanks(progress.Group(), single || count == 0);
  Stages stages(progress, { { "points", areSingle ? 0.0 : 5.0 }, { "splat", 95 } });
  if (areSingle)
  {
    return splat<float>(
      { { single ? single->GetPointer(0) : nullptr, count }, masses, massEach, order }, target,
      wanted, stages["splat"], cells->GetPointer(0));
  }
  const DoubleTuples doubles(points, stages["points"]);
  return splat<double>({ { doubles.data(), count }, masses, massEach, order }, target, wanted,
    stages["splat"], cells->GetPointer(0));
}

std::int64_t splatDistributed(ConstPointSpan<3> points, const double* masses,
  const std::int64_t* order, const SplatTarget& target, const TupleBox& wanted, Progress& progress,
  vtkDoubleArray* cells)
{
  return splat<double>(
    { points, masses, 0.0, order }, target, wanted, progress, cells->GetPointer(0));
}

} // namespace RectifiedTransport::Bridge
