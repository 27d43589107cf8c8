// SPDX-License-Identifier: BSD-3-Clause
// Descent of a relaxation's energy. The energy never grows.
#ifndef RectifiedTransport_RelaxationDescent_h
#define RectifiedTransport_RelaxationDescent_h

#include "Core/Algebra/LimitedMemoryBfgs.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"
#include "Core/Relaxation/RelaxationEnergy.h"
#include "Core/Relaxation/RelaxationFrame.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

struct DescentSettings
{
  double LongestStep; // longest step of a point, in its spacings; may be infinite
  // The root mean square of the first step, in spacings. With 0, the squares of the spacings are
  // the inverse Hessian's diagonal as they are, without a factor.
  double FirstStep;
  double EnergiesAUnit; // factor from the function to the reported energy
};

template <int Dimension>
class RelaxationDescent
{
public:
  // Each step changes the coordinates `x` of the points, in `frame`.
  RelaxationDescent(RelaxationEnergy<Dimension>& energy, const RelaxationFrame<Dimension>& frame,
    const DescentSettings& settings, std::vector<double>& x, Progress& progress);

  // Whether the energy of the points could be computed. Otherwise do not call Run.
  bool HasEnergy() const { return std::isfinite(this->Value); }
  // Takes steps according to the options.
  RelaxationReport Run(const RelaxationOptions& options, Progress& progress);

private:
  using Vector = std::vector<double>;

  // Moves all points at once. If that lowers the energy nowhere along the direction of descent,
  // returns false and leaves the points unchanged.
  bool Step(Progress& progress);
  static PointSpan<Dimension> PointsOf(Vector& x)
  {
    return { x.data(), static_cast<std::int64_t>(x.size()) / Dimension };
  }
  double Side(std::size_t i) const { return this->Frame.Sides[i % Dimension]; }
  // Whether a coordinate is at the border and descends outwards.
  bool IsHeld(std::size_t i) const;
  // Computes Direction: minus the inverse Hessian times the free gradient, shortened.
  void FindDirection(Progress& progress);
  void ShortenDirection();
  // Searches along a new direction. Without aims, points may stay at forbidden places.
  bool Search(bool hasAims, Progress& progress);
  // Moves by a part of the direction into Next. Returns the change of the energy to first order.
  double Move(double part, Progress& progress);
  // Makes Next the current points, and adds the secant pair to the Hessian.
  void Accept(double found, Progress& progress);

  RelaxationEnergy<Dimension>& Function;
  const RelaxationFrame<Dimension> Frame;
  const DescentSettings Settings;
  Vector& X;
  double Value = 0.0;
  Vector Gradient;
  Vector Spacings; // spacing at each point, in units of the frame
  LimitedMemoryBfgs Hessian;
  Vector Free;      // the gradient, 0 for coordinates that are held
  Vector Diagonal;  // diagonal of the inverse Hessian, up to a factor
  Vector Direction; // direction of the search
  Vector Taken;     // the step of an iteration
  Vector Change;    // change of the gradient in that step
  Vector Next;
  Vector NextGradient;
  Vector NextSpacings;
  std::vector<char> Aimed; // points whose whole step leads away from a forbidden place, if any
  int Steps = 0;
};

} // namespace RectifiedTransport

#endif
