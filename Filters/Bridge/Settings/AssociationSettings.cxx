// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Settings/AssociationSettings.h"

#include "Bridge/Run/PropertyCheck.h"

#include <ostream>

namespace RectifiedTransport
{

namespace
{

const char* const AssociationTexts[] = { "Points", "Cells" };

} // namespace

const char* AssociationSettings::Text() const
{
  return choiceText(AssociationTexts, this->Association);
}

void AssociationSettings::Check() const
{
  requireChoice("Association", this->Association, AssociationTexts);
}

void AssociationSettings::Print(std::ostream& os, vtkIndent indent) const
{
  os << indent << "Association: " << this->Text() << "\n";
}

} // namespace RectifiedTransport
