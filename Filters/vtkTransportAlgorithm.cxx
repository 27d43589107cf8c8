// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportAlgorithm.h"

#include "Bridge/Settings/FlowSettings.h"

VTK_ABI_NAMESPACE_BEGIN
vtkImplementFlowPropertiesMacro(vtkTransportAlgorithm);

//------------------------------------------------------------------------------
vtkTransportAlgorithm::vtkTransportAlgorithm(int densityPort)
  : vtkDensityAlgorithm(densityPort)
{
}

//------------------------------------------------------------------------------
vtkTransportAlgorithm::~vtkTransportAlgorithm() = default;

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->GetFlowSettings().Print(os, indent);
}
VTK_ABI_NAMESPACE_END
