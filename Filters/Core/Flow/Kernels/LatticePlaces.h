// SPDX-License-Identifier: BSD-3-Clause
// Where the nodes of a flow map's lattices lie.
#ifndef RectifiedTransport_LatticePlaces_h
#define RectifiedTransport_LatticePlaces_h

#include "Core/Flow/Kernels/FlowMapView.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// The places of the nodes along an axis, the inverse of u(x) of LatticeAxis: x = u^2 / (4 Layer) in
// the layer. The ends are exact.
inline std::vector<double> placesOf(const LatticeAxis& axis)
{
  std::vector<double> places;
  for (std::int64_t node = 0; node <= axis.Cells; ++node)
  {
    const double u = static_cast<double>(node) * (axis.Length / static_cast<double>(axis.Cells));
    const double fromEnd = axis.Length - u;
    const double belowEnd = fromEnd < 2.0 * axis.Layer
      ? axis.Size - fromEnd * fromEnd / (4.0 * axis.Layer)
      : u - axis.Layer;
    places.push_back(u < 2.0 * axis.Layer ? u * u / (4.0 * axis.Layer) : belowEnd);
  }
  places.front() = 0.0;
  places.back() = axis.Size;
  return places;
}

} // namespace RectifiedTransport

#endif
