// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Boxes/CommonGrid.h"

#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Geometry/InverseMatrix.h"
#include "Core/Messages/PropertyCheck.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

// Enlarges a box by the corners of an image's points. Beyond its points there is nothing to be
// sampled, also where the domain of a point array reaches half a spacing farther.
void addPoints(const ImageGrid& grid, Eigen::Vector3d& low, Eigen::Vector3d& high)
{
  const std::array<int, 6>& extent = grid.Extent();
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    Eigen::Vector3d steps;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto a = static_cast<Eigen::Index>(axis);
      steps[a] = grid.Spacing()[a] * extent[2 * axis + (corner >> axis & 1)];
    }
    const Eigen::Vector3d place = grid.Origin() + grid.Direction() * steps;
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
}

// The translation that brings the image's first layer into the plane through the origin across an
// axis, as the three numbers that Transform has.
std::string translateOf(const ImageGrid& grid, Eigen::Index axis)
{
  const Eigen::Vector3d normal = grid.Direction().col(axis).normalized();
  const auto first = static_cast<double>(grid.Extent()[2 * static_cast<std::size_t>(axis)]);
  const Eigen::Vector3d place = grid.Origin() + normal * (grid.Spacing()[axis] * first);
  std::string text;
  for (Eigen::Index i = 0; i < 3; ++i)
  {
    const double move = -place.dot(normal) * normal[i];
    text += (i > 0 ? " " : "") + textOf(move == 0.0 ? 0.0 : move);
  }
  return text;
}

// How Resample To Image puts images in different boxes on one, for messages: its properties, for
// the smallest box that holds both, at the finest spacing.
std::string sameBoxAdvice(const ImageGrid& first, const ImageGrid& other)
{
  Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL);
  Eigen::Vector3d high = -low;
  addPoints(first, low, high);
  addPoints(other, low, high);
  // The finest spacing of the two, along each axis.
  const Eigen::Vector3d spacing = first.Spacing().cwiseAbs().cwiseMin(other.Spacing().cwiseAbs());
  std::string bounds;
  std::string dimensions;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto a = static_cast<Eigen::Index>(axis);
    const double values =
      first.IsAxis(axis) ? std::round((high[a] - low[a]) / spacing[a]) + 1.0 : 1.0;
    bounds += textOf(low[a]) + " " + textOf(high[a]) + " ";
    dimensions += (axis > 0 ? " " : "") + textOf(std::clamp(values, 1.0, 1e9));
  }
  return "Resample To Image of each, for a surface of what Solid Density makes of it, does so, "
         "with "
         "Use Input Bounds off and the same Sampling Bounds and Sampling Dimensions; " +
    bounds + "and " + dimensions + " hold these two";
}

// How Transform puts images in different planes into one across an axis along which they are flat.
// Both are moved to the plane through the origin, so that it does not matter which one is right.
std::string samePlaneAdvice(const ImageGrid& first, const ImageGrid& other, std::size_t axis)
{
  const auto a = static_cast<Eigen::Index>(axis);
  return "Transform of each makes it so, with the Translate " + translateOf(first, a) + " and " +
    translateOf(other, a);
}

constexpr double relativeRounding = 1e-6; // part of lengths and coordinates, as in single precision
constexpr double mostRounding = 0.01;     // part of a spacing; larger offsets are no rounding
constexpr double directionTolerance = 1e-6; // for each element, as ITK has it by default
constexpr double planeTolerance = 1e-6;     // part of the longest side
constexpr const char* sizesProperty = "Dimensions";

// The interval of the domain along an axis, in coordinates along given directions. For an axis of
// one point Low is the coordinate of that point.
struct Side
{
  double Low;     // the lower end of the first cell; the upper one if Spacing is negative
  double Spacing; // from one cell to the next, with its sign
  int Cells;
  bool IsAxis;
};

using Sides = std::array<Side, 3>;

// The product by columns: terms are added from left to right, as vtkMatrix3x3 does. The order of
// Eigen's product, and so its rounding, depends on its version and on the instruction set.
Eigen::Vector3d product(const ImageGrid::Matrix& matrix, const Eigen::Vector3d& v)
{
  return matrix.col(0) * v[0] + matrix.col(1) * v[1] + matrix.col(2) * v[2];
}

// `directions` are those of the grid but for their tolerance: those of another grid, so that far
// from the origin both have the same coordinates.
Sides sidesOf(const ImageGrid& grid, const ImageGrid::Matrix& directions)
{
  // The origin in coordinates along the directions.
  const Eigen::Vector3d origin = product(inverseOf(directions), grid.Origin());
  Sides sides;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto axis = static_cast<Eigen::Index>(i);
    const double spacing = grid.Spacing()[axis];
    const int first = grid.Extent()[2 * i];
    // The domain of values on points begins half a spacing before the first point.
    const double index = grid.IsAxis(i) && grid.IsOnPoints() ? first - 0.5 : first;
    sides[i] = { origin[axis] + spacing * index, spacing, grid.NumberOfValues()[i],
      grid.IsAxis(i) };
  }
  return sides;
}

// The grid of these sides in the directions of another one, with an extent from 0.
ImageGrid withSides(const ImageGrid& grid, const Sides& sides)
{
  std::array<int, 6> extent{};
  Eigen::Vector3d spacing;
  Eigen::Vector3d place;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Side& side = sides[i];
    const auto axis = static_cast<Eigen::Index>(i);
    spacing[axis] = side.Spacing;
    extent[2 * i + 1] = !side.IsAxis ? 0 : grid.IsOnPoints() ? side.Cells - 1 : side.Cells;
    place[axis] = side.IsAxis && grid.IsOnPoints() ? side.Low + 0.5 * side.Spacing : side.Low;
  }
  const Eigen::Vector3d origin = product(grid.Direction(), place);
  return { extent, origin, spacing, grid.Direction(), grid.IsOnPoints() };
}

// Element by element, not by angles: the message names the same tolerance.
bool haveSameDirection(const ImageGrid& a, const ImageGrid& b)
{
  return ((a.Direction() - b.Direction()).cwiseAbs().array() <= directionTolerance).all();
}

// False where an axis of one point has no direction of its own.
bool hasInverse(const ImageGrid& grid)
{
  constexpr double flat = 1e-12;
  return std::abs(grid.Direction().determinant()) > flat;
}

// The axes of an image as text, which messages show and comparisons use.
std::string axesOf(const Sides& sides)
{
  std::string axes;
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (sides[i].IsAxis)
    {
      axes += axes.empty() ? "" : " and ";
      axes += "xyz"[i];
    }
  }
  return axes.empty() ? "no axis" : "the axes " + axes;
}

// The side of the domain along an axis, in physical units.
double sideLength(const Side& side)
{
  return std::abs(side.Spacing) * side.Cells;
}

// The longest side of the domain: what is off a plane is compared with it.
double longestOf(const Sides& sides)
{
  double longest = 0.0;
  for (const Side& side : sides)
  {
    longest = std::max(longest, side.IsAxis ? sideLength(side) : 0.0);
  }
  return longest;
}

// What no resampling to a common box could mend: other axes, directions, signs or planes.
void requireAlike(const NamedGrid& first, const NamedGrid& other)
{
  const Sides a = sidesOf(first.Grid, first.Grid.Direction());
  const Sides b = sidesOf(other.Grid, first.Grid.Direction());
  if (axesOf(a) != axesOf(b))
  {
    fail(first.Name, " has ", axesOf(a), ", ", other.Name, " has ", axesOf(b),
      "; all must have the same number of dimensions, along the same axes");
  }
  if (!haveSameDirection(first.Grid, other.Grid))
  {
    fail(first.Name, " and ", other.Name,
      " have different direction matrices; all must have the same one, up to ", directionTolerance,
      " in each element (Resample To Image makes it so)");
  }
  if (!hasInverse(first.Grid))
  {
    fail(first.Name, " has a direction matrix without an inverse, and its geometry is not that of ",
      other.Name, "; give axes of one point a direction of their own");
  }
  // A spacing of the other sign would run through the box backward. Flat images may lie apart by
  // rounding, which is compared with the longest side.
  const double longest = std::max(longestOf(a), longestOf(b));
  for (std::size_t i = 0; i < 3; ++i)
  {
    const char axis = "xyz"[i];
    if (a[i].IsAxis && a[i].Spacing * b[i].Spacing < 0.0)
    {
      fail("Along ", axis, " the spacing of ", first.Name, " is ", a[i].Spacing, " and that of ",
        other.Name, " is ", b[i].Spacing, "; both must have the same sign");
    }
    if (!a[i].IsAxis && std::abs(a[i].Low - b[i].Low) > planeTolerance * longest)
    {
      fail(first.Name, " lies at ", axis, " = ", a[i].Low, ", ", other.Name, " at ", axis, " = ",
        b[i].Low, "; images that are flat along an axis must lie in one plane (",
        samePlaneAdvice(first.Grid, other.Grid, i), ")");
    }
  }
}

// How far apart ends of an interval may be that are meant to be the same.
// The rounding grows with the coordinates; it must stay far below a cell.
double toleranceOf(double low, double high, double spacing)
{
  const double largest = std::max({ high - low, std::abs(low), std::abs(high) });
  return std::min(relativeRounding * largest, mostRounding * std::abs(spacing));
}

// Both ends and the number of cells agree, so that the spacing does, too.
bool isSame(const Side& a, const Side& b)
{
  const double end = a.Low + a.Spacing * a.Cells;
  const double tolerance = toleranceOf(std::min(a.Low, end), std::max(a.Low, end), a.Spacing);
  return !a.IsAxis ||
    (a.Cells == b.Cells && std::abs(a.Low - b.Low) <= tolerance &&
      std::abs(b.Low + b.Spacing * b.Cells - end) <= tolerance);
}

// Returns whether the grids have the same cells along all axes.
bool isSame(const Sides& a, const Sides& b)
{
  return isSame(a[0], b[0]) && isSame(a[1], b[1]) && isSame(a[2], b[2]);
}

// Along one axis: the smallest interval that contains all sides, at the finest spacing.
struct Union
{
  std::size_t Axis;
  double Low;
  double Length;
  double Finest; // or a multiple of it
  double Cells;  // rounded up, but not what is rounding itself; may exceed an integer
  double Sign;
};

// With the sign of the spacing the interval is ascending for all images.
Union uniteSides(const std::vector<Sides>& all, std::size_t axis)
{
  const double sign = all.front()[axis].Spacing < 0.0 ? -1.0 : 1.0;
  double low = sign * all.front()[axis].Low;
  double high = low;
  double finest = std::abs(all.front()[axis].Spacing);
  for (const Sides& sides : all)
  {
    const Side& side = sides[axis];
    low = std::min(low, sign * side.Low);
    high = std::max(high, sign * side.Low + sideLength(side));
    finest = std::min(finest, std::abs(side.Spacing));
  }
  const double tolerance = toleranceOf(low, high, finest);
  const double cells = std::max(1.0, std::ceil((high - low - tolerance) / finest));
  return { axis, low, high - low, finest, cells, sign };
}

// Along one axis at a multiple of the finest spacing; at least `least`.
double cellsAt(const Union& axis, double factor, double least)
{
  constexpr double exact = 1.0 - 1e-12; // a spacing that divides the box adds no cell
  return factor > 1.0 ? std::max(least, std::ceil(exact * axis.Length / (axis.Finest * factor)))
                      : axis.Cells;
}

// Makes spacings larger, all by the least factor with which there are no more cells than `most`,
// but `least` along each axis.
void coarsen(std::vector<Union>& axes, double most, double least)
{
  // The number of cells falls with the factor, in steps: double it until it is enough, then bisect
  // to the last bit.
  const auto isMore = [&](double factor) {
    double cells = 1.0;
    bool isLeast = true;
    for (const Union& axis : axes)
    {
      cells *= cellsAt(axis, factor, least);
      isLeast = isLeast && cellsAt(axis, factor, least) <= least;
    }
    return cells > most && !isLeast;
  };
  double below = 1.0;
  double factor = 1.0;
  while (isMore(factor))
  {
    below = factor;
    factor *= 2.0;
  }
  for (double middle = 0.5 * (below + factor); middle > below && middle < factor;
       middle = 0.5 * (below + factor))
  {
    (isMore(middle) ? below : factor) = middle;
  }
  // Numbers of cells are whole. At the least factor, the cells along one axis fill the box exactly,
  // but for rounding; that axis gives the factor which all others get.
  double filling = factor;
  for (const Union& axis : axes)
  {
    // The factor with which this axis's cells fill the box.
    const double own = axis.Length / (axis.Finest * cellsAt(axis, factor, least));
    filling =
      factor > 1.0 && std::abs(own - factor) < 1e-11 * factor ? std::max(filling, own) : filling;
  }
  for (Union& axis : axes)
  {
    axis.Cells = cellsAt(axis, factor, least);
    axis.Finest *= filling;
  }
}

// The number of cells of a grid; a double, because three ints may exceed every integer.
double cellsOf(const Sides& sides)
{
  return std::accumulate(sides.begin(), sides.end(), 1.0,
    [](double cells, const Side& side) { return side.IsAxis ? cells * side.Cells : cells; });
}

} // namespace

// Equal grids are the usual case, and keep the first grid bit by bit.
ImageGrid commonGrid(const std::vector<NamedGrid>& grids, const int dimensions[3], MostCells limit)
{
  const ImageGrid& first = grids.front().Grid;
  std::vector<Sides> all{ sidesOf(first, first.Direction()) };
  bool same = true;
  for (const NamedGrid& grid : grids)
  {
    if (grid.Grid == first)
    {
      continue;
    }
    requireAlike(grids.front(), grid);
    all.push_back(sidesOf(grid.Grid, first.Direction()));
    same = same && isSame(all.front(), all.back());
  }
  if (same)
  {
    return gridWithValues(first, dimensions, sizesProperty);
  }

  // Grids that differ get the box around all of them. Along axes of one point, the first grid's
  // place stays.
  constexpr double most = MaximumResolution;
  Sides sides = all.front();
  std::vector<Union> unions;
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (sides[i].IsAxis)
    {
      // The axes of all grids are the same here, which requireAlike has checked.
      unions.push_back(uniteSides(all, i));
    }
  }
  if (limit == MostCells::OfTheLargest)
  {
    std::vector<double> cells;
    std::transform(all.begin(), all.end(), std::back_inserter(cells), cellsOf);
    // Points have no axis where there is one of them.
    coarsen(unions, *std::max_element(cells.begin(), cells.end()), first.IsOnPoints() ? 2.0 : 1.0);
  }
  for (const Union& side : unions)
  {
    if (!(side.Cells <= most) && dimensions[side.Axis] == 0)
    {
      fail("The box of all inputs at the finest spacing has ", side.Cells, " cells along ",
        "xyz"[side.Axis], "; it must have at most ", MaximumResolution);
    }
    // Limited for the moment where `dimensions` gives the number.
    const double cells = std::min(side.Cells, most);
    sides[side.Axis].Low = side.Sign * side.Low;
    sides[side.Axis].Cells = static_cast<int>(cells);
    sides[side.Axis].Spacing = side.Sign * side.Length / cells;
  }
  // gridWithValues checks `dimensions` and may change the spacing; its result is put back on the
  // box exactly.
  Sides exact =
    sidesOf(gridWithValues(withSides(first, sides), dimensions, sizesProperty), first.Direction());
  for (const Union& side : unions)
  {
    exact[side.Axis].Low = side.Sign * side.Low;
    if (dimensions[side.Axis] == 0)
    {
      exact[side.Axis].Spacing = side.Sign * side.Finest;
    }
  }
  return withSides(first, exact);
}

bool haveSameCells(const ImageGrid& a, const ImageGrid& b)
{
  return a == b || isSame(sidesOf(a, a.Direction()), sidesOf(b, a.Direction()));
}

void requireSameBox(const NamedGrid& first, const NamedGrid& other)
{
  if (first.Grid == other.Grid)
  {
    return;
  }
  requireAlike(first, other);
  const Sides a = sidesOf(first.Grid, first.Grid.Direction());
  const Sides b = sidesOf(other.Grid, first.Grid.Direction());
  for (std::size_t i = 0; i < 3; ++i)
  {
    // Both ends, with the sign of the spacing.
    // The ends alone are compared: the numbers of cells may differ.
    const double ends[] = { a[i].Low, a[i].Low + a[i].Spacing * a[i].Cells };
    const double others[] = { b[i].Low, b[i].Low + b[i].Spacing * b[i].Cells };
    const double tolerance = toleranceOf(std::min(ends[0], ends[1]), std::max(ends[0], ends[1]),
      std::min(std::abs(a[i].Spacing), std::abs(b[i].Spacing)));
    if (a[i].IsAxis &&
      (std::abs(ends[0] - others[0]) > tolerance || std::abs(ends[1] - others[1]) > tolerance))
    {
      fail(other.Name, " reaches from ", textOf(others[0]), " to ", textOf(others[1]), " along ",
        "xyz"[i], ", ", first.Name, " from ", textOf(ends[0]), " to ", textOf(ends[1]),
        "; all must fill the same box (", sameBoxAdvice(first.Grid, other.Grid), ")");
    }
  }
}

} // namespace RectifiedTransport
