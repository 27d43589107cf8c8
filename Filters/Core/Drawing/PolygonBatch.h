// SPDX-License-Identifier: BSD-3-Clause
// Polygons of one colour that follow each other, as one area.
#ifndef RectifiedTransport_PolygonBatch_h
#define RectifiedTransport_PolygonBatch_h

#include "Core/Drawing/Drawing.h"

#include <vector>

namespace RectifiedTransport
{

class PolygonBatch
{
public:
  // The drawing must outlive this object.
  explicit PolygonBatch(Drawing& page)
    : Page(page)
  {
  }

  // Polygons are drawn before those of another colour. Where transparent ones overlap, both count.
  void Add(const PagePath& polygon, Colour colour);
  // Draws what is left. Call it before anything else is drawn, and at the end.
  void Draw();

private:
  Drawing& Page;
  std::vector<PagePath> Polygons; // all of the same orientation
  Colour ColourOfAll;
};

} // namespace RectifiedTransport

#endif
