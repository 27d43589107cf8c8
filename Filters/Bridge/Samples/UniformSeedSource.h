// SPDX-License-Identifier: BSD-3-Clause
// Points that are uniform in a box: the worker of vtkUniformSeedSource.
#ifndef RectifiedTransport_UniformSeedSource_h
#define RectifiedTransport_UniformSeedSource_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Seeds/Seeds.h"

#include <array>
#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// The members are the properties of that class.
struct UniformSeedSource
{
  SeedPattern Pattern;
  std::array<double, 6> Bounds;
  int Dimension;
  std::int64_t NumberOfPoints;
  int RandomSeed;

  // Makes the points of a piece; their numbers follow those of the pieces before. Throws Failure
  // and Cancelled.
  void Run(int piece, int pieces, Progress& progress, vtkPolyData* output) const;
};

} // namespace RectifiedTransport::Bridge

#endif
