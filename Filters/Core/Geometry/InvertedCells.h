// SPDX-License-Identifier: BSD-3-Clause
// The cells that a move of their points inverts.
#ifndef RectifiedTransport_InvertedCells_h
#define RectifiedTransport_InvertedCells_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/ExactSum.h"

#include <cstdint>

namespace RectifiedTransport
{

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

  // Adds a cell by the vertices of its simplices before and after a move, D + 1 for each simplex.
  // Its pieces have equally many of them, one piece after the other. The signed length, area or
  // volume of a piece is the sum of those of its simplices. A cell has an orientation if that is
  // not 0 before, for one of its pieces, and is inverted if it has the other sign or is 0 after.
  // `offset`: the largest coordinate of the vertices before their rounding.
  template <int D>
  void AddCell(
    ConstPointSpan<D> before, ConstPointSpan<D> after, std::int64_t pieces, double offset);
};

} // namespace RectifiedTransport

#endif
