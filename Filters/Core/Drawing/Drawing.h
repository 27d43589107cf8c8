// SPDX-License-Identifier: BSD-3-Clause
// A page of filled discs, lines and polygons, which a file format writes.
#ifndef RectifiedTransport_Drawing_h
#define RectifiedTransport_Drawing_h

#include "Core/Geometry/Points.h"

#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// Red, green and blue light and opacity, 0 to 255.
struct Colour
{
  std::uint8_t Red = 0;
  std::uint8_t Green = 0;
  std::uint8_t Blue = 0;
  std::uint8_t Opacity = 255;

  bool operator==(const Colour& other) const
  {
    return this->Red == other.Red && this->Green == other.Green && this->Blue == other.Blue &&
      this->Opacity == other.Opacity;
  }
};

// Millimetres to the right and up from the lower left corner of the page.
using PagePoint = Point<2>;
using PagePath = std::vector<PagePoint>;

// In millimetres.
struct DrawingPage
{
  PagePoint Size;
  double ClippedMargin; // on all four sides, where nothing is visible
  double StrokeWidth;   // of all strokes
};

// Which points are inside a set of polygons.
enum class FillRule
{
  Any, // of polygons that turn the same way
  Odd  // an odd number of them
};

// Call Begin first and End last. What is drawn later lies on top. Everything throws
// Failure if the file cannot be written.
class Drawing
{
public:
  virtual ~Drawing() = default;

  // The longest side of a page that the format holds, in millimetres.
  virtual double LongestSide() const = 0;

  virtual void Begin(const DrawingPage& page) = 0;
  // What follows belongs to a layer of this label in UTF-8, until the next one begins.
  virtual void BeginLayer(const std::string& label) = 0;
  virtual void FillDisc(const PagePoint& centre, double radius, Colour colour) = 0;
  // Fills polygons as one area: no seams show where they touch.
  virtual void FillPolygons(
    const std::vector<PagePath>& polygons, FillRule rule, Colour colour) = 0;
  // A path with round ends and corners; a closed one returns to its first point.
  virtual void Stroke(const PagePath& path, bool isClosed, Colour colour) = 0;
  virtual void End() = 0;
};

} // namespace RectifiedTransport

#endif
