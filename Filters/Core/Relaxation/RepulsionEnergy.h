// SPDX-License-Identifier: BSD-3-Clause
// The energy that relaxByRepulsion lowers, and its gradient.
#ifndef RectifiedTransport_RepulsionEnergy_h
#define RectifiedTransport_RepulsionEnergy_h

#include "Core/Relaxation/NeighbourTree.h"
#include "Core/Relaxation/RelaxationEnergy.h"
#include "Core/Relaxation/SpacingTree.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

struct RepulsionWidth
{
  double Deviation; // standard deviation s of the Gaussians, in spacings
  double Cut;       // the kernel ends where exp(-q) is exp(-Cut)

  // The squared distance at which the kernel ends, per unit of the sum of two squared spacings: q =
  // |x - y|^2 / (2 s^2 (h^2 + k^2)) = Cut.
  double Reach() const { return 2.0 * this->Cut * this->Deviation * this->Deviation; }
};

// The points x and the density n, scaled to their number N, are blurred by Gaussians. The energy is
// the squared norm of the difference,
//   E = 1/N (sum over points of K(x, y) - 2 sum of A(x) + integral of n A), A(x) = integral of n K,
// with K of RepulsionShape. It is 1 on average for independent random points, 0 at best. A does not
// depend on the points and is interpolated in the tree. Coordinates are those of a RelaxationFrame.
template <int Dimension>
class RepulsionEnergy final : public RelaxationEnergy<Dimension>
{
public:
  RepulsionEnergy(const RectifiedFlow<Dimension>& flow, const RelaxationFrame<Dimension>& frame,
    const SpacingTree<Dimension>& tree, std::int64_t points, const RepulsionWidth& width,
    Progress& progress);

  // For speed: call it again after large displacements.
  void Sort(ConstPointSpan<Dimension> points, Progress& progress) override;
  double Evaluate(ConstPointSpan<Dimension> points, PointSpan<Dimension> gradient, double* spacings,
    Progress& progress) override;

private:
  // Returns the masses of the leaves, at their centroids.
  NeighbourTree<Dimension> FindSources(Progress& progress) const;
  // Values and first derivatives of A at the nodes.
  typename SpacingTree<Dimension>::Field SumAttraction(
    const NeighbourTree<Dimension>& sources, Progress& progress) const;
  // Computes A at the nodes (Fields) and the integral of n A (Constant).
  void FindAttraction(Progress& progress);

  const RectifiedFlow<Dimension>& Flow;
  const RelaxationFrame<Dimension> Frame;
  const SpacingTree<Dimension>& Tree;
  const double Count;
  const RepulsionKernels<Dimension> Kernels;
  RepulsionShape Shape;
  double Reach;
  // The spacing h and the attraction A at the nodes of the tree.
  typename SpacingTree<Dimension>::template FieldOf<ValuePair> Fields;
  double Constant = 0.0;
  NeighbourTree<Dimension> Particles;
  // For each point in the order of Particles: h and A there, and the leaf that contains it.
  std::vector<HermiteData<Dimension, ValuePair>> AtPoints;
  std::vector<std::int64_t> Leaves;
  std::vector<double> Parts; // each block's part in N E
};

// A bound of the spacings, and so of the widths of kernels, for points distributed very differently
// from the density: many points in a place that should have few would all be neighbours.
//
// The largest spacing, at least 1, with which points have an affordable number of neighbours on
// average; infinity if none is too large. `reach` is that of NeighbourTree.
template <int Dimension>
double affordableSpacing(const SpacingTree<Dimension>& tree, ConstPointSpan<Dimension> points,
  double reach, Progress& progress);

} // namespace RectifiedTransport

#endif
