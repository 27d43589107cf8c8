// SPDX-License-Identifier: BSD-3-Clause
// The properties of the splat kernel, checked, as text and printed.
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

  // With the default Boundary. Throws Failure for values out of range.
  SplatOptions Options() const;
};

} // namespace RectifiedTransport

// For the source file of a class that has vtkSplatPropertiesMacro.
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
