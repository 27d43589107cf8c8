// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/MapDerivatives.h"

namespace RectifiedTransport
{

namespace
{

// columns[a] is the derivative along axis a.
template <int Dimension>
double determinant(const double (&columns)[Dimension][Dimension])
{
  if constexpr (Dimension == 1)
  {
    return columns[0][0];
  }
  else if constexpr (Dimension == 2)
  {
    return columns[0][0] * columns[1][1] - columns[0][1] * columns[1][0];
  }
  else
  {
    const double* u = columns[0];
    const double* v = columns[1];
    const double* w = columns[2];
    return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
      u[2] * (v[0] * w[1] - v[1] * w[0]);
  }
}

} // namespace

template <int Dimension>
void MapDerivatives<Dimension>::Write(
  std::int64_t first, std::int64_t last, double* divergences, double* determinants) const
{
  GridSize<Dimension> stride;
  GridSize<Dimension> cell;
  std::int64_t cells = 1;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    stride[axis] = cells * Dimension;
    cell[axis] = first / cells % this->Lattice[axis];
    cells *= this->Lattice[axis];
  }
  for (std::int64_t i = first; i < last; ++i)
  {
    const double* here = this->Positions + i * Dimension;
    double columns[Dimension][Dimension] = {};
    double divergence = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const bool below = cell[axis] > 0;
      const bool above = cell[axis] + 1 < this->Lattice[axis];
      columns[axis][axis] = 1.0;
      if (below || above)
      {
        const double* low = below ? here - stride[axis] : here;
        const double* high = above ? here + stride[axis] : here;
        const double width = below && above ? 2.0 * this->Step[axis] : this->Step[axis];
        for (int row = 0; row < Dimension; ++row)
        {
          columns[axis][row] = (high[row] - low[row]) / width;
        }
      }
      divergence += columns[axis][axis] - 1.0;
    }
    divergences[i] = divergence;
    determinants[i] = determinant<Dimension>(columns);
    for (int axis = 0; axis < Dimension && ++cell[axis] == this->Lattice[axis]; ++axis)
    {
      cell[axis] = 0;
    }
  }
}

template class MapDerivatives<1>;
template class MapDerivatives<2>;
template class MapDerivatives<3>;

} // namespace RectifiedTransport
