// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportAlgorithm.h"

#include "Bridge/Run/StepReport.h"
#include "Bridge/Settings/FlowSettings.h"
#include "Bridge/Settings/TableSettings.h"

VTK_ABI_NAMESPACE_BEGIN
using namespace RectifiedTransport;

//------------------------------------------------------------------------------
vtkTransportAlgorithm::vtkTransportAlgorithm(int densityPort)
  : vtkDensityAlgorithm(densityPort)
  , Tables(TABLES_AUTO)
  , Integrator(MULTISTEP)
  , NumberOfSteps(0)
  , AreaTolerance(0.02)
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
void vtkTransportAlgorithm::WarnOfSteps(const FlowReport& flow, const FlowOptions& options,
  FlowDirection direction, const std::string& name)
{
  const std::string warning = stepWarning(flow, options, direction);
  if (!warning.empty())
  {
    this->WarnOnFirstRank(name.empty() ? warning : name + ": " + warning);
  }
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::WarnOfAreas()
{
  this->WarnOnFirstRank(
    "EqualizeAreas changed nothing: every pass made errors larger or folds more "
    "numerous (less contrast helps, for example a part of the mean added with "
    "Calculator)");
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tables: " << this->GetTablesAsString() << "\n";
  printFlowOptions(*this, os, indent);
}
VTK_ABI_NAMESPACE_END
