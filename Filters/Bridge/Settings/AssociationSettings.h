// SPDX-License-Identifier: BSD-3-Clause
// Where a filter puts the values of the image that it makes, as its property says it: checked and
// named.
#ifndef RectifiedTransport_AssociationSettings_h
#define RectifiedTransport_AssociationSettings_h

namespace RectifiedTransport
{

// The values are those of vtkAssociationPropertiesMacro.
struct AssociationSettings
{
  int Association;

  const char* Text() const;
  // Of what is in range.
  bool IsOnPoints() const { return this->Association == 0; }
  // Throws Failure for what is out of range.
  void Check() const;
};

} // namespace RectifiedTransport

// What a class needs that has vtkAssociationPropertiesMacro.
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
