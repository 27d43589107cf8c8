// SPDX-License-Identifier: BSD-3-Clause
// Where the shapes of a drawing lie.
#ifndef RectifiedTransport_DrawnExtent_h
#define RectifiedTransport_DrawnExtent_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace RectifiedTransport
{

// The bounds of what is drawn; at first of nothing.
class DrawnBounds
{
public:
  DrawnBounds();
  void Include(const double* point, double radius = 0.0);
  // Other bounds, and what lies around them up to this distance.
  void Include(const DrawnBounds& other, double radius);

  bool IsEmpty() const { return this->Lower[0] > this->Upper[0]; }
  const double* LowerCorner() const { return this->Lower.data(); }
  const double* UpperCorner() const { return this->Upper.data(); }
  double Length(std::size_t axis) const { return this->Upper[axis] - this->Lower[axis]; }
  // Leaves out the shortest axis, the last one if several are as short.
  std::array<std::size_t, 2> LongestAxes() const;

private:
  std::array<double, 3> Lower;
  std::array<double, 3> Upper;
};

struct DrawnExtent
{
  // The point of this number, of a line, of a polygon or of a dot with a radius. Throws
  // Failure unless all is finite and the radius is not negative.
  void Include(const double* point, std::int64_t number, double radius);
  // The point of a dot that has the radius of all such dots. Throws the same.
  void IncludeDot(const double* point, std::int64_t number);

  // A radius for dots that are all at one place.
  double RadiusWithoutNeighbours() const;

  DrawnBounds Points;
  DrawnBounds Dots;              // without a radius of their own
  DrawnBounds Rest;              // with the others' radii
  std::int64_t NumberOfDots = 0; // of Dots
  bool HasStrokes = false;
};

} // namespace RectifiedTransport

#endif
