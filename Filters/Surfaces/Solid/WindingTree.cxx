// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Solid/WindingTree.h"

#include "Core/Geometry/PointBounds.h"
#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/Progress.h"
#include "Surfaces/Solid/SurfaceCuts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

constexpr double pi = 3.14159265358979323846;
// Triangles of a leaf; fewer make the tree deeper, more are counted one by one.
constexpr std::int64_t leaf = 8;
// A node counts as a whole beyond this many times its radius.
constexpr double far = 2.0;

// Half the cross product of two sides: the area, along the normal.
Point<3> areaVector(const std::array<Corner, 3>& corners)
{
  return 0.5 * cross(corners[1] - corners[0], corners[2] - corners[0]);
}

Point<3> centreOf(const std::array<Corner, 3>& corners)
{
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

} // namespace

WindingTree::WindingTree(const TriangleSurface& surface, const Context& context)
  : Surface(surface)
  , Order(static_cast<std::size_t>(surface.NumberOfTriangles))
{
  Progress progress(context);
  std::iota(this->Order.begin(), this->Order.end(), std::int64_t{ 0 });
  std::vector<Point<3>> centres(this->Order.size());
  for (std::size_t i = 0; i < centres.size(); ++i)
  {
    centres[i] = centreOf(cornersOf(surface, static_cast<std::int64_t>(i)));
  }
  progress.Check();
  if (!this->Order.empty())
  {
    this->Build(0, surface.NumberOfTriangles, centres);
  }
  progress.EndSlice(1);
}

// Halves the triangles at the median of their centres along the longest axis.
void WindingTree::Build(std::int64_t first, std::int64_t end, const std::vector<Point<3>>& centres)
{
  const std::size_t own = this->Nodes.size();
  this->Nodes.emplace_back();
  this->Nodes[own].First = first;
  this->Nodes[own].End = end;
  this->Summarize(this->Nodes[own]);
  if (end - first > leaf)
  {
    const auto centre = [&centres](std::int64_t triangle) {
      return centres[static_cast<std::size_t>(triangle)];
    };
    PointBounds bounds;
    for (std::int64_t i = first; i < end; ++i)
    {
      bounds.Add(centre(this->Order[static_cast<std::size_t>(i)]).data());
    }
    const std::size_t axis = static_cast<std::size_t>(bounds.Longest());
    const std::int64_t middle = first + (end - first) / 2;
    const auto begin = this->Order.begin();
    std::nth_element(
      begin + first, begin + middle, begin + end, [&](std::int64_t a, std::int64_t b) {
        // Equal places in one order, whatever the library.
        return std::make_pair(centre(a)[axis], a) < std::make_pair(centre(b)[axis], b);
      });
    this->Build(first, middle, centres);
    this->Build(middle, end, centres);
  }
  this->Nodes[own].Next = static_cast<std::int64_t>(this->Nodes.size());
}

void WindingTree::Summarize(Node& node) const
{
  Point<3> sum{};
  double area = 0.0;
  const auto forTriangles = [&](const auto& visit) {
    for (std::int64_t i = node.First; i < node.End; ++i)
    {
      visit(cornersOf(this->Surface, this->Order[static_cast<std::size_t>(i)]));
    }
  };
  forTriangles([&](const std::array<Corner, 3>& corners) {
    const double own = lengthOf(areaVector(corners));
    sum = sum + own * centreOf(corners);
    area += own;
  });
  // Triangles without an area count nothing; any place does for their centre.
  node.Centre = area > 0.0
    ? sum / area
    : centreOf(cornersOf(this->Surface, this->Order[static_cast<std::size_t>(node.First)]));
  node.Dipole = {};
  node.Gradient = {};
  double radius = 0.0; // squared
  forTriangles([&](const std::array<Corner, 3>& corners) {
    const Point<3> own = areaVector(corners);
    const Point<3> offset = centreOf(corners) - node.Centre;
    node.Dipole = node.Dipole + own;
    for (std::size_t i = 0; i < 3; ++i)
    {
      node.Gradient[i] += own[i] * offset[i];
    }
    node.Gradient[3] += own[0] * offset[1] + own[1] * offset[0];
    node.Gradient[4] += own[0] * offset[2] + own[2] * offset[0];
    node.Gradient[5] += own[1] * offset[2] + own[2] * offset[1];
    for (const Corner& corner : corners)
    {
      radius = std::max(radius, squaredDistance(corner, node.Centre));
    }
  });
  node.Reach = far * far * radius;
}

double WindingTree::At(const Point<3>& place) const
{
  double winding = 0.0;
  for (std::size_t i = 0; i < this->Nodes.size();)
  {
    const Node& node = this->Nodes[i];
    const Point<3> offset = node.Centre - place;
    const double squared = dot(offset, offset);
    if (squared > node.Reach)
    {
      winding += this->OfNode(node, offset, squared);
      i = static_cast<std::size_t>(node.Next);
      continue;
    }
    if (node.End - node.First <= leaf)
    {
      for (std::int64_t j = node.First; j < node.End; ++j)
      {
        winding += this->OfTriangle(this->Order[static_cast<std::size_t>(j)], place);
      }
    }
    ++i;
  }
  return winding / (4.0 * pi);
}

// The solid angle of the node's triangles. With d from the place to the centre, a triangle of area
// vector a at d + e has about a . (d + e) / |d + e|^3, whose terms up to e are
// a . d / |d|^3 + (a . e - 3 (a . d) (e . d) / |d|^2) / |d|^3.
double WindingTree::OfNode(const Node& node, const Point<3>& d, double squared) const
{
  const std::array<double, 6>& g = node.Gradient;
  const double trace = g[0] + g[1] + g[2];
  const double along = g[0] * d[0] * d[0] + g[1] * d[1] * d[1] + g[2] * d[2] * d[2] +
    g[3] * d[0] * d[1] + g[4] * d[0] * d[2] + g[5] * d[1] * d[2];
  return (dot(node.Dipole, d) + trace - 3.0 * along / squared) / (squared * std::sqrt(squared));
}

// The solid angle of a triangle (van Oosterom and Strackee 1983).
double WindingTree::OfTriangle(std::int64_t triangle, const Point<3>& place) const
{
  const std::array<Corner, 3> corners = cornersOf(this->Surface, triangle);
  const Point<3> a = corners[0] - place;
  const Point<3> b = corners[1] - place;
  const Point<3> c = corners[2] - place;
  const double la = lengthOf(a);
  const double lb = lengthOf(b);
  const double lc = lengthOf(c);
  return 2.0 *
    std::atan2(
      dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

} // namespace RectifiedTransport
