// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/SiteCellStatistics.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"

#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// How many pixels are summed before the host is asked.
constexpr std::int64_t sliceOfPixels = std::int64_t{ 1 } << 14;

// What is summed over the pixels of a cell. Their places are sums of halves: exact, however far
// from the cell its site is.
template <int D>
struct CellSum
{
  double Pixels = 0.0;
  double Index[D] = {};
  double Cost = 0.0;

  void Add(const CellSum& other)
  {
    this->Pixels += other.Pixels;
    this->Cost += other.Cost;
    for (int a = 0; a < D; ++a)
    {
      this->Index[a] += other.Index[a];
    }
  }
};

double squaredLength(const double* d)
{
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

// The largest component is taken out, so that no power of it passes the range of numbers.
double costOf(const double* d, const CostNorm& norm)
{
  const double largest = std::max({ std::abs(d[0]), std::abs(d[1]), std::abs(d[2]) });
  double length = largest;
  if (largest > 0.0 && !std::isinf(norm.Norm))
  {
    const double part[3] = { std::abs(d[0]) / largest, std::abs(d[1]) / largest,
      std::abs(d[2]) / largest };
    if (norm.Norm == 2.0)
    {
      length *= std::sqrt(squaredLength(part));
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

template <int D>
class CellSums
{
public:
  CellSums(vtkPointSet* sites, const ImageGrid& geometry, const std::int64_t* labels)
    : Geometry(geometry)
    , Size(geometry.Size<D>())
    , Labels(labels)
    , Sites(static_cast<std::size_t>(sites->GetNumberOfPoints()) * 3)
  {
    for (vtkIdType i = 0; i < sites->GetNumberOfPoints(); ++i)
    {
      sites->GetPoint(i, this->Sites.data() + 3 * i);
    }
  }

  // The sums of fixed chunks make the result the same for every executor. Their number keeps the
  // memory for them below that of the labels.
  std::vector<CellSum<D>> Run(const CostNorm& norm, Progress& progress) const
  {
    const auto sites = static_cast<std::int64_t>(this->Sites.size() / 3);
    const auto pixels = static_cast<std::int64_t>(numberOfCells<D>(this->Size));
    const std::int64_t chunks = std::clamp<std::int64_t>(pixels / (16 * sites), 1, 1024);
    const std::int64_t chunk = (pixels + chunks - 1) / chunks;
    std::vector<std::vector<CellSum<D>>> parts(static_cast<std::size_t>(chunks));
    for (auto& part : parts)
    {
      part.resize(static_cast<std::size_t>(sites));
    }
    const bool isSquare = norm.Norm == 2.0 && norm.Exponent == 2.0;
    progress.For(pixels, chunk, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t begin = first; begin < last; begin += chunk)
      {
        CellSum<D>* sums = parts[static_cast<std::size_t>(begin / chunk)].data();
        const std::int64_t end = std::min(begin + chunk, last);
        // With many sites there are few chunks, and long ones.
        for (std::int64_t slice = begin; slice < end && !progress.ShouldStop();
             slice += sliceOfPixels)
        {
          const std::int64_t sliceEnd = std::min(slice + sliceOfPixels, end);
          if (isSquare)
          {
            this->Sum(slice, sliceEnd, sums, squaredLength);
          }
          else
          {
            this->Sum(slice, sliceEnd, sums, [&norm](const double* d) { return costOf(d, norm); });
          }
        }
      }
    });
    std::vector<CellSum<D>> all(static_cast<std::size_t>(sites));
    for (const auto& part : parts)
    {
      for (std::size_t i = 0; i < all.size(); ++i)
      {
        all[i].Add(part[i]);
      }
    }
    return all;
  }

private:
  template <class Cost>
  void Sum(std::int64_t first, std::int64_t last, CellSum<D>* sums, const Cost& cost) const
  {
    double index[D];
    std::int64_t rest = first;
    for (int a = 0; a < D; ++a)
    {
      index[a] = static_cast<double>(rest % this->Size[a]) + 0.5;
      rest /= this->Size[a];
    }
    for (std::int64_t pixel = first; pixel < last; ++pixel)
    {
      double x[3];
      this->Geometry.template ToPhysical<D>(index, x);
      const std::int64_t label = this->Labels[pixel];
      const double* site = this->Sites.data() + 3 * label;
      const double d[3] = { x[0] - site[0], x[1] - site[1], x[2] - site[2] };
      CellSum<D>& sum = sums[label];
      sum.Pixels += 1.0;
      for (int a = 0; a < D; ++a)
      {
        sum.Index[a] += index[a];
      }
      sum.Cost += cost(d);
      for (int a = 0; a < D; ++a)
      {
        index[a] += 1.0;
        if (index[a] < static_cast<double>(this->Size[a]))
        {
          break;
        }
        index[a] = 0.5;
      }
    }
  }

  const ImageGrid& Geometry;
  const GridSize<D> Size;
  const std::int64_t* Labels;
  std::vector<double> Sites;
};

} // namespace

template <int D>
double writeSiteCellStatistics(vtkPointSet* sites, const SiteDensity<D>& grid,
  const ImageGrid& geometry, const SiteIdArray* labels, const CostNorm& norm, Progress& progress,
  vtkPointData* output)
{
  const vtkIdType count = sites->GetNumberOfPoints();
  auto masses = newArray<vtkDoubleArray>("CellMass", 1, count);
  auto centroids = newArray<vtkDoubleArray>("CellCentroid", 3, count);
  auto costs = newArray<vtkDoubleArray>("CellCost", 1, count);
  double* mass = masses->GetPointer(0);
  double* centroid = centroids->GetPointer(0);
  double* cost = costs->GetPointer(0);
  const double pixels = numberOfCells<D>(grid.Size());
  const std::string purpose = "the sums of the " + std::to_string(count) + " cells";
  const std::vector<CellSum<D>> sums =
    withMemory(purpose, static_cast<double>(count) * 2.0 * sizeof(CellSum<D>), [&]() {
      // Only GetPointer wants an array that is not const.
      auto* array = const_cast<SiteIdArray*>(labels);
      return CellSums<D>(sites, geometry, array->GetPointer(0)).Run(norm, progress);
    });

  double total = 0.0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const CellSum<D>& sum = sums[static_cast<std::size_t>(i)];
    double mean[D];
    for (int a = 0; a < D; ++a)
    {
      mean[a] = sum.Index[a] / sum.Pixels;
    }
    geometry.ToPhysical<D>(mean, centroid + 3 * i);
    cost[i] = sum.Cost / pixels;
    total += cost[i];
  }
  if (!std::isfinite(total))
  {
    throw Failure("The cost of CostExponent " + std::to_string(norm.Exponent) +
      " passes the largest double; it must be so low that distances to its power are finite");
  }
  if (!std::isfinite(pixels * geometry.CellMeasure()))
  {
    throw Failure("The domain's length, area or volume passes the largest double; scale the sites");
  }
  // The sites in one pixel share its cell's mass, to the last bit.
  for (std::int64_t k = 0; k < grid.NumberOfPixels(); ++k)
  {
    double shared = 0.0;
    for (std::int64_t i = 0; i < grid.SitesIn(k); ++i)
    {
      shared += sums[static_cast<std::size_t>(grid.Site(k, i))].Pixels;
    }
    const auto share = shared / static_cast<double>(grid.SitesIn(k)) * geometry.CellMeasure();
    for (std::int64_t i = 0; i < grid.SitesIn(k); ++i)
    {
      mass[grid.Site(k, i)] = share;
    }
  }
  output->AddArray(masses);
  output->AddArray(centroids);
  output->AddArray(costs);
  return total;
}

template double writeSiteCellStatistics<1>(vtkPointSet*, const SiteDensity<1>&, const ImageGrid&,
  const SiteIdArray*, const CostNorm&, Progress&, vtkPointData*);
template double writeSiteCellStatistics<2>(vtkPointSet*, const SiteDensity<2>&, const ImageGrid&,
  const SiteIdArray*, const CostNorm&, Progress&, vtkPointData*);
template double writeSiteCellStatistics<3>(vtkPointSet*, const SiteDensity<3>&, const ImageGrid&,
  const SiteIdArray*, const CostNorm&, Progress&, vtkPointData*);

} // namespace RectifiedTransport
