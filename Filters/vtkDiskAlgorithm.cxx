// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDiskAlgorithm.h"

#include "Bridge/Triangles/SurfaceInput.h"
#include "Core/Parameterization/CornerSettings.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkPolyData.h"

#include <stdexcept>

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
  catch (const std::invalid_argument& error)
  {
    vtkErrorWithObjectMacro(object, << error.what());
  }
}
} // namespace

//------------------------------------------------------------------------------
vtkDiskAlgorithm::vtkDiskAlgorithm()
  : Corners(std::make_unique<CornerSettings>())
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
  this->SetPortPolicy(0, PORT_GATHERED_SURFACE);
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
int vtkDiskAlgorithm::FillInputPortInformation(int, vtkInformation* info)
{
  SurfaceInput::Require(info);
  return 1;
}

//------------------------------------------------------------------------------
int vtkDiskAlgorithm::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
void vtkDiskAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Corners:" << this->Corners->Text() << "\n";
}
VTK_ABI_NAMESPACE_END
