// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAreaPreservingParameterization.h"

#include "Bridge/Parameterization/AreaPreservingParameterization.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Settings/CornerSettings.h"
#include "Bridge/Surface/SurfaceInput.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkAreaPreservingParameterization);

using namespace RectifiedTransport;

//------------------------------------------------------------------------------
vtkAreaPreservingParameterization::vtkAreaPreservingParameterization()
  : Resolution(512)
  , Polish(true)
  , Corners(std::make_unique<CornerSettings>())
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
  this->SetPortPolicy(0, PORT_GATHERED_SURFACE);
}

//------------------------------------------------------------------------------
vtkAreaPreservingParameterization::~vtkAreaPreservingParameterization() = default;

//------------------------------------------------------------------------------
void vtkAreaPreservingParameterization::SetNumberOfCorners(int count)
{
  changeCorners(this, [=]() { return this->Corners->Resize(count); });
}

//------------------------------------------------------------------------------
int vtkAreaPreservingParameterization::GetNumberOfCorners()
{
  return this->Corners->Number();
}

//------------------------------------------------------------------------------
void vtkAreaPreservingParameterization::SetCorner(int index, vtkIdType point)
{
  changeCorners(this, [=]() { return this->Corners->Set(index, point); });
}

//------------------------------------------------------------------------------
vtkIdType vtkAreaPreservingParameterization::GetCorner(int index)
{
  return static_cast<vtkIdType>(this->Corners->At(index));
}

//------------------------------------------------------------------------------
vtkPolyData* vtkAreaPreservingParameterization::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
int vtkAreaPreservingParameterization::FillInputPortInformation(int, vtkInformation* info)
{
  SurfaceInput::Require(info);
  return 1;
}

//------------------------------------------------------------------------------
int vtkAreaPreservingParameterization::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkAreaPreservingParameterization::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  AreaPreservingParameterization parameterization{};
  parameterization.Corners = *this->Corners;
  parameterization.Resolution = this->Resolution;
  parameterization.Polish = this->Polish;
  parameterization.Check();
  AlgorithmProgress progress(this, this->Threading);

  const SurfaceInput input(vtkDataObject::GetData(inputVector[0]), progress);
  if (!input.Get())
  {
    return 1;
  }
  const ParameterizationReport report =
    parameterization.Run(input.Get(), progress, vtkPolyData::GetData(outputVector));
  for (const std::string& warning : report.Warnings())
  {
    vtkWarningMacro(<< warning);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkAreaPreservingParameterization::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Corners->Print(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Polish: " << (this->Polish ? "On" : "Off") << "\n";
}
VTK_ABI_NAMESPACE_END
