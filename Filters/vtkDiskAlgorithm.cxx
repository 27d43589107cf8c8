// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDiskAlgorithm.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Settings/CornerSettings.h"

#include "vtkPolyData.h"

VTK_ABI_NAMESPACE_BEGIN

namespace
{
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

// change() returns whether anything changed.
template <class Change>
void changeCorners(vtkObject* object, const Change& change)
{
  try
  {
    if (change())
    {
      object->Modified();
    }
  }
  catch (const Failure& failure)
  {
    vtkErrorWithObjectMacro(object, << failure.what());
  }
}
} // namespace

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
  changeCorners(this, [=]() { return this->Corners->Resize(count); });
}

//------------------------------------------------------------------------------
int vtkDiskAlgorithm::GetNumberOfCorners()
{
  return this->Corners->Number();
}

//------------------------------------------------------------------------------
void vtkDiskAlgorithm::SetCorner(int index, vtkIdType point)
{
  changeCorners(this, [=]() { return this->Corners->Set(index, point); });
}

//------------------------------------------------------------------------------
vtkIdType vtkDiskAlgorithm::GetCorner(int index)
{
  return static_cast<vtkIdType>(this->Corners->At(index));
}

//------------------------------------------------------------------------------
vtkPolyData* vtkDiskAlgorithm::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
void vtkDiskAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Corners->Print(os, indent);
}
VTK_ABI_NAMESPACE_END
