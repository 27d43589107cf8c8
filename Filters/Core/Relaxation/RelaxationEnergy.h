// SPDX-License-Identifier: BSD-3-Clause
// A function of the positions of points that a relaxation lowers.
#ifndef RectifiedTransport_RelaxationEnergy_h
#define RectifiedTransport_RelaxationEnergy_h

#include "Core/Geometry/Points.h"

#include <vector>

namespace RectifiedTransport
{

class Progress;

// Coordinates are those of a RelaxationFrame. Members throw std::bad_alloc and Cancelled.
template <int Dimension>
class RelaxationEnergy
{
public:
  virtual ~RelaxationEnergy() = default;
  // Returns the energy, infinite if it could not be computed, and writes its gradient with respect
  // to the coordinates of the points, and their spacings. The squared spacings approximate the
  // diagonal of the inverse second derivatives, up to a factor.
  virtual double Evaluate(ConstPointSpan<Dimension> points, PointSpan<Dimension> gradient,
    double* spacings, Progress& progress) = 0;
  // Called from time to time with the points that will be evaluated next, or points near them.
  virtual void Sort(ConstPointSpan<Dimension>, Progress&) {}
  // Some places in the domain may be forbidden. Changes the steps of points at such places so that
  // whole steps lead away, and marks these points, if there are any.
  virtual void Aim(
    ConstPointSpan<Dimension>, PointSpan<Dimension>, std::vector<char>&, Progress&) const
  {
  }
  // Moves the ends of partial steps away from forbidden places, for points that were not at one
  // before. The points stay distinct.
  virtual void Constrain(ConstPointSpan<Dimension>, PointSpan<Dimension>, Progress&) const {}
};

} // namespace RectifiedTransport

#endif
