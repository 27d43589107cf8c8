// SPDX-License-Identifier: BSD-3-Clause
// Poisson's equation on the nodes of a box with natural boundaries, by cosine transforms.
#ifndef RectifiedTransport_NodePoisson_h
#define RectifiedTransport_NodePoisson_h

#include "Core/Grid/NodeGrid.h"

#include <memory>

namespace RectifiedTransport
{

class Progress;

// The mass of each node is that of its hat function; the whole box has volume 1. Nodes at the
// border stand for a part of a cell: half of one for each side that they lie on. Reusable, but by
// one caller at a time. All results have the same bits for every number of threads. Each solution
// adds units of work: the nodes, for each axis and transform, and for the other loops. Throws
// Cancelled and std::bad_alloc.
template <int Dimension>
class NodePoisson
{
public:
  explicit NodePoisson(const NodeGrid<Dimension>& grid);
  ~NodePoisson();

  // p with -Laplace p = r and mean 0, for masses r whose sum is taken as 0.
  void Solve(const double* masses, double* p, Progress& progress);
  // The same for -div(max(floor, density) grad p) = r, by so many iterations of the method of
  // conjugate gradients, preconditioned by Solve. The density is given by the masses of its nodes,
  // which sum to 1.
  void SolveWeighted(const double* masses, const double* density, double floor, int iterations,
    double* p, Progress& progress);

  // Bytes that an object holds at most, with a thread a processor.
  static double MemoryFor(const NodeGrid<Dimension>& grid, bool weighted);

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace RectifiedTransport

#endif
