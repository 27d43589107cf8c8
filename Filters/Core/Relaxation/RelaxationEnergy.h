// SPDX-License-Identifier: BSD-3-Clause
// A function of the places of points that a relaxation lowers.
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
  // Returns the energy, infinite where it could not be computed, and writes its gradient by the
  // coordinates of the points, and their spacings: the squares are about the diagonal of the
  // inverse second derivatives, up to a factor.
  virtual double Evaluate(ConstPointSpan<Dimension> points, PointSpan<Dimension> gradient,
    double* spacings, Progress& progress) = 0;
  // Called now and then with the points that will be evaluated next, or some near them.
  virtual void Sort(ConstPointSpan<Dimension>, Progress&) {}
  // There may be places in the domain where no point shall be. Changes the steps of points that are
  // there: whole steps lead away. Notes for which points, where there are any.
  virtual void Aim(
    ConstPointSpan<Dimension>, PointSpan<Dimension>, std::vector<char>&, Progress&) const
  {
  }
  // Moves the ends of a part of the steps away from there, for points that were not there before.
  // The points stay distinct.
  virtual void Constrain(ConstPointSpan<Dimension>, PointSpan<Dimension>, Progress&) const {}
};

} // namespace RectifiedTransport

#endif
