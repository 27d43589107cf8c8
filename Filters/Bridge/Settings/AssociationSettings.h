// SPDX-License-Identifier: BSD-3-Clause
// The property Association, checked and as text: whether the values of an output image are point or
// cell data.
#ifndef RectifiedTransport_AssociationSettings_h
#define RectifiedTransport_AssociationSettings_h

#include "vtkIndent.h"

#include <iosfwd>

namespace RectifiedTransport
{

// The values are those of vtkAssociationPropertiesMacro.
struct AssociationSettings
{
  int Association;

  const char* Text() const;
  // For a value in range.
  bool IsOnPoints() const { return this->Association == 0; }
  // Throws Failure for a value out of range.
  void Check() const;
  void Print(std::ostream& os, vtkIndent indent) const;
};

} // namespace RectifiedTransport

// For the source file of a class that has vtkAssociationPropertiesMacro.
#define vtkImplementAssociationPropertiesMacro(Class)                                              \
  RectifiedTransport::AssociationSettings Class::GetAssociationSettings()                          \
  {                                                                                                \
    return { this->Association };                                                                  \
  }                                                                                                \
  const char* Class::GetAssociationAsString()                                                      \
  {                                                                                                \
    return this->GetAssociationSettings().Text();                                                  \
  }

#endif
