// SPDX-License-Identifier: BSD-3-Clause
// The properties Kernel and Radius.
#ifndef RectifiedTransport_SplatSettings_h
#define RectifiedTransport_SplatSettings_h

#include "Core/Messages/PropertyCheck.h"
#include "Core/Splat/Splat.h"

namespace RectifiedTransport::Bridge
{

constexpr const char* KernelTexts[] = { "CloudInCell", "NearestCell", "TriangularShapedCloud",
  "Gaussian" };

// With the default Boundary. Throws Failure for values out of range.
inline SplatOptions splatOptions(int kernel, double radius)
{
  requireChoice("Kernel", kernel, KernelTexts);
  requireThat(radius > 0.0 && radius <= SplatOptions::LargestRadius, "Radius", radius,
    "above 0 and at most 10000 cells");
  SplatOptions options;
  options.Kernel = static_cast<SplatKernel>(kernel);
  options.Radius = radius;
  return options;
}

} // namespace RectifiedTransport::Bridge

#endif
