// SPDX-License-Identifier: BSD-3-Clause
// The properties of the seeds of particles, checked, as text and printed.
#ifndef RectifiedTransport_SeedSettings_h
#define RectifiedTransport_SeedSettings_h

#include "Core/Seeds/Seeds.h"

#include "vtkIndent.h"

#include <iosfwd>

namespace RectifiedTransport
{

// The values are those of vtkSeedPropertiesMacro.
struct SeedSettings
{
  int SeedPattern;
  int RandomSeed;

  const char* PatternText() const;
  void Print(std::ostream& os, vtkIndent indent) const;

  // Throws Failure for a value out of range.
  RectifiedTransport::SeedPattern Pattern() const;
};

} // namespace RectifiedTransport

// For the source file of a class that has vtkSeedPropertiesMacro.
#define vtkImplementSeedPropertiesMacro(Class)                                                     \
  RectifiedTransport::SeedSettings Class::GetSeedSettings()                                        \
  {                                                                                                \
    return { this->SeedPattern, this->RandomSeed };                                                \
  }                                                                                                \
  const char* Class::GetSeedPatternAsString()                                                      \
  {                                                                                                \
    return this->GetSeedSettings().PatternText();                                                  \
  }

#endif
