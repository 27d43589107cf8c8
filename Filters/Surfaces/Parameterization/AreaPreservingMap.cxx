// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/AreaPreservingMap.h"

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Parameterization/MapPolish.h"
#include "Surfaces/Parameterization/MassRaster.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

// The backward flow from the density of the surface's area in the square to the uniform one (paper,
// Section 5.4).
class AreaFlow
{
public:
  AreaFlow(const DiskMesh& disk, const SquareMap& square, std::int64_t resolution)
    : Disk(disk)
    , Square(square)
    , Resolution(resolution)
    , Masses(resolution * resolution)
  {
  }

  // Transports the area density to the uniform one, and the positions with it.
  void Run(std::vector<Point<2>>& positions, const Context& context)
  {
    Progress progress(context);
    const GridSize<2> size{ this->Resolution, this->Resolution };
    Stages stages(
      progress, { { "masses", 30 }, { "tables", 10 }, { "map", 55 }, { "positions", 5 } });
    // The density of a cell is the area of the surface that the conformal map puts there; the map
    // is linear on each triangle, so that a triangle's area is spread evenly over its image.
    rasterizeMass({ positions, this->Disk.Triangle(0), this->Disk.AreaShares(),
                    this->Disk.NumberOfTriangles() },
      size, this->Masses.data(), stages["masses"]);
    const DensityArray<2, double> density(this->Masses.data(), size);
    const RectifiedFlow<2> flow(density, stages["tables"]);
    // The flow works in index space: a cell has the width 1.
    const auto cells = static_cast<double>(this->Resolution);
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        const double position = positions[i][axis];
        positions[i][axis] =
          cells * (this->IsOnSide(i, axis) ? std::clamp(position, inside, 1.0 - inside) : position);
      }
    }
    // Conformal maps squeeze areas by factors of up to 10^5. With 256 steps the triangles' straight
    // edges limit what the flow reaches on most surfaces, no longer the integrator. Fewer would do
    // for the areas, but turn over more triangles where the surface is squeezed.
    FlowOptions options;
    options.LeastSteps = 256;
    options.Maps = FlowMaps::Off; // most of the time goes elsewhere
    flow.Backward(positions, positions, options, stages["map"]);
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        // A point on a side keeps that coordinate; only its place along the side changes.
        positions[i][axis] =
          this->IsOnSide(i, axis) ? this->Square.Positions[i][axis] : positions[i][axis] / cells;
      }
    }
    stages["positions"].EndSlice(1);
  }

private:
  // Points on the sides move along them as points this far inside do. The flow moves a point of the
  // distance e to a side by about sqrt(2 e) away from it, hence those on a side quite differently
  // from any neighbour, and triangles there would shear.
  static constexpr double inside = 1.0 / 512.0;

  bool IsOnSide(std::size_t point, std::size_t axis) const
  {
    return (this->Square.OnSides[point] >> axis & 1) != 0;
  }

  const DiskMesh& Disk;
  const SquareMap& Square;
  const std::int64_t Resolution;
  LargeBuffer<double> Masses; // shares of the surface's area by cells, axis 0 fastest
};

// An upper limit for surfaces that never reach the goal: most need 2 to 5 sweeps.
constexpr int mostSweeps = 24;
constexpr int sweepsBeforeFlips = 5; // up to which flips alone are a reason to go on
constexpr int sweepsBeforeFlow = 3;  // another flow may follow after every third sweep
constexpr int mostRings = 14;        // rings of triangles around flipped ones, in the last repair
constexpr double distant = 0.05; // deviation of 95 % of the area where a flow is better than sweeps

// The root mean square to be reached: small, and small beside what a conformal map has.
double targetFor(const MapDistortion& conformal)
{
  constexpr double largest = 0.02;
  constexpr double smallest = 5e-4; // below nothing is gained
  constexpr double uneven = 0.6;
  const double part = conformal.AreaRootMeanSquare < uneven ? 1.0 / 12.0 : 1.0 / 24.0;
  return std::clamp(part * conformal.AreaRootMeanSquare, smallest, largest);
}

// The goals for the median deviation and for 95 % of the area are those of the header.
bool isNear(const MapDistortion& distortion, double goal)
{
  return distortion.AreaMedian < 0.01 && distortion.Area95 < 0.03 &&
    distortion.AreaRootMeanSquare < goal;
}

} // namespace

AreaPreservingMap mapAreaPreserving(const DiskMesh& disk, const SquareMap& conformal,
  const AreaPreservingOptions& options, const Context& context)
{
  if (options.Resolution < 1 || options.Resolution > AreaPreservingOptions::MaximumResolution)
  {
    throw std::invalid_argument("Resolution is " + std::to_string(options.Resolution) +
      "; it must be from 1 to " + std::to_string(AreaPreservingOptions::MaximumResolution));
  }
  Progress progress(context);
  AreaPreservingMap map;
  map.Positions = conformal.Positions;
  const auto measure = [&](Progress& stage) {
    map.Distortion = measureDistortion(disk, map.Positions, stage);
  };
  Stages stages(progress,
    { { "distortion", 2 }, { "flow", 39 }, { "distortion of flow", 1 },
      { "sweeps", options.Polish ? 49.0 : 0.0 }, { "flips", options.Polish ? 9.0 : 0.0 } });
  measure(stages["distortion"]);
  // Collapsed triangles miss their whole share s: their deviation |0 - 1| alone makes the root mean
  // square sqrt(sum of s), which no sweep can undercut.
  const CollapsedTriangles collapsed = findCollapsed(disk, conformal);
  const double goal = std::hypot(targetFor(map.Distortion), std::sqrt(collapsed.AreaShare));
  AreaFlow flow(disk, conformal, options.Resolution);
  const bool isKept = isNear(map.Distortion, goal) && map.Distortion.Flipped <= collapsed.Count;
  if (!options.Polish || !isKept) // the integrator's error may be larger than what there is to mend
  {
    flow.Run(map.Positions, stages["flow"]);
    ++map.Flows;
    measure(stages["distortion of flow"]);
  }
  if (options.Polish)
  {
    const MapParts parts(disk, conformal);
    const auto isDone = [&]() {
      return isNear(map.Distortion, goal) &&
        (map.Distortion.Flipped <= collapsed.Count || map.Sweeps >= sweepsBeforeFlips);
    };
    Rounds sweeps(stages["sweeps"], 2);
    for (; map.Sweeps < mostSweeps && !isDone(); ++map.Sweeps)
    {
      // Sweeps move points within regions. Mass that is missing far away needs a global flow.
      const bool flows =
        map.Sweeps > 0 && map.Sweeps % sweepsBeforeFlow == 0 && map.Distortion.Area95 > distant;
      Stages sweep(
        sweeps.Next(), { { "flow", flows ? 15.0 : 0.0 }, { "polish", 15 }, { "distortion", 1 } });
      if (flows)
      {
        flow.Run(map.Positions, sweep["flow"]);
        ++map.Flows;
      }
      polishAreas(parts, map.Sweeps, map.Positions, sweep["polish"]);
      measure(sweep["distortion"]);
    }
    Rounds repairs(stages["flips"], 1);
    // Larger patches are tried only while flips are left: they distort more of the map.
    for (int rings = 2; rings <= mostRings && map.Distortion.Flipped > collapsed.Count; ++rings)
    {
      Stages repair(repairs.Next(), { { "flips", 10 }, { "distortion", 1 } });
      repairFlips(parts, rings, map.Positions, repair["flips"]);
      measure(repair["distortion"]);
    }
  }
  progress.EndSlice(1);
  return map;
}

} // namespace RectifiedTransport
