// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDiskAlgorithm.h"

#include "Bridge/Run/Settings/IndexedList.h"
#include "Surfaces/Parameterization/CornerSettings.h"

VTK_ABI_NAMESPACE_BEGIN

using namespace RectifiedTransport::Bridge;

struct vtkDiskAlgorithm::vtkCorners
{
  IndexedList<std::int64_t> List{ "corners", "index of a corner", -1 };
};

//------------------------------------------------------------------------------
vtkDiskAlgorithm::vtkDiskAlgorithm()
  : Corners(std::make_unique<vtkCorners>())
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
  this->Corners->List.Resize(this, count);
}

//------------------------------------------------------------------------------
int vtkDiskAlgorithm::GetNumberOfCorners()
{
  return this->Corners->List.Number();
}

//------------------------------------------------------------------------------
void vtkDiskAlgorithm::SetCorner(int index, vtkIdType point)
{
  this->Corners->List.Set(this, index, point);
}

//------------------------------------------------------------------------------
vtkIdType vtkDiskAlgorithm::GetCorner(int index)
{
  return static_cast<vtkIdType>(this->Corners->List.At(index));
}

//------------------------------------------------------------------------------
RectifiedTransport::CornerSettings vtkDiskAlgorithm::GetCorners() const
{
  return { this->Corners->List.All };
}

//------------------------------------------------------------------------------
void vtkDiskAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Corners:";
  this->Corners->List.Print(os, " automatic");
}
VTK_ABI_NAMESPACE_END
