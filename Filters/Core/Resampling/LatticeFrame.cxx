// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/LatticeFrame.h"

#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Resampling/CellFrame.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

namespace
{

using Eigen::Vector3d;

// Chunks of cells have this size for any number of threads, so that sums have the same bits.
constexpr std::int64_t frameGrain = std::int64_t{ 1 } << 12;

// The edges of a cell from its first corner, in lengths.
using Edges = std::array<Vector3d, 3>;

Edges noEdges()
{
  return { Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero() };
}

Edges edgesOf(const BoxCorners& corners, int dimension)
{
  Edges edges = noEdges();
  for (int a = 0; a < dimension; ++a)
  {
    // Corner 2^a is at the other end of edge a.
    edges[static_cast<std::size_t>(a)] = corners[1 << a] - corners[0];
  }
  return edges;
}

// The mean of parallel edges over all cells has less rounding than any of them.
struct Sums
{
  Edges Along = noEdges();
  std::int64_t Cells = 0;
};

Sums sumOf(Sums a, const Sums& b)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    a.Along[i] += b.Along[i];
  }
  a.Cells += b.Cells;
  return a;
}

// Adds a cell's edges to the sums of those that are parallel to the edges `like`. Returns false
// unless each edge of `like` has one, in any order and direction.
bool addEdges(const Edges& edges, const Edges& like, int dimension, Sums& sums)
{
  constexpr double rough = 0.25; // coordinates may be rounded; corners are compared later
  int found = 0;
  for (int a = 0; a < dimension; ++a)
  {
    const Vector3d& edge = edges[static_cast<std::size_t>(a)];
    for (int b = 0; b < dimension; ++b)
    {
      const auto axis = static_cast<std::size_t>(b);
      const Vector3d& other = like[axis];
      // 1 or -1 for an edge that is `other` or its opposite.
      const double along = edge.dot(other) / other.squaredNorm();
      const Vector3d forward = along < 0.0 ? Vector3d(-edge) : edge;
      if ((forward - other).norm() <= rough * other.norm())
      {
        sums.Along[axis] += forward;
        found |= 1 << b;
      }
    }
  }
  // Bit b is set if an edge is parallel to edge b of `like`.
  return found == (1 << dimension) - 1;
}

// The edges of the first cell of the dimension; all others are compared with these.
std::optional<Edges> firstEdges(const CellSets& sets, int dimension)
{
  for (const auto& set : sets)
  {
    BoxCorners corners(*set, dimension);
    for (std::int64_t cell = 0; cell < set->NumberOfCells; ++cell)
    {
      if (corners.IsOfDimension(cell))
      {
        return corners.Read(cell) ? std::optional<Edges>(edgesOf(corners, dimension))
                                  : std::nullopt;
      }
    }
  }
  return std::nullopt;
}

// Puts unit vectors along the edges into the columns of the space axes that they are nearest to,
// greedily from the best pair on. Axes within 1e-9 of an axis of space become that axis, so that
// rounding turns no image.
bool setAxes(const Sums& sums, int dimension, LatticeFrame& frame, Vector3d& spacing)
{
  std::array<Vector3d, 3> units;
  ImageGrid::Matrix along = ImageGrid::Matrix::Constant(-1.0); // how far edges go along the axes
  for (int e = 0; e < dimension; ++e)
  {
    const auto edge = static_cast<std::size_t>(e);
    units[edge] = sums.Along[edge].normalized();
    along.row(e) = units[edge].cwiseAbs().transpose();
  }
  if (!along.allFinite())
  {
    return false;
  }
  for (int n = 0; n < dimension; ++n)
  {
    Eigen::Index e = 0;
    Eigen::Index axis = 0;
    // The best pair of an edge and an axis that are both free.
    along.maxCoeff(&e, &axis);
    along.row(e).setConstant(-1.0);
    along.col(axis).setConstant(-1.0);
    const auto edge = static_cast<std::size_t>(e);
    Vector3d unit = units[edge];
    // Axes point the way of the axes of space.
    unit *= unit[axis] < 0.0 ? -1.0 : 1.0;
    constexpr double straight = 1e-9;
    const bool isStraight = (unit - Vector3d::Unit(axis)).norm() <= straight;
    frame.Axes.col(axis) = isStraight ? Vector3d(Vector3d::Unit(axis)) : unit;
    // The length of the mean edge.
    spacing[axis] = sums.Along[edge].norm() / static_cast<double>(sums.Cells);
    frame.IsAxis[static_cast<std::size_t>(axis)] = true;
  }
  return true;
}

// Makes the columns orthonormal by Gram and Schmidt. Columns across a plane or a line complete
// them. In 3D the third keeps its side: a lattice may be left-handed.
void completeAxes(int dimension, LatticeFrame& frame)
{
  ImageGrid::Matrix& axes = frame.Axes;
  if (dimension == 1)
  {
    const auto main = static_cast<Eigen::Index>(
      std::find(frame.IsAxis.begin(), frame.IsAxis.end(), true) - frame.IsAxis.begin());
    axes = axesAround(axes.col(main), main);
    return;
  }
  Eigen::Index flat = 2;
  if (dimension == 2)
  {
    flat = static_cast<Eigen::Index>(
      std::find(frame.IsAxis.begin(), frame.IsAxis.end(), false) - frame.IsAxis.begin());
  }
  const Eigen::Index first = (flat + 1) % 3;
  const Eigen::Index second = (flat + 2) % 3;
  const Vector3d along = axes.col(first);
  const Vector3d beside = axes.col(second);
  axes.col(second) = (beside - along * along.dot(beside)).normalized();
  const Vector3d across = along.cross(Vector3d(axes.col(second)));
  // The cross product is right-handed; the given third axis may be opposite to it.
  const bool isMirrored = dimension == 3 && across.dot(Vector3d(axes.col(flat))) < 0.0;
  axes.col(flat) = isMirrored ? Vector3d(-across) : across;
}

// The bounds of corners, in coordinates along the frame's axes; empty at first.
struct Box
{
  Vector3d Low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d High = Vector3d::Constant(-std::numeric_limits<double>::infinity());
  double Rounding = 0.0; // largest rounding of a corner's coordinates
};

Box boxOf(Box a, const Box& b)
{
  return { a.Low.cwiseMin(b.Low), a.High.cwiseMax(b.High), std::max(a.Rounding, b.Rounding) };
}

// Combines what visit(corners, cell, part) adds of all cells of the dimension, until it returns
// false. This is the work of the current stage.
template <class Part, class Visit, class Combine>
Part reduceCells(const CellSets& sets, int dimension, Progress& progress, const Visit& visit,
  const Combine& combine)
{
  Part all;
  for (const auto& set : sets)
  {
    all = combine(all,
      reduceChunks(
        progress, set->NumberOfCells, frameGrain, Part(),
        [&](std::int64_t first, std::int64_t last) {
          BoxCorners corners(*set, dimension);
          Part part;
          bool goesOn = true;
          for (std::int64_t cell = first; cell < last && goesOn; ++cell)
          {
            goesOn = !corners.IsOfDimension(cell) || visit(corners, cell, part);
          }
          return part;
        },
        combine));
  }
  return all;
}

// The axes are orthonormal, so that their transpose takes places to coordinates along them.
Box boxOfCells(
  const CellSets& sets, int dimension, const ImageGrid::Matrix& axes, Progress& progress)
{
  const ImageGrid::Matrix toFrame = axes.transpose();
  return reduceCells<Box>(
    sets, dimension, progress,
    [&](BoxCorners& corners, std::int64_t cell, Box& part) {
      // All corners count, not only the first ones.
      const bool isRead = corners.Read(cell);
      for (int i = 0; isRead && i < corners.Count(); ++i)
      {
        const Vector3d x = toFrame * corners[i];
        // The rounding is relative to the largest coordinate of a corner.
        part = boxOf(part, { x, x, corners.Rounding() * corners[i].cwiseAbs().maxCoeff() });
      }
      return true;
    },
    boxOf);
}

} // namespace

// First the edges, then the box along them: number of cells = length of the box / mean edge,
// rounded.
std::optional<LatticeFrame> LatticeFrame::Of(
  const CellSets& sets, int dimension, Progress& progress)
{
  // Cells that fit no lattice are no error: the caller resamples them instead.
  const std::optional<Edges> like = firstEdges(sets, dimension);
  if (!like)
  {
    return std::nullopt;
  }
  std::atomic<bool> misfits{ false };
  const Sums sums = reduceCells<Sums>(
    sets, dimension, progress,
    [&](BoxCorners& corners, std::int64_t cell, Sums& part) {
      // Chunks are of a fixed size, so that sums do not depend on threads.
      ++part.Cells;
      if (!corners.Read(cell) || !addEdges(edgesOf(corners, dimension), *like, dimension, part))
      {
        misfits = true; // the others need no look
      }
      return !misfits;
    },
    sumOf);
  LatticeFrame frame;
  Vector3d edge = Vector3d::Zero();
  // One cell that is no such box is enough for no lattice.
  if (misfits || !setAxes(sums, dimension, frame, edge))
  {
    return std::nullopt;
  }
  completeAxes(dimension, frame);
  frame.Cells = static_cast<double>(sums.Cells);
  const Box box = boxOfCells(sets, dimension, frame.Axes, progress);
  const double longest = (box.High - box.Low).maxCoeff();
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    const double length = box.High[axis] - box.Low[axis];
    if (!frame.IsAxis[a])
    {
      constexpr double flatness = 1e-5; // part of the longest side, as of any plane
      // Cells of one plane or line: the box has no extent across it.
      if (!(length <= std::max(flatness * longest, box.Rounding)))
      {
        return std::nullopt;
      }
      frame.Low[axis] = 0.5 * (box.Low[axis] + box.High[axis]);
      continue;
    }
    constexpr double usual = 1e-4; // part of a spacing, as coordinates of some formats are rounded
    // Beyond a tenth of a spacing, neighbouring places could be confused.
    constexpr double most = 0.1;
    frame.CellsAlong[a] = std::max(1.0, std::round(length / edge[axis]));
    frame.Low[axis] = box.Low[axis];
    // Along oblique axes, the ends are rounded as any other corner.
    const bool isStraight = frame.Axes(axis, axis) == 1.0;
    frame.Spacing[axis] = isStraight ? length / frame.CellsAlong[a] : edge[axis];
    frame.Tolerance[axis] =
      std::min(std::max(usual * frame.Spacing[axis], box.Rounding), most * frame.Spacing[axis]);
    if (!(frame.Spacing[axis] > 0.0) || !std::isfinite(frame.CellsAlong[a]))
    {
      return std::nullopt;
    }
  }
  return frame;
}

BoxCorners::BoxCorners(const CellSet& cells, int dimension)
  : Set(cells)
  , Dimension(dimension)
  , Reader(cells.Read())
{
}

// Pixels, voxels, lines and polylines have their points in the order of the bits.
bool BoxCorners::Read(std::int64_t cell)
{
  // The points of cells around a face (quadrilaterals and hexahedra), by the bits of the corners:
  // VTK numbers these corners in turn.
  constexpr std::array<std::size_t, 8> around{ 0, 1, 3, 2, 4, 5, 7, 6 };
  const CellShape shape = this->Reader->ShapeOf(cell);
  const bool isAround =
    shape == CellShape::Quad || shape == CellShape::Polygon || shape == CellShape::Hexahedron;
  const bool isInOrder = shape == CellShape::Line || shape == CellShape::PolyLine ||
    shape == CellShape::Pixel || shape == CellShape::Voxel;
  if (!isAround && !isInOrder)
  {
    return false;
  }
  const CellReader::Ids& ids = this->Reader->PointsOf(cell);
  const auto count = static_cast<std::size_t>(this->Count());
  // Polygons and polylines may have any number of points.
  if (ids.size() != count)
  {
    return false;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::int64_t id = ids[isAround ? around[i] : i];
    if (id < 0 || id >= this->Set.NumberOfPoints)
    {
      return false;
    }
    this->Points[i] = id;
    this->Reader->GetPosition(id, this->Corners[i].data());
  }
  return true;
}

// A corner's place along an axis is (coordinate - Low) / Spacing, which must be a whole number
// within the tolerance. The cell's place is the least of its corners'.
bool BoxCorners::FindPlace(const LatticeFrame& frame, std::array<std::int64_t, 3>& place,
  std::array<unsigned, 8>& sides) const
{
  sides.fill(0);
  place = { 0, 0, 0 };
  unsigned allAxes = 0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (!frame.IsAxis[a])
    {
      continue;
    }
    allAxes |= 1U << a;
    const auto axis = static_cast<Eigen::Index>(a);
    std::array<std::int64_t, 8> steps{};
    for (int i = 0; i < this->Count(); ++i)
    {
      const double along = frame.Axes.col(axis).dot((*this)[i]) - frame.Low[axis];
      // Not a number fails the comparison, too.
      const double whole = std::round(along / frame.Spacing[axis]);
      if (!(std::abs(along - whole * frame.Spacing[axis]) <= frame.Tolerance[axis]))
      {
        return false;
      }
      steps[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(whole);
    }
    // The low corner's place.
    place[a] = *std::min_element(steps.begin(), steps.begin() + this->Count());
    for (int i = 0; i < this->Count(); ++i)
    {
      // 0 on the low side, 1 on the high one.
      const std::int64_t side = steps[static_cast<std::size_t>(i)] - place[a];
      if (side > 1)
      {
        return false;
      }
      sides[static_cast<std::size_t>(i)] |= static_cast<unsigned>(side) << a;
    }
    if (static_cast<double>(place[a]) >= frame.CellsAlong[a])
    {
      return false;
    }
  }
  // The bits make a box if each edge of the cell goes along another axis, and each corner is where
  // the sum of its edges leads.
  unsigned axes = 0;
  for (int a = 0; a < this->Dimension; ++a)
  {
    axes |= sides[0] ^ sides[std::size_t{ 1 } << a];
  }
  bool isBox = axes == allAxes;
  for (int i = 0; i < this->Count(); ++i)
  {
    unsigned side = sides[0];
    for (int a = 0; a < this->Dimension; ++a)
    {
      // The lattice axis, as a bit, along which edge a of the cell goes.
      const unsigned step = sides[0] ^ sides[std::size_t{ 1 } << a];
      side ^= (i >> a & 1) != 0 ? step : 0;
      isBox = isBox && (step == 1 || step == 2 || step == 4);
    }
    isBox = isBox && side == sides[static_cast<std::size_t>(i)];
  }
  return isBox;
}

} // namespace RectifiedTransport
