// SPDX-License-Identifier: BSD-3-Clause
// How good a cartogram is, measured on its own polygons.
#ifndef RectifiedTransport_MapMeasures_h
#define RectifiedTransport_MapMeasures_h

#include "Core/Cartogram/RegionMap.h"
#include "Core/Overlap/RegionOutlines.h"
#include "Core/Overlap/RingCrossings.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

class MapMeasures
{
public:
  // `after` has the regions of `before`.
  MapMeasures(const RegionMap& before, const RegionMap& after, const std::vector<double>& masses)
    : Work(Context(SerialExecutor()))
  {
    this->TakeErrors(after, masses);
    this->CrossingBefore = this->Crossing(before);
    this->CrossingAfter = this->Crossing(after);
    this->Overlap = this->OverlapOf(after);
    this->TakeShapes(before, after);
  }

  // Of the regions' shares of the area, relative.
  double LargestError = 0.0;
  double MeanError = 0.0;
  // Rings that cross or touch themselves.
  std::int64_t CrossingBefore = 0;
  std::int64_t CrossingAfter = 0;
  double Overlap = 0.0; // of polygons, by their area
  // The mean of half of the areas that are in one of a region before and after alone, both of area
  // 1 and with one centroid.
  double Shape = 0.0;
  // The mean angle by which directions between centroids turn, in degrees.
  double Turn = 0.0;

private:
  void TakeErrors(const RegionMap& map, const std::vector<double>& masses)
  {
    const std::vector<double> areas = map.Areas(static_cast<std::int32_t>(masses.size()));
    const double perMass = std::accumulate(areas.begin(), areas.end(), 0.0) /
      std::accumulate(masses.begin(), masses.end(), 0.0);
    for (std::size_t i = 0; i < masses.size(); ++i)
    {
      const double error = std::abs(areas[i] / (masses[i] * perMass) - 1.0);
      this->LargestError = std::max(this->LargestError, error);
      this->MeanError += error / static_cast<double>(masses.size());
    }
  }

  static std::vector<Point<2>> PointsOf(const RegionMap& map, std::int64_t ring)
  {
    std::vector<Point<2>> points;
    for (std::int64_t i = 0; i < map.CountOf(ring); ++i)
    {
      const Point<2>& place = map.Points()[static_cast<std::size_t>(map.CornerOf(ring, i))];
      if (points.empty() || place != points.back())
      {
        points.push_back(place);
      }
    }
    while (points.size() > 1 && points.back() == points.front())
    {
      points.pop_back();
    }
    return points;
  }

  static void Add(const std::vector<Point<2>>& points, Rings& rings)
  {
    for (const Point<2>& point : points)
    {
      rings.Add(point);
    }
    rings.EndRing();
  }

  std::int64_t Crossing(const RegionMap& map)
  {
    std::int64_t crossing = 0;
    for (std::int64_t ring = 0; ring < map.Rings(); ++ring)
    {
      std::vector<Point<2>> points = PointsOf(map, ring);
      Rings alone;
      Add(points, alone);
      std::sort(points.begin(), points.end());
      const bool touches = std::adjacent_find(points.begin(), points.end()) != points.end();
      crossing += touches || haveCrossings(alone, this->Work) ? 1 : 0;
    }
    return crossing;
  }

  // What an odd number of the rings encloses.
  RegionSize SizeOf(const Rings& rings)
  {
    const std::vector<double> alike(static_cast<std::size_t>(rings.Count()), 1.0);
    const std::vector<OutlineEdge> edges = regionOutlines(rings, alike, this->Work);
    return sizeOfRegion(edges.data(), edges.data() + edges.size());
  }

  double OverlapOf(const RegionMap& map)
  {
    Rings all;
    double sum = 0.0;
    for (std::int64_t ring = 0; ring < map.Rings(); ++ring)
    {
      const std::vector<Point<2>> points = PointsOf(map, ring);
      Rings alone;
      Add(points, alone);
      Add(points, all);
      const double area = this->SizeOf(alone).Area;
      sum += map.IsHole(ring) ? -area : area;
    }
    // What two polygons cover counts twice in the sum, and not at all in what is covered oddly.
    return 0.5 * std::abs(sum - this->SizeOf(all).Area) / sum;
  }

  // Appends a region's rings, with area 1 about its centroid.
  Point<2> AddUnit(const RegionMap& map, const std::vector<std::int64_t>& numbers, Rings& both)
  {
    Rings own;
    for (const std::int64_t ring : numbers)
    {
      Add(PointsOf(map, ring), own);
    }
    const RegionSize size = this->SizeOf(own);
    const double scale = 1.0 / std::sqrt(size.Area);
    for (const std::int64_t ring : numbers)
    {
      std::vector<Point<2>> points = PointsOf(map, ring);
      for (Point<2>& point : points)
      {
        point = { scale * (point[0] - size.Centroid[0]), scale * (point[1] - size.Centroid[1]) };
      }
      Add(points, both);
    }
    return size.Centroid;
  }

  void TakeShapes(const RegionMap& before, const RegionMap& after)
  {
    const auto ringsBefore = before.RingsOfRegions();
    const auto ringsAfter = after.RingsOfRegions();
    std::vector<Point<2>> centresBefore;
    std::vector<Point<2>> centresAfter;
    const auto regions = static_cast<double>(ringsBefore.size());
    for (std::size_t i = 0; i < ringsBefore.size(); ++i)
    {
      Rings both;
      centresBefore.push_back(this->AddUnit(before, ringsBefore[i], both));
      centresAfter.push_back(this->AddUnit(after, ringsAfter[i], both));
      this->Shape += 0.5 * this->SizeOf(both).Area / regions;
    }
    const double degrees = 45.0 / std::atan(1.0);
    for (std::size_t i = 0; i < centresBefore.size(); ++i)
    {
      for (std::size_t k = 0; k < i; ++k)
      {
        const Point<2> a{ centresBefore[i][0] - centresBefore[k][0],
          centresBefore[i][1] - centresBefore[k][1] };
        const Point<2> b{ centresAfter[i][0] - centresAfter[k][0],
          centresAfter[i][1] - centresAfter[k][1] };
        const double turn = std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
        this->Turn += degrees * std::abs(turn) / (0.5 * regions * (regions - 1.0));
      }
    }
  }

  Progress Work;
};

} // namespace RectifiedTransport

#endif
