// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Meshes/MeshGrid.h"

#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Run/Failure.h"
#include "Core/Parallel/Progress.h"

#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

using Eigen::Vector3d;

// Of the longest side: what a plane or a line may be off by. Single precision is ten times better.
constexpr double flatness = 1e-5;
constexpr vtkIdType cellsBetweenPolls = vtkIdType{ 1 } << 16;

std::string describe(const Vector3d& x)
{
  std::ostringstream text;
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
  return text.str();
}

// Calls visit(x) for the corners of all cells with mass, each point once. Throws Failure for one
// that is not finite.
template <class Visit>
void visitCorners(const std::vector<DensityBlock>& blocks, const MassCells& cells,
  Progress& progress, const Visit& visit)
{
  vtkNew<vtkIdList> points;
  for (const DensityBlock& block : blocks)
  {
    vtkDataSet* data = block.Data;
    const BlankedCells blanked(data, block.Name.c_str());
    std::vector<bool> visited(static_cast<std::size_t>(data->GetNumberOfPoints()), false);
    vtkIdType notFinite = -1;
    for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
    {
      if (cell % cellsBetweenPolls == 0)
      {
        progress.Check();
      }
      if (!cells.Find(data, cell, points))
      {
        continue;
      }
      for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
      {
        const vtkIdType point = points->GetId(i);
        if (visited[static_cast<std::size_t>(point)])
        {
          continue;
        }
        Vector3d x;
        data->GetPoint(point, x.data());
        if (x.allFinite())
        {
          visited[static_cast<std::size_t>(point)] = true;
          visit(x);
        }
        else if (!blanked.Has(cell) && !blanked.HasPointOf(points))
        {
          notFinite = notFinite < 0 ? point : std::min(notFinite, point);
        }
      }
    }
    if (notFinite >= 0)
    {
      Vector3d x;
      data->GetPoint(notFinite, x.data());
      fail("Point ", notFinite, " of the ", block.Name, " is at ", describe(x),
        "; the coordinates of all points of cells must be finite");
    }
  }
}

using Bounds = Eigen::AlignedBox3d;

// The eigenvectors of the points' covariance, by growing eigenvalue.
Eigen::Matrix3d principalAxes(const std::vector<DensityBlock>& blocks, const MassCells& cells,
  const Bounds& bounds, Progress& progress)
{
  const Vector3d middle = 0.5 * (bounds.min() + bounds.max());
  const double unit = bounds.sizes().maxCoeff();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  Vector3d first = Vector3d::Zero();
  double count = 0.0;
  visitCorners(blocks, cells, progress, [&](const Vector3d& x) {
    const Vector3d d = (x - middle) / unit;
    first += d;
    second += d * d.transpose();
    count += 1.0;
  });
  first /= count;
  const Eigen::Matrix3d covariance = second / count - first * first.transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
}

// Rounded, so that slices of one plane have the same axes, and with its largest component positive.
Vector3d roundedDirection(Vector3d v, Eigen::Index& largest)
{
  constexpr double step = 1e-6;
  v.cwiseAbs().maxCoeff(&largest);
  v *= v[largest] < 0.0 ? -1.0 : 1.0;
  v = (v / step).array().round() * step;
  return v.normalized();
}

struct Frame
{
  ImageGrid::Matrix Axes = ImageGrid::Matrix::Identity();
  Bounds Box; // of the coordinates along the axes
};

[[noreturn]] void failFlat(int dimension, bool areClosedLines, double off, double length)
{
  fail("The input's cells are ",
    dimension == 1     ? "lines that are not on one straight line"
      : areClosedLines ? "closed lines that lie in no plane"
                       : "faces that lie in no plane",
    ": points are ", off, " off, with a longest side of ", length, "; ",
    areClosedLines ? "they must lie in one plane"
      : dimension == 2
      ? "they must lie in one plane, as a slice does (Sample Surface takes curved "
        "surfaces that are disks)"
      : "they must lie on one, or closed ones in a plane, around regions (Triangle "
        "Strips joins the segments of a slice)");
}

Frame frameOf(const std::vector<DensityBlock>& blocks, const MassCells& cells, Progress& progress)
{
  const int dimension = cells.Dimension;
  Frame frame;
  visitCorners(blocks, cells, progress, [&](const Vector3d& x) { frame.Box.extend(x); });
  const Vector3d lengths = frame.Box.sizes();
  const double longest = lengths.maxCoeff();
  if (!std::isfinite(longest) || !(longest > 0.0))
  {
    if (longest == 0.0)
    {
      fail("The cells of the input are all at one place; they must have a length, area or volume");
    }
    fail("The cells of the input reach from ", describe(frame.Box.min()), " to ",
      describe(frame.Box.max()), "; a side must not be past the largest double");
  }
  const auto isFlat = [&](const Vector3d& sides) {
    return (sides.array() <= flatness * longest).count() >= 3 - dimension;
  };
  if (dimension == 3 || isFlat(lengths))
  {
    return frame;
  }
  Eigen::Index main = 0;
  const Vector3d direction = roundedDirection(
    principalAxes(blocks, cells, frame.Box, progress).col(dimension == 2 ? 0 : 2), main);
  frame.Axes = axesAround(direction, main);
  frame.Box = Bounds();
  const Eigen::Matrix3d toFrame = frame.Axes.transpose();
  visitCorners(blocks, cells, progress, [&](const Vector3d& x) { frame.Box.extend(toFrame * x); });
  Vector3d sides = frame.Box.sizes();
  if (!isFlat(sides))
  {
    std::sort(sides.data(), sides.data() + 3);
    failFlat(dimension, cells.AreClosedLines, sides[2 - dimension], sides[2]);
  }
  return frame;
}

} // namespace

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

ImageGrid meshGrid(const std::vector<DensityBlock>& blocks, const MassCells& cells, int resolution,
  Progress& progress)
{
  const int dimension = cells.Dimension;
  Frame frame = frameOf(blocks, cells, progress);
  // Flat axes are those of the shortest sides.
  Vector3d sides = frame.Box.sizes();
  double box[6];
  for (int flat = dimension; flat < 3; ++flat)
  {
    Eigen::Index shortest = 0;
    sides.minCoeff(&shortest);
    sides[shortest] = std::numeric_limits<double>::infinity();
    const double middle = 0.5 * (frame.Box.min()[shortest] + frame.Box.max()[shortest]);
    frame.Box.min()[shortest] = middle;
    frame.Box.max()[shortest] = middle;
  }
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    box[2 * a] = frame.Box.min()[a];
    box[2 * a + 1] = frame.Box.max()[a];
  }
  const ImageGrid straight = gridWithResolution(gridOfBox(box), resolution, "DensityResolution");
  return { straight.Extent(), frame.Axes * straight.Origin(), straight.Spacing(), frame.Axes,
    straight.IsOnPoints() };
}

} // namespace RectifiedTransport::Bridge
