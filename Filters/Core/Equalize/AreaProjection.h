// SPDX-License-Identifier: BSD-3-Clause
// Cimmino's simultaneous projections: every cell moves its corners along the gradient of its area
// to its target, and each corner takes the sum. Corrects errors on the scale of cells.
#ifndef RectifiedTransport_AreaProjection_h
#define RectifiedTransport_AreaProjection_h

#include "Core/Equalize/CornerLattice.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Rows of cells and of corners that take part in a sweep.
struct ActiveRows
{
  std::vector<unsigned char> OfCells;
  std::vector<unsigned char> OfCorners;
};

template <int Dimension>
class AreaProjection
{
public:
  explicit AreaProjection(CornerLattice<Dimension>& lattice);

  // To be called before the sweeps: `targets` are the areas that the cells shall have.
  void SetTargets(const float* targets, Progress& progress);
  // Changes the moves of the lattice. Units of progress: twice the
  // rows of corners, with states three times.
  void Sweep(Progress& progress);
  // Only of the cells with this bit in their states, which are in active rows.
  void Sweep(
    const unsigned char* states, unsigned char bit, const ActiveRows& rows, Progress& progress);

  static double Memory(const GridSize<Dimension>& size);

private:
  void FindMobility(std::int64_t cornerRow);
  void FindMultipliers(std::int64_t cellRow, typename CornerLattice<Dimension>::Rows& rows,
    std::vector<double>& areas);
  void Project(
    std::int64_t cornerRow, typename CornerLattice<Dimension>::Rows& rows, const float* none);

  void SweepRows(
    const ActiveRows* active, const unsigned char* states, unsigned char bit, Progress& progress);

  CornerLattice<Dimension>& Lattice;
  const EqualizeKernels<Dimension> Kernels;
  const float* Targets = nullptr;
  LargeBuffer<float> Mobility;    // of the corners
  LargeBuffer<float> Multipliers; // of the cells
};

} // namespace RectifiedTransport

#endif
