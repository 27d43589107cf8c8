// SPDX-License-Identifier: BSD-3-Clause
#include "Display/PluginTrace.h"

#include "Display/ProxyTexts.h"

#include "vtkPVPluginsInformation.h"
#include "vtkSMPluginManager.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSession.h"
#include "vtkSMTrace.h"
#include "vtkWeakPointer.h"

namespace RectifiedTransport
{

namespace
{

void traceLoading(vtkPVPluginsInformation* plugins, bool isRemote)
{
  for (unsigned int i = 0; plugins && i < plugins->GetNumberOfPlugins(); ++i)
  {
    const char* name = plugins->GetPluginName(i);
    if (name && std::string(name) == "RectifiedTransport" && plugins->GetPluginLoaded(i))
    {
      SM_SCOPED_TRACE(LoadPlugin).arg(plugins->GetPluginFileName(i)).arg("remote", isRemote);
    }
  }
}

} // namespace

void tracePlugin(vtkSMProxy* proxy)
{
  static vtkWeakPointer<vtkSMTrace> traced;
  vtkSMTrace* trace = vtkSMTrace::GetActiveTracer();
  if (!trace || trace == traced || !proxy || !isOfPlugin(proxy))
  {
    return;
  }
  traced = trace;
  vtkSMPluginManager* plugins = vtkSMProxyManager::GetProxyManager()->GetPluginManager();
  vtkSMSession* session = proxy->GetSession();
  if ((session->GetProcessRoles() & vtkPVSession::SERVERS) == 0)
  {
    traceLoading(plugins->GetRemoteInformation(session), true);
  }
  traceLoading(plugins->GetLocalInformation(), false);
}

} // namespace RectifiedTransport
