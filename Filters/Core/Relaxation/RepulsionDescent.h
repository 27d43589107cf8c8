// SPDX-License-Identifier: BSD-3-Clause
// Descent of the repulsion's energy, which never grows.
#ifndef RectifiedTransport_RepulsionDescent_h
#define RectifiedTransport_RepulsionDescent_h

#include "Core/Algebra/LimitedMemoryBfgs.h"
#include "Core/Relaxation/RepulsionEnergy.h"

#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class RepulsionDescent
{
public:
  // The coordinates `x` of the points, in `frame`, are changed by each step.
  RepulsionDescent(RepulsionEnergy<Dimension>& energy, const RelaxationFrame<Dimension>& frame,
    std::vector<double>& x, Progress& progress);

  double Energy() const { return this->Value; }
  // Moves all points at once, each by at most a part of its spacing. Returns false, with the points
  // where they were, if that lowers the energy nowhere along the direction of descent.
  bool Step();

private:
  using Vector = std::vector<double>;

  double Evaluate(const Vector& x, Vector& gradient, Vector& spacings);
  double Side(std::size_t i) const { return this->Frame.Sides[i % Dimension]; }
  // Whether a coordinate is at the border and descends outwards.
  bool IsHeld(std::size_t i) const;
  Vector Direction();
  void Shorten(Vector& direction) const;
  bool Search(const Vector& direction);
  // Moves by a part of the direction into Next. Returns the change of the energy to first order.
  double Move(const Vector& direction, double part);
  void Accept(double found);

  RepulsionEnergy<Dimension>& Function;
  const RelaxationFrame<Dimension> Frame;
  Progress& Work;
  Vector& X;
  double Value = 0.0;
  Vector Gradient;
  Vector Spacings; // of the points
  LimitedMemoryBfgs Hessian;
  Vector Next;
  Vector NextGradient;
  Vector NextSpacings;
  int Steps = 0;
};

} // namespace RectifiedTransport

#endif
