// SPDX-License-Identifier: BSD-3-Clause
// Images that are parts of one lattice.
#ifndef RectifiedTransport_LatticeExtent_h
#define RectifiedTransport_LatticeExtent_h

#include "Core/Geometry/ImageGrid.h"

#include <array>
#include <optional>

namespace RectifiedTransport
{

// The extent that an image has in another one, the lattice, if its points are points of that one:
// the axes, which must be orthogonal, and the spacings are the same. Origins may be rounded to
// single precision.
std::optional<std::array<int, 6>> extentIn(const ImageGrid& lattice, const ImageGrid& grid);

} // namespace RectifiedTransport

#endif
