// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Drawing/PolygonBatch.h"

#include <algorithm>
#include <cstddef>

namespace RectifiedTransport
{

void PolygonBatch::Add(const PagePath& polygon, Colour colour)
{
  // Programs read areas of more polygons slowly.
  constexpr std::size_t mostPolygons = 50000;
  if (!(colour == this->ColourOfAll) || this->Polygons.size() == mostPolygons)
  {
    this->Draw();
  }
  // All polygons get the same orientation: with the nonzero winding rule, overlaps then stay
  // filled.
  double twice = 0.0; // the area
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const PagePoint& a = polygon[i];
    const PagePoint& b = polygon[(i + 1) % polygon.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  this->Polygons.push_back(polygon);
  if (twice < 0.0)
  {
    std::reverse(this->Polygons.back().begin() + 1, this->Polygons.back().end());
  }
  this->ColourOfAll = colour;
  // Transparent polygons are drawn one by one, since each overlap counts.
  if (colour.Opacity < 255)
  {
    this->Draw();
  }
}

void PolygonBatch::Draw()
{
  if (!this->Polygons.empty())
  {
    this->Page.FillPolygons(this->Polygons, FillRule::Any, this->ColourOfAll);
    this->Polygons.clear();
  }
}

} // namespace RectifiedTransport
