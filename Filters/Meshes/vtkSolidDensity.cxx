// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSolidDensity.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Ranks/GatheredData.h"
#include "Bridge/Ranks/RankConsistency.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Inputs/InputBlock.h"
#include "Bridge/Run/Settings/AssociationSettings.h"
#include "Bridge/Triangles/SolidDensity.h"
#include "Core/Geometry/Boxes/SolidGrid.h"
#include "Core/Messages/PropertyCheck.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkSolidDensity);

namespace
{
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

constexpr int MaximumSupersampling = 16;
// The enumeration of the class indexes these.
constexpr const char* OpenSurfacesTexts[] = { "Error", "WindingNumber" };

SolidDensity solidOf(vtkSolidDensity& filter)
{
  SolidDensity solid{};
  solid.Resolution = filter.GetResolution();
  solid.Supersampling = filter.GetSupersampling();
  solid.Padding = filter.GetPadding();
  solid.OnPoints = isOnPoints(filter.GetAssociation());
  solid.MayBeOpen = filter.GetOpenSurfaces() == vtkSolidDensity::OPEN_SURFACES_WINDING_NUMBER;
  return solid;
}
} // namespace

//------------------------------------------------------------------------------
vtkSolidDensity::vtkSolidDensity()
{
  this->AddInputPort(PORT_PARTITIONED_POINTS, { "vtkPolyData" });
  this->AddOutputPort("vtkImageData");
}

//------------------------------------------------------------------------------
const char* vtkSolidDensity::GetAssociationAsString()
{
  return choiceText(AssociationTexts, this->Association);
}

//------------------------------------------------------------------------------
const char* vtkSolidDensity::GetOpenSurfacesAsString()
{
  return choiceText(OpenSurfacesTexts, this->OpenSurfaces);
}

//------------------------------------------------------------------------------
int vtkSolidDensity::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const Ranks& ranks = this->UpdateInputOnRanks(0, inputVector, outputVector);
  const ImageGrid grid = solidOf(*this).GridAround(vtkPolyData::GetData(inputVector[0]), ranks);
  announceSubExtents(outputVector->GetInformationObject(0));
  announceDensity(grid, outputVector->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
int vtkSolidDensity::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireThat(this->Supersampling >= 1 && this->Supersampling <= MaximumSupersampling,
    "Supersampling", this->Supersampling, "from 1 to 16");
  requireChoice("OpenSurfaces", this->OpenSurfaces, OpenSurfacesTexts);
  const SolidDensity solid = solidOf(*this);
  requireSolidGrid(this->Resolution, this->Padding);
  const Ranks& ranks = this->GetRanks();
  AlgorithmProgress progress(this, this->Threading, ranks);

  auto* input = requireBlock<vtkPolyData>(vtkDataObject::GetData(inputVector[0]), "The input",
    "a vtkPolyData, as Extract Surface makes one of it");
  const vtkSmartPointer<vtkPointSet> gathered =
    gatherPoints(input, ranks, Receivers::All, PointSetKind::Polygons);
  auto* surface = vtkPolyData::SafeDownCast(gathered);
  if (!surface || surface->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  vtkInformation* information = outputVector->GetInformationObject(0);
  const SolidDensityReport report = solid.Run(
    surface, [&](const ImageGrid& all) { return extentToGive(all.Extent(), information, ranks); },
    progress, vtkImageData::GetData(outputVector, 0));
  this->WarnOnFirstRank(report.Repair);
  // The extent may change with time.
  announceGrid(report.Grid, information);
  return 1;
}

//------------------------------------------------------------------------------
void vtkSolidDensity::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Supersampling: " << this->Supersampling << "\n";
  os << indent << "Padding: " << this->Padding << "\n";
  os << indent << "Association: " << this->GetAssociationAsString() << "\n";
  os << indent << "OpenSurfaces: " << this->GetOpenSurfacesAsString() << "\n";
}
VTK_ABI_NAMESPACE_END
