// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/MapDerivatives.h"

#include <Eigen/Core>
#include <Eigen/LU>

namespace RectifiedTransport
{

template <int Dimension>
void MapDerivatives<Dimension>::Write(
  std::int64_t first, std::int64_t last, double* divergences, double* determinants) const
{
  // Central differences of positions inside, one-sided ones at the lattice's border: J = dT/dx, div
  // (T - x) = trace(J) - dimension, and det J, the ratio of volumes.
  using Vector = Eigen::Map<const Eigen::Matrix<double, 1, Dimension>>;
  GridSize<Dimension> stride;
  std::int64_t cells = 1;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    stride[axis] = cells;
    // Positions lie in `Within`, axis 0 fastest.
    cells *= this->Within.Cells[axis];
  }
  GridSize<Dimension> cell = this->Part.CellOf(first);
  for (std::int64_t i = first; i < last; ++i)
  {
    // Row a is the derivative along axis a.
    Eigen::Matrix<double, Dimension, Dimension> jacobian;
    jacobian.setIdentity();
    const std::int64_t at = this->Within.NumberOf(cell);
    double divergence = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      // Along an axis of one cell there is no difference; the identity stands.
      const bool below = cell[axis] > 0;
      const bool above = cell[axis] + 1 < this->Lattice[axis];
      if (below || above)
      {
        const Vector low(this->Positions[below ? at - stride[axis] : at]);
        const Vector high(this->Positions[above ? at + stride[axis] : at]);
        const double width = below && above ? 2.0 * this->Step[axis] : this->Step[axis];
        jacobian.row(axis) = (high - low) / width;
      }
      divergence += jacobian(axis, axis) - 1.0;
    }
    divergences[i] = divergence;
    determinants[i] = jacobian.determinant();
    for (int axis = 0;
         axis < Dimension && ++cell[axis] == this->Part.Low[axis] + this->Part.Cells[axis]; ++axis)
    {
      cell[axis] = this->Part.Low[axis];
    }
  }
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(MapDerivatives);

} // namespace RectifiedTransport
