// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFlowAlgorithm.h"

#include "Bridge/Run/Settings/FlowSettings.h"

VTK_ABI_NAMESPACE_BEGIN
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

//------------------------------------------------------------------------------
const char* vtkFlowAlgorithm::GetIntegratorAsString()
{
  return choiceText(IntegratorTexts, this->Integrator);
}

//------------------------------------------------------------------------------
const char* vtkFlowAlgorithm::GetTableLookupAsString()
{
  return choiceText(TableLookupTexts, this->TableLookup);
}

//------------------------------------------------------------------------------
const char* vtkFlowAlgorithm::GetFlowMapsAsString()
{
  return choiceText(FlowMapsTexts, this->FlowMaps);
}

//------------------------------------------------------------------------------
FlowOptions vtkFlowAlgorithm::GetFlowOptions()
{
  return flowOptionsOf(*this);
}

//------------------------------------------------------------------------------
void vtkFlowAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  printFlowOptions(*this, os, indent);
}
VTK_ABI_NAMESPACE_END
