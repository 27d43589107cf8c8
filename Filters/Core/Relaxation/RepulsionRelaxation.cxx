// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Stages.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"
#include "Core/Relaxation/RelaxationDescent.h"
#include "Core/Relaxation/RelaxedPoints.h"
#include "Core/Relaxation/RepulsionEnergy.h"
#include "Core/Relaxation/SpacingLimit.h"

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

// The widest leaves, in spacings: the interpolation then changes energies by about 1e-4
// (2D) and 1e-3 (3D).
template <int Dimension>
constexpr double finestLeaf = Dimension == 2 ? 0.6 : 0.75;

constexpr DescentSettings descent = { 0.3, 0.1, 1.0 };

template <int Dimension>
class RepulsionRun
{
public:
  RepulsionRun(const RectifiedFlow<Dimension>& flow, const Point<Dimension>& spacing,
    PointSpan<Dimension> points)
    : Flow(flow)
    , Given(points)
    , Frame(flow.Size(), spacing, points.size())
    , Points(points, Frame)
  {
  }

  RelaxationReport Relax(const RelaxationOptions& options, Progress& progress)
  {
    Stages stages(progress, { { "points", 5 }, { "energy", 15 }, { "descent", 80 } });
    const RepulsionWidth& width = repulsionWidth<Dimension>;
    this->Prepare(width, stages["points"]);
    RepulsionEnergy<Dimension> energy(
      this->Flow, this->Frame, *this->Tree, this->Points.Size(), width, stages["energy"]);
    const RelaxationReport report = RelaxationDescent<Dimension>(
      energy, this->Frame, descent, this->Points.Coordinates(), stages["energy"])
                                      .Run(options, stages["descent"]);
    this->Points.Write(this->Flow.Size(), this->Given);
    progress.EndSlice(1);
    return report;
  }

private:
  void Prepare(const RepulsionWidth& width, Progress& progress)
  {
    this->MakeTree(std::numeric_limits<double>::infinity(), progress);
    this->Points.Separate(
      [this](const Point<Dimension>& x) {
        return this->Tree->Evaluate(this->Tree->Spacing(), this->Tree->Locate(x))[0];
      },
      progress);
    const double limit =
      affordableSpacing<Dimension>(*this->Tree, this->Points.Get(), width.Reach(), progress);
    if (!std::isinf(limit))
    {
      this->MakeTree(limit, progress);
    }
    this->Points.Arrange(progress);
  }

  void MakeTree(double largest, Progress& progress)
  {
    this->Tree.reset();
    this->Tree = std::make_unique<SpacingTree<Dimension>>(
      this->Flow, this->Frame, this->Points.Size(), finestLeaf<Dimension>, largest, progress);
  }

  const RectifiedFlow<Dimension>& Flow;
  const PointSpan<Dimension> Given;
  const RelaxationFrame<Dimension> Frame;
  RelaxedPoints<Dimension> Points;
  std::unique_ptr<SpacingTree<Dimension>> Tree;
};

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
  return RepulsionRun<Dimension>(flow, spacing, points).Relax(options, progress);
}

template decltype(relaxByRepulsion<2>) relaxByRepulsion<2>;
template decltype(relaxByRepulsion<3>) relaxByRepulsion<3>;

} // namespace RectifiedTransport
