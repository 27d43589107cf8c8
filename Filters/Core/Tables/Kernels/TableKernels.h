// SPDX-License-Identifier: BSD-3-Clause
// The kernels that build summed-area tables (paper, Algorithm 2), one set for each instruction set,
// and the choice among them.
#ifndef RectifiedTransport_TableKernels_h
#define RectifiedTransport_TableKernels_h

#include "Core/Parallel/InstructionSet.h"

#include <cstdint>

namespace RectifiedTransport
{

// The result of one pass over a row of grid cells. Sums are taken in eight lanes, in the same order
// for every instruction set.
struct RowInspection
{
  double Sum;
  double Moment; // about the low face of the first cell
  double Largest;
  double Smallest;
  std::int64_t Wrong; // values that are negative or not finite
};
using InspectRow = RowInspection (*)(const double* values, std::int64_t count);

// How many values of a row equal its largest one, and the largest of the others (0 if there are
// none).
struct RowMaximum
{
  std::int64_t Count;
  double Below;
};
using CountLargest = RowMaximum (*)(const double* values, std::int64_t count, double largest);

// Adds a row of grid cells to {f, f * centre} of every column.
using AddToColumns = void (*)(
  const double* values, std::int64_t count, double centre, double* columns, double* moments);

// Adds one row of grid cells, or a strip of it, to the row of nodes below and writes the sums.
// `Values` are the cells from the strip's start, `Prefix` the sums {f, f * centre along axis 0} of
// the row's cells before it. See TableBuild.cxx for the rest.
struct TableRow2D
{
  const double* Values;
  std::int64_t First; // first cell of the strip
  std::int64_t Count; // cells in the strip
  double Prefix[2];
  double Centre;       // along axis 1
  const double* Below; // the records of the strip's nodes First+1.. below this row of cells
  double* Nodes;       // output: the records above it
};
using AddTableRow2D = void (*)(const TableRow2D& row);

struct TableRow3D
{
  const double* Values;
  std::int64_t First;  // first cell of the row
  std::int64_t Count;  // cells in the row
  double Centre[2];    // along axes 1 and 2
  double* Columns;     // {f, f * centre 1} of each column of the slice so far, updated
  const double* Below; // the records of this row's nodes 1.. below this slice
  double* Nodes;       // output: the records above it
};
using AddTableRow3D = void (*)(const TableRow3D& row);

struct TableKernels
{
  InspectRow Inspect;
  CountLargest Largest;
  AddToColumns AddColumns;
  AddTableRow2D AddRow2D;
  AddTableRow3D AddRow3D;
};

// Compiled for each instruction set.
template <InstructionSet Set>
const TableKernels& tableKernelsOf();

// The sets for all instruction sets compute the same bits.
const TableKernels& tableKernels(InstructionSet set = instructionSet());

} // namespace RectifiedTransport

#endif
