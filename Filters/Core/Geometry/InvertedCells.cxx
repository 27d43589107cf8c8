// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/InvertedCells.h"

#include "Core/Geometry/SimplexDeterminant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// The signed length, area or volume of the simplex that begins at a vertex.
template <int D>
double simplexMeasure(ConstPointSpan<D> vertices, std::int64_t first)
{
  std::array<Point<D>, D + 1> corners;
  for (Point<D>& corner : corners)
  {
    std::copy_n(vertices[first++], D, corner.data());
  }
  return determinant(corners) / simplicesOfBox<D>;
}

// A bound for what rounding may make of a measure that is 0: errors of coordinates (64 units in the
// last place of the largest), times the extent along the other axes.
template <int D>
double roundingOf(ConstPointSpan<D> vertices, double offset)
{
  double largest = offset;
  double extent = 0.0;
  for (std::int64_t i = 0; i < vertices.size(); ++i)
  {
    for (int a = 0; a < D; ++a)
    {
      const double x = vertices[i][a];
      largest = std::max(largest, std::abs(x));
      extent = std::max(extent, std::abs(x - vertices[0][a]));
    }
  }
  constexpr double steps = 64.0;
  double rounding = steps * std::numeric_limits<double>::epsilon() * largest;
  for (int a = 1; a < D; ++a)
  {
    rounding *= extent;
  }
  return rounding;
}

} // namespace

// Measures of the pieces of a cell before and after a move. The sign of the first is the
// orientation that a piece has to keep; a measure within rounding of 0 counts as lost.
template <int D>
void InvertedCells::AddCell(
  ConstPointSpan<D> before, ConstPointSpan<D> after, std::int64_t pieces, double offset)
{
  bool isOriented = false;
  bool isInverted = false;
  const std::int64_t vertices = before.size() / pieces;
  for (std::int64_t first = 0; first < before.size(); first += vertices)
  {
    double old = 0.0;
    double moved = 0.0;
    for (std::int64_t i = first; i < first + vertices; i += D + 1)
    {
      old += simplexMeasure<D>(before, i);
      moved += simplexMeasure<D>(after, i);
    }
    if (std::abs(old) > roundingOf<D>(before.Part(first, vertices), offset))
    {
      // A piece without a measure before has no orientation to lose.
      isOriented = true;
      const bool isPieceInverted =
        std::copysign(1.0, old) * moved <= roundingOf<D>(after.Part(first, vertices), offset);
      isInverted = isInverted || isPieceInverted;
      this->Area.Add(std::abs(moved));
      this->InvertedArea.Add(isPieceInverted ? std::abs(moved) : 0.0);
    }
  }
  this->All += isOriented ? 1 : 0;
  this->Inverted += isInverted ? 1 : 0;
}

template void InvertedCells::AddCell<1>(ConstPointSpan<1>, ConstPointSpan<1>, std::int64_t, double);
template void InvertedCells::AddCell<2>(ConstPointSpan<2>, ConstPointSpan<2>, std::int64_t, double);
template void InvertedCells::AddCell<3>(ConstPointSpan<3>, ConstPointSpan<3>, std::int64_t, double);

} // namespace RectifiedTransport
