// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/CellFrame.h"

#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/Progress.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Eigen::Vector3d;

// A plane or a line may be off by this part of the longest side. Single precision is ten times
// better.
constexpr double flatness = 1e-5;

std::string describe(const Eigen::Vector3d& x)
{
  std::ostringstream text;
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
  return text.str();
}

[[noreturn]] void failFlat(const MassCells& mass, const Eigen::Vector3d& sides)
{
  const int dimension = mass.Dimension;
  std::ostringstream text;
  text << "The input's cells are "
       << (dimension == 1           ? "lines that are not on one straight line"
              : mass.AreClosedLines ? "closed lines that lie in no plane"
                                    : "faces that lie in no plane")
       << ": points are " << sides[2 - dimension] << " off, with a longest side of " << sides[2]
       << "; "
       << (mass.AreClosedLines ? "they must lie in one plane"
              : dimension == 2
              ? "they must lie in one plane, as a slice does, or be the polygons of a closed "
                "surface, as Extract Surface makes them"
              : "they must lie on one, or closed ones in a plane, around regions (Triangle "
                "Strips joins the segments of a slice)");
  throw NotFlat(text.str());
}

// Calls visit(x) for the corners of all cells of a set with mass, each point once. Throws Failure
// for points that are not finite, except those of hidden cells.
template <class Visit>
void visitCorners(
  const CellSet& set, const MassCells& cells, Progress& progress, const Visit& visit)
{
  constexpr std::int64_t cellsBetweenPolls = std::int64_t{ 1 } << 16;
  // A bit for each point, as cells share points.
  std::vector<bool> visited(static_cast<std::size_t>(set.NumberOfPoints), false);
  std::int64_t notFinite = -1;
  const auto reader = set.Read();
  for (std::int64_t cell = 0; cell < set.NumberOfCells; ++cell)
  {
    progress.CheckEvery(cellsBetweenPolls, cell);
    const CellReader::Ids* points = cells.Find(*reader, cell);
    for (std::size_t i = 0; points && i < points->size(); ++i)
    {
      const std::int64_t point = (*points)[i];
      if (visited[static_cast<std::size_t>(point)])
      {
        continue;
      }
      Vector3d x;
      reader->GetPosition(point, x.data());
      if (x.allFinite())
      {
        visited[static_cast<std::size_t>(point)] = true;
        visit(x);
      }
      else if (!set.HiddenCells.Has(cell) && !set.HiddenPoints.HasAny(*points))
      {
        // The least number, whatever the order of cells, is in the message.
        notFinite = notFinite < 0 ? point : std::min(notFinite, point);
      }
    }
  }
  if (notFinite >= 0)
  {
    Vector3d x;
    reader->GetPosition(notFinite, x.data());
    fail("Point ", notFinite, " of the ", set.Name, " is at ", describe(x),
      "; the coordinates of all points of cells must be finite");
  }
}

template <class Visit>
void visitCorners(
  const CellSets& sets, const MassCells& cells, Progress& progress, const Visit& visit)
{
  for (const std::shared_ptr<const CellSet>& set : sets)
  {
    visitCorners(*set, cells, progress, visit);
  }
}

using PhysicalBox = Eigen::AlignedBox3d;

// The eigenvectors of the points' covariance matrix, by growing eigenvalue: the first is the
// normal of the best plane, the last the direction of the best line. Offsets from the middle, by
// the longest side, keep squares from overflow and cancellation.
Eigen::Matrix3d principalAxes(
  const CellSets& sets, const MassCells& cells, const PhysicalBox& bounds, Progress& progress)
{
  const Vector3d middle = 0.5 * (bounds.min() + bounds.max());
  const double unit = bounds.sizes().maxCoeff();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  Vector3d first = Vector3d::Zero();
  double count = 0.0;
  visitCorners(sets, cells, progress, [&](const Vector3d& x) {
    // Offsets of at most about 1.
    const Vector3d d = (x - middle) / unit;
    first += d;
    second += d * d.transpose();
    count += 1.0;
  });
  first /= count;
  // cov = mean(d d^T) - mean(d) mean(d)^T
  const Eigen::Matrix3d covariance = second / count - first * first.transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
}

// Rounded to 1e-6, so that slices of one plane have the same axes, and with its largest component
// positive.
Vector3d roundedDirection(Vector3d v, Eigen::Index& largest)
{
  constexpr double step = 1e-6;
  v.cwiseAbs().maxCoeff(&largest);
  // A direction and its opposite are the same axis.
  v *= v[largest] < 0.0 ? -1.0 : 1.0;
  v = (v / step).array().round() * step;
  return v.normalized();
}

// Gives the axes of the shortest sides no length: the box keeps `dimension` axes.
void flatten(int dimension, PhysicalBox& box)
{
  Vector3d sides = box.sizes();
  for (int flat = dimension; flat < 3; ++flat)
  {
    Eigen::Index shortest = 0;
    sides.minCoeff(&shortest);
    // The next shortest one comes next.
    sides[shortest] = std::numeric_limits<double>::infinity();
    const double middle = 0.5 * (box.min()[shortest] + box.max()[shortest]);
    box.min()[shortest] = middle;
    box.max()[shortest] = middle;
  }
}

} // namespace

// Gram and Schmidt on the direction and the next axis of space; the third is their cross product.
ImageGrid::Matrix axesAround(const Vector3d& direction, Eigen::Index main)
{
  ImageGrid::Matrix axes;
  const Eigen::Index next = (main + 1) % 3;
  const Vector3d along = (Vector3d::Unit(next) - direction * direction[next]).normalized();
  axes.col(main) = direction;
  axes.col(next) = along;
  axes.col((main + 2) % 3) = direction.cross(along);
  return axes;
}

// The points farthest from the first one, from the line through both, and from the plane of all
// three.
bool areInPlane(std::int64_t count, const std::function<void(std::int64_t, double*)>& positionOf)
{
  Vector3d first = Vector3d::Zero();
  const auto farthest = [&](const auto& distance) {
    Vector3d found = Vector3d::Zero(); // from the first
    double most = 0.0;
    for (std::int64_t i = 0; i < count; ++i)
    {
      Vector3d x;
      positionOf(i, x.data());
      const double own = distance(x - first);
      if (own > most && std::isfinite(own))
      {
        found = x - first;
        most = own;
      }
    }
    return found;
  };
  if (count > 0)
  {
    positionOf(0, first.data());
  }
  const Vector3d along = farthest([](const Vector3d& x) { return x.norm(); });
  const Vector3d across = farthest([&](const Vector3d& x) { return along.cross(x).norm(); });
  const Vector3d normal = along.cross(across).normalized();
  const Vector3d off = farthest([&](const Vector3d& x) { return std::abs(normal.dot(x)); });
  return std::abs(normal.dot(off)) <= flatness * along.norm();
}

// The axes of space serve where the cells are flat along them; else principal axes.
CellFrame CellFrame::Of(const CellSets& sets, const MassCells& cells, Progress& progress)
{
  const int dimension = cells.Dimension;
  CellFrame frame;
  visitCorners(sets, cells, progress, [&](const Vector3d& x) { frame.Box.extend(x); });
  const Vector3d lengths = frame.Box.sizes();
  const double longest = lengths.maxCoeff();
  // No extent: nothing to resample.
  if (longest == 0.0)
  {
    fail("The cells of the input are all at one place; they must have a length, area or volume");
  }
  if (!std::isfinite(longest) || longest < 0.0)
  {
    fail("The cells of the input reach from ", describe(frame.Box.min()), " to ",
      describe(frame.Box.max()), "; a side must not be past the largest double");
  }
  // Flat along as many axes as the dimension leaves.
  const auto isFlat = [&](const Vector3d& sides) {
    return (sides.array() <= flatness * longest).count() >= 3 - dimension;
  };
  if (dimension < 3 && !isFlat(lengths))
  {
    Eigen::Index main = 0;
    const Vector3d direction = roundedDirection(
      principalAxes(sets, cells, frame.Box, progress).col(dimension == 2 ? 0 : 2), main);
    frame.Axes = axesAround(direction, main);
    frame.Box = PhysicalBox();
    // Coordinates in the frame are the products with its axes: the inverse is the transpose.
    const Eigen::Matrix3d toFrame = frame.Axes.transpose();
    visitCorners(sets, cells, progress, [&](const Vector3d& x) { frame.Box.extend(toFrame * x); });
    Vector3d sides = frame.Box.sizes();
    if (!isFlat(sides))
    {
      std::sort(sides.data(), sides.data() + 3);
      failFlat(cells, sides);
    }
  }
  flatten(dimension, frame.Box);
  return frame;
}

// A grid along the axes of space, then turned into the frame.
ImageGrid CellFrame::Grid(int resolution) const
{
  double box[6];
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    box[2 * a] = this->Box.min()[a];
    box[2 * a + 1] = this->Box.max()[a];
  }
  // The grid in frame coordinates: axis-aligned there.
  const ImageGrid straight = gridWithResolution(gridOfBox(box), resolution, "DensityResolution");
  return { straight.Extent(), this->Axes * straight.Origin(), straight.Spacing(), this->Axes,
    straight.IsOnPoints() };
}

} // namespace RectifiedTransport
