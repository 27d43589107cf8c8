// SPDX-License-Identifier: BSD-3-Clause
// How a filter spreads the mass of particles, as its properties say it: checked, named and printed.
#ifndef RectifiedTransport_SplatSettings_h
#define RectifiedTransport_SplatSettings_h

#include "Core/Splat/Splat.h"

#include "vtkIndent.h"

#include <iosfwd>

namespace RectifiedTransport
{

// The values are those of the enumerations in vtkMassSplatter.
struct SplatSettings
{
  int Kernel;
  double Radius;
  int Boundary;

  const char* KernelText() const;
  const char* BoundaryText() const;
  void Print(std::ostream& os, vtkIndent indent) const;

  // Throws Failure for what is out of range.
  SplatOptions Options() const;
};

} // namespace RectifiedTransport

#endif
