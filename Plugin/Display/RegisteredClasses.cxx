// SPDX-License-Identifier: BSD-3-Clause
// Classes that ParaView makes by their names, as the XML gives them: domains, helpers, proxies and
// representations.
#include "Display/vtkCheckeredSurfaceRepresentation.h"
#include "Display/vtkFilledOutlinesRepresentation.h"
#include "Display/vtkSMDensityArrayDomain.h"
#include "Display/vtkSMDeviceNameDomain.h"
#include "Display/vtkSMTransportMorphProxy.h"
#include "Display/vtkSMTransportStateProxy.h"
#include "Display/vtkSMVectorWriterInitializationHelper.h"

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"

namespace
{

template <class T>
vtkObjectBase* make(void*)
{
  return T::New();
}

// The proxies of representations call methods of a superclass.
int callSuperclass(vtkClientServerInterpreter* interpreter, vtkObjectBase* object,
  const char* method, const vtkClientServerStream& arguments, vtkClientServerStream& result, void*)
{
  return interpreter->CallCommandFunction(
    "vtkGeometryRepresentationWithFaces", object, method, arguments, result);
}

void addClasses(vtkClientServerInterpreter* to)
{
  to->AddNewInstanceFunction(
    "vtkCheckeredSurfaceRepresentation", make<vtkCheckeredSurfaceRepresentation>);
  to->AddCommandFunction("vtkCheckeredSurfaceRepresentation", callSuperclass);
  to->AddNewInstanceFunction(
    "vtkFilledOutlinesRepresentation", make<vtkFilledOutlinesRepresentation>);
  to->AddCommandFunction("vtkFilledOutlinesRepresentation", callSuperclass);
  to->AddNewInstanceFunction("vtkSMDensityArrayDomain", make<vtkSMDensityArrayDomain>);
  to->AddNewInstanceFunction("vtkSMDeviceNameDomain", make<vtkSMDeviceNameDomain>);
  to->AddNewInstanceFunction("vtkSMTransportMorphProxy", make<vtkSMTransportMorphProxy>);
  to->AddNewInstanceFunction("vtkSMTransportStateProxy", make<vtkSMTransportStateProxy>);
  to->AddNewInstanceFunction(
    "vtkSMVectorWriterInitializationHelper", make<vtkSMVectorWriterInitializationHelper>);
}

// When the plugin's library is loaded.
const bool isRegistered = []() {
  vtkClientServerInterpreterInitializer::GetInitializer()->RegisterCallback(addClasses);
  return true;
}();

} // namespace
