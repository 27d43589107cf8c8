// SPDX-License-Identifier: BSD-3-Clause
// The direction of the limited-memory BFGS method (Nocedal, "Updating Quasi-Newton Matrices with
// Limited Storage", Mathematics of Computation 35, 1980), with a diagonal first inverse Hessian.
#ifndef RectifiedTransport_LimitedMemoryBfgs_h
#define RectifiedTransport_LimitedMemoryBfgs_h

#include <vector>

namespace RectifiedTransport
{

class Progress;

class LimitedMemoryBfgs
{
public:
  explicit LimitedMemoryBfgs(std::size_t pairs)
    : Most(pairs)
  {
  }

  void Reset() { this->Pairs.clear(); }
  bool IsEmpty() const { return this->Pairs.empty(); }
  // Adds a step and the change of the gradient over it, if the curvature along it is positive.
  void Add(const std::vector<double>& step, const std::vector<double>& change, Progress& progress);
  // Writes minus the inverse Hessian times the gradient. `diagonal` approximates the diagonal of
  // the inverse Hessian, up to a factor.
  void FindDirection(const std::vector<double>& gradient, const std::vector<double>& diagonal,
    std::vector<double>& direction, Progress& progress) const;

private:
  struct Pair
  {
    std::vector<double> Step;
    std::vector<double> Change;
    double Curvature; // their inner product
  };

  std::size_t Most;
  std::vector<Pair> Pairs; // the oldest first
};

} // namespace RectifiedTransport

#endif
