// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parameterization/AreaPreservingMap.h"

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parameterization/AreaPolish.h"
#include "Core/Parameterization/FlipRepair.h"
#include "Core/Parameterization/MassRaster.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t maximumResolution = 1 << 14;
constexpr std::int64_t grain = std::int64_t{ 1 } << 14;

// A side of the square and the masses of the cells along it. The flow's limit there moves points
// along the side, by the transport of these masses to the uniform one: that is the mass before
// them.
class SideMasses
{
public:
  SideMasses(const double* masses, std::int64_t count, std::int64_t stride)
    : Before(static_cast<std::size_t>(count) + 1, 0.0)
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->Before[static_cast<std::size_t>(i) + 1] =
        this->Before[static_cast<std::size_t>(i)] + masses[i * stride];
    }
  }

  double ShareBefore(double x) const
  {
    const double total = this->Before.back();
    if (!(total > 0.0))
    {
      return x;
    }
    const auto count = static_cast<double>(this->Before.size() - 1);
    const double cell = std::min(std::floor(x * count), count - 1.0);
    const double low = this->Before[static_cast<std::size_t>(cell)];
    const double high = this->Before[static_cast<std::size_t>(cell) + 1];
    return std::clamp((low + (high - low) * (x * count - cell)) / total, 0.0, 1.0);
  }

private:
  std::vector<double> Before; // the sums of the masses below each cell, and of all
};

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
    progress.BeginStage(0.3);
    rasterizeMass({ positions, this->Disk.Triangle(0), this->Disk.AreaShares(),
                    this->Disk.NumberOfTriangles() },
      size, this->Masses.data(), progress.Stage());
    const std::vector<Point<2>> onSides = this->MovedAlongSides(positions);

    progress.BeginStage(0.4);
    const DensityArray<2, double> density(this->Masses.data(), size);
    const RectifiedFlow<2> flow(density, progress.Stage());
    progress.BeginStage(0.95);
    const auto cells = static_cast<double>(this->Resolution);
    for (Point<2>& position : positions)
    {
      position = { position[0] * cells, position[1] * cells };
    }
    // Conformal maps squeeze areas by factors of up to 10^5, where 32 steps are not enough: with
    // 256 no longer the integrator but the triangles' straight edges limit what the flow reaches.
    FlowOptions options;
    options.NumberOfSteps = 256;
    flow.Backward(positions, positions, options, progress.Stage());
    progress.BeginStage(1.0);
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      positions[i] = this->Square.OnSides[i] != 0
        ? onSides[i]
        : Point<2>{ positions[i][0] / cells, positions[i][1] / cells };
    }
    progress.EndSlice(1);
  }

private:
  std::vector<Point<2>> MovedAlongSides(std::vector<Point<2>> positions) const
  {
    const std::int64_t n = this->Resolution;
    const double* masses = this->Masses.data();
    const SideMasses lower(masses, n, 1);
    const SideMasses upper(masses + (n - 1) * n, n, 1);
    const SideMasses left(masses, n, n);
    const SideMasses right(masses + n - 1, n, n);
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      Point<2>& position = positions[i];
      switch (this->Square.OnSides[i])
      {
        case 1:
          position[1] = (position[0] == 0.0 ? left : right).ShareBefore(position[1]);
          break;
        case 2:
          position[0] = (position[1] == 0.0 ? lower : upper).ShareBefore(position[0]);
          break;
        default:
          break;
      }
    }
    return positions;
  }

  const DiskMesh& Disk;
  const SquareMap& Square;
  const std::int64_t Resolution;
  LargeBuffer<double> Masses;
};

constexpr int mostSweeps = 24;
constexpr int sweepsBeforeFlips = 5; // that flips alone are a reason for
constexpr int sweepsBeforeFlow = 3;
constexpr double far = 0.05; // of 95 % of the area: the flow is better at it than sweeps

// The root mean square to be reached: small, and small beside what a conformal map has.
double goalFor(const MapDistortion& conformal)
{
  constexpr double largest = 0.02;
  constexpr double smallest = 5e-4; // below nothing is gained
  constexpr double uneven = 0.6;
  const double part = conformal.AreaRootMeanSquare < uneven ? 1.0 / 12.0 : 1.0 / 24.0;
  return std::clamp(part * conformal.AreaRootMeanSquare, smallest, largest);
}

bool isNear(const MapDistortion& distortion, double goal)
{
  return distortion.AreaMedian < 0.01 && distortion.Area95 < 0.03 &&
    distortion.AreaRootMeanSquare < goal;
}

} // namespace

AreaPreservingMap mapAreaPreserving(const DiskMesh& disk, const SquareMap& conformal,
  const AreaPreservingOptions& options, const Context& context)
{
  if (options.Resolution < 1 || options.Resolution > maximumResolution)
  {
    throw std::invalid_argument("Resolution is " + std::to_string(options.Resolution) +
      "; it must be from 1 to " + std::to_string(maximumResolution));
  }
  Progress progress(context);
  AreaPreservingMap map;
  map.Positions = conformal.Positions;
  const auto measure = [&]() {
    map.Distortion = measureDistortion(disk, map.Positions, progress.Stage());
  };
  // How far the progress is after a part of what is left of it: how many sweeps there will be is
  // not known.
  const auto beginNext = [&progress](double part) {
    progress.BeginStage(progress.StageEnd() + part * (1.0 - progress.StageEnd()));
  };

  beginNext(0.02);
  measure();
  const double goal = goalFor(map.Distortion);
  AreaFlow flow(disk, conformal, options.Resolution);
  beginNext(0.4);
  flow.Run(map.Positions, progress.Stage());
  beginNext(0.02);
  measure();
  if (options.Polish)
  {
    const MapParts parts(disk, conformal);
    const auto isDone = [&]() {
      return isNear(map.Distortion, goal) &&
        (map.Distortion.Flipped == 0 || map.Sweeps >= sweepsBeforeFlips);
    };
    for (; map.Sweeps < mostSweeps && !isDone(); ++map.Sweeps)
    {
      if (map.Sweeps > 0 && map.Sweeps % sweepsBeforeFlow == 0 && map.Distortion.Area95 > far)
      {
        beginNext(0.3);
        flow.Run(map.Positions, progress.Stage());
        ++map.Flows;
      }
      beginNext(0.3);
      polishAreas(parts, map.Sweeps, map.Positions, progress.Stage());
      beginNext(0.02);
      measure();
    }
    for (int rings = 2; rings <= 14 && map.Distortion.Flipped > 0; ++rings)
    {
      beginNext(0.5);
      repairFlips(parts, rings, map.Positions, progress.Stage());
      beginNext(0.1);
      measure();
    }
  }
  progress.BeginStage(1.0);
  progress.EndSlice(1);
  return map;
}

} // namespace RectifiedTransport
