// SPDX-License-Identifier: BSD-3-Clause
// The pixels of a domain that is divided among sites, and what they take.
#ifndef RectifiedTransport_LabelPixels_h
#define RectifiedTransport_LabelPixels_h

#include "Core/Geometry/ImageGrid.h"

#include <string>

namespace RectifiedTransport
{

// The box in pixels that are as near to squares or cubes as possible, `resolution` along its
// longest side; 0 is 512 in 2D and 64 in 3D. Throws Failure, which names Resolution.
ImageGrid labelPixels(const ImageGrid& box, int resolution);

// Whether they take so long that users should know it beforehand.
bool areManyPixels(const ImageGrid& pixels);

// "64 x 64 x 64 pixels take about 10.7 MB", and for many pixels what helps.
std::string describeLabelPixels(const ImageGrid& pixels);

} // namespace RectifiedTransport

#endif
