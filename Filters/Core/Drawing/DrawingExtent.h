// SPDX-License-Identifier: BSD-3-Clause
// Where the shapes of a drawing lie.
#ifndef RectifiedTransport_DrawingExtent_h
#define RectifiedTransport_DrawingExtent_h

#include <Eigen/Geometry>

#include <cstdint>

namespace RectifiedTransport
{

// The bounds of what is drawn; at first of nothing.
using DrawingBounds = Eigen::AlignedBox3d;

struct DrawingExtent
{
  // Includes a point of a line, of a polygon or of a dot with a radius; `number` is its index.
  // Throws Failure unless all values are finite and the radius is not negative.
  void Include(const double* point, std::int64_t number, double radius);
  // Includes the point of a dot that has the common radius of such dots. Throws the same.
  void IncludeDot(const double* point, std::int64_t number);
  // Gives the dots this radius.
  void SetRadiusOfDots(double radius);

  // A radius for dots that are all at one place.
  double RadiusWithoutNeighbours() const;

  DrawingBounds Points;
  DrawingBounds Dots;            // dots without a radius of their own
  DrawingBounds OtherShapes;     // other shapes, with their radii
  std::int64_t NumberOfDots = 0; // number of points in Dots
  bool HasStrokes = false;
};

} // namespace RectifiedTransport

#endif
