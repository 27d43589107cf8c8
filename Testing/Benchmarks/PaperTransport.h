// SPDX-License-Identifier: BSD-3-Clause
// Algorithms 1 and 2 of Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport with Rectified
// Flows", ACM TOG 44(4), 2025, transcribed as they stand: scalar, one table a quantity, RK4 with
// uniform steps. The baseline of the benchmarks, and the tables of the tests' oracle. It shares
// nothing with Filters/Core.
//
// All coordinates are in cells, axis 0 (x) runs fastest. Where the page is misprinted this is what
// it means: a box sum takes + + - - of its corners, and inside a cell the moment grows by the mass
// of the part of the cell's column times its centre, so that the differences along the own axis are
// those of the mass table, not of the moment table.
#ifndef RectifiedTransport_PaperTransport_h
#define RectifiedTransport_PaperTransport_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport::Paper
{

template <std::size_t Dimension>
using Vector = std::array<double, Dimension>;

template <std::size_t Dimension>
using Size = std::array<std::int64_t, Dimension>;

// The integrals of f and of x_a f over a box.
template <std::size_t Dimension>
struct Integrals
{
  double Mass;
  Vector<Dimension> Moment;
};

// E^pi, E^x, E^y (and E^z) of (S+1)^Dimension nodes, and the image, which is not owned.
template <std::size_t Dimension>
struct Tables
{
  Size<Dimension> Cells;
  const double* Image;
  std::vector<double> Mass;
  std::array<std::vector<double>, Dimension> Moment;
};

inline Tables<1> buildTables(const std::vector<double>& image, const Size<1>& cells)
{
  const std::size_t nodes = static_cast<std::size_t>(cells[0] + 1);
  Tables<1> tables{ cells, image.data(), std::vector<double>(nodes),
    { std::vector<double>(nodes) } };
  for (std::int64_t j = 0; j < cells[0]; ++j)
  {
    tables.Mass[j + 1] = tables.Mass[j] + image[j];
    tables.Moment[0][j + 1] = tables.Moment[0][j] + image[j] * (static_cast<double>(j) + 0.5);
  }
  return tables;
}

inline Tables<2> buildTables(const std::vector<double>& image, const Size<2>& cells)
{
  const std::int64_t width = cells[0];
  const std::int64_t height = cells[1];
  const std::int64_t row = width + 1;
  const std::size_t nodes = static_cast<std::size_t>(row * (height + 1));
  Tables<2> tables{ cells, image.data(), std::vector<double>(nodes),
    { std::vector<double>(nodes), std::vector<double>(nodes) } };
  double* mass = tables.Mass.data();
  double* momentX = tables.Moment[0].data();
  double* momentY = tables.Moment[1].data();
  for (std::int64_t i = 0; i < height; ++i)
  {
    for (std::int64_t j = 0; j < width; ++j)
    {
      const double value = image[i * width + j];
      const std::int64_t n00 = i * row + j;
      const std::int64_t n01 = n00 + 1;
      const std::int64_t n10 = n00 + row;
      const std::int64_t n11 = n10 + 1;
      mass[n11] = mass[n10] + mass[n01] - mass[n00] + value;
      momentX[n11] =
        momentX[n10] + momentX[n01] - momentX[n00] + value * (static_cast<double>(j) + 0.5);
      momentY[n11] =
        momentY[n10] + momentY[n01] - momentY[n00] + value * (static_cast<double>(i) + 0.5);
    }
  }
  return tables;
}

inline Tables<3> buildTables(const std::vector<double>& image, const Size<3>& cells)
{
  const std::int64_t width = cells[0];
  const std::int64_t height = cells[1];
  const std::int64_t depth = cells[2];
  const std::int64_t row = width + 1;
  const std::int64_t slice = row * (height + 1);
  const std::size_t nodes = static_cast<std::size_t>(slice * (depth + 1));
  Tables<3> tables{ cells, image.data(), std::vector<double>(nodes),
    { std::vector<double>(nodes), std::vector<double>(nodes), std::vector<double>(nodes) } };
  for (std::int64_t k = 0; k < depth; ++k)
  {
    for (std::int64_t j = 0; j < height; ++j)
    {
      for (std::int64_t i = 0; i < width; ++i)
      {
        const double value = image[(k * height + j) * width + i];
        const std::int64_t node = k * slice + j * row + i;
        const auto accumulate = [=](double* e, double term) {
          e[node + slice + row + 1] = e[node + slice + row] + e[node + slice + 1] +
            e[node + row + 1] - e[node + slice] - e[node + row] - e[node + 1] + e[node] + term;
        };
        accumulate(tables.Mass.data(), value);
        accumulate(tables.Moment[0].data(), value * (static_cast<double>(i) + 0.5));
        accumulate(tables.Moment[1].data(), value * (static_cast<double>(j) + 0.5));
        accumulate(tables.Moment[2].data(), value * (static_cast<double>(k) + 0.5));
      }
    }
  }
  return tables;
}

inline Integrals<1> interpolate(const Tables<1>& tables, double x)
{
  const std::int64_t i = std::min(static_cast<std::int64_t>(x), tables.Cells[0] - 1);
  const double floorX = static_cast<double>(i);
  const double cell = tables.Image[i] * (x - floorX);
  return { tables.Mass[i] + cell, { tables.Moment[0][i] + cell * 0.5 * (x + floorX) } };
}

// Lerp, interp_x and interp_y at one corner: the integrals over [0,x] x [0,y]. The cell's value
// closes the bilinear patch: 8 loads.
inline Integrals<2> interpolate(const Tables<2>& tables, double x, double y)
{
  const std::int64_t i = std::min(static_cast<std::int64_t>(x), tables.Cells[0] - 1);
  const std::int64_t j = std::min(static_cast<std::int64_t>(y), tables.Cells[1] - 1);
  const double floorX = static_cast<double>(i);
  const double floorY = static_cast<double>(j);
  const double fractionX = x - floorX;
  const double fractionY = y - floorY;
  const std::int64_t node = j * (tables.Cells[0] + 1) + i;
  const std::int64_t above = node + tables.Cells[0] + 1;
  const double* mass = tables.Mass.data();
  const double* momentX = tables.Moment[0].data();
  const double* momentY = tables.Moment[1].data();
  const double cell = tables.Image[j * tables.Cells[0] + i] * fractionX * fractionY;
  const double alongX = (mass[node + 1] - mass[node]) * fractionX;
  const double alongY = (mass[above] - mass[node]) * fractionY;
  return { mass[node] + alongX + alongY + cell,
    { momentX[node] + (momentX[above] - momentX[node]) * fractionY +
        (alongX + cell) * 0.5 * (x + floorX),
      momentY[node] + (momentY[node + 1] - momentY[node]) * fractionX +
        (alongY + cell) * 0.5 * (y + floorY) } };
}

// The same in 3D: trilinear, and quadratic along a moment's own axis: 20 loads (with every table
// read on its own, 32, it was measured slower).
inline Integrals<3> interpolate(const Tables<3>& tables, double x, double y, double z)
{
  const std::int64_t i = std::min(static_cast<std::int64_t>(x), tables.Cells[0] - 1);
  const std::int64_t j = std::min(static_cast<std::int64_t>(y), tables.Cells[1] - 1);
  const std::int64_t k = std::min(static_cast<std::int64_t>(z), tables.Cells[2] - 1);
  const double floorX = static_cast<double>(i);
  const double floorY = static_cast<double>(j);
  const double floorZ = static_cast<double>(k);
  const double u = x - floorX;
  const double v = y - floorY;
  const double w = z - floorZ;
  const std::int64_t row = tables.Cells[0] + 1;
  const std::int64_t slice = row * (tables.Cells[1] + 1);
  const std::int64_t node = k * slice + j * row + i;
  const auto bilinear = [](const double* e, std::int64_t stepP, std::int64_t stepQ, double p,
                          double q) {
    const double e0 = e[0] + (e[stepP] - e[0]) * p;
    const double e1 = e[stepQ] + (e[stepQ + stepP] - e[stepQ]) * p;
    return e0 + (e1 - e0) * q;
  };
  const double* mass = tables.Mass.data() + node;
  const double mass0 = bilinear(mass, row, slice, v, w);
  const double alongX = (bilinear(mass + 1, row, slice, v, w) - mass0) * u;
  const double alongY = (bilinear(mass + row, 1, slice, u, w) - bilinear(mass, 1, slice, u, w)) * v;
  const double alongZ = (bilinear(mass + slice, 1, row, u, v) - bilinear(mass, 1, row, u, v)) * w;
  return { mass0 + alongX,
    { bilinear(tables.Moment[0].data() + node, row, slice, v, w) + alongX * 0.5 * (x + floorX),
      bilinear(tables.Moment[1].data() + node, 1, slice, u, w) + alongY * 0.5 * (y + floorY),
      bilinear(tables.Moment[2].data() + node, 1, row, u, v) + alongZ * 0.5 * (z + floorZ) } };
}

template <std::size_t Dimension>
void accumulate(Integrals<Dimension>& sum, double sign, const Integrals<Dimension>& corner)
{
  sum.Mass += sign * corner.Mass;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
  {
    sum.Moment[axis] += sign * corner.Moment[axis];
  }
}

inline Integrals<1> integrate(const Tables<1>& tables, const Vector<1>& a, const Vector<1>& b)
{
  Integrals<1> sum = interpolate(tables, b[0]);
  accumulate(sum, -1.0, interpolate(tables, a[0]));
  return sum;
}

inline Integrals<2> integrate(const Tables<2>& tables, const Vector<2>& a, const Vector<2>& b)
{
  Integrals<2> sum = interpolate(tables, b[0], b[1]);
  accumulate(sum, -1.0, interpolate(tables, a[0], b[1]));
  accumulate(sum, -1.0, interpolate(tables, b[0], a[1]));
  accumulate(sum, 1.0, interpolate(tables, a[0], a[1]));
  return sum;
}

inline Integrals<3> integrate(const Tables<3>& tables, const Vector<3>& a, const Vector<3>& b)
{
  Integrals<3> sum = interpolate(tables, b[0], b[1], b[2]);
  accumulate(sum, -1.0, interpolate(tables, a[0], b[1], b[2]));
  accumulate(sum, -1.0, interpolate(tables, b[0], a[1], b[2]));
  accumulate(sum, 1.0, interpolate(tables, a[0], a[1], b[2]));
  accumulate(sum, -1.0, interpolate(tables, b[0], b[1], a[2]));
  accumulate(sum, 1.0, interpolate(tables, a[0], b[1], a[2]));
  accumulate(sum, 1.0, interpolate(tables, b[0], a[1], a[2]));
  accumulate(sum, -1.0, interpolate(tables, a[0], a[1], a[2]));
  return sum;
}

// What Velocity returns at t = 1, where the box is a point and the formula 0/0.
enum class FinalVelocity
{
  Zero, // the authors' code
  Limit // x - S/2
};

// Algorithm 1. At t = 0 the bounds are infinite and the clip makes the whole box of them. The
// second clip of each bound only matters for stages that leave the box.
template <std::size_t Dimension>
Vector<Dimension> velocity(const Tables<Dimension>& tables, const Vector<Dimension>& x, double t,
  FinalVelocity finalVelocity)
{
  Vector<Dimension> v;
  if (t >= 1.0)
  {
    for (std::size_t axis = 0; axis < Dimension; ++axis)
    {
      const double side = static_cast<double>(tables.Cells[axis]);
      v[axis] = finalVelocity == FinalVelocity::Limit ? x[axis] - 0.5 * side : 0.0;
    }
    return v;
  }
  Vector<Dimension> a;
  Vector<Dimension> b;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
  {
    const double side = static_cast<double>(tables.Cells[axis]);
    a[axis] = std::min(side, std::max(0.0, side - (side - x[axis]) / t));
    b[axis] = std::max(0.0, std::min(side, x[axis] / t));
  }
  const Integrals<Dimension> box = integrate(tables, a, b);
  for (std::size_t axis = 0; axis < Dimension; ++axis)
  {
    v[axis] = (box.Moment[axis] / box.Mass - x[axis]) / (1.0 - t);
  }
  return v;
}

template <std::size_t Dimension>
Vector<Dimension> moved(const Vector<Dimension>& x, const Vector<Dimension>& v, double by)
{
  Vector<Dimension> y;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
  {
    y[axis] = x[axis] + by * v[axis];
  }
  return y;
}

// A step of RK4 of the length `dt`, which is negative backward.
template <std::size_t Dimension>
void step(const Tables<Dimension>& tables, Vector<Dimension>& x, double t0, double t1, double t2,
  double dt, FinalVelocity finalVelocity)
{
  const Vector<Dimension> v1 = velocity(tables, x, t0, finalVelocity);
  const Vector<Dimension> v2 = velocity(tables, moved(x, v1, 0.5 * dt), t1, finalVelocity);
  const Vector<Dimension> v3 = velocity(tables, moved(x, v2, 0.5 * dt), t1, finalVelocity);
  const Vector<Dimension> v4 = velocity(tables, moved(x, v3, dt), t2, finalVelocity);
  for (std::size_t axis = 0; axis < Dimension; ++axis)
  {
    x[axis] += (v1[axis] + 2.0 * (v2[axis] + v3[axis]) + v4[axis]) * (dt / 6.0);
  }
}

// Algorithm 2 without its tables: moves each point from t = 0 to t = 1 in `steps` steps of RK4.
template <std::size_t Dimension>
void advect(const Tables<Dimension>& tables, std::vector<Vector<Dimension>>& points, int steps,
  FinalVelocity finalVelocity)
{
  const double dt = 1.0 / steps;
  for (Vector<Dimension>& x : points)
  {
    for (int i = 0; i < steps; ++i)
    {
      const double t0 = static_cast<double>(i) / steps;
      const double t1 = (i + 0.5) / steps;
      const double t2 = static_cast<double>(i + 1) / steps;
      step(tables, x, t0, t1, t2, dt, finalVelocity);
    }
  }
}

// The same from t = 1 to t = 0 (Section 5.4), with the limit at t = 1: with zero nothing moves in
// the first stage.
template <std::size_t Dimension>
void retrace(const Tables<Dimension>& tables, Vector<Dimension>& x, int steps)
{
  for (int i = steps; i > 0; --i)
  {
    const double t0 = static_cast<double>(i) / steps;
    const double t1 = (i - 0.5) / steps;
    const double t2 = static_cast<double>(i - 1) / steps;
    step(tables, x, t0, t1, t2, -1.0 / steps, FinalVelocity::Limit);
  }
}

template <std::size_t Dimension>
void retrace(const Tables<Dimension>& tables, std::vector<Vector<Dimension>>& points, int steps)
{
  for (Vector<Dimension>& x : points)
  {
    retrace(tables, x, steps);
  }
}

} // namespace RectifiedTransport::Paper

#endif
