// SPDX-License-Identifier: BSD-3-Clause
// The method of conjugate gradients with a preconditioner (Hestenes and Stiefel, "Methods of
// Conjugate Gradients for Solving Linear Systems", 1952).
#ifndef RectifiedTransport_ConjugateGradients_h
#define RectifiedTransport_ConjugateGradients_h

namespace RectifiedTransport
{

// Solves A x = b for a symmetric matrix A without negative eigenvalues. The caller holds the
// vectors and their loops; r = b - A x is the residual, p the direction, zero at first.
class ConjugateGradients
{
public:
  // One iteration, of these steps:
  //   precondition()   z = M r; returns r z
  //   turn(beta)       p = z + beta p
  //   apply()          q = A p; returns p q
  //   advance(alpha)   x = x + alpha p, r = r - alpha q
  // Returns false, and leaves x as it is, if nothing but rounding is left.
  template <class Precondition, class NewDirection, class Apply, class Advance>
  bool Iterate(const Precondition& precondition, const NewDirection& newDirection,
    const Apply& apply, const Advance& advance)
  {
    const double product = precondition();
    if (!(product > 0.0))
    {
      return false;
    }
    newDirection(this->LastProduct > 0.0 ? product / this->LastProduct : 0.0);
    const double curvature = apply();
    if (!(curvature > 0.0))
    {
      return false;
    }
    advance(product / curvature);
    this->LastProduct = product;
    this->LastGain = product * product / curvature;
    return true;
  }

  // The next direction does not depend on the last one: r has been computed anew.
  void Restart() { this->LastProduct = 0.0; }
  // Twice what the last iteration took from the energy x A x / 2 - b x.
  double Gain() const { return this->LastGain; }

private:
  double LastProduct = 0.0; // r z of the last iteration
  double LastGain = 0.0;
};

} // namespace RectifiedTransport

#endif
