// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSolidDensity.h"

#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Image/SolidGrid.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/InputBlock.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Settings/AssociationSettings.h"
#include "Bridge/Solid/SolidDensity.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkSolidDensity);
vtkImplementAssociationPropertiesMacro(vtkSolidDensity);

namespace
{
using namespace RectifiedTransport;

constexpr int MaximumSupersampling = 16;
} // namespace

//------------------------------------------------------------------------------
vtkSolidDensity::vtkSolidDensity()
  : Resolution(64)
  , Supersampling(2)
  , Padding(0.05)
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
}

//------------------------------------------------------------------------------
vtkSolidDensity::~vtkSolidDensity() = default;

//------------------------------------------------------------------------------
vtkImageData* vtkSolidDensity::GetOutput()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
int vtkSolidDensity::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkSolidDensity::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkSolidDensity::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->UpdateInputBeforeData(0, inputVector, outputVector);
  vtkPolyData* surface = vtkPolyData::GetData(inputVector[0]);
  const SolidDensity solid{ this->Resolution, this->Supersampling, this->Padding,
    this->GetAssociationSettings().IsOnPoints() };
  const ImageGrid grid = surface && surface->GetNumberOfPoints() > 0
    ? solid.GridAround(surface)
    : ImageGrid().WithValuesOn(solid.OnPoints);
  announceDensity(grid, outputVector->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
int vtkSolidDensity::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireThat(this->Supersampling >= 1 && this->Supersampling <= MaximumSupersampling,
    "Supersampling", this->Supersampling, "from 1 to 16");
  this->GetAssociationSettings().Check();
  requireSolidGrid(this->Resolution, this->Padding);
  AlgorithmProgress progress(this, this->Threading);

  // All data are in piece 0, whatever pieces are requested.
  if (this->IsLaterPiece(request, outputVector))
  {
    return 1;
  }
  auto* input = requireBlock<vtkPolyData>(vtkDataObject::GetData(inputVector[0]), "The input",
    "a vtkPolyData, as Extract Surface makes one of it");
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  vtkImageData* output = vtkImageData::GetData(outputVector, 0);
  const SolidDensity solid{ this->Resolution, this->Supersampling, this->Padding,
    this->GetAssociationSettings().IsOnPoints() };
  solid.Run(input, progress, output);
  // The extent may change with time.
  announceGrid(gridOf(output, true), outputVector->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
void vtkSolidDensity::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Supersampling: " << this->Supersampling << "\n";
  os << indent << "Padding: " << this->Padding << "\n";
  this->GetAssociationSettings().Print(os, indent);
}
VTK_ABI_NAMESPACE_END
