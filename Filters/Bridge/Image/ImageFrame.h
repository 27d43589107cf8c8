// SPDX-License-Identifier: BSD-3-Clause
// The geometry of an image without its data, as pipelines publish it, and that of another image on
// the same domain.
#ifndef RectifiedTransport_ImageFrame_h
#define RectifiedTransport_ImageFrame_h

#include "Bridge/VTKCompatibility.h"

#include <array>
#include <cstddef>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class ImageFrame
{
public:
  ImageFrame(); // without points
  explicit ImageFrame(vtkImageData* image);
  // What a pipeline has published; it has no points where it has published no extent.
  explicit ImageFrame(vtkInformation* information);

  // Points along the coordinate axes.
  ImageFrame(const std::array<int, 3>& points, const std::array<double, 3>& origin,
    const std::array<double, 3>& spacing);

  // A box along the coordinate axes, {x0, x1, y0, y1, z0, z1}: one cell, and no axis where the box
  // is flat (a billionth of its longest side is rounding).
  explicit ImageFrame(const double (&bounds)[6]);

  // The part of the domain of the cells (or dual cells of the points) along an axis. Places are
  // measured from the origin of space along the frame's own directions. Without an axis there, Low
  // is the place of the one point.
  struct Side
  {
    double Low; // where the first cell begins; the highest end if Spacing is negative
    double Spacing;
    int Cells;
    bool IsAxis;
  };
  Side GetSide(std::size_t axis, bool onPoints) const;

  // The frame that has these sides in the directions of another, and whose extent begins at 0.
  ImageFrame WithSides(const std::array<Side, 3>& sides, bool onPoints) const;

  bool operator==(const ImageFrame& other) const;

  // Ask for the memory of what the image will hold before that: from VTK 9.3 on an image keeps the
  // coordinates of its planes of points. Throws Failure where there is no memory for them.
  void CopyTo(vtkImageData* image) const;
  void Publish(vtkInformation* information) const;
  // And that the active scalars will be the array Density, of doubles.
  void PublishDensity(vtkInformation* information, bool onPoints) const;

  bool IsEmpty() const;
  bool HasOnePoint() const { return this->Values(true) == std::array<int, 3>{ 1, 1, 1 }; }
  // The numbers of values of a point or cell array along the axes, 1 where there is no axis.
  std::array<int, 3> Values(bool onPoints) const;

  int NumberOfAxes() const;
  double NumberOfValues(bool onPoints) const;
  // "8 x 4", without the axes of one point.
  std::string DescribeValues(bool onPoints) const;

  // The frame with other numbers of values, on the domain that the cells (or dual cells of the
  // points) cover; 0 for as many as there are. Throws Failure, which names `property`.
  ImageFrame WithValues(const int values[3], bool onPoints, const char* property) const;

  // The frame with `resolution` cells along the longest axis of the domain that the cells cover,
  // and as nearly cubic ones as fit along the others. Throws Failure, which names `property`.
  ImageFrame WithResolution(int resolution, const char* property) const;

  // The frame that has a point at the centre of each of the cells, counted from 0.
  ImageFrame AtCellCentres() const;

  // The frame whose cells are the dual cells of the points: half a spacing more on each side.
  ImageFrame WithDualCells() const;

  // Whether the direction matrix has one, without which there is no GetSide. An axis of one point
  // need not have a direction of its own.
  bool HasInverse() const;

  // To the billionth.
  bool HasDirectionOf(const ImageFrame& other) const;

  // Of the numbers alone, which differ wherever WithValues changes anything.
  bool HasExtentOf(const ImageFrame& other) const { return this->Extent == other.Extent; }

private:
  // Lets an axis have `points` points, the first of them at an index that need not be a whole one.
  void SetAxis(std::size_t axis, double first, int points);

  std::array<int, 6> Extent{ 0, -1, 0, -1, 0, -1 };
  std::array<double, 3> Origin{ 0.0, 0.0, 0.0 };
  std::array<double, 3> Spacing{ 1.0, 1.0, 1.0 };
  std::array<double, 9> Direction{ 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
};

} // namespace RectifiedTransport

#endif
