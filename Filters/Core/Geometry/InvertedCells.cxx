// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/InvertedCells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

PieceOutline firstCorners(std::int64_t count)
{
  PieceOutline outline(static_cast<std::size_t>(count));
  std::iota(outline.begin(), outline.end(), 0);
  return outline;
}

OrientedPiece facesOfPrism(std::int64_t sides)
{
  PieceOutline bottom = firstCorners(sides);
  std::reverse(bottom.begin() + 1, bottom.end());
  PieceOutline top = firstCorners(sides);
  std::for_each(top.begin(), top.end(), [sides](std::int64_t& corner) { corner += sides; });
  OrientedPiece faces{ bottom, top };
  for (std::int64_t i = 0; i < sides; ++i)
  {
    const std::int64_t next = (i + 1) % sides;
    faces.push_back({ i, next, sides + next, sides + i });
  }
  return faces;
}

// A signed length, area or volume, and what rounding may make of 0.
struct Measure
{
  double Value;
  double Rounding;
};

// Half the normal of an outline times its area, doubled (Newell), and the mean of its corners.
struct OutlineSums
{
  double Area[3] = { 0.0, 0.0, 0.0 };
  double Centre[3] = { 0.0, 0.0, 0.0 };
};

template <int D>
OutlineSums sumsOf(const PieceOutline& outline, ConstPointSpan<D> points)
{
  const double* origin = points[0];
  const auto at = [&](std::size_t i, double* x) {
    const double* point = points[outline[i % outline.size()]];
    std::transform(point, point + D, origin, x, std::minus<>());
  };
  OutlineSums sums;
  double x[3] = { 0.0, 0.0, 0.0 };
  double next[3] = { 0.0, 0.0, 0.0 };
  at(0, x);
  for (std::size_t i = 0; i < outline.size(); ++i)
  {
    at(i + 1, next);
    for (int a = 0; a < 3; ++a)
    {
      const int b = (a + 1) % 3;
      const int c = (a + 2) % 3;
      sums.Area[a] += x[b] * next[c] - x[c] * next[b];
      sums.Centre[a] += x[a] / static_cast<double>(outline.size());
    }
    std::copy_n(next, 3, x);
  }
  return sums;
}

template <int D>
double signedMeasure(const OrientedPiece& piece, ConstPointSpan<D> points)
{
  double value = 0.0;
  for (const PieceOutline& outline : piece)
  {
    if (outline.size() < 2)
    {
      continue;
    }
    if constexpr (D == 1)
    {
      value = points[outline[1]][0] - points[outline[0]][0];
    }
    else
    {
      const auto [area, centre] = sumsOf<D>(outline, points);
      value += D == 2 ? 0.5 * area[2]
                      : (centre[0] * area[0] + centre[1] * area[1] + centre[2] * area[2]) / 6.0;
    }
  }
  return value;
}

template <int D>
Measure measure(const OrientedPiece& piece, ConstPointSpan<D> points, double offset)
{
  double largest = offset;
  double extent = 0.0;
  for (const PieceOutline& outline : piece)
  {
    for (const std::int64_t corner : outline)
    {
      for (int a = 0; a < D; ++a)
      {
        const double x = points[corner][a];
        largest = std::max(largest, std::abs(x));
        extent = std::max(extent, std::abs(x - points[0][a]));
      }
    }
  }
  constexpr double steps = 64.0;
  double rounding = steps * std::numeric_limits<double>::epsilon() * largest;
  for (int a = 1; a < D; ++a)
  {
    rounding *= extent;
  }
  return { signedMeasure<D>(piece, points), rounding };
}

bool isEmpty(const OrientedPiece& piece)
{
  return std::all_of(
    piece.begin(), piece.end(), [](const PieceOutline& outline) { return outline.empty(); });
}

} // namespace

template <>
std::vector<OrientedPiece> orientedPieces<1>(OrientedShape shape, std::int64_t corners)
{
  const std::int64_t count = shape == OrientedShape::Line ? 2
    : shape == OrientedShape::PolyLine                    ? corners
                                                          : 0;
  std::vector<OrientedPiece> lines;
  for (std::int64_t i = 0; i + 1 < count; ++i)
  {
    lines.push_back({ { i, i + 1 } });
  }
  return lines;
}

template <>
std::vector<OrientedPiece> orientedPieces<2>(OrientedShape shape, std::int64_t corners)
{
  std::vector<OrientedPiece> pieces;
  if (shape == OrientedShape::Polygon)
  {
    pieces.push_back({ firstCorners(corners) });
  }
  else if (shape == OrientedShape::Pixel)
  {
    pieces.push_back({ { 0, 1, 3, 2 } });
  }
  for (std::int64_t i = 0; shape == OrientedShape::TriangleStrip && i + 2 < corners; ++i)
  {
    const std::int64_t odd = i % 2; // every other triangle runs the other way round
    pieces.push_back({ { i + odd, i + 1 - odd, i + 2 } });
  }
  return pieces;
}

template <>
std::vector<OrientedPiece> orientedPieces<3>(OrientedShape shape, std::int64_t /*corners*/)
{
  switch (shape)
  {
    case OrientedShape::Tetrahedron:
      return { { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 }, { 0, 2, 1 } } };
    case OrientedShape::Voxel:
      return { { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 2, 3, 1 },
        { 4, 5, 7, 6 } } };
    case OrientedShape::Hexahedron:
      return { { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 }, { 3, 7, 6, 2 }, { 0, 3, 2, 1 },
        { 4, 5, 6, 7 } } };
    case OrientedShape::Wedge:
      return { { { 0, 1, 2 }, { 3, 5, 4 }, { 0, 3, 4, 1 }, { 1, 4, 5, 2 }, { 2, 5, 3, 0 } } };
    case OrientedShape::Pyramid:
      return { { { 0, 3, 2, 1 }, { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } } };
    case OrientedShape::PentagonalPrism:
      return { facesOfPrism(5) };
    case OrientedShape::HexagonalPrism:
      return { facesOfPrism(6) };
    default:
      return {};
  }
}

template <int D>
void InvertedCells::AddCell(const std::vector<OrientedPiece>& pieces, ConstPointSpan<D> before,
  ConstPointSpan<D> after, double offset)
{
  if (std::all_of(pieces.begin(), pieces.end(), isEmpty))
  {
    return;
  }
  bool isOriented = false;
  bool isInverted = false;
  for (const OrientedPiece& piece : pieces)
  {
    const Measure old = measure<D>(piece, before, offset);
    const Measure moved = measure<D>(piece, after, offset);
    if (std::abs(old.Value) > old.Rounding)
    {
      isOriented = true;
      const bool isPieceInverted = std::copysign(1.0, old.Value) * moved.Value <= moved.Rounding;
      isInverted = isInverted || isPieceInverted;
      this->Area.Add(std::abs(moved.Value));
      this->InvertedArea.Add(isPieceInverted ? std::abs(moved.Value) : 0.0);
    }
  }
  this->All += isOriented ? 1 : 0;
  this->Inverted += isInverted ? 1 : 0;
}

template void InvertedCells::AddCell<1>(
  const std::vector<OrientedPiece>&, ConstPointSpan<1>, ConstPointSpan<1>, double);
template void InvertedCells::AddCell<2>(
  const std::vector<OrientedPiece>&, ConstPointSpan<2>, ConstPointSpan<2>, double);
template void InvertedCells::AddCell<3>(
  const std::vector<OrientedPiece>&, ConstPointSpan<3>, ConstPointSpan<3>, double);

} // namespace RectifiedTransport
