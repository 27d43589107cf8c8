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

// The members are the properties of that class.
struct MassSplatter
{
  std::array<int, 3> Dimensions; // without a reference
  bool OnPoints;
  bool DivideByVolume;
  SplatOptions Splat;

  struct Report
  {
    ImageGrid Grid; // of the whole image; empty where there is none
    std::int64_t Points = 0;
    std::int64_t Outside = 0; // of the grid
  };
  // What ranks want and give together.
  struct Share
  {
    bool HasReference;
    vtkInformation* Output; // of the pipeline
  };

  // The grid of the output on the points' bounds, without a reference. Throws Failure.
  ImageGrid GridAround(const double (&bounds)[6]) const;

  // Splats masses, 1 each where `masses` is nullptr, onto the grid of a reference, or of the
  // points' bounds. Throws Failure and Cancelled.
  Report Run(vtkPointSet* points, vtkDataArray* masses, vtkImageData* reference, Progress& progress,
    vtkImageData* output) const;

  // The same of the points of the progress's ranks, which call this together. Each gives its part
  // of points and reference, which may be nullptr, and gets the part of the image that extentToGive
  // says.
  Report RunOnRanks(vtkPointSet* points, vtkDataArray* masses, vtkImageData* reference,
    const Share& share, Progress& progress, vtkImageData* output) const;

private:
  ImageGrid CellsIn(const double (&bounds)[6]) const;
  ImageGrid GridOf(const ImageGrid& cells, bool hasReference) const;
};

} // namespace RectifiedTransport

#endif
