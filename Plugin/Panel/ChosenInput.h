// SPDX-License-Identifier: BSD-3-Clause
// What is chosen on the panel, before and after Apply.
#ifndef RectifiedTransport_ChosenInput_h
#define RectifiedTransport_ChosenInput_h

#include "pqCoreUtilities.h"

#include "vtkCommand.h"
#include "vtkSMProperty.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

namespace RectifiedTransport
{

// The data of the first input; nullptr without one.
inline vtkPVDataInformation* chosenData(vtkSMProperty* property)
{
  if (!property)
  {
    return nullptr;
  }
  vtkSMUncheckedPropertyHelper input(property);
  auto* source =
    input.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy(0)) : nullptr;
  return source ? source->GetDataInformation(input.GetOutputPort(0)) : nullptr;
}

// Calls a slot, or sends a signal, whenever the choice changes. An input that is taken away makes
// the second event alone, when that is applied.
inline void followChoice(vtkSMProperty* property, QObject* receiver, const char* slot)
{
  if (property)
  {
    for (const auto event :
      { vtkCommand::UncheckedPropertyModifiedEvent, vtkCommand::ModifiedEvent })
    {
      pqCoreUtilities::connect(property, event, receiver, slot);
    }
  }
}

} // namespace RectifiedTransport

#endif
