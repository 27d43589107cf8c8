// SPDX-License-Identifier: BSD-3-Clause
// The cells of a density that are not empty, and the density that empty ones count as.
#ifndef RectifiedTransport_OccupiedCells_h
#define RectifiedTransport_OccupiedCells_h

#include "Core/Parallel/ExactSum.h"
#include "Core/Tables/Reading/DensityRules.h"

#include <cstdint>
#include <limits>

namespace RectifiedTransport
{

// The same bits however cells are divided among threads and ranks. Trivially copyable.
struct OccupiedCells
{
  ExactSum Mass;  // the sum of their densities, in cells
  ExactSum Cells; // their number; a cell that data cover in part counts in part
  double Least = std::numeric_limits<double>::infinity();

  // Adds values, except those that are no density and those that `empty`, unless nullptr, marks.
  void Add(const double* values, const unsigned char* empty, std::int64_t count);
  void Add(const OccupiedCells& other);
};

// Returns the density of empty cells by the rule; 0 if all cells are empty.
double densityOfEmptyCells(const EmptyRule& rule, const OccupiedCells& filled);

// Adds to the values of `cells` cells the density of the part of each that data do not cover;
// `covered` are the other parts, `filled` the least density in them. Returns the density that was
// added. Throws Cancelled.
double fillEmptyParts(const double* covered, std::int64_t cells, OccupiedCells filled,
  const EmptyRule& rule, Progress& progress, double* values);

} // namespace RectifiedTransport

#endif
