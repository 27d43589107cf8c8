// SPDX-License-Identifier: BSD-3-Clause
// What of an array of several components is the density.
#ifndef RectifiedTransport_ComponentChoice_h
#define RectifiedTransport_ComponentChoice_h

#include "Core/Tables/Reading/DensityRules.h"

#include "vtkType.h"

namespace RectifiedTransport::Bridge
{

// What Auto takes of an array of a VTK type: an index, Luminance, Magnitude, or AutoComponent
// where it has no choice.
inline int automaticComponent(int type, int components)
{
  // The types of photographs. Velocities, displacements and tensors have others.
  const bool isPhotograph = type == VTK_UNSIGNED_CHAR || type == VTK_UNSIGNED_SHORT;
  return components == 1                ? 0
    : !isPhotograph                     ? Magnitude
    : components <= MostColorComponents ? Luminance
                                        : AutoComponent;
}

} // namespace RectifiedTransport::Bridge

#endif
