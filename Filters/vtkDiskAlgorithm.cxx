// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDiskAlgorithm.h"

#include "Bridge/Settings/CornerSettings.h"

VTK_ABI_NAMESPACE_BEGIN

using namespace RectifiedTransport::Bridge;

//------------------------------------------------------------------------------
vtkDiskAlgorithm::vtkDiskAlgorithm()
  : Corners(std::make_unique<CornerSettings>())
{
  this->AddInputPort(
    PORT_GATHERED_SURFACE, { "vtkPolyData", "vtkUnstructuredGrid", "vtkStructuredGrid" });
  this->AddOutputPort("vtkPolyData");
}

//------------------------------------------------------------------------------
vtkDiskAlgorithm::~vtkDiskAlgorithm() = default;

//------------------------------------------------------------------------------
void vtkDiskAlgorithm::SetNumberOfCorners(int count)
{
  this->Corners->Resize(this, count);
}

//------------------------------------------------------------------------------
int vtkDiskAlgorithm::GetNumberOfCorners()
{
  return this->Corners->Number();
}

//------------------------------------------------------------------------------
void vtkDiskAlgorithm::SetCorner(int index, vtkIdType point)
{
  this->Corners->Set(this, index, point);
}

//------------------------------------------------------------------------------
vtkIdType vtkDiskAlgorithm::GetCorner(int index)
{
  return static_cast<vtkIdType>(this->Corners->At(index));
}

//------------------------------------------------------------------------------
void vtkDiskAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Corners:";
  this->Corners->Print(os, " automatic");
}
VTK_ABI_NAMESPACE_END
