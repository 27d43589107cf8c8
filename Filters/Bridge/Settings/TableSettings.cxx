// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Settings/TableSettings.h"

#include "Bridge/Run/PropertyCheck.h"

#include <ostream>

namespace RectifiedTransport
{

namespace
{

const char* const TablesTexts[] = { "Auto", "Whole", "Tiled" };

} // namespace

const char* TableSettings::Text() const
{
  return choiceText(TablesTexts, this->Tables);
}

void TableSettings::Print(std::ostream& os, vtkIndent indent) const
{
  os << indent << "Tables: " << this->Text() << "\n";
}

void TableSettings::Check() const
{
  requireChoice("Tables", this->Tables, TablesTexts);
}

} // namespace RectifiedTransport
