// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Settings/SeedSettings.h"

#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Settings/SeedPatternTexts.h"

#include <ostream>

namespace RectifiedTransport
{

const char* SeedSettings::PatternText() const
{
  return choiceText(SeedPatternTexts, this->SeedPattern);
}

RectifiedTransport::SeedPattern SeedSettings::Pattern() const
{
  requireChoice("SeedPattern", this->SeedPattern, SeedPatternTexts);
  return static_cast<RectifiedTransport::SeedPattern>(this->SeedPattern);
}

void SeedSettings::Print(std::ostream& os, vtkIndent indent) const
{
  os << indent << "SeedPattern: " << this->PatternText() << "\n";
  os << indent << "RandomSeed: " << this->RandomSeed << "\n";
}

} // namespace RectifiedTransport
