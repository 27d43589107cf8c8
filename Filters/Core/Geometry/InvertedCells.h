// SPDX-License-Identifier: BSD-3-Clause
// The cells that a move of their corners inverts.
#ifndef RectifiedTransport_InvertedCells_h
#define RectifiedTransport_InvertedCells_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/ExactSum.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Corners are numbered as those of VTK's linear cells.
enum class OrientedShape
{
  None, // has no orientation
  Line,
  PolyLine,
  Polygon,
  Pixel,
  TriangleStrip,
  Tetrahedron,
  Voxel,
  Hexahedron,
  Wedge,
  Pyramid,
  PentagonalPrism,
  HexagonalPrism
};

// Corners of a cell by their numbers: a line, the outline of a polygon or of a face.
using PieceOutline = std::vector<std::int64_t>;
// What has an orientation of its own: one line, one polygon, or the faces of one volume.
using OrientedPiece = std::vector<PieceOutline>;

// The pieces of a cell with so many corners; none if the shape is not of D dimensions.
template <int D>
std::vector<OrientedPiece> orientedPieces(OrientedShape shape, std::int64_t corners);

struct InvertedCells
{
  std::int64_t Inverted = 0;
  std::int64_t All = 0; // that have an orientation
  // The sums of the measures of their pieces, as they are moved.
  ExactSum InvertedArea{};
  ExactSum Area{};

  void Add(const InvertedCells& other)
  {
    this->Inverted += other.Inverted;
    this->All += other.All;
    this->InvertedArea.Add(other.InvertedArea);
    this->Area.Add(other.Area);
  }

  // Adds a cell by the places of its corners before and after a move. It has an orientation if the
  // signed length, area or volume of a piece is not 0 before, and is inverted if that has the other
  // sign or is 0 after. `offset`: the largest coordinate of the places before their rounding.
  template <int D>
  void AddCell(const std::vector<OrientedPiece>& pieces, ConstPointSpan<D> before,
    ConstPointSpan<D> after, double offset);
};

} // namespace RectifiedTransport

#endif
