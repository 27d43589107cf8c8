// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Stages.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"
#include "Core/Relaxation/RelaxationDescent.h"
#include "Core/Relaxation/RelaxedPoints.h"
#include "Core/Relaxation/RepulsionEnergy.h"

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace RectifiedTransport
{

namespace
{

// Chosen by experiment. Wider Gaussians converge slowly, as they hardly see the structure between
// neighbours; narrower ones make lattices in patches (2D).
template <int Dimension>
constexpr RepulsionWidth repulsionWidth = { Dimension == 2 ? 0.5 : 0.45, 13.8 };

// The widest leaves, in spacings. The interpolation then changes energies by about 1e-4 (2D) and
// 1e-3 (3D).
template <int Dimension>
constexpr double finestLeaf = Dimension == 2 ? 0.6 : 0.75;

// A step is at most 0.3 spacings long, so that two neighbours that approach each other do not meet.
// The first step has a root mean square of 0.1 spacings, as the gradient has no scale yet.
constexpr DescentSettings settings = { 0.3, 0.1, 1.0 };

} // namespace

template <int Dimension>
RelaxationReport relaxByRepulsion(const DensitySource<Dimension>& density,
  const RectifiedFlow<Dimension>& flow, const Point<Dimension>& spacing,
  PointSpan<Dimension> points, const RelaxationOptions& options, const Context& context)
{
  check(options);
  if (density.Size != flow.Size())
  {
    throw std::invalid_argument("the flow is that of a density of another size");
  }
  if (points.size() == 0)
  {
    return { { 0.0 } };
  }
  Progress progress(context);
  Stages stages(progress, { { "points", 5 }, { "energy", 15 }, { "descent", 80 } });
  const RepulsionWidth& width = repulsionWidth<Dimension>;
  const RelaxationFrame<Dimension> frame(flow.Size(), spacing, points.size());
  RelaxedPoints<Dimension> relaxed(points, frame);
  std::unique_ptr<SpacingTree<Dimension>> tree;
  const auto makeTree = [&](double largest) {
    tree.reset();
    tree = std::make_unique<SpacingTree<Dimension>>(
      flow, frame, points.size(), finestLeaf<Dimension>, largest, stages["points"]);
  };
  makeTree(std::numeric_limits<double>::infinity());
  relaxed.Separate(
    [&](const Point<Dimension>& x) { return tree->Evaluate(tree->Spacing(), tree->Locate(x))[0]; },
    stages["points"]);
  // The tree is made again with a limit only if the points are distributed so differently from the
  // density that their kernels would have too many neighbours.
  const double limit =
    affordableSpacing<Dimension>(*tree, relaxed.Get(), width.Reach(), stages["points"]);
  if (!std::isinf(limit))
  {
    makeTree(limit);
  }
  relaxed.Arrange(stages["points"]);
  RepulsionEnergy<Dimension> energy(flow, frame, *tree, points.size(), width, stages["energy"]);
  RelaxationDescent<Dimension> descent(
    energy, frame, settings, relaxed.Coordinates(), stages["energy"]);
  const RelaxationReport report = descent.Run(options, stages["descent"]);
  relaxed.Write(flow.Size(), points);
  progress.EndSlice(1);
  return report;
}

template decltype(relaxByRepulsion<2>) relaxByRepulsion<2>;
template decltype(relaxByRepulsion<3>) relaxByRepulsion<3>;

} // namespace RectifiedTransport
