// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/CutSurfaceMap.h"

#include "Core/Geometry/PointBounds.h"
#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/TriangleShape.h"
#include "Surfaces/Parameterization/LocalMap.h"
#include "Surfaces/Parameterization/SquareCorners.h"
#include "Surfaces/Parameterization/TutteEmbedding.h"
#include "Surfaces/Seams/SquareAtlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// The part of its square that is for a disk's surface: closed holes take some of it. A triangle
// alone is mapped to half of its square.
double partOf(const CutDisk& disk)
{
  return disk.Mesh ? 1.0 - disk.AreaShareOfHoles : 0.5;
}

// The area that a map covers of its square, without closed holes: 1 minus their images.
double coveredBy(const CutDisk& disk, const std::vector<Point<2>>& positions)
{
  double holes = 0.0;
  const std::int64_t end = disk.Mesh->NumberOfTriangles();
  for (std::int64_t triangle = end - disk.TrianglesOfHoles; triangle < end; ++triangle)
  {
    holes += imageArea(*disk.Mesh, positions, triangle);
  }
  return 1.0 - holes;
}

// Places a disk's map in its square of the atlas.
void put(const std::vector<Point<2>>& positions, const AtlasSquare& square, std::int64_t first,
  std::vector<Point<2>>& all)
{
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      all[static_cast<std::size_t>(first) + i][axis] =
        square.Low[axis] + square.Side * positions[i][axis];
    }
  }
}

// Disks of an atlas need fewer cells: with 4 sqrt(points) along an axis there are 16 a point.
// Beside the given resolution, this bounds the sum over disks by the number of points.
AreaPreservingOptions optionsFor(
  const CutDisk& disk, std::size_t disks, const AreaPreservingOptions& options)
{
  AreaPreservingOptions own = options;
  if (disks > 1)
  {
    constexpr double cells = 4.0;
    const double enough = std::ceil(cells * std::sqrt(static_cast<double>(disk.NumberOfPoints)));
    own.Resolution = std::min(options.Resolution, static_cast<std::int64_t>(enough));
  }
  return own;
}

// Maps a disk with seams, from the conformal map or an even embedding. Seams make long boundaries.
// Conformal maps squeeze the bays between them, in the worst cases beyond what the flow can mend.
class SeamedDiskMap
{
public:
  SeamedDiskMap(const CutDisk& disk, const AreaPreservingOptions& options)
    : Disk(*disk.Mesh)
    , Conformal(disk.Conformal->Square)
    , Options(options)
    , Collapsed(countCollapsed(this->Disk, this->Conformal.Corners))
  {
  }

  // Starts with the map that promises the better angles. If that does not reach the areas, tries
  // the other one, too, and keeps the one with fewer flips, then with the smaller deviation.
  AreaPreservingMap Find(const Context& context)
  {
    Progress progress(context);
    Stages stages(progress, { { "first map", 1 }, { "other map", 1 } });
    // Unevenness of conformal maps; below, an embedding gains no angles.
    constexpr double uneven = 1.3;
    const bool isUneven = areaDistortion(this->Disk, this->Conformal.Positions) >= uneven;
    AreaPreservingMap found = this->MapFrom(isUneven, stages["first map"]);
    constexpr double wrong = 0.05; // deviation of 95 % of the area, at which the filter warns
    if (this->FlipsOf(found) > 0 || found.Distortion.Area95 > wrong)
    {
      AreaPreservingMap other = this->MapFrom(!isUneven, stages["other map"]);
      if (std::make_pair(this->FlipsOf(other), other.Distortion.Area95) <
        std::make_pair(this->FlipsOf(found), found.Distortion.Area95))
      {
        found = std::move(other);
      }
    }
    progress.EndSlice(1);
    return found;
  }

private:
  // Flipped triangles that are not collapsed already by the choice of corners.
  std::int64_t FlipsOf(const AreaPreservingMap& map) const
  {
    return std::max<std::int64_t>(map.Distortion.Flipped - this->Collapsed, 0);
  }

  // The area-preserving flow begins with Tutte's embedding or with the conformal map.
  AreaPreservingMap MapFrom(bool embedding, Progress& progress)
  {
    if (!embedding)
    {
      return mapAreaPreserving(this->Disk, this->Conformal, this->Options, progress);
    }
    Stages stages(progress, { { "embedding", 1 }, { "map", 1 } });
    const SquareMap even = tutteEmbedding(this->Disk, this->Conformal, stages["embedding"]);
    return mapAreaPreserving(this->Disk, even, this->Options, stages["map"]);
  }

  const DiskMesh& Disk;
  const SquareMap& Conformal;
  const AreaPreservingOptions Options;
  const std::int64_t Collapsed;
};

// A disk that was not cut begins with the conformal map, as in the paper (Section 5.4).
AreaPreservingMap mapDisk(
  const CutDisk& disk, const AreaPreservingOptions& options, const Context& context)
{
  return disk.HasSeams ? SeamedDiskMap(disk, options).Find(context)
                       : mapAreaPreserving(*disk.Mesh, disk.Conformal->Square, options, context);
}

} // namespace

CutSurfaceMap mapCutSurface(
  const CutSurface& cut, const AreaPreservingOptions& options, const Context& context)
{
  const std::vector<CutDisk>& disks = cut.Disks();
  std::vector<double> areas;
  std::vector<double> points;
  for (const CutDisk& disk : disks)
  {
    // Squares have areas in proportion to area / part, so that each surface's share of the unit
    // square is in proportion to its area in space.
    areas.push_back(disk.Area / partOf(disk));
    points.push_back(static_cast<double>(disk.NumberOfPoints));
  }
  const std::vector<AtlasSquare> squares = arrangeSquares(areas);

  // Arrays are by points of the cut surface; each disk fills its own range of them.
  CutSurfaceMap map;
  map.Conformal.resize(static_cast<std::size_t>(cut.NumberOfPoints()));
  map.Positions.resize(map.Conformal.size());
  Progress progress(context);
  Parts parts(progress, points);
  for (std::size_t i = 0; i < disks.size(); ++i)
  {
    const CutDisk& disk = disks[i];
    const double square = squares[i].Side * squares[i].Side;
    if (!disk.Mesh)
    {
      map.Coverage += partOf(disk) * square;
      // Half of the square, for a triangle alone.
      const std::vector<Point<2>> half{ { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 } };
      put(half, squares[i], disk.FirstPoint, map.Conformal);
      put(half, squares[i], disk.FirstPoint, map.Positions);
      continue;
    }
    const SquareMap& conformal = disk.Conformal->Square;
    const AreaPreservingMap found =
      mapDisk(disk, optionsFor(disk, disks.size(), options), parts[static_cast<std::int64_t>(i)]);
    map.Coverage += coveredBy(disk, found.Positions) * square;
    put(conformal.Positions, squares[i], disk.FirstPoint, map.Conformal);
    put(found.Positions, squares[i], disk.FirstPoint, map.Positions);
    map.Collapsed += countCollapsed(*disk.Mesh, conformal.Corners);
  }
  return map;
}

CutTriangles::CutTriangles(const CutSurface& cut, const TriangleSurface& given)
  : Points(static_cast<std::size_t>(cut.NumberOfPoints()))
{
  double total = 0.0;
  const double largest = largestCoordinate(given.Points);
  // Repeated triangles lie on others and would count their area twice. They ascend, as the
  // triangles do.
  auto repeated = cut.Repeated().begin();
  for (std::int64_t triangle = 0; triangle < given.NumberOfTriangles; ++triangle)
  {
    if (repeated != cut.Repeated().end() && repeated->Triangle == triangle)
    {
      ++repeated;
      continue;
    }
    const std::int64_t* corners = cut.CornersOf(triangle);
    // Triangles without area are in no disk.
    if (std::min({ corners[0], corners[1], corners[2] }) < 0)
    {
      continue;
    }
    // In units of the largest coordinate, so that areas neither overflow nor vanish.
    std::array<Point<3>, 3> places;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::int64_t point = given.Triangles[3 * triangle + static_cast<int>(i)];
      places[i] = pointAt(given.Points, point) / largest;
    }
    // The area is length times height / 2.
    const TriangleShape shape(places[0], places[1], places[2]);
    const double area = 0.5 * shape.Length * shape.Height;
    if (!(area > 0.0))
    {
      continue;
    }
    std::array<std::int64_t, 3> ids{ corners[0], corners[1], corners[2] };
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->Points[static_cast<std::size_t>(ids[i])] = places[i];
    }
    // All triangles of a disk then turn alike, so that a negative image area is a flip.
    if (cut.IsTurned(triangle))
    {
      std::swap(ids[1], ids[2]);
    }
    this->Triangles.insert(this->Triangles.end(), ids.begin(), ids.end());
    this->Numbers.push_back(triangle);
    this->Shares.push_back(area);
    total += area;
  }
  // Shares of the area; the divisor `largest` of the coordinates cancels.
  for (double& share : this->Shares)
  {
    share /= total;
  }
}

MeasuredTriangles CutTriangles::Measured() const
{
  return { { this->Points, this->Triangles.data(),
             static_cast<std::int64_t>(this->Numbers.size()) },
    this->Shares.data() };
}

std::vector<Point<2>> scaledToUnitArea(const CutSurfaceMap& map)
{
  // Areas grow by 1 / Coverage, lengths by its root.
  const double scale = 1.0 / std::sqrt(map.Coverage);
  std::vector<Point<2>> scaled = map.Positions;
  for (Point<2>& position : scaled)
  {
    position = { scale * position[0], scale * position[1] };
  }
  return scaled;
}

} // namespace RectifiedTransport
