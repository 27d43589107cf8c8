// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportAlgorithm.h"

#include "Bridge/Settings/FlowSettings.h"
#include "Bridge/Settings/TableSettings.h"

VTK_ABI_NAMESPACE_BEGIN
using namespace RectifiedTransport;

//------------------------------------------------------------------------------
vtkTransportAlgorithm::vtkTransportAlgorithm(int densityPort)
  : vtkDensityAlgorithm(densityPort)
  , Tables(TABLES_AUTO)
  , Integrator(MULTISTEP)
  , NumberOfSteps(32)
  , Tolerance(0.01)
  , TableLookup(INTERPOLATED)
  , FlowMaps(FLOW_MAPS_AUTO)
{
}

//------------------------------------------------------------------------------
vtkTransportAlgorithm::~vtkTransportAlgorithm() = default;

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetTablesAsString()
{
  return choiceText(TablesTexts, this->Tables);
}

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetIntegratorAsString()
{
  return choiceText(IntegratorTexts, this->Integrator);
}

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetTableLookupAsString()
{
  return choiceText(TableLookupTexts, this->TableLookup);
}

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetFlowMapsAsString()
{
  return choiceText(FlowMapsTexts, this->FlowMaps);
}

//------------------------------------------------------------------------------
FlowOptions vtkTransportAlgorithm::GetFlowOptions()
{
  return flowOptionsOf(*this);
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tables: " << this->GetTablesAsString() << "\n";
  printFlowOptions(*this, os, indent);
}
VTK_ABI_NAMESPACE_END
