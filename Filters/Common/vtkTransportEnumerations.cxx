// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportEnumerations.h"

VTK_ABI_NAMESPACE_BEGIN
//------------------------------------------------------------------------------
void vtkTransportEnumerations::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
VTK_ABI_NAMESPACE_END
