// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/CutOpenComponent.h"

#include "Core/Parallel/KeySort.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/DisjointSets.h"
#include "Surfaces/Mesh/TriangleShape.h"
#include "Surfaces/Parameterization/LocalMap.h"
#include "Surfaces/Parameterization/SquareCorners.h"
#include "Surfaces/Parameterization/TutteEmbedding.h"
#include "Surfaces/Seams/CutGraph.h"
#include "Surfaces/Seams/HoleFans.h"
#include "Surfaces/Seams/SeamSearch.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

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

// The measure by which maps are compared: the root mean square of log(area change), and 1 for each
// collapsed triangle.
double distortionSum(const DiskMesh& disk, const ConformalMap& map)
{
  // A triangle without area in the map is worse than any seam.
  return areaDistortion(disk, map.Square.Positions) +
    static_cast<double>(countCollapsed(disk, map.Square.Corners));
}

class ComponentCutting
{
public:
  ComponentCutting(SeamMesh& mesh, std::int64_t given)
    : Mesh(mesh)
    , NumberOfGiven(given)
  {
  }

  // Opens the component and maps it conformally. Then lets seams grow and maps again, at most
  // `rounds` times, and keeps the most even of all the maps.
  CutOpenDisk Open(int rounds, Progress& progress)
  {
    constexpr std::int64_t disk = 1; // Euler characteristic, also of the projective plane
    if (this->Mesh.EulerCharacteristic() == disk && !this->Mesh.IsClosed())
    {
      return this->OpenDisk(progress);
    }
    Stages stages(progress,
      { { "seams", 20 }, { "map", 22 }, { "extensions", rounds > 0 ? 42.0 : 0.0 },
        { "corners", 16 } });
    openToDisk(this->Mesh, stages["seams"]);
    shortenSeams(this->Mesh, stages["seams"]);
    // Only the last and the best disk are in memory.
    auto last = std::make_shared<CutOpenDisk>(this->Make(stages["map"]));
    std::shared_ptr<CutOpenDisk> best = last;
    Rounds extensions(stages["extensions"], 2);
    for (int round = 0; round < rounds; ++round)
    {
      Stages extension(extensions.Next(), { { "seams", 1 }, { "map", 3 } });
      if (!this->Extend(*last, extension["seams"]))
      {
        break;
      }
      last = std::make_shared<CutOpenDisk>(this->Make(extension["map"]));
      best = last->Distortion < best->Distortion ? last : best;
    }
    last.reset();
    best->Disk.HasSeams = true;
    this->TurnCorners(*best, stages["corners"]);
    return std::move(*best);
  }

private:
  // A disk needs no seams, except if its boundary has three points: a square has four corners. A
  // seam to an inner point gives the boundary two more. A triangle alone gets no mesh.
  CutOpenDisk OpenDisk(Progress& progress)
  {
    if (this->Mesh.NumberOfTriangles() > 1)
    {
      if (this->HasThreePointsOnBoundary())
      {
        this->JoinInnerPoint(progress);
      }
      return this->Make(progress);
    }
    SeamMesh::Cut cut = this->Mesh.MakeCut(progress);
    const auto at = [&](std::size_t i) { return this->Mesh.Position(cut.Origins[i]); };
    const TriangleShape shape(at(0), at(1), at(2));
    return { { {}, {}, 0, 3, 0.5 * shape.Length * shape.Height }, std::move(cut), 0.0 };
  }

  // The triangles cut along the current seams, with a conformal map.
  CutOpenDisk Make(Progress& progress)
  {
    SeamMesh::Cut cut = this->Mesh.MakeCut(progress);
    progress.Check();
    const auto points = static_cast<std::int64_t>(cut.Origins.size());
    LargeBuffer<double> places(3 * points);
    for (std::int64_t i = 0; i < points; ++i)
    {
      const Point<3>& place = this->Mesh.Position(cut.Origins[static_cast<std::size_t>(i)]);
      std::copy(place.begin(), place.end(), places.data() + 3 * i);
    }
    progress.Check();
    Stages stages(progress, { { "mesh", 1 }, { "map", 2 } });
    CutDisk disk{ {}, {}, 0, points, 0.0 };
    const TriangleSurface surface{ { places.data(), points }, cut.Triangles.data(),
      this->Mesh.NumberOfTriangles() };
    disk.Mesh.emplace(surface, stages["mesh"]);
    // The mesh has its own unit of length; areas are compared between disks in that of the
    // component.
    disk.Area = disk.Mesh->Area() * disk.Mesh->Unit() * disk.Mesh->Unit();
    // Triangles that close holes count neither for the area nor, beyond their fixed share, for the
    // map.
    if (this->NumberOfGiven < this->Mesh.NumberOfTriangles())
    {
      const double* shares = disk.Mesh->AreaShares();
      disk.Area *= std::accumulate(shares, shares + this->NumberOfGiven, 0.0);
      disk.TrianglesOfHoles = this->Mesh.NumberOfTriangles() - this->NumberOfGiven;
      disk.AreaShareOfHoles = HoleFans::AreaShare;
      disk.Mesh->SetShareFrom(this->NumberOfGiven, disk.AreaShareOfHoles);
    }
    disk.Conformal = mapConformally(*disk.Mesh, chooseCorners(*disk.Mesh), stages["map"]);
    const double distortion = distortionSum(*disk.Mesh, *disk.Conformal);
    progress.Check();
    return { std::move(disk), std::move(cut), distortion };
  }

  // Lets seams grow to where the map squeezes areas: a seam to the tip of a limb opens it. Returns
  // whether one grows.
  bool Extend(const CutOpenDisk& opened, Progress& progress)
  {
    // Where seams meet they enclose small angles, which the sides of the square straighten. That
    // also squeezes areas, and seams there would not help. Hence a new seam must be at least half
    // as long as the side of a square with the area that is squeezed.
    constexpr double least = 0.5;
    Stages stages(progress, { { "squeezed points", 1 }, { "seams", 1 } });
    const std::vector<DistortionPeak> tips = findDistortionPeaks(*opened.Disk.Mesh,
      opened.Disk.Conformal->Square.Positions, PeakLimits(), stages["squeezed points"]);
    SeamSearch search(this->Mesh, stages["seams"]);
    bool isLonger = false;
    for (const DistortionPeak& tip : tips)
    {
      const std::int64_t point = opened.Cut.Origins[static_cast<std::size_t>(tip.Point)];
      const double length = least * std::sqrt(tip.AreaShare * opened.Disk.Area);
      isLonger = joinToSeams(this->Mesh, search, point, length) || isLonger;
    }
    return isLonger;
  }

  // Tries the corners 1/16, 2/16 and 3/16 of the boundary farther on; a quarter is where the
  // corners began. Each try costs a conformal map, so that larger disks keep their corners.
  void TurnCorners(CutOpenDisk& opened, Progress& progress)
  {
    constexpr std::int64_t mostPoints = std::int64_t{ 1 } << 17;
    const DiskMesh& disk = *opened.Disk.Mesh;
    if (disk.NumberOfPoints() > mostPoints)
    {
      return;
    }
    const SquareCorners corners = opened.Disk.Conformal->Square.Corners;
    constexpr int turns = 3;
    Parts parts(progress, turns);
    for (int turn = 0; turn < turns; ++turn)
    {
      const SquareCorners turned = turnCorners(disk, corners, (turn + 1) / 16.0);
      if (turned == corners)
      {
        continue;
      }
      ConformalMap map = mapConformally(disk, turned, parts[turn]);
      const double distortion = distortionSum(disk, map);
      progress.Check();
      if (distortion < opened.Distortion)
      {
        opened.Distortion = distortion;
        opened.Disk.Conformal = std::move(map);
      }
    }
  }

  // Counts no further than 4.
  bool HasThreePointsOnBoundary() const
  {
    int count = 0;
    for (std::int64_t point = 0; point < this->Mesh.NumberOfPoints() && count <= 3; ++point)
    {
      count += this->Mesh.IsOnSeam(point) ? 1 : 0;
    }
    return count == 3;
  }

  // A seam from any inner point to the boundary; its edge there becomes two sides of the cut.
  void JoinInnerPoint(Progress& progress)
  {
    std::int64_t inner = 0;
    while (this->Mesh.IsOnSeam(inner))
    {
      ++inner;
    }
    SeamSearch search(this->Mesh, progress);
    joinToSeams(this->Mesh, search, inner);
  }

  SeamMesh& Mesh;
  const std::int64_t NumberOfGiven;
};

} // namespace

std::vector<DistortionPeak> findDistortionPeaks(const DiskMesh& disk,
  const std::vector<Point<2>>& positions, const PeakLimits& limits, const Context& context)
{
  Progress progress(context);
  progress.Expect(disk.NumberOfPoints());
  return PeakSearch(disk, positions, progress).Find(limits);
}

CutOpenDisk cutComponent(SeamMesh& mesh, std::int64_t given, int rounds, Progress& progress)
{
  return ComponentCutting(mesh, given).Open(rounds, progress);
}

} // namespace RectifiedTransport
