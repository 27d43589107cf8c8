// SPDX-License-Identifier: BSD-3-Clause
// How particles look when they are shown for the first time.
#ifndef RectifiedTransport_DotDisplay_h
#define RectifiedTransport_DotDisplay_h

class vtkSMPVRepresentationProxy;
class vtkSMSourceProxy;
class vtkSMViewProxy;

namespace RectifiedTransport
{

constexpr const char* typeOfDots = "Point Gaussian";

// The number of axes along which bounds have an extent.
int dimensionOf(const double bounds[6]);

// Particles in space are spheres. Flat ones are plain circles without an array's colours, dark on a
// light background and light on a dark one. The radius is from their spacing. All this follows the
// background, and the radius the particles, until the user changes it.
void showDots(vtkSMSourceProxy* producer, int port, vtkSMViewProxy* view,
  vtkSMPVRepresentationProxy* representation);

} // namespace RectifiedTransport

#endif
