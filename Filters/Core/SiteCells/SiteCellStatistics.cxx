// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/SiteCellStatistics.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Pixels that are summed between two polls for cancellation.
constexpr std::int64_t sliceOfPixels = std::int64_t{ 1 } << 14;

// Sums over the pixels of a site cell. If all pixels have the weight 1, Index sums half-integers,
// which is exact, however far the site is from the cell.
template <int Dimension>
struct CellSum
{
  double Weight = 0.0; // number or mass of the pixels
  double Index[Dimension] = {};
  double Cost = 0.0;

  void Add(const CellSum& other)
  {
    this->Weight += other.Weight;
    this->Cost += other.Cost;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Index[axis] += other.Index[axis];
    }
  }
};

// Returns |d|^2, the usual cost, without a power.
double squaredNorm(const double* d)
{
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

// Returns |d|_p^q. The largest component is factored out, so that powers of the others do not
// overflow.
double costOf(const double* d, const CostNorm& norm)
{
  // With p infinite, this component is the norm itself.
  const double largest = std::max({ std::abs(d[0]), std::abs(d[1]), std::abs(d[2]) });
  double length = largest;
  if (largest > 0.0 && !std::isinf(norm.Norm))
  {
    const double part[3] = { std::abs(d[0]) / largest, std::abs(d[1]) / largest,
      std::abs(d[2]) / largest };
    if (norm.Norm == 2.0)
    {
      length *= std::sqrt(squaredNorm(part));
    }
    else
    {
      double sum = 0.0;
      for (const double x : part)
      {
        sum += std::pow(x, norm.Norm);
      }
      length *= std::pow(sum, 1.0 / norm.Norm);
    }
  }
  return std::pow(length, norm.Exponent);
}

// Adds the pixels [first, last) with their weights.
template <int Dimension, class Weight, class Cost>
void addPixels(const ImageGrid& grid, const std::int64_t* labels, ConstPointSpan<3> sites,
  const Weight& weightOf, const Cost& cost, std::int64_t first, std::int64_t last,
  CellSum<Dimension>* sums)
{
  const GridSize<Dimension> size = grid.Size<Dimension>();
  // The centre of the first pixel in index space; later ones follow by increments, without
  // divisions.
  double index[Dimension];
  std::int64_t rest = first;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    index[axis] = static_cast<double>(rest % size[axis]) + 0.5;
    rest /= size[axis];
  }
  for (std::int64_t pixel = first; pixel < last; ++pixel)
  {
    const std::int64_t label = labels[pixel];
    if (label >= 0)
    {
      // Costs are of physical distances.
      double x[3];
      grid.ToPhysical<Dimension>(index, x);
      const double* site = sites[label];
      const double d[3] = { x[0] - site[0], x[1] - site[1], x[2] - site[2] };
      CellSum<Dimension>& sum = sums[label];
      // The sums are the mass, the first moments in index space, and the cost.
      const double weight = weightOf(pixel);
      sum.Weight += weight;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        sum.Index[axis] += weight * index[axis];
      }
      sum.Cost += weight * cost(d);
    }
    for (int axis = 0; axis < Dimension; ++axis)
    {
      index[axis] += 1.0;
      if (index[axis] < static_cast<double>(size[axis]))
      {
        break;
      }
      index[axis] = 0.5;
    }
  }
}

// Sums over the pixels of each site cell. The sums of fixed chunks, added in their order, make the
// result the same for every executor. The number of chunks keeps their memory below that of the
// labels.
template <int Dimension, class Weight>
std::vector<CellSum<Dimension>> sumCells(const ImageGrid& grid, const std::int64_t* labels,
  ConstPointSpan<3> sites, const Weight& weightOf, const CostNorm& norm, Progress& progress)
{
  const std::int64_t pixels = grid.NumberOfCells();
  const std::int64_t chunks = std::clamp<std::int64_t>(pixels / (16 * sites.size()), 1, 1024);
  const std::int64_t chunk = (pixels + chunks - 1) / chunks;
  using Sums = std::vector<CellSum<Dimension>>;
  // A sum for each site in each chunk.
  std::vector<Sums> parts(
    static_cast<std::size_t>(chunks), Sums(static_cast<std::size_t>(sites.size())));
  // The usual cost has a loop of its own, without calls to pow().
  const bool isSquare = norm.Norm == 2.0 && norm.Exponent == 2.0;
  progress.For(pixels, chunk, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t begin = first; begin < last; begin += chunk)
    {
      CellSum<Dimension>* sums = parts[static_cast<std::size_t>(begin / chunk)].data();
      const std::int64_t end = std::min(begin + chunk, last);
      // With many sites there are few, long chunks, which are cut into slices for cancellation.
      for (std::int64_t slice = begin; slice < end && !progress.ShouldStop();
           slice += sliceOfPixels)
      {
        const std::int64_t sliceEnd = std::min(slice + sliceOfPixels, end);
        const auto add = [&](const auto& cost) {
          addPixels<Dimension>(grid, labels, sites, weightOf, cost, slice, sliceEnd, sums);
        };
        isSquare ? add(squaredNorm) : add([&norm](const double* d) { return costOf(d, norm); });
      }
    }
  });
  // Chunks are added in their order.
  Sums all(static_cast<std::size_t>(sites.size()));
  for (const Sums& part : parts)
  {
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i].Add(part[i]);
    }
  }
  return all;
}

// Throws if the cost is not finite, for example because the exponent is too large for the
// distances.
void requireCost(double cost, const CostNorm& norm)
{
  if (!std::isfinite(cost))
  {
    throw std::overflow_error("The cost of CostExponent " + std::to_string(norm.Exponent) +
      " passes the largest double; it must be so low that distances to its power are finite");
  }
}

} // namespace

// All pixels weigh the same. Every site has at least one, so that its mean exists.
template <int Dimension>
double measureSiteCells(const SiteCells<Dimension>& cells, const std::int64_t* labels,
  const CostNorm& norm, const SiteCellStatistics& statistics, const Context& context)
{
  Progress progress(context);
  const std::vector<CellSum<Dimension>> sums = sumCells<Dimension>(
    cells.Grid(), labels, cells.Sites(), [](std::int64_t) { return 1.0; }, norm, progress);
  const SiteDensity<Dimension>& shared = cells.Pixels();
  const double pixels = numberOfCells<Dimension>(shared.Size());
  // The cost is a mean over all pixels, so each site has its sum divided by their number.
  double total = 0.0;
  for (std::int64_t i = 0; i < cells.NumberOfSites(); ++i)
  {
    const CellSum<Dimension>& sum = sums[static_cast<std::size_t>(i)];
    double mean[Dimension];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      mean[axis] = sum.Index[axis] / sum.Weight;
    }
    cells.Grid().template ToPhysical<Dimension>(mean, statistics.Centroid[i]);
    statistics.Cost[i] = sum.Cost / pixels;
    total += statistics.Cost[i];
  }
  requireCost(total, norm);
  // Areas of the cells; sites in one pixel share their pixels equally.
  const double measure = cells.Grid().CellMeasure();
  if (!std::isfinite(pixels * measure))
  {
    throw std::overflow_error(
      "The domain's length, area or volume passes the largest double; scale the sites");
  }
  // Sites in one pixel share the mass of their cells equally, to the last bit.
  for (std::int64_t k = 0; k < shared.NumberOfPixels(); ++k)
  {
    double all = 0.0;
    for (std::int64_t i = 0; i < shared.SitesIn(k); ++i)
    {
      all += sums[static_cast<std::size_t>(shared.Site(k, i))].Weight;
    }
    const double share = all / static_cast<double>(shared.SitesIn(k)) * measure;
    for (std::int64_t i = 0; i < shared.SitesIn(k); ++i)
    {
      statistics.Mass[shared.Site(k, i)] = share;
    }
  }
  return total;
}

// Pixels weigh as much as their part of the mass; those without mass have the label -1.
template <int Dimension>
double measureSiteCells(const DensitySiteCells<Dimension>& cells, const std::int64_t* labels,
  double totalMass, const CostNorm& norm, const SiteCellStatistics& statistics,
  const Context& context)
{
  Progress progress(context);
  const PixelMasses<Dimension>& masses = cells.Masses();
  const auto weightOf = [&masses](std::int64_t pixel) {
    return static_cast<double>(masses[pixel]) / static_cast<double>(masses.Total());
  };
  const std::vector<CellSum<Dimension>> sums =
    sumCells<Dimension>(cells.Grid(), labels, cells.Sites(), weightOf, norm, progress);
  // Weights are shares of the mass, so that their sums are masses and costs already.
  double total = 0.0;
  for (std::int64_t i = 0; i < cells.NumberOfSites(); ++i)
  {
    const CellSum<Dimension>& sum = sums[static_cast<std::size_t>(i)];
    double mean[Dimension];
    // A site cell without mass has no centroid; its site takes the place of it.
    std::copy_n(cells.IndexSites()[i], Dimension, mean);
    for (int axis = 0; axis < Dimension && sum.Weight > 0.0; ++axis)
    {
      mean[axis] = sum.Index[axis] / sum.Weight;
    }
    cells.Grid().template ToPhysical<Dimension>(mean, statistics.Centroid[i]);
    statistics.Mass[i] = sum.Weight * totalMass;
    statistics.Cost[i] = sum.Cost;
    total += sum.Cost;
  }
  requireCost(total, norm);
  return total;
}

template double measureSiteCells<1>(const SiteCells<1>&, const std::int64_t*, const CostNorm&,
  const SiteCellStatistics&, const Context&);
template double measureSiteCells<2>(const SiteCells<2>&, const std::int64_t*, const CostNorm&,
  const SiteCellStatistics&, const Context&);
template double measureSiteCells<3>(const SiteCells<3>&, const std::int64_t*, const CostNorm&,
  const SiteCellStatistics&, const Context&);
template double measureSiteCells<1>(const DensitySiteCells<1>&, const std::int64_t*, double,
  const CostNorm&, const SiteCellStatistics&, const Context&);
template double measureSiteCells<2>(const DensitySiteCells<2>&, const std::int64_t*, double,
  const CostNorm&, const SiteCellStatistics&, const Context&);
template double measureSiteCells<3>(const DensitySiteCells<3>&, const std::int64_t*, double,
  const CostNorm&, const SiteCellStatistics&, const Context&);

} // namespace RectifiedTransport
