// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/MassCells.h"

#include "Core/Parallel/Progress.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

using Eigen::Vector3d;

// A position as a vector.
Vector3d pointAt(const CellReader& reader, std::int64_t point)
{
  Vector3d x;
  reader.GetPosition(point, x.data());
  return x;
}

// The points of a polyline that ends where it begins (the same point, or the same coordinates);
// else nullptr.
const CellReader::Ids* findClosedLine(CellReader& reader, std::int64_t cell)
{
  if (reader.ShapeOf(cell) != CellShape::PolyLine)
  {
    return nullptr;
  }
  const CellReader::Ids& points = reader.PointsOf(cell);
  // Some filters repeat the first point, others its number.
  const bool isClosed = points.size() > 2 &&
    (points.front() == points.back() ||
      pointAt(reader, points.front()) == pointAt(reader, points.back()));
  return isClosed ? &points : nullptr;
}

// Whether all points are near the line through the first one and the one farthest from it.
bool isStraight(const CellReader& reader, const CellReader::Ids& points)
{
  constexpr double straightness = 1e-5; // part of the line's length
  const Vector3d first = pointAt(reader, points.front());
  Vector3d farthest = Vector3d::Zero();
  for (const std::int64_t point : points)
  {
    const Vector3d x = pointAt(reader, point) - first;
    farthest = x.norm() > farthest.norm() ? x : farthest;
  }
  const double length = farthest.norm();
  double off = 0.0;
  for (std::size_t i = 1; i < points.size() && length > 0.0; ++i)
  {
    // The distance from the line: x minus its projection.
    const Vector3d x = pointAt(reader, points[i]) - first;
    off = std::max(off, (x - farthest * (x.dot(farthest) / (length * length))).norm());
  }
  return !(off > straightness * length);
}

// Whether a set has a closed line that is not straight, hence one with something inside.
bool hasRegion(const CellSet& cells, Progress& progress)
{
  constexpr std::int64_t cellsBetweenPolls = std::int64_t{ 1 } << 12;
  const auto reader = cells.Read();
  for (std::int64_t cell = 0; cell < cells.NumberOfCells; ++cell)
  {
    progress.CheckEvery(cellsBetweenPolls, cell);
    const CellReader::Ids* points = findClosedLine(*reader, cell);
    if (points && !isStraight(*reader, *points))
    {
      return true;
    }
  }
  return false;
}

} // namespace

bool MassCells::HasDimension(const CellReader& reader, std::int64_t cell) const
{
  return reader.DimensionOf(cell) == (this->AreClosedLines ? 1 : this->Dimension);
}

const CellReader::Ids* MassCells::Find(CellReader& reader, std::int64_t cell) const
{
  if (this->AreClosedLines)
  {
    return findClosedLine(reader, cell);
  }
  return this->HasDimension(reader, cell) ? &reader.PointsOf(cell) : nullptr;
}

// Regions have the dimension 2 although their cells are lines.
MassCells massCells(const CellSets& sets, int dimension, Progress& progress)
{
  const bool areRegions = dimension == 1 &&
    std::any_of(
      sets.begin(), sets.end(), [&](const auto& cells) { return hasRegion(*cells, progress); });
  return { areRegions ? 2 : dimension, areRegions };
}

} // namespace RectifiedTransport
