// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_LayerPainter_h
#define RectifiedTransport_LayerPainter_h

#include "Core/Parallel/Progress.h"

namespace RectifiedTransport::Bridge
{

class Drawing;
class DrawnLayer;
class PageLayout;

// Draws the shapes of a layer. Throws Failure and Cancelled.
void paintLayer(
  const DrawnLayer& layer, const PageLayout& layout, Drawing& drawing, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
