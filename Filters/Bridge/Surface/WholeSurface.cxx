// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/WholeSurface.h"

#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonInput.h"
#include "Core/Mesh/MergePoints.h"
#include "Core/Mesh/TJunctions.h"
#include "Core/Mesh/UnitScale.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Parallel/Stages.h"

#include "vtkDataObject.h"
#include "vtkPolyData.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

} // namespace

WholeSurface::WholeSurface(vtkPolyData* input, Progress& progress)
{
  Stages stages(progress,
    { { "points", 20 }, { "triangles", 40 }, { "corners", 20 }, { "repeated triangles", 15 },
      { "scale", 2 }, { "areas", 3 } });
  this->Coordinates = readSurfacePoints(input, "it must be a surface", stages["points"]);
  this->Cells.emplace(input, stages["triangles"]);
  const std::int64_t triangles = this->Cells->NumberOfTriangles();
  withMemory("the surface's " + std::to_string(triangles) + " triangles",
    static_cast<double>(triangles) * 80.0 + static_cast<double>(this->Coordinates.size()) * 16.0,
    [&]() {
      this->Corners = this->Cells->Corners(stages["corners"]);
      this->LeaveOutGhosts(input, stages["corners"]);
      this->LeaveOutRepeated(stages["repeated triangles"]);
      const double rounding = roundingOfCorners(this->Surface(), stages["scale"]);
      this->ScalePoints(stages["scale"]);
      this->RoundingOfPoints = rounding / this->Unit;
      this->FindAreas(stages["areas"]);
    });
}

TriangleSurface WholeSurface::Surface() const
{
  return { { this->Coordinates.data(), this->Coordinates.size() / 3 }, this->Corners.data(),
    this->NumberOfTriangles() };
}

void WholeSurface::ScalePoints(Progress& progress)
{
  const std::int64_t count = this->Coordinates.size() / 3;
  double* coordinates = this->Coordinates.data();
  Eigen::AlignedBox3d bounds;
  progress.ForInOrder(count, Grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      bounds.extend(Eigen::Map<const Eigen::Vector3d>(coordinates + 3 * i));
    }
  });
  const UnitScale scale(bounds);
  this->Unit = scale.Unit();
  progress.For(count, Grain, [=](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      Eigen::Map<Eigen::Vector3d> point(coordinates + 3 * i);
      point = scale(point);
    }
  });
}

template <class IsLeftOut>
void WholeSurface::LeaveOut(const IsLeftOut& isLeftOut, Progress& progress)
{
  const std::int64_t all = this->NumberOfTriangles();
  const auto kept = reduceChunks(
    progress, all, Grain, std::int64_t{ 0 },
    [&](std::int64_t first, std::int64_t last) {
      std::int64_t count = 0;
      for (std::int64_t triangle = first; triangle < last; ++triangle)
      {
        count += isLeftOut(triangle) ? 0 : 1;
      }
      return count;
    },
    std::plus<>());
  if (kept == all)
  {
    return;
  }
  LargeBuffer<std::int64_t> given(kept);
  LargeBuffer<std::int64_t> corners(3 * kept);
  std::int64_t next = 0;
  progress.ForInOrder(all, Grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t triangle = first; triangle < last; ++triangle)
    {
      if (!isLeftOut(triangle))
      {
        given.data()[next] = this->Given(triangle);
        std::copy_n(this->Corners.data() + 3 * triangle, 3, corners.data() + 3 * next);
        ++next;
      }
    }
  });
  this->Kept = std::move(given);
  this->Corners = std::move(corners);
}

void WholeSurface::LeaveOutGhosts(vtkPolyData* input, Progress& progress)
{
  const unsigned char* ghosts = ghostFlags(input, vtkDataObject::CELL, "input surface");
  if (!ghosts)
  {
    return;
  }
  const std::int64_t all = this->NumberOfTriangles();
  this->LeaveOut(
    [&](std::int64_t triangle) {
      return (ghosts[this->Cells->InputCellOf(triangle)] & ghostCell) != 0;
    },
    progress);
  if (this->NumberOfTriangles() == 0)
  {
    throw Failure("The input surface has only ghost cells: all " + std::to_string(all) +
      " triangles are duplicates, blanked or refined");
  }
}

// Points at one place are one.
void WholeSurface::LeaveOutRepeated(Progress& progress)
{
  Stages stages(progress, { { "points", 1 }, { "search", 1 }, { "removal", 1 } });
  const TriangleSurface surface = this->Surface();
  LargeBuffer<std::int64_t> firsts(surface.Points.size());
  mergePoints(surface.Points, firsts.data(), stages["points"]);
  LargeBuffer<std::int64_t> merged(3 * surface.NumberOfTriangles);
  std::transform(surface.Triangles, surface.Triangles + merged.size(), merged.data(),
    [&firsts](std::int64_t point) { return firsts.data()[point]; });
  const std::vector<RepeatedTriangle> repeated = findRepeatedTriangles(
    { surface.Points, merged.data(), surface.NumberOfTriangles }, stages["search"]);
  this->NumberOfRepeated = static_cast<std::int64_t>(repeated.size());
  this->LeaveOut(
    [&repeated](std::int64_t triangle) {
      return std::binary_search(repeated.begin(), repeated.end(), RepeatedTriangle{ triangle, -1 },
        [](const auto& a, const auto& b) { return a.Triangle < b.Triangle; });
    },
    stages["removal"]);
}

void WholeSurface::FindAreas(Progress& progress)
{
  const std::int64_t triangles = this->NumberOfTriangles();
  this->Shares = LargeBuffer<double>(triangles);
  double* areas = this->Shares.data();
  this->Area = reduceChunks(
    progress, triangles, Grain, 0.0,
    [&](std::int64_t first, std::int64_t last) {
      double sum = 0.0;
      for (std::int64_t triangle = first; triangle < last; ++triangle)
      {
        const auto corner = [&](int i) {
          return Eigen::Map<const Eigen::Vector3d>(
            this->Coordinates.data() + 3 * this->Corners.data()[3 * triangle + i]);
        };
        areas[triangle] = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
        sum += areas[triangle];
      }
      return sum;
    },
    std::plus<>());
  if (!(this->Area > 0.0))
  {
    throw Failure("The input surface has no area: each of its " + std::to_string(triangles) +
      " triangles has corners at one place or on one line");
  }
  const double area = this->Area;
  progress.For(triangles, Grain, [=](std::int64_t first, std::int64_t last) {
    for (std::int64_t triangle = first; triangle < last; ++triangle)
    {
      areas[triangle] /= area;
    }
  });
}

} // namespace RectifiedTransport::Bridge
