// SPDX-License-Identifier: BSD-3-Clause
#include "pqGivenInputDecorator.h"

#include "ChosenInput.h"

#include "pqPropertyWidget.h"

#include "vtkPVXMLElement.h"
#include "vtkSMProxy.h"

pqGivenInputDecorator::pqGivenInputDecorator(
  vtkPVXMLElement* config, pqPropertyWidget* parentWidgetOfProperty)
  : Superclass(config, parentWidgetOfProperty)
{
  const char* name = config->GetAttribute("property");
  this->Input = name ? parentWidgetOfProperty->proxy()->GetProperty(name) : nullptr;
  int inverse = 0;
  this->IsInverse = config->GetScalarAttribute("inverse", &inverse) != 0 && inverse != 0;
  RectifiedTransport::followChoice(this->Input, this, SIGNAL(visibilityChanged()));
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
