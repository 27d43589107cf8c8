// SPDX-License-Identifier: BSD-3-Clause
// The geometry of an image without its data, as pipelines publish it, and that of another image on
// the same domain.
#ifndef RectifiedTransport_ImageFrame_h
#define RectifiedTransport_ImageFrame_h

#include <array>

class vtkImageData;
class vtkInformation;

namespace RectifiedTransport
{

class ImageFrame
{
public:
  explicit ImageFrame(vtkImageData* image);
  // What a pipeline has published; it has no points where it has published no extent.
  explicit ImageFrame(vtkInformation* information);

  void CopyTo(vtkImageData* image) const;
  void Publish(vtkInformation* information) const;

  bool IsEmpty() const;
  // The numbers of values of a point or cell array along the axes, 1 where there is no axis.
  std::array<int, 3> Values(bool onPoints) const;

  // The frame with other numbers of values, on the domain that the cells (or dual cells of the
  // points) cover; 0 for as many as there are. Throws Failure, which names `property`.
  ImageFrame WithValues(const int values[3], bool onPoints, const char* property) const;

  // Of the numbers alone, which differ wherever WithValues changes anything.
  bool HasExtentOf(const ImageFrame& other) const { return this->Extent == other.Extent; }

private:
  std::array<int, 6> Extent;
  std::array<double, 3> Origin;
  std::array<double, 3> Spacing;
  std::array<double, 9> Direction;
};

} // namespace RectifiedTransport

#endif
