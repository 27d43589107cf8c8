// SPDX-License-Identifier: BSD-3-Clause
// Splats the mass of points: the worker of vtkMassSplatter.
#ifndef RectifiedTransport_MassSplatter_h
#define RectifiedTransport_MassSplatter_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Splat/Splat.h"

#include <array>
#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkImageData;
class vtkInformation;
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// The members are the properties of that class.
struct MassSplatter
{
  std::array<int, 3> Dimensions; // without a reference; 0 0 0: by the points
  bool OnPoints;
  bool DivideByVolume;
  SplatOptions Splat;

  struct Report
  {
    ImageGrid Grid; // the whole image; empty if there is none
    std::int64_t Points = 0;
    std::int64_t Outside = 0; // points outside the grid
  };
  // What masses are splat onto.
  struct Target
  {
    bool HasReference; // else a box around the points
    vtkImageData* Reference;
    vtkInformation* Output; // the pipeline information of the output
  };

  // The grid of the output around so many points, without a reference. Throws Failure.
  ImageGrid GridAround(const double (&bounds)[6], std::int64_t points) const;

  // Splats masses, 1 each if `masses` is nullptr, onto the grid of a reference or of the points'
  // bounds. Collective: each rank gives its part of points and reference, which may be nullptr, and
  // gets the part of the image that extentToGive returns. Throws Failure and Cancelled.
  Report Run(vtkPointSet* points, vtkDataArray* masses, const Target& target, Progress& progress,
    vtkImageData* output) const;

private:
  ImageGrid GridOfReference(vtkImageData* reference, const Ranks& ranks) const;
  ImageGrid CellsIn(const double (&bounds)[6], std::int64_t points) const;
  ImageGrid GridOf(const ImageGrid& cells, bool hasReference) const;
};

} // namespace RectifiedTransport::Bridge

#endif
