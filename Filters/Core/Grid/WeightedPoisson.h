// SPDX-License-Identifier: BSD-3-Clause
// Solves -div(max(floor, density) grad p) = r on the nodes of a box with natural boundaries, by the
// method of conjugate gradients.
#ifndef RectifiedTransport_WeightedPoisson_h
#define RectifiedTransport_WeightedPoisson_h

#include "Core/Grid/NodeGrid.h"

#include <cstdint>
#include <functional>

namespace RectifiedTransport
{

class Progress;

// The solver's arrays. NodePoisson preconditions: see there for what masses mean and who may call.
template <int Dimension>
class WeightedPoisson
{
public:
  // Solves Poisson's equation for the first, masses, into the second.
  using Preconditioner = std::function<void(const double*, double*)>;

  explicit WeightedPoisson(const NodeGrid<Dimension>& grid);

  // The first call takes the memory. Adds as many units of work as there are nodes, and for each
  // iteration four times as many and what the preconditioner adds.
  void Solve(const double* masses, const double* density, double floor, int iterations,
    const Preconditioner& precondition, double* p, Progress& progress);

  // Bytes.
  static double MemoryFor(const NodeGrid<Dimension>& grid);

private:
  template <class Kernel>
  void ForRows(std::int64_t first, std::int64_t last, const Kernel& kernel) const;
  void Begin(
    const double* masses, const double* density, double floor, double* p, Progress& progress);
  double Apply(Progress& progress);
  double ApplyToRow(std::int64_t row, std::int64_t node);

  const NodeGrid<Dimension> Grid;
  const std::int64_t Nodes;
  const std::int64_t Chunk;
  NodeValues Weights;
  NodeValues Residual; // what is left of the masses
  NodeValues Preconditioned;
  NodeValues Direction;
  NodeValues Image;
};

} // namespace RectifiedTransport

#endif
