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

// L(i, i) is the sum of the strengths of node i's edges, and L(i, j) is minus the strength of the
// edge between i and j. So x^T L x is the sum over edges of strength * (x_i - x_j)^2. The matrix is
// singular: constants are not determined.
class GraphLaplacian
{
public:
  explicit GraphLaplacian(std::int64_t nodes)
    : Diagonal(static_cast<std::size_t>(nodes), 0.0)
  {
    constexpr std::size_t edgesOfNode = 3; // a planar graph of n nodes has at most 3 n - 6 edges
    this->Edges.reserve(edgesOfNode * this->Diagonal.size());
  }

  // Begins another graph of the nodes.
  void RemoveEdges();
  // Call it once for each edge, the smaller node first.
  void AddEdge(std::int64_t first, std::int64_t second, double strength)
  {
    this->Diagonal[static_cast<std::size_t>(first)] += strength;
    this->Diagonal[static_cast<std::size_t>(second)] += strength;
    this->Edges.emplace_back(second, first, -strength);
  }

  // Adds `damping` times the mean of the diagonal to the diagonal. Returns false for a pivot of
  // zero. A graph that differs little from the previous one keeps its order of elimination. The
  // search for an order cannot be cancelled: about a second for a million nodes. Throws
  // std::bad_alloc and Cancelled.
  bool Factorize(double damping, Progress& progress);
  // Replaces the right side by the solution for the matrix that was factorized last. Returns false
  // if it is not finite.
  bool Solve(std::vector<double>& values) const;

private:
  void Analyze(const SparseCholesky::Matrix& lower, Progress& progress);

  std::vector<double> Diagonal;
  std::vector<Eigen::Triplet<InterruptibleReal>> Edges; // entries of the lower triangle
  SparseCholesky System;
  Eigen::Index Ordered = 0; // entries of the factor for which the order was found
};

} // namespace RectifiedTransport

#endif
