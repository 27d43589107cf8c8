// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/AllTriangles.h"

#include "Core/Geometry/CoincidentPoints.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/Repair/MergePoints.h"
#include "Surfaces/Mesh/Repair/TJunctions.h"
#include "Surfaces/Mesh/UnitScale.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Points or triangles in a range; it does not depend on the number of threads, so that sums over
// ranges do not, either.
constexpr std::int64_t wholeGrain = std::int64_t{ 1 } << 13;

} // namespace

// Ghost triangles and repeated ones are left out; what is left is scaled and measured. No triangle
// needs to be connected to another.
AllTriangles::AllTriangles(LargeBuffer<double> coordinates, LargeBuffer<std::int64_t> corners,
  const IsLeftOut& isLeftOut, Progress& progress)
  : Coordinates(std::move(coordinates))
  , Corners(std::move(corners))
  , Count(this->Corners.size() / 3)
{
  Stages stages(progress,
    { { "left out", 5 }, { "repeated triangles", 75 }, { "scale", 10 }, { "areas", 15 } });
  const std::int64_t all = this->Count;
  if (isLeftOut)
  {
    this->LeaveOut(isLeftOut, stages["left out"]);
    if (this->Count == 0)
    {
      throw std::invalid_argument("has only ghost cells: all " + std::to_string(all) +
        " triangles are duplicates, blanked or refined");
    }
  }
  this->LeaveOutRepeated(stages["repeated triangles"]);
  // Before scaling: the coordinates' own bits tell whether they are floats.
  const double rounding = roundingOfCorners(this->Surface(), stages["scale"]);
  this->ScalePoints(stages["scale"]);
  // In the unit of the scaled coordinates.
  this->RoundingOfPoints = rounding / this->Unit;
  this->FindAreas(stages["areas"]);
}

// Replaces coordinates by those from the centre of the bounds, in units of their longest side.
void AllTriangles::ScalePoints(Progress& progress)
{
  const std::int64_t count = this->Coordinates.size() / 3;
  double* coordinates = this->Coordinates.data();
  Eigen::AlignedBox3d bounds;
  progress.ForEachInOrder(count, wholeGrain,
    [&](std::int64_t i) { bounds.extend(Eigen::Map<const Eigen::Vector3d>(coordinates + 3 * i)); });
  const UnitScale scale(bounds);
  this->Unit = scale.Unit();
  progress.ForEach(count, wholeGrain, [=](std::int64_t i) {
    Eigen::Map<Eigen::Vector3d> point(coordinates + 3 * i);
    point = scale(point);
  });
}

// Moves the triangles that stay to the front of Corners, and notes their given numbers.
void AllTriangles::LeaveOut(const IsLeftOut& isLeftOut, Progress& progress)
{
  // The list of given numbers exists only if triangles are left out.
  if (this->GivenIds.size() == 0)
  {
    this->GivenIds = LargeBuffer<std::int64_t>(this->Count);
    std::iota(this->GivenIds.data(), this->GivenIds.data() + this->Count, std::int64_t{ 0 });
  }
  std::int64_t next = 0;
  progress.ForEachInOrder(this->Count, wholeGrain, [&](std::int64_t triangle) {
    if (!isLeftOut(triangle))
    {
      this->GivenIds.data()[next] = this->GivenIds.data()[triangle];
      std::copy_n(this->Corners.data() + 3 * triangle, 3, this->Corners.data() + 3 * next++);
    }
  });
  this->Count = next;
}

// Leaves out triangles with the places of one before. Points at one place count as one, as each
// face may have points of its own.
void AllTriangles::LeaveOutRepeated(Progress& progress)
{
  Stages stages(progress, { { "points", 1 }, { "search", 1 }, { "removal", 1 } });
  const TriangleSurface surface = this->Surface();
  LargeBuffer<std::int64_t> firsts(surface.Points.size());
  mergePoints<3>(surface.Points, firsts.data(), stages["points"]);
  LargeBuffer<std::int64_t> merged(3 * surface.NumberOfTriangles);
  std::transform(surface.Triangles, surface.Triangles + merged.size(), merged.data(),
    [&firsts](std::int64_t point) { return firsts.data()[point]; });
  const std::vector<RepeatedTriangle> repeated = findRepeatedTriangles(
    { surface.Points, merged.data(), surface.NumberOfTriangles }, stages["search"]);
  this->NumberOfRepeated = static_cast<std::int64_t>(repeated.size());
  if (!repeated.empty())
  {
    auto next = repeated.begin(); // they ascend
    this->LeaveOut(
      [&](std::int64_t triangle) {
        const bool isRepeated = next != repeated.end() && next->Triangle == triangle;
        next += isRepeated ? 1 : 0;
        return isRepeated;
      },
      stages["removal"]);
  }
}

// The areas in units of Unit^2, then as shares. The sum is over fixed chunks, so that it does not
// depend on the number of threads.
void AllTriangles::FindAreas(Progress& progress)
{
  const std::int64_t triangles = this->NumberOfTriangles();
  this->Shares = LargeBuffer<double>(triangles);
  double* areas = this->Shares.data();
  this->Area = reduceEach(
    progress, triangles, wholeGrain, 0.0,
    [&](std::int64_t triangle, double& sum) {
      const auto corner = [&](int i) {
        return Eigen::Map<const Eigen::Vector3d>(
          this->Coordinates.data() + 3 * this->Corners.data()[3 * triangle + i]);
      };
      // |b x c| / 2
      areas[triangle] = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
      sum += areas[triangle];
    },
    std::plus<>());
  // Single triangles without area stay; they get no samples.
  if (!(this->Area > 0.0))
  {
    throw std::invalid_argument("has no area: each of its " + std::to_string(triangles) +
      " triangles has corners at one place or on one line");
  }
  const double area = this->Area;
  progress.ForEach(triangles, wholeGrain, [=](std::int64_t triangle) { areas[triangle] /= area; });
}

} // namespace RectifiedTransport
