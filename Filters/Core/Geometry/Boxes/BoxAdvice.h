// SPDX-License-Identifier: BSD-3-Clause
// What to do with images that lie in different boxes or planes, for messages.
#ifndef RectifiedTransport_BoxAdvice_h
#define RectifiedTransport_BoxAdvice_h

#include "Core/Geometry/ImageGrid.h"

#include <cstddef>
#include <string>

namespace RectifiedTransport
{

// How Resample To Image puts both on one box: its properties, for the smallest box that holds both,
// at the finest spacing.
std::string sameBoxAdvice(const ImageGrid& first, const ImageGrid& other);

// How Transform puts both into one plane across an axis along which they are flat.
std::string samePlaneAdvice(const ImageGrid& first, const ImageGrid& other, std::size_t axis);

} // namespace RectifiedTransport

#endif
