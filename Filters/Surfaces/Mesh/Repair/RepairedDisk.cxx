// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/Repair/RepairedDisk.h"

#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/Stages.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Merging cannot help where it only joins more. It helps with edges of more than two triangles if
// some of these are repeated.
bool mayMerge(const NotADisk& defect)
{
  switch (defect.Defect())
  {
    case DiskDefect::PointsNotFinite:
    case DiskDefect::NoTriangles:
    case DiskDefect::Closed:
      return false;
    default:
      return true;
  }
}

// The error of a repaired surface in the numbers of the given one.
NotADisk inGivenNumbers(const NotADisk& defect, const RepairedSurface& repaired)
{
  // -1: the defect has no number.
  const std::int64_t first = defect.First();
  if (first < 0)
  {
    return defect;
  }
  const bool isTriangle = defect.Defect() == DiskDefect::TrianglesWithoutArea;
  return { defect.Defect(), defect.Count(),
    isTriangle ? repaired.GivenTriangle(first) : repaired.FirstGivenPoint(first) };
}

} // namespace

// Attempts with growing changes: without merging points, then with it, each with the rounding of
// double first. A closed surface gets no better with a larger rounding.
RepairedDisk::RepairedDisk(const TriangleSurface& surface, double rounding, const Context& context)
  : NumberOfPoints(surface.Points.size())
{
  Progress progress(context);
  if (surface.NumberOfTriangles == 0 || !areFinite(surface.Points))
  {
    this->Disk.emplace(surface, progress); // throws
    return;
  }
  // The first attempt repairs what rounding in double made.
  const double least = roundingOfDoubles(surface.Points);
  const double most = std::max(least, rounding);
  Rounds rounds(progress, 1);
  // Each attempt is a round of the progress, as their number is not known in advance.
  const auto isDisk = [&](const SurfaceRepairOptions& options) {
    return this->Try(surface, options, rounds.Next());
  };
  const auto isDiskWith = [&](bool merges) {
    return isDisk({ least, merges }) ||
      (most > least && this->Defect->Defect() != DiskDefect::Closed && isDisk({ most, merges }));
  };
  if (isDiskWith(false))
  {
    // Where a filter has dropped triangles without area, as vtkTriangleFilter does, there are
    // cracks between points at one place. A cut that makes the surface a disk stays open.
    if (this->Repairs().FlatTriangles > 0)
    {
      // The disk without merging is the result if merging makes no disk.
      std::optional<RepairedSurface> repaired = std::move(this->Repaired);
      std::optional<DiskMesh> disk = std::move(this->Disk);
      if (!isDiskWith(true))
      {
        this->Repaired = std::move(repaired);
        this->Disk = std::move(disk);
      }
    }
    return;
  }
  const NotADisk apart = *this->Defect;
  if (mayMerge(apart) && isDiskWith(true))
  {
    return;
  }
  // If there are several components, the user should know what is wrong once they are joined.
  throw apart.Defect() == DiskDefect::Components ? *this->Defect : apart;
}

// The given surface is tried as it is, if it needs no repair; this saves the copy.
bool RepairedDisk::Try(
  const TriangleSurface& surface, const SurfaceRepairOptions& options, const Context& context)
{
  Progress progress(context);
  Stages stages(progress, { { "check", 1 }, { "given", 3 }, { "repair", 2 }, { "repaired", 4 } });
  if (!options.MergesEqualPoints && !needsRepair(surface, options.Rounding, stages["check"]))
  {
    if (this->TryAs(surface, {}, stages["given"]))
    {
      return true;
    }
    // Repeated triangles make such edges, too: a repair drops them.
    if (this->Defect->Defect() != DiskDefect::NonManifoldEdges)
    {
      return false;
    }
  }
  std::optional<RepairedSurface> made = repairSurface(surface, options, stages["repair"]);
  return this->TryAs(surface, std::move(made), stages["repaired"]);
}

// An empty `repaired` says that the given surface is tried. The error of a failed attempt is kept
// in Defect, in the numbers of given points and triangles, because the user knows only these.
bool RepairedDisk::TryAs(
  const TriangleSurface& surface, std::optional<RepairedSurface> repaired, const Context& context)
{
  this->Repaired = std::move(repaired);
  const bool hasTriangles = !this->Repaired || this->Repaired->Surface().NumberOfTriangles > 0;
  try
  {
    if (!hasTriangles)
    {
      throw NotADisk(DiskDefect::TrianglesWithoutArea, surface.NumberOfTriangles, 0);
    }
    this->Disk.emplace(this->Repaired ? this->Repaired->Surface() : surface, context);
    return true;
  }
  catch (const NotADisk& defect)
  {
    this->Defect.emplace(
      this->Repaired && hasTriangles ? inGivenNumbers(defect, *this->Repaired) : defect);
    return false;
  }
}

std::array<std::int64_t, 3> RepairedDisk::GivenCorners(std::int64_t triangle) const
{
  const std::int64_t* corners =
    this->Repaired ? this->Repaired->Corners(triangle) : this->Disk->Triangle(triangle);
  return { corners[0], corners[1], corners[2] };
}

// The shares are relative to the disk's area: a given triangle has its own area, although parts of
// it may have been moved by flips.
GivenTriangles::GivenTriangles(const RepairedDisk& disk, const std::int64_t* given)
  : Points(disk.Mesh().Surface().Points)
{
  const auto at = [this](std::int64_t point) {
    return Eigen::Map<const Eigen::Vector3d>(this->Points[point]);
  };
  const auto normalOf = [&at](const std::int64_t* ids) -> Eigen::Vector3d {
    return (at(ids[1]) - at(ids[0])).cross(at(ids[2]) - at(ids[0]));
  };
  std::int64_t last = -1;
  for (std::int64_t triangle = 0; triangle < disk.Mesh().NumberOfTriangles(); ++triangle)
  {
    last = std::max(last, disk.GivenTriangle(triangle));
  }
  // A given triangle that was cut into parts is written once, with its own corners.
  std::vector<unsigned char> isDone(static_cast<std::size_t>(last + 1), 0);
  for (std::int64_t triangle = 0; triangle < disk.Mesh().NumberOfTriangles(); ++triangle)
  {
    const std::int64_t number = disk.GivenTriangle(triangle);
    std::array<std::int64_t, 3> ids;
    for (std::size_t i = 0; i < 3; ++i)
    {
      ids[i] = disk.PointOf(given[3 * number + static_cast<std::int64_t>(i)]);
    }
    const bool isKept = *std::min_element(ids.begin(), ids.end()) >= 0;
    if (std::exchange(isDone[static_cast<std::size_t>(number)], 1) != 0 || !isKept)
    {
      continue;
    }
    const Eigen::Vector3d normal = normalOf(ids.data());
    const double share = 0.5 * normal.norm() / disk.Mesh().Area();
    if (share > 0.0)
    {
      // Turned as in the disk.
      if (normal.dot(normalOf(disk.Mesh().Triangle(triangle))) < 0.0)
      {
        std::swap(ids[1], ids[2]);
      }
      this->Triangles.insert(this->Triangles.end(), ids.begin(), ids.end());
      this->Numbers.push_back(number);
      this->Shares.push_back(share);
    }
  }
}

TriangleSurface GivenTriangles::Surface() const
{
  return { this->Points, this->Triangles.data(), static_cast<std::int64_t>(this->Numbers.size()) };
}

} // namespace RectifiedTransport
