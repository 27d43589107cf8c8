// SPDX-License-Identifier: BSD-3-Clause
// The property Tables, checked, as text and printed.
#ifndef RectifiedTransport_TableSettings_h
#define RectifiedTransport_TableSettings_h

#include "vtkIndent.h"

#include <iosfwd>

namespace RectifiedTransport
{

// The values are those of vtkTablesPropertiesMacro.
struct TableSettings
{
  int Tables;

  const char* Text() const;
  void Print(std::ostream& os, vtkIndent indent) const;
  // Throws Failure for a value out of range.
  void Check() const;
};

} // namespace RectifiedTransport

// For the source file of a class that has vtkTablesPropertiesMacro.
#define vtkImplementTablesPropertiesMacro(Class)                                                   \
  RectifiedTransport::TableSettings Class::GetTableSettings()                                      \
  {                                                                                                \
    return { this->Tables };                                                                       \
  }                                                                                                \
  const char* Class::GetTablesAsString()                                                           \
  {                                                                                                \
    return this->GetTableSettings().Text();                                                        \
  }

#endif
