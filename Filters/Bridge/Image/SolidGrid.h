// SPDX-License-Identifier: BSD-3-Clause
// The grid of cubic cells around a solid.
#ifndef RectifiedTransport_SolidGrid_h
#define RectifiedTransport_SolidGrid_h

#include "Bridge/Image/ImageFrame.h"
#include "Core/Tables/Density.h"

#include <array>

namespace RectifiedTransport
{

class SolidGrid
{
public:
  // Throws Failure for what is out of range whatever the surface.
  static void RequireRanges(int resolution, double padding);

  // `resolution` cells along the longest side of the bounds grown by `padding` of the longest side
  // on each side; along the others as many as cover them, about the centre. Throws Failure, which
  // names the property that asks for what is not possible.
  SolidGrid(const std::array<double, 6>& bounds, int resolution, double padding);

  const GridSize<3>& Cells() const { return this->Size; }
  double Spacing() const { return this->Width; }
  const std::array<double, 3>& Corner() const { return this->Low; }

  // An image with values on the cells, or on points at their centres.
  ImageFrame Frame(bool onPoints) const;

private:
  GridSize<3> Size;
  double Width;
  std::array<double, 3> Low;
};

} // namespace RectifiedTransport

#endif
