// SPDX-License-Identifier: BSD-3-Clause
// The size of a grid as text for messages.
#ifndef RectifiedTransport_GridText_h
#define RectifiedTransport_GridText_h

#include "Core/Geometry/GridSize.h"

#include <string>

namespace RectifiedTransport::Bridge
{

template <int D>
std::string describeSize(const GridSize<D>& size)
{
  std::string text;
  for (int a = 0; a < D; ++a)
  {
    text += (a == 0 ? "" : " x ") + std::to_string(size[a]);
  }
  return text;
}

} // namespace RectifiedTransport::Bridge

#endif
