// SPDX-License-Identifier: BSD-3-Clause
// Classes that ParaView makes by their names, as the XML gives them: domains and helpers.
#ifndef RectifiedTransport_ClassByName_h
#define RectifiedTransport_ClassByName_h

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"
#include "vtkNew.h"

namespace RectifiedTransport
{

// Call it when the plugin's library is loaded, to initialise a constant.
template <class T>
bool registerClass()
{
  const auto addTo = [](vtkClientServerInterpreter* interpreter) {
    const auto make = [](void*) -> vtkObjectBase* { return T::New(); };
    interpreter->AddNewInstanceFunction(vtkNew<T>()->GetClassName(), make);
  };
  vtkClientServerInterpreterInitializer::GetInitializer()->RegisterCallback(addTo);
  return true;
}

} // namespace RectifiedTransport

#endif
