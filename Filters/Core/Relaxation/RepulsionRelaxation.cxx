// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Progress.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"
#include "Core/Relaxation/Polls.h"
#include "Core/Relaxation/RepulsionDescent.h"
#include "Core/Relaxation/SpacingLimit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>

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

void check(const RelaxationOptions& options)
{
  if (options.MaximumIterations < 0)
  {
    throw std::invalid_argument("MaximumIterations is " +
      std::to_string(options.MaximumIterations) + ", it must be 0 or more");
  }
  if (!(options.Tolerance >= 0.0 && options.Tolerance < 1.0))
  {
    throw std::invalid_argument(
      "Tolerance is " + std::to_string(options.Tolerance) + ", it must be at least 0 and below 1");
  }
}

template <int Dimension>
class RepulsionRun
{
public:
  RepulsionRun(const RectifiedFlow<Dimension>& flow, const Point<Dimension>& spacing,
    PointSpan<Dimension> points, const Context& context)
    : Flow(flow)
    , Points(points)
    , Frame(flow.Size(), spacing, points.size())
    , Work(context)
  {
  }

  RelaxationReport Relax(const RelaxationOptions& options)
  {
    if (this->Points.size() == 0)
    {
      return { { 0.0 } };
    }
    this->Work.BeginStage(0.05);
    this->Read();
    const RepulsionWidth& width = repulsionWidth<Dimension>;
    this->MakeTree(std::numeric_limits<double>::infinity());
    this->Separate();
    const double limit = affordableSpacing<Dimension>(
      *this->Tree, { this->X.data(), this->Points.size() }, width.Reach(), this->Work);
    if (!std::isinf(limit))
    {
      this->MakeTree(limit);
    }
    this->Arrange();
    this->Work.BeginStage(0.2);
    RepulsionEnergy<Dimension> energy(
      this->Flow, this->Frame, *this->Tree, this->Points.size(), width, this->Work);
    RepulsionDescent<Dimension> descent(energy, this->Frame, this->X, this->Work);
    RelaxationReport report{ { descent.Energy() } };
    const int most = options.MaximumIterations;
    for (int iteration = 0; iteration < most; ++iteration)
    {
      this->Work.BeginStage(0.2 + 0.8 * (iteration + 1) / most);
      const double before = descent.Energy();
      if (!descent.Step())
      {
        break;
      }
      report.Energy.push_back(descent.Energy());
      if (before - descent.Energy() <= options.Tolerance * std::abs(before))
      {
        break;
      }
    }
    this->Write();
    this->Work.BeginStage(1.0);
    this->Work.EndSlice(1);
    return report;
  }

private:
  void Read()
  {
    this->X.resize(static_cast<std::size_t>(this->Points.size()) * Dimension);
    for (std::size_t i = 0; i < this->X.size(); ++i)
    {
      const double index = this->Points.data()[i];
      if (!std::isfinite(index))
      {
        throw std::invalid_argument("point " + std::to_string(i / Dimension) + " is not finite");
      }
      const std::size_t axis = i % Dimension;
      this->X[i] = std::clamp(index * this->Frame.CellSides[axis], 0.0, this->Frame.Sides[axis]);
    }
    this->Given = this->X;
  }

  void MakeTree(double largest)
  {
    this->Tree.reset();
    this->Tree = std::make_unique<SpacingTree<Dimension>>(
      this->Flow, this->Frame, this->Points.size(), finestLeaf<Dimension>, largest, this->Work);
  }

  Point<Dimension> At(std::int64_t point) const
  {
    Point<Dimension> x;
    std::copy_n(this->X.data() + point * Dimension, Dimension, x.begin());
    return x;
  }

  // Moves all but one of coincident points, in directions that depend on how many there are alone.
  void Separate()
  {
    std::vector<std::int64_t> order(static_cast<std::size_t>(this->Points.size()));
    std::iota(order.begin(), order.end(), 0);
    Polls polls(this->Work);
    std::sort(order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) {
      polls.Count();
      const auto first = this->At(a);
      const auto second = this->At(b);
      return first < second || (first == second && a < b);
    });
    std::uint64_t ordinal = 0;
    Point<Dimension> last{};
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      const Point<Dimension> x = this->At(order[i]);
      ordinal = i > 0 && x == last ? ordinal + 1 : 0;
      last = x;
      if (ordinal > 0)
      {
        this->MoveAside(order[i], x, ordinal);
      }
    }
  }

  void MoveAside(std::int64_t point, const Point<Dimension>& x, std::uint64_t ordinal)
  {
    constexpr double part = 1.0 / 64;
    const double spacing = this->Tree->Evaluate(this->Tree->Spacing(), this->Tree->Locate(x))[0];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto stream = static_cast<std::uint64_t>(axis);
      const double aside = part * spacing * (2.0 * unitReal(randomWord(stream, ordinal)) - 1.0);
      const double side = this->Frame.Sides[axis];
      // Mirrored at the border, where clamping would put several in one place.
      const double moved =
        x[axis] + (x[axis] + aside < 0.0 || x[axis] + aside > side ? -aside : aside);
      this->X[static_cast<std::size_t>(point * Dimension + axis)] = std::clamp(moved, 0.0, side);
    }
  }

  // Puts the points into an order that depends on the set of them alone; so do all sums then.
  void Arrange()
  {
    std::vector<ScaledPoint<Dimension>> points(static_cast<std::size_t>(this->Points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      points[i] = scaledPoint<Dimension>(this->At(static_cast<std::int64_t>(i)), 1.0, 1.0);
    }
    ReachTree<Dimension> sorted;
    sorted.Build(std::move(points), this->Work);
    this->Order.assign(sorted.Order(), sorted.Order() + sorted.Size());
    for (std::int64_t i = 0; i < sorted.Size(); ++i)
    {
      std::copy_n(sorted.Points()[i].X, Dimension, this->X.data() + i * Dimension);
    }
  }

  // Points that have not moved keep their bits.
  void Write()
  {
    for (std::int64_t i = 0; i < this->Points.size(); ++i)
    {
      const std::int64_t point = this->Order[static_cast<std::size_t>(i)];
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const double x = this->X[static_cast<std::size_t>(i * Dimension + axis)];
        const bool isMoved = x != this->Given[static_cast<std::size_t>(point * Dimension + axis)];
        double& index = this->Points[point][axis];
        index = std::clamp(isMoved ? x / this->Frame.CellSides[axis] : index, 0.0,
          static_cast<double>(this->Flow.Size()[axis]));
      }
    }
  }

  const RectifiedFlow<Dimension>& Flow;
  const PointSpan<Dimension> Points;
  const RelaxationFrame<Dimension> Frame;
  Progress Work;
  std::unique_ptr<SpacingTree<Dimension>> Tree;
  std::vector<double> X;
  std::vector<double> Given;
  std::vector<std::int64_t> Order;
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
  return RepulsionRun<Dimension>(flow, spacing, points, context).Relax(options);
}

template RelaxationReport relaxByRepulsion<2>(const DensitySource<2>&, const RectifiedFlow<2>&,
  const Point<2>&, PointSpan<2>, const RelaxationOptions&, const Context&);
template RelaxationReport relaxByRepulsion<3>(const DensitySource<3>&, const RectifiedFlow<3>&,
  const Point<3>&, PointSpan<3>, const RelaxationOptions&, const Context&);

} // namespace RectifiedTransport
