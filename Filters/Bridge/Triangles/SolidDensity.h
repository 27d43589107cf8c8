// SPDX-License-Identifier: BSD-3-Clause
// The density of a solid: the worker of vtkSolidDensity.
#ifndef RectifiedTransport_SolidDensity_h
#define RectifiedTransport_SolidDensity_h

#include "Bridge/Triangles/ClosedSurface.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"

#include <array>
#include <functional>
#include <memory>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct SolidDensityReport
{
  ImageGrid Grid;     // the whole image
  std::string Repair; // a warning; empty if the surface needed no repair
  // In the index space of the cells.
  std::shared_ptr<const ClosedSurface> Surface;
};

// The members are the properties of that class, and what other filters say of them.
struct SolidDensity
{
  int Resolution;
  int Supersampling;
  double Padding;
  bool OnPoints;
  bool MayBeOpen; // OpenSurfaces
  // What the error about an open surface begins with, as lists of messages cut its end, and what
  // users know Resolution by.
  std::string OpenAdvice = "OpenSurfaces WindingNumber takes this surface with its holes. ";
  const char* ResolutionName = "Resolution";

  // The grid of the image around a surface that is distributed over ranks; without points if there
  // is no surface. Collective. Throws Failure.
  ImageGrid GridAround(vtkPolyData* surface, const Ranks& ranks) const;

  // Writes the fraction of each image cell that a closed surface encloses, for the cells of the
  // extent that is chosen for an image. Throws Failure and Cancelled.
  SolidDensityReport Run(vtkPolyData* surface,
    const std::function<std::array<int, 6>(const ImageGrid&)>& chooseExtent, Progress& progress,
    vtkImageData* output) const;
};

} // namespace RectifiedTransport::Bridge

#endif
