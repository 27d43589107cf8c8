// SPDX-License-Identifier: BSD-3-Clause
// Descent of a relaxation's energy, which never grows.
#ifndef RectifiedTransport_RelaxationDescent_h
#define RectifiedTransport_RelaxationDescent_h

#include "Core/Algebra/LimitedMemoryBfgs.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"
#include "Core/Relaxation/RelaxationEnergy.h"
#include "Core/Relaxation/RelaxationFrame.h"

#include <cmath>
#include <vector>

namespace RectifiedTransport
{

struct DescentSettings
{
  double LongestStep;   // of a point, in its spacings; may be infinite
  double FirstStep;     // root mean square, in spacings; 0: the spacings' squares have no factor
  double EnergiesAUnit; // reported energies in those of the function
};

template <int Dimension>
class RelaxationDescent
{
public:
  // The coordinates `x` of the points, in `frame`, are changed by each step.
  RelaxationDescent(RelaxationEnergy<Dimension>& energy, const RelaxationFrame<Dimension>& frame,
    const DescentSettings& settings, std::vector<double>& x, Progress& progress);

  // Whether the energy of the points could be computed; there is no run else.
  bool HasEnergy() const { return std::isfinite(this->Value); }
  // Takes steps as the options say; each is a stage, the last of which ends at 1.
  RelaxationReport Run(const RelaxationOptions& options);

private:
  using Vector = std::vector<double>;

  // Moves all points at once. Returns false, with the points where they were, if that lowers the
  // energy nowhere along the direction of descent.
  bool Step();
  double Evaluate(const Vector& x, Vector& gradient, Vector& spacings);
  double Side(std::size_t i) const { return this->Frame.Sides[i % Dimension]; }
  // Whether a coordinate is at the border and descends outwards.
  bool IsHeld(std::size_t i) const;
  Vector Direction();
  void Shorten(Vector& direction) const;
  // Without aims, points may stay where none shall be.
  bool Search(Vector direction, bool hasAims);
  // Moves by a part of the direction into Next. Returns the change of the energy to first order.
  double Move(const Vector& direction, double part);
  void Accept(double found);

  RelaxationEnergy<Dimension>& Function;
  const RelaxationFrame<Dimension> Frame;
  const DescentSettings Settings;
  Progress& Work;
  Vector& X;
  double Value = 0.0;
  Vector Gradient;
  Vector Spacings; // of the points
  LimitedMemoryBfgs Hessian;
  Vector Next;
  Vector NextGradient;
  Vector NextSpacings;
  std::vector<char> Aimed; // points whose whole step leads away from where none shall be, if any
  int Steps = 0;
};

} // namespace RectifiedTransport

#endif
