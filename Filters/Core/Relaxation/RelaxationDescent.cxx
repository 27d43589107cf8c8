// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/RelaxationDescent.h"

#include "Core/Parallel/Stages.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// Pairs (s, y) of the L-BFGS method, each of two vectors of the size of x.
constexpr std::size_t pairsKept = 6;
constexpr int mostEvaluations = 12; // along one direction; each shortens the step to at most half
// Armijo's part c of the first-order change: a step s is accepted if f(x + s) <= f(x) + c g . s.
constexpr double sufficient = 1e-4;
constexpr int stepsBetweenSorts = 8; // points move little against each other in so few steps

} // namespace

template <int Dimension>
RelaxationDescent<Dimension>::RelaxationDescent(RelaxationEnergy<Dimension>& energy,
  const RelaxationFrame<Dimension>& frame, const DescentSettings& settings, std::vector<double>& x,
  Progress& progress)
  : Function(energy)
  , Frame(frame)
  , Settings(settings)
  , X(x)
  , Gradient(x.size())
  , Spacings(x.size() / Dimension)
  , Hessian(pairsKept)
  , Free(x.size())
  , Diagonal(x.size())
  , Direction(x.size())
  , Taken(x.size())
  , Change(x.size())
  , Next(x.size())
  , NextGradient(x.size())
  , NextSpacings(x.size() / Dimension)
{
  this->Function.Sort(PointsOf(x), progress);
  this->Value = this->Function.Evaluate(
    PointsOf(this->X), PointsOf(this->Gradient), this->Spacings.data(), progress);
}

// The report has the energy before the first step and after each; the last step may gain little.
template <int Dimension>
RelaxationReport RelaxationDescent<Dimension>::Run(
  const RelaxationOptions& options, Progress& progress)
{
  Parts steps(progress, options.MaximumIterations);
  RelaxationReport report{ { this->Value * this->Settings.EnergiesAUnit } };
  for (int iteration = 0; iteration < options.MaximumIterations; ++iteration)
  {
    const double before = this->Value;
    if (!this->Step(steps[iteration]))
    {
      break;
    }
    report.Energy.push_back(this->Value * this->Settings.EnergiesAUnit);
    if (before - this->Value <= options.Tolerance * std::abs(before))
    {
      break;
    }
  }
  return report;
}

// A step tries, in this order: the L-BFGS direction; the scaled gradient, after a reset of the
// Hessian; and a step in which points at forbidden places need not leave them.
template <int Dimension>
bool RelaxationDescent<Dimension>::Step(Progress& progress)
{
  const bool isFresh = this->Hessian.IsEmpty();
  bool isDone = this->Search(true, progress);
  if (!isDone)
  {
    this->Hessian.Reset();
    isDone = (!isFresh && this->Search(true, progress)) ||
      (!this->Aimed.empty() && this->Search(false, progress));
  }
  if (!isDone)
  {
    return false;
  }
  if (++this->Steps % stepsBetweenSorts == 0)
  {
    this->Function.Sort(PointsOf(this->X), progress);
  }
  return true;
}

// A coordinate at the border whose descent leads outwards is in the active set: it is fixed for
// this step, as in projected quasi-Newton methods.
template <int Dimension>
bool RelaxationDescent<Dimension>::IsHeld(std::size_t i) const
{
  return this->Gradient[i] > 0.0 ? this->X[i] <= 0.0 : this->X[i] >= this->Side(i);
}

template <int Dimension>
// The direction is -H g in the free coordinates, where the first inverse Hessian is proportional to
// h^2 of each point's spacing h.
void RelaxationDescent<Dimension>::FindDirection(Progress& progress)
{
  for (std::size_t i = 0; i < this->X.size(); ++i)
  {
    const double h = this->Spacings[i / Dimension];
    this->Diagonal[i] = h * h;
    this->Free[i] = this->IsHeld(i) ? 0.0 : this->Gradient[i];
  }
  this->Hessian.FindDirection(this->Free, this->Diagonal, this->Direction, progress);
  // Without pairs, H has no scale. The first step then has the given root mean square: sqrt(sum
  // (d_i / h_i)^2 / n) = FirstStep spacings.
  double scale = 1.0;
  if (this->Hessian.IsEmpty() && this->Settings.FirstStep > 0.0)
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < this->X.size(); ++i)
    {
      sum += this->Direction[i] * this->Direction[i] / this->Diagonal[i];
    }
    scale = sum > 0.0
      ? this->Settings.FirstStep / std::sqrt(sum / static_cast<double>(this->X.size()))
      : 0.0;
  }
  for (std::size_t i = 0; i < this->X.size(); ++i)
  {
    this->Direction[i] = this->IsHeld(i) ? 0.0 : scale * this->Direction[i];
  }
  this->ShortenDirection();
}

// Limits each point's step to LongestStep spacings: the quadratic model holds only while a point
// stays among its neighbours.
template <int Dimension>
void RelaxationDescent<Dimension>::ShortenDirection()
{
  for (std::size_t point = 0; point < this->Spacings.size(); ++point)
  {
    double* step = this->Direction.data() + point * Dimension;
    double squared = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      squared += step[axis] * step[axis];
    }
    // The length of the step in the point's spacings.
    const double length = std::sqrt(squared) / this->Spacings[point];
    for (int axis = 0; axis < Dimension && length > this->Settings.LongestStep; ++axis)
    {
      step[axis] *= this->Settings.LongestStep / length;
    }
  }
}

template <int Dimension>
bool RelaxationDescent<Dimension>::Search(bool hasAims, Progress& progress)
{
  this->FindDirection(progress);
  this->Aimed.clear();
  if (hasAims)
  {
    this->Function.Aim(PointsOf(this->X), PointsOf(this->Direction), this->Aimed, progress);
  }
  // A backtracking line search. `part` is the fraction of the direction that is tried.
  double part = 1.0;
  for (int tries = 0; tries < mostEvaluations; ++tries)
  {
    // The projection may turn the step: only a step with g . s < 0 descends.
    const double slope = this->Move(part, progress);
    if (!(slope < 0.0))
    {
      return false;
    }
    const double found = this->Function.Evaluate(
      PointsOf(this->Next), PointsOf(this->NextGradient), this->NextSpacings.data(), progress);
    if (found <= this->Value + sufficient * slope && found < this->Value)
    {
      this->Accept(found, progress);
      return true;
    }
    // The minimum of the parabola through f(x), the slope g . s and f(x + s), relative to the step.
    // The bounds keep the search from stalling (0.1) and make it finite (0.5); an infinite energy
    // gives 0.1.
    part *= std::clamp(-0.5 * slope / (found - this->Value - slope), 0.1, 0.5);
  }
  return false;
}

// Takes the projected step: x + part d, clamped to the domain, then to what the energy allows.
template <int Dimension>
double RelaxationDescent<Dimension>::Move(double part, Progress& progress)
{
  // Points that are not aimed keep at least this part of their distance to the border. Points that
  // met in a corner would never leave each other.
  constexpr double usualRest = 0.125;
  for (std::size_t i = 0; i < this->X.size(); ++i)
  {
    const double x = this->X[i];
    const double side = this->Side(i);
    const bool isAimed = !this->Aimed.empty() && this->Aimed[i / Dimension] != 0;
    const double rest = isAimed ? 0.0 : usualRest;
    this->Next[i] = std::clamp(x + part * this->Direction[i], rest * x, side - rest * (side - x));
  }
  this->Function.Constrain(PointsOf(this->X), PointsOf(this->Next), progress);
  double slope = 0.0;
  for (std::size_t i = 0; i < this->X.size(); ++i)
  {
    slope += this->Gradient[i] * (this->Next[i] - this->X[i]);
  }
  return slope;
}

// Vectors are swapped, not copied: what was Next becomes memory for the next trial.
template <int Dimension>
void RelaxationDescent<Dimension>::Accept(double found, Progress& progress)
{
  // The secant pair: s = x_new - x, y = g_new - g.
  for (std::size_t i = 0; i < this->X.size(); ++i)
  {
    this->Taken[i] = this->Next[i] - this->X[i];
    this->Change[i] = this->NextGradient[i] - this->Gradient[i];
  }
  this->Hessian.Add(this->Taken, this->Change, progress);
  this->X.swap(this->Next);
  this->Gradient.swap(this->NextGradient);
  this->Spacings.swap(this->NextSpacings);
  this->Value = found;
}

template class RelaxationDescent<2>;
template class RelaxationDescent<3>;

} // namespace RectifiedTransport
