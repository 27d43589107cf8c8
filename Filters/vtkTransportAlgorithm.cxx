// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportAlgorithm.h"

#include "Bridge/Density/FlowCache.h"
#include "Bridge/Flow/FlowSettings.h"

VTK_ABI_NAMESPACE_BEGIN

struct vtkTransportAlgorithm::vtkInternals
{
  RectifiedTransport::FlowCache Cache;
};

//------------------------------------------------------------------------------
vtkTransportAlgorithm::vtkTransportAlgorithm(int densityPort)
  : vtkDensityAlgorithm(densityPort)
  , Integrator(MULTISTEP)
  , NumberOfSteps(32)
  , Tolerance(0.01)
  , TableLookup(INTERPOLATED)
  , Threading(THREADING_AUTO)
  , Internals(new vtkInternals)
{
}

//------------------------------------------------------------------------------
vtkTransportAlgorithm::~vtkTransportAlgorithm() = default;

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetIntegratorAsString()
{
  return this->GetFlowSettings().IntegratorText();
}

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetTableLookupAsString()
{
  return this->GetFlowSettings().TableLookupText();
}

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetThreadingAsString()
{
  return this->GetFlowSettings().ThreadingText();
}

//------------------------------------------------------------------------------
vtkMTimeType vtkTransportAlgorithm::GetTableBuildTime()
{
  return this->Internals->Cache.BuildTime();
}

//------------------------------------------------------------------------------
RectifiedTransport::FlowCache& vtkTransportAlgorithm::GetFlowCache()
{
  return this->Internals->Cache;
}

//------------------------------------------------------------------------------
RectifiedTransport::FlowSettings vtkTransportAlgorithm::GetFlowSettings()
{
  return { this->Integrator, this->NumberOfSteps, this->Tolerance, this->TableLookup,
    this->Threading };
}

//------------------------------------------------------------------------------
RectifiedTransport::FlowOptions vtkTransportAlgorithm::GetFlowOptions()
{
  return this->GetFlowSettings().Options();
}

//------------------------------------------------------------------------------
RectifiedTransport::Executor* vtkTransportAlgorithm::NewExecutor()
{
  return this->GetFlowSettings().MakeExecutor().release();
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->GetFlowSettings().Print(os, indent);
  os << indent << "TableBuildTime: " << this->GetTableBuildTime() << "\n";
}
VTK_ABI_NAMESPACE_END
