// SPDX-License-Identifier: BSD-3-Clause
// The rows of a grid of labelled pixels, and the faces between pixels of different labels.
#ifndef RectifiedTransport_PixelRows_h
#define RectifiedTransport_PixelRows_h

#include "Core/Geometry/GridSize.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// Rows are along axis 0.
template <int Dimension>
struct PixelRows
{
  explicit PixelRows(const GridSize<Dimension>& size)
    : Size(size)
  {
    std::int64_t stride = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Stride[axis] = stride;
      stride *= size[axis];
    }
    this->Count = stride / size[0];
  }

  // Calls visit(pixel, neighbour) for the faces of a row's pixels to the next ones along each axis
  // that lie between two labels.
  template <class Visit>
  void VisitFaces(std::int64_t row, const std::int64_t* labels, const Visit& visit) const
  {
    const std::int64_t first = row * this->Size[0];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const std::int64_t stride = this->Stride[axis];
      // The last pixel along an axis has no next one.
      if (axis > 0 && first / stride % this->Size[axis] + 1 == this->Size[axis])
      {
        continue;
      }
      const std::int64_t last = first + this->Size[0] - (axis == 0 ? 1 : 0);
      for (std::int64_t pixel = first; pixel < last; ++pixel)
      {
        if (labels[pixel] != labels[pixel + stride])
        {
          visit(pixel, pixel + stride);
        }
      }
    }
  }

  GridSize<Dimension> Size;
  std::int64_t Stride[Dimension]; // pixels to the next one along an axis
  std::int64_t Count;
};

// Returns the squared sides of a pixel, relative to the longest one: squares of lengths may
// overflow.
template <int Dimension>
Point<Dimension> squaredSides(const Point<Dimension>& spacing)
{
  const double longest = *std::max_element(spacing.begin(), spacing.end());
  Point<Dimension> squares;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double side = spacing[axis] / longest;
    squares[axis] = side * side;
  }
  return squares;
}

} // namespace RectifiedTransport

#endif
