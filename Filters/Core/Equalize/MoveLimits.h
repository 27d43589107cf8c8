// SPDX-License-Identifier: BSD-3-Clause
// Cells that the moves of a pass would fold, and what is done about them.
#ifndef RectifiedTransport_MoveLimits_h
#define RectifiedTransport_MoveLimits_h

#include "Core/Equalize/AreaProjection.h"
#include "Core/Equalize/CornerLattice.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Of cells, whose masses have the mean one.
struct AreaSums
{
  double Missing = 0.0; // mass - area
  double Error = 0.0;
  std::int64_t Folded = 0; // with mass, but without a positive area
  std::int64_t Failed = 0; // those that a move takes too much of the area of
};

AreaSums operator+(const AreaSums& a, const AreaSums& b);

template <int Dimension>
class MoveLimits
{
public:
  MoveLimits(CornerLattice<Dimension>& lattice, AreaProjection<Dimension>& projection);

  // Before the moves, for each row of cells: what they shall keep.
  void Guard(std::int64_t cellRow, const float* targets, const double* areas);
  AreaSums SumOfRows() const;

  // Changes the moves, until every cell keeps enough, or no more than `folded` cells are folded.
  // `targets` are those of all cells. Returns the sums of the moved cells; `limited` becomes at
  // least the number of cells that needed it.
  AreaSums Apply(
    const float* targets, std::int64_t folded, std::int64_t& limited, Progress& progress);
  void HalveMoves(Progress& progress);

  static double Memory(const GridSize<Dimension>& size);

private:
  void Measure(const float* targets, Progress& progress);
  AreaSums Judge(std::int64_t cellRow, const float* targets, const double* areas);
  void ActivateRows();
  void Shorten(float factor, Progress& progress);
  void ShortenRow(std::int64_t cornerRow, float factor);

  CornerLattice<Dimension>& Lattice;
  AreaProjection<Dimension>& Projection;
  const EqualizeKernels<Dimension> Kernels;
  LargeBuffer<unsigned char> States;
  LargeBuffer<float> Least; // area that a guarded cell shall keep
  std::vector<AreaSums> RowSums;
  ActiveRows Active;
};

} // namespace RectifiedTransport

#endif
