// SPDX-License-Identifier: BSD-3-Clause
#include "pqGivenInputDecorator.h"

#include "pqCoreUtilities.h"
#include "pqPropertyWidget.h"

#include "vtkCommand.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

pqGivenInputDecorator::pqGivenInputDecorator(
  vtkPVXMLElement* config, pqPropertyWidget* parentWidgetOfProperty)
  : Superclass(config, parentWidgetOfProperty)
{
  const char* name = config->GetAttribute("property");
  this->Input = name ? parentWidgetOfProperty->proxy()->GetProperty(name) : nullptr;
  int inverse = 0;
  this->IsInverse = config->GetScalarAttribute("inverse", &inverse) != 0 && inverse != 0;
  if (this->Input)
  {
    // An input that is taken away makes the second event alone, when that is applied.
    for (const auto event :
      { vtkCommand::UncheckedPropertyModifiedEvent, vtkCommand::ModifiedEvent })
    {
      pqCoreUtilities::connect(this->Input, event, this, SIGNAL(visibilityChanged()));
    }
  }
}

bool pqGivenInputDecorator::canShowWidget(bool showAdvanced) const
{
  if (!this->Input)
  {
    return this->Superclass::canShowWidget(showAdvanced);
  }
  vtkSMUncheckedPropertyHelper helper(this->Input, true);
  const bool isGiven = helper.GetNumberOfElements() > 0 && helper.GetAsProxy(0) != nullptr;
  return isGiven != this->IsInverse && this->Superclass::canShowWidget(showAdvanced);
}
