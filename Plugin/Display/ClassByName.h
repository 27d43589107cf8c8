// SPDX-License-Identifier: BSD-3-Clause
// Classes that ParaView makes by their names, as the XML gives them: domains, helpers and
// representations.
#ifndef RectifiedTransport_ClassByName_h
#define RectifiedTransport_ClassByName_h

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"

class vtkClientServerStream;
class vtkObjectBase;

namespace RectifiedTransport
{

// Call it when the plugin's library is loaded, to initialise a constant. If the proxy of a class
// calls methods, these are methods of a superclass that ParaView calls by name.
template <class T>
bool registerClass(const char* name, const char* superclass = nullptr)
{
  static const char* const ownName = name; // for functions without captures
  static const char* const calledName = superclass;
  const auto addTo = [](vtkClientServerInterpreter* interpreter) {
    const auto make = [](void*) -> vtkObjectBase* { return T::New(); };
    interpreter->AddNewInstanceFunction(ownName, make);
    if (calledName)
    {
      const auto call = [](vtkClientServerInterpreter* own, vtkObjectBase* object,
                          const char* method, const vtkClientServerStream& arguments,
                          vtkClientServerStream& result, void*) {
        return own->CallCommandFunction(calledName, object, method, arguments, result);
      };
      interpreter->AddCommandFunction(ownName, call);
    }
  };
  vtkClientServerInterpreterInitializer::GetInitializer()->RegisterCallback(addTo);
  return true;
}

} // namespace RectifiedTransport

#endif
