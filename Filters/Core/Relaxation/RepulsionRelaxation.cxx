// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Progress.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"
#include "Core/Relaxation/LimitedMemoryBfgs.h"
#include "Core/Relaxation/RepulsionEnergy.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace RectifiedTransport
{

namespace
{

double tune(const char* name, double value)
{
  const char* text = std::getenv(name);
  return text ? std::atof(text) : value;
}

constexpr std::int64_t grain = 1024;
constexpr double setUp = 0.2; // its part of the progress

void check(const RelaxationOptions& options)
{
  if (options.MaximumIterations < 0)
  {
    throw std::invalid_argument("MaximumIterations is " +
      std::to_string(options.MaximumIterations) + ", it must be 0 or more");
  }
  if (!(options.Tolerance >= 0.0 && options.Tolerance < 1.0))
  {
    throw std::invalid_argument("Tolerance is " + std::to_string(options.Tolerance) +
      ", it must be at least 0 and below 1");
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
    this->Work.BeginStage(setUp);
    this->Read();
    const SpacingTree<Dimension> tree(this->Flow, this->Frame, this->Points.size(),
      tune("RT_FINEST", Dimension == 2 ? 0.5 : 1.0), this->Work);
    this->Separate(tree);
    RepulsionEnergy<Dimension> energy(this->Flow, this->Frame, tree, this->Points.size(),
      { tune("RT_S", 0.6), tune("RT_CUT", 13.8) }, this->Work);
    energy.Sort(this->Span(this->X), this->Work);
    RelaxationReport report{ this->Minimize(energy, options) };
    this->Write();
    return report;
  }

private:
  using Vector = std::vector<double>;

  PointSpan<Dimension> Span(Vector& vector) const
  {
    return { vector.data(), this->Points.size() };
  }

  double Side(std::size_t i) const { return this->Frame.Sides[i % Dimension]; }

  void Read()
  {
    this->X.resize(static_cast<std::size_t>(this->Points.size()) * Dimension);
    for (std::size_t i = 0; i < this->X.size(); ++i)
    {
      const double index = this->Points.data()[i];
      if (!std::isfinite(index))
      {
        throw std::invalid_argument(
          "point " + std::to_string(i / Dimension) + " is not finite");
      }
      this->X[i] =
        std::clamp(index * this->Frame.CellSides[i % Dimension], 0.0, this->Side(i));
    }
    this->Start = this->X;
  }

  // Moves all but one of coincident points, in directions that depend on their number alone.
  void Separate(const SpacingTree<Dimension>& tree)
  {
    const Point<Dimension>* points = reinterpret_cast<const Point<Dimension>*>(this->X.data());
    std::vector<std::int64_t> order(static_cast<std::size_t>(this->Points.size()));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [points](std::int64_t a, std::int64_t b) {
      return points[a] < points[b] || (points[a] == points[b] && a < b);
    });
    std::uint64_t ordinal = 0;
    Point<Dimension> last{};
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      const std::int64_t point = order[i];
      const bool repeats = i > 0 && points[point] == last;
      last = points[point];
      ordinal = repeats ? ordinal + 1 : 0;
      if (!repeats)
      {
        continue;
      }
      constexpr double part = 1.0 / 64;
      const double reach = part * tree.Evaluate(tree.Spacing(), tree.Locate(last))[0];
      for (std::size_t axis = 0; axis < Dimension; ++axis)
      {
        const std::size_t at = static_cast<std::size_t>(point) * Dimension + axis;
        const double side = 2.0 * unitReal(randomWord(axis, ordinal)) - 1.0;
        this->X[at] = std::clamp(this->X[at] + reach * side, 0.0, this->Side(at));
      }
    }
  }

  Vector Minimize(RepulsionEnergy<Dimension>& energy, const RelaxationOptions& options)
  {
    const std::size_t size = this->X.size();
    LimitedMemoryBfgs hessian(static_cast<std::size_t>(tune("RT_PAIRS", 6)));
    Vector gradient(size);
    Vector spacings(size / Dimension);
    Vector next(size);
    Vector nextGradient(size);
    Vector nextSpacings(size / Dimension);
    Vector diagonal(size);
    double best =
      energy.Evaluate(this->Span(this->X), this->Span(gradient), spacings.data(), this->Work);
    Vector energies{ best };
    for (int iteration = 0; iteration < options.MaximumIterations; ++iteration)
    {
      this->Work.BeginStage(setUp + (1.0 - setUp) * (iteration + 1) / options.MaximumIterations);
      const double before = best;
      for (const bool isFresh : { hessian.IsEmpty(), true })
      {
        if (isFresh)
        {
          hessian.Forget();
        }
        for (std::size_t i = 0; i < size; ++i)
        {
          const double h = spacings[i / Dimension];
          diagonal[i] = h * h;
        }
        Vector direction = this->Direction(hessian, gradient, diagonal, spacings);
        double factor = 1.0;
        for (int tries = 0; tries < 12 && best == before; ++tries)
        {
          double slope = 0.0;
          for (std::size_t i = 0; i < size; ++i)
          {
            next[i] = std::clamp(this->X[i] + factor * direction[i], 0.0, this->Side(i));
            slope += gradient[i] * (next[i] - this->X[i]);
          }
          if (!(slope < 0.0))
          {
            break;
          }
          const double found = energy.Evaluate(
            this->Span(next), this->Span(nextGradient), nextSpacings.data(), this->Work);
          ++this->Evaluations;
          if (found <= before + 1e-4 * slope && found < before)
          {
            best = found;
            break;
          }
          factor *= std::clamp(0.5 * -slope / (found - before - slope), 0.1, 0.5);
        }
        if (best < before || isFresh)
        {
          break;
        }
      }
      if (!(best < before))
      {
        break;
      }
      Vector step(size);
      Vector change(size);
      for (std::size_t i = 0; i < size; ++i)
      {
        step[i] = next[i] - this->X[i];
        change[i] = nextGradient[i] - gradient[i];
      }
      hessian.Add(std::move(step), std::move(change), this->Work);
      this->X.swap(next);
      gradient.swap(nextGradient);
      spacings.swap(nextSpacings);
      energies.push_back(best);
      if (before - best <= options.Tolerance * before)
      {
        break;
      }
      if (iteration % 8 == 7)
      {
        energy.Sort(this->Span(this->X), this->Work);
      }
    }
    if (std::getenv("RT_VERBOSE"))
    {
      fprintf(stderr, "evaluations %d\n", this->Evaluations);
    }
    return energies;
  }
  int Evaluations = 0;

  // The descent of each point, at most a part of its spacing.
  Vector Direction(const LimitedMemoryBfgs& hessian, const Vector& gradient,
    const Vector& diagonal, const Vector& spacings)
  {
    const std::size_t size = this->X.size();
    Vector free = gradient;
    const auto isHeld = [&](std::size_t i) {
      return gradient[i] > 0.0 ? this->X[i] <= 0.0 : this->X[i] >= this->Side(i);
    };
    for (std::size_t i = 0; i < size; ++i)
    {
      free[i] = isHeld(i) ? 0.0 : free[i];
    }
    Vector direction = hessian.Direction(free, diagonal, this->Work);
    double scale = 1.0;
    if (hessian.IsEmpty())
    {
      double sum = 0.0;
      for (std::size_t i = 0; i < size; ++i)
      {
        sum += direction[i] * direction[i] / diagonal[i];
      }
      scale = sum > 0.0 ? 0.1 / std::sqrt(sum / static_cast<double>(size)) : 0.0;
    }
    static const double longest = tune("RT_LONGEST", 0.3);
    for (std::size_t point = 0; point < spacings.size(); ++point)
    {
      double squared = 0.0;
      for (std::size_t i = point * Dimension; i < (point + 1) * Dimension; ++i)
      {
        direction[i] = isHeld(i) ? 0.0 : scale * direction[i];
        squared += direction[i] * direction[i];
      }
      const double length = std::sqrt(squared) / spacings[point];
      for (std::size_t i = point * Dimension; i < (point + 1) * Dimension && length > longest; ++i)
      {
        direction[i] *= longest / length;
      }
    }
    return direction;
  }

  void Write()
  {
    for (std::size_t i = 0; i < this->X.size(); ++i)
    {
      const std::size_t axis = i % Dimension;
      const double size = static_cast<double>(this->Flow.Size()[axis]);
      double& index = this->Points.data()[i];
      index = this->X[i] == this->Start[i] ? index : this->X[i] / this->Frame.CellSides[axis];
      index = std::clamp(index, 0.0, size);
    }
  }

  const RectifiedFlow<Dimension>& Flow;
  const PointSpan<Dimension> Points;
  const RelaxationFrame<Dimension> Frame;
  Progress Work;
  Vector X;
  Vector Start;
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
