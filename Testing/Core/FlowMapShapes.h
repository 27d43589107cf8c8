// SPDX-License-Identifier: BSD-3-Clause
// Shapes of flow maps for tests.
#ifndef FlowMapShapes_h
#define FlowMapShapes_h

#include "Core/Flow/FlowMapShape.h"

#include <cstddef>

namespace RectifiedTransport
{

template <int Dimension>
FlowMapShape<Dimension> forwardShape(const GridSize<Dimension>& size, int count = 32)
{
  return FlowMapShape<Dimension>(size, count, FlowDirection::Forward);
}

// A power of two, half of which the maps do not pay for.
template <int Dimension>
std::size_t particlesThatPay(const FlowMapShape<Dimension>& shape)
{
  std::size_t enough = 1;
  while (!shape.PaysFor(static_cast<double>(enough)))
  {
    enough *= 2;
  }
  return enough;
}

} // namespace RectifiedTransport

#endif
