// SPDX-License-Identifier: BSD-3-Clause
// How a filter spreads the mass of particles, as its properties say it: checked, named and printed.
#ifndef RectifiedTransport_SplatSettings_h
#define RectifiedTransport_SplatSettings_h

#include "Core/Splat/Splat.h"

#include "vtkIndent.h"

#include <iosfwd>

namespace RectifiedTransport
{

// The values are those of vtkSplatPropertiesMacro.
struct SplatSettings
{
  int Kernel;
  double Radius;

  const char* KernelText() const;
  void Print(std::ostream& os, vtkIndent indent) const;

  // With the usual Boundary. Throws Failure for what is out of range.
  SplatOptions Options() const;
};

} // namespace RectifiedTransport

// What a class needs that has vtkSplatPropertiesMacro.
#define vtkImplementSplatPropertiesMacro(Class)                                                    \
  RectifiedTransport::SplatSettings Class::GetSplatSettings()                                      \
  {                                                                                                \
    return { this->Kernel, this->Radius };                                                         \
  }                                                                                                \
  const char* Class::GetKernelAsString()                                                           \
  {                                                                                                \
    return this->GetSplatSettings().KernelText();                                                  \
  }

#endif
