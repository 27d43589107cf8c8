// SPDX-License-Identifier: BSD-3-Clause
// A view of the summed-area tables (paper, Section 3.3) for kernels: plain pointers and numbers.
//
// A node record is {E, E_0} in 1D, {E, E_0, E_1, E} in 2D and {E, E_0, E_1, E_2} in 3D. E is the
// sum of the density over the grid cells below the node, E_a the sum of density times cell centre
// along axis a (paper, Algorithm 2). Level l holds every 4^l-th node; if 4^l does not divide the
// size, the last coarse cell is narrower.
#ifndef RectifiedTransport_TableView_h
#define RectifiedTransport_TableView_h

#include <cstdint>

namespace RectifiedTransport
{

// Cells of a level are 2^levelShift times as wide as those of the level before.
constexpr int levelShift = 2;

template <int Dimension>
struct TableView
{
  // Doubles a node. In 64 bits, because offsets in doubles need them.
  static constexpr std::int64_t Record = Dimension == 1 ? 2 : 4;
  static constexpr int MaximumLevels = 16;

  struct Level
  {
    const double* Nodes;
    std::int64_t Stride[Dimension]; // in doubles
  };

  // Nodes of uneven spacing, instead of those of levels.
  struct UnevenAxis
  {
    const std::int32_t* NodeBelow; // node at or below each grid cell
    const double* Places;          // places of the nodes, at whole grid cells
  };

  Level Levels[MaximumLevels];
  int LevelCount;
  bool IsUneven = false; // the only table is Levels[1], with its nodes as in Uneven
  UnevenAxis Uneven[Dimension] = {};
  // The part of the domain that the nodes cover and sum over. Only the finest level may cover a
  // part. Pointers to nodes are those of node 0 of the domain, even if that is not in the part.
  bool IsPart = false;
  double Low[Dimension];
  double High[Dimension];
  bool EvenLevels[Dimension]; // no level has a narrower last cell
  bool BeyondCaches;          // prefetching the finest level pays
  double Size[Dimension];
  double Centroid[Dimension];
  double VoidMass; // a box with at most this counts as empty
  double Largest;  // value of a cell

  // One bit a cell, rows padded to whole words; null if every cell has mass.
  const std::uint64_t* Occupied;
  std::int64_t WordsPerRow;
  std::int64_t Cells[Dimension];
};

} // namespace RectifiedTransport

#endif
