// SPDX-License-Identifier: BSD-3-Clause
// Traced scripts that run where the plugin is not loaded.
#ifndef RectifiedTransport_PluginTrace_h
#define RectifiedTransport_PluginTrace_h

class vtkSMProxy;

namespace RectifiedTransport
{

// Before a proxy is made: a trace gets the lines that load the plugin, once, if the proxy is the
// plugin's. ParaView traces them only where the plugin is loaded by hand during the trace.
void tracePlugin(vtkSMProxy* proxy);

} // namespace RectifiedTransport

#endif
