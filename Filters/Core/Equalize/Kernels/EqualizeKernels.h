// SPDX-License-Identifier: BSD-3-Clause
// The loops of equalizeAreas over rows of the lattice, one set for each instruction set, and the
// choice among them.
#ifndef RectifiedTransport_EqualizeKernels_h
#define RectifiedTransport_EqualizeKernels_h

#include "Core/Parallel/InstructionSet.h"

#include <cstdint>

namespace RectifiedTransport
{

// A row of a lattice of points along axis 0, an array a coordinate.
template <int Dimension>
struct PointRow
{
  const double* X[Dimension];
};

// The rows of corners at and after a row of cells, by their offsets 0, 1, 2 along axis 1 and, in
// 3D, axis 2: row [offset1 + 3 * offset2]. Rows beyond the lattice repeat its last row.
template <int Dimension>
struct CellRow
{
  PointRow<Dimension> Corners[Dimension == 2 ? 3 : 9];
  std::int64_t Cells;
};

// The rows about a row of corners, by their offsets -1, 0, 1 in the same order. Rows beyond the
// lattice repeat the nearest one, so that their faces are empty.
template <int Dimension>
struct CornerRow
{
  PointRow<Dimension> Corners[Dimension == 2 ? 3 : 9];
  std::int64_t Cells; // along axis 0
  // At the cell of which this row's corners are the low ones: the weights of the cells' upper faces
  // along each axis, and the potential. A flux is a weight times a difference of the potential.
  const float* Weights[Dimension];
  const double* Potential;
  std::int64_t Stride[Dimension]; // distance of neighbouring cells along each axis
  float* Moves[Dimension];        // output, a corner each
};

// The same rows with their moves, and the multipliers of the rows of cells below (-1) and above (0)
// along axis 1, in 3D also axis 2: [offset1 + 1 + 2 * (offset2 + 1)]. Zeros where there are none.
template <int Dimension>
struct ProjectedRow
{
  PointRow<Dimension> Corners[Dimension == 2 ? 3 : 9];
  std::int64_t Cells;
  const float* Multipliers[Dimension == 2 ? 2 : 4];
  const float* Mobility;          // one for each corner
  const float* Before[Dimension]; // moves of the corners
  float* After[Dimension];        // output
};

template <int Dimension>
struct EqualizeKernels
{
  // Areas or volumes of the (multi)linear images of the cells.
  void (*Areas)(const CellRow<Dimension>& row, double* areas);
  // Weights of the upper faces along all axes; the last along axis 0 is 0.
  void (*Weights)(const CellRow<Dimension>& row, float* const* weights);
  // The moves of a row of corners that fit the fluxes through the faces about them.
  void (*Moves)(const CornerRow<Dimension>& row);

  // For each cell (target - area) / (sum over its corners of mobility * squared gradient of its
  // area). The mobilities' rows are those of the corners with offsets 0 and 1.
  void (*Multipliers)(const CellRow<Dimension>& row, const float* const* mobilities,
    const double* areas, const float* targets, float* multipliers);
  // The moves of a row of corners and the sum over their cells of multiplier * gradient,
  // times their mobility.
  void (*Project)(const ProjectedRow<Dimension>& row);
};

// Compiled for each instruction set.
template <int Dimension, InstructionSet Set>
EqualizeKernels<Dimension> equalizeKernelsOf();

// All compute the same bits.
template <int Dimension>
EqualizeKernels<Dimension> equalizeKernels(InstructionSet set = instructionSet());

} // namespace RectifiedTransport

#endif
