// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/DistortionPeaks.h"

#include "Core/Parallel/KeySort.h"
#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/DisjointSets.h"
#include "Surfaces/Parameterization/LocalMap.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// Above this, rounding decides how large the image of a triangle is.
constexpr double largest = 1e10;

// Persistence of the peaks of a density: points enter from high to low, and join the regions of
// neighbours that are in. Where two regions meet, at a pass, the one with the lower peak ends (the
// elder rule). Regions are trees of union-find whose root is the peak.
class PeakSearch
{
public:
  PeakSearch(const DiskMesh& disk, const std::vector<Point<2>>& positions, Progress& progress)
    : Disk(disk)
    , Run(progress)
    , Triangles(disk)
    , Areas(static_cast<std::size_t>(disk.NumberOfPoints()), 0.0)
    , Densities(static_cast<std::size_t>(disk.NumberOfPoints()), 0.0)
    , Regions(static_cast<std::size_t>(disk.NumberOfPoints()), -1)
  {
    // The density of a point is its share of the surface by its share of the square, each a
    // third of those of its triangles.
    std::vector<double> images(this->Areas.size(), 0.0);
    for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
    {
      const std::int64_t* ids = disk.Triangle(t);
      const double image = std::max(0.0, imageArea(disk, positions, t));
      for (int i = 0; i < 3; ++i)
      {
        images[static_cast<std::size_t>(ids[i])] += image / 3.0;
        this->Areas[static_cast<std::size_t>(ids[i])] += disk.AreaShare(t) / 3.0;
      }
    }
    for (std::size_t point = 0; point < images.size(); ++point)
    {
      this->Densities[point] =
        this->Areas[point] / std::max(images[point], this->Areas[point] / largest);
    }
    // Seams grow to inner points: the boundary is open already.
    for (const std::int64_t point : disk.Boundary())
    {
      this->Densities[static_cast<std::size_t>(point)] = 0.0;
    }
  }

  // Only points that are squeezed enough enter, so that the areas of regions are those that are
  // squeezed about a peak. Equal keys keep the order of the points: peaks do not depend on anything
  // else.
  std::vector<DistortionPeak> Find(const PeakLimits& limits)
  {
    this->Run.Check();
    std::vector<DistortionPeak> points;
    for (std::size_t point = 0; point < this->Densities.size(); ++point)
    {
      if (this->Densities[point] >= limits.Squeeze)
      {
        points.push_back({ -this->Densities[point], static_cast<std::int64_t>(point), 0.0 });
      }
    }
    sortByKey(points, this->Run);
    std::vector<DistortionPeak> found;
    for (const DistortionPeak& next : points)
    {
      this->Enter(next.Point, limits, found);
      this->Run.Add(1);
    }
    for (const DistortionPeak& peak : points) // what no higher one has ended
    {
      if (this->Regions[static_cast<std::size_t>(peak.Point)] == peak.Point)
      {
        this->End(peak.Point, 0.0, limits, found);
      }
    }
    // The worst, with the least key, first.
    sortByKey(found, this->Run);
    return found;
  }

private:
  double DensityAt(std::int64_t point) const
  {
    return this->Densities[static_cast<std::size_t>(point)];
  }
  double& AreaOf(std::int64_t peak) { return this->Areas[static_cast<std::size_t>(peak)]; }

  // Lets a point enter. A region is the tree of its peak, which is higher than all others in it;
  // equal densities are decided by number.
  void Enter(std::int64_t point, const PeakLimits& limits, std::vector<DistortionPeak>& found)
  {
    std::int64_t* regions = this->Regions.data();
    regions[point] = point;
    this->Triangles.VisitCorners(point, [&](std::int64_t neighbour) {
      if (regions[neighbour] < 0)
      {
        return;
      }
      std::int64_t high = rootOf(regions, neighbour);
      std::int64_t low = rootOf(regions, point);
      if (high == low)
      {
        return;
      }
      if (this->DensityAt(high) < this->DensityAt(low) ||
        (this->DensityAt(high) == this->DensityAt(low) && low < high))
      {
        std::swap(high, low);
      }
      // A region of the point alone is no peak that ends: it has just joined.
      if (low != point)
      {
        this->End(low, this->DensityAt(point), limits, found);
      }
      regions[low] = high;
      this->AreaOf(high) += this->AreaOf(low);
    });
  }

  // Reports a peak whose region ends at a pass of some density, if it is prominent (peak / pass)
  // and enough of the surface is about it.
  void End(
    std::int64_t peak, double pass, const PeakLimits& limits, std::vector<DistortionPeak>& found)
  {
    // A region that no higher one has ended has the pass 0, and is prominent.
    const double density = this->DensityAt(peak);
    if (density >= limits.Prominence * pass && this->AreaOf(peak) >= limits.AreaShare)
    {
      found.push_back({ -density, peak, this->AreaOf(peak) });
    }
  }

  const DiskMesh& Disk;
  Progress& Run;
  const PointTriangles Triangles;
  std::vector<double> Areas;         // shares of points, and then of the regions of peaks
  std::vector<double> Densities;     // by points; 0 on the boundary
  std::vector<std::int64_t> Regions; // trees; -1 for points that are not entered
};

} // namespace

std::vector<DistortionPeak> findDistortionPeaks(const DiskMesh& disk,
  const std::vector<Point<2>>& positions, const PeakLimits& limits, const Context& context)
{
  Progress progress(context);
  progress.Expect(disk.NumberOfPoints());
  return PeakSearch(disk, positions, progress).Find(limits);
}

} // namespace RectifiedTransport
