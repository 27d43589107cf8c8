// SPDX-License-Identifier: BSD-3-Clause
// Linear systems with the Laplacian of a graph.
#ifndef RectifiedTransport_GraphLaplacian_h
#define RectifiedTransport_GraphLaplacian_h

#include "Core/Algebra/SparseCholesky.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// The matrix whose diagonal has the strengths of each node's edges, with minus the strengths beside
// it. It is singular: constants are not determined.
class GraphLaplacian
{
public:
  explicit GraphLaplacian(std::int64_t nodes)
    : Diagonal(static_cast<std::size_t>(nodes), 0.0)
  {
    constexpr std::size_t edgesOfNode = 3; // in the plane at most
    this->Edges.reserve(edgesOfNode * this->Diagonal.size());
  }

  // Each edge once, of its two nodes the smaller first.
  void AddEdge(std::int64_t first, std::int64_t second, double strength)
  {
    this->Diagonal[static_cast<std::size_t>(first)] += strength;
    this->Diagonal[static_cast<std::size_t>(second)] += strength;
    this->Edges.emplace_back(second, first, -strength);
  }

  // Replaces the right side by the solution, with this part of the mean of the diagonal added to
  // it. Returns false for a pivot of zero and a solution that is not finite. The order of
  // elimination is found in one piece, which cannot be cancelled: about a second for a million
  // nodes. Throws std::bad_alloc and Cancelled.
  bool Solve(double damping, std::vector<double>& values, Progress& progress) const;

private:
  std::vector<double> Diagonal;
  std::vector<Eigen::Triplet<InterruptibleReal>> Edges; // of the lower triangle
};

} // namespace RectifiedTransport

#endif
