// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/IntrinsicDelaunay.h"

#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/SurfaceEdges.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Sides = std::array<double, 3>;

// Four times the area of a triangle, without cancellation (Kahan 2014, "Miscalculating area and
// angles of a needle-like triangle"); at least a part of its longest side's square that keeps
// cotangents finite.
double areaTimesFour(Sides sides)
{
  // The area is at least 1e-14 / 4 of the longest side's square: cotangents are at most about 1e14.
  constexpr double least = 1e-14;
  std::sort(sides.begin(), sides.end());
  const auto [c, b, a] = sides;
  // Heron's formula for 16 area^2 with sides a >= b >= c, in the order of operations that Kahan
  // gives: the parentheses must stay.
  const double square = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return std::max(std::sqrt(std::max(square, 0.0)), least * a * a);
}

double square(double value)
{
  return value * value;
}

// Lawson's algorithm: flips edges that are not Delaunay, and looks again at those around them.
class DelaunayRun
{
public:
  DelaunayRun(const DiskMesh& disk, IntrinsicTriangles& triangles)
    : Triangles(triangles)
    , Others(3 * disk.NumberOfTriangles())
  {
    const ConstPointSpan<3> points = disk.Surface().Points;
    for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        const std::int64_t* corners = disk.Triangle(t);
        const Eigen::Map<const Eigen::Vector3d> from(points[corners[i]]);
        const Eigen::Map<const Eigen::Vector3d> to(points[corners[(i + 1) % 3]]);
        this->Points(t)[i] = corners[i];
        this->Lengths(t)[i] = (to - from).norm();
        const std::int64_t side = 3 * t + static_cast<std::int64_t>(i);
        this->Others.data()[side] = disk.Edges().Other(side);
      }
    }
    // Lengths alone count from here on; positions in space are no longer needed.
    this->Mollify(disk.NumberOfTriangles());
  }

  void Run(Progress& progress)
  {
    const std::int64_t sides = this->Others.size();
    std::vector<std::int64_t> stack;
    // Enough for all surfaces that were met; rounding must not let two edges flip for ever. What
    // remains are weights that may be negative.
    const std::int64_t most = 10 * sides;
    constexpr std::int64_t polled = std::int64_t{ 1 } << 16;
    std::int64_t flips = 0;
    progress.Expect(sides);
    for (std::int64_t start = 0; start < sides; ++start)
    {
      progress.Add(1);
      stack.push_back(start);
      while (!stack.empty())
      {
        const std::int64_t side = stack.back();
        stack.pop_back();
        if (!this->IsDelaunay(side) && flips < most)
        {
          const std::int64_t other = this->Others.data()[side];
          this->Flip(side, other);
          // A flip can only make the four outer edges of the two triangles violate the condition.
          // Two sides of each suffice: f is then (c, a, d) and g is (d, b, c), whose sides 0 and 1
          // are these.
          for (const std::int64_t triangle : { side / 3, other / 3 })
          {
            stack.push_back(3 * triangle);
            stack.push_back(3 * triangle + 1);
          }
          // Polled every so many flips: one start may cause long chains.
          if (++flips % polled == 0)
          {
            progress.Check();
          }
        }
      }
    }
  }

private:
  std::array<std::int64_t, 3>& Points(std::int64_t t) { return this->Triangles.Points.data()[t]; }
  Sides& Lengths(std::int64_t t) { return this->Triangles.Lengths.data()[t]; }

  // Adds the same length to all sides so that every triangle has l_i + l_j - l_k > 0 with a margin
  // (Sharp and Crane 2020). Nothing changes for surfaces that have it already.
  void Mollify(std::int64_t count)
  {
    constexpr double margin = 1e-12; // margin by the mean length
    double sum = 0.0;
    // The most by which a side exceeds the sum of the other two.
    double excess = -std::numeric_limits<double>::infinity();
    for (std::int64_t t = 0; t < count; ++t)
    {
      const Sides& l = this->Lengths(t);
      sum += l[0] + l[1] + l[2];
      excess = std::max({ excess, l[0] - l[1] - l[2], l[1] - l[2] - l[0], l[2] - l[0] - l[1] });
    }
    const double growth = margin * sum / (3.0 * static_cast<double>(count)) + excess;
    for (std::int64_t t = 0; growth > 0.0 && t < count; ++t)
    {
      for (double& length : this->Lengths(t))
      {
        length += growth;
      }
    }
  }

  // An edge is Delaunay if the angles opposite to it sum to at most pi: cot alpha + cot beta >= 0.
  // A sum that rounding alone makes negative must not flip to and fro. Boundary edges, and those
  // between two sides of one triangle, cannot flip.
  bool IsDelaunay(std::int64_t side)
  {
    constexpr double rounding = 1e-10;
    const std::int64_t other = this->Others.data()[side];
    if (other < 0 || other / 3 == side / 3)
    {
      return true;
    }
    // The angle opposite to side i of a triangle is at the corner that the side does not have.
    const double a = this->Triangles.Cotangents(side / 3)[static_cast<std::size_t>(side % 3)];
    const double b = this->Triangles.Cotangents(other / 3)[static_cast<std::size_t>(other % 3)];
    return a + b >= -rounding * (1.0 + std::abs(a) + std::abs(b));
  }

  // Changes the two triangles as flipEdge changes their sides.
  void Flip(std::int64_t side, std::int64_t other)
  {
    const std::int64_t f = side / 3;
    const std::int64_t g = other / 3;
    const auto i = static_cast<std::size_t>(side % 3);
    const auto j = static_cast<std::size_t>(other % 3);
    // Triangle f is (a, b, c), and g is (b, a, d) from its side j on; they share the edge ab.
    const std::int64_t a = this->Points(f)[i];
    const std::int64_t b = this->Points(f)[(i + 1) % 3];
    const std::int64_t c = this->Points(f)[(i + 2) % 3];
    const std::int64_t d = this->Points(g)[(j + 2) % 3];
    const double ab = this->Lengths(f)[i];
    const double bc = this->Lengths(f)[(i + 1) % 3];
    const double ca = this->Lengths(f)[(i + 2) % 3];
    const double ad = this->Lengths(g)[(j + 1) % 3];
    const double db = this->Lengths(g)[(j + 2) % 3];
    // In the plane with a at 0 and b at (ab, 0), c is above and d below.
    const double cx = (square(ab) + square(ca) - square(bc)) / (2.0 * ab);
    const double dx = (square(ab) + square(ad) - square(db)) / (2.0 * ab);
    const double cy = areaTimesFour({ ab, bc, ca }) / (2.0 * ab);
    const double dy = -areaTimesFour({ ab, ad, db }) / (2.0 * ab);
    const double cd = std::hypot(cx - dx, cy - dy);

    // The new edge is cd, the diagonal of the two triangles unfolded into the plane.
    flipEdge(this->Others.data(), side, other);
    this->Points(f) = { c, a, d };
    this->Lengths(f) = { ca, ad, cd };
    this->Points(g) = { d, b, c };
    this->Lengths(g) = { db, bc, cd };
  }

  IntrinsicTriangles& Triangles;
  LargeBuffer<std::int64_t> Others;
};

} // namespace

// cot(angle opposite to l_i) = (l_j^2 + l_k^2 - l_i^2) / (4 area), by the law of cosines.
std::array<double, 3> IntrinsicTriangles::Cotangents(std::int64_t triangle) const
{
  const Sides& l = this->Lengths.data()[triangle];
  const double area = areaTimesFour(l);
  const auto cotangent = [&](std::size_t i) {
    return (square(l[(i + 1) % 3]) + square(l[(i + 2) % 3]) - square(l[i])) / area;
  };
  return { cotangent(0), cotangent(1), cotangent(2) };
}

IntrinsicTriangles triangulateDelaunay(const DiskMesh& disk, const Context& context)
{
  Progress progress(context);
  IntrinsicTriangles triangles{ LargeBuffer<std::array<std::int64_t, 3>>(disk.NumberOfTriangles()),
    LargeBuffer<std::array<double, 3>>(disk.NumberOfTriangles()) };
  DelaunayRun(disk, triangles).Run(progress);
  return triangles;
}

} // namespace RectifiedTransport
