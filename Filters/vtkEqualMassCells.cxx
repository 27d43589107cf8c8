// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEqualMassCells.h"

#include "Bridge/Image/DefaultArray.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/InputBlock.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Settings/FlowSettings.h"
#include "Bridge/SiteCells/EqualMassCells.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <cmath>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkEqualMassCells);
vtkImplementFlowPropertiesMacro(vtkEqualMassCells);

namespace
{
using namespace RectifiedTransport;

// The box of a domain, as of a density: with point data that of the dual cells.
ImageGrid boxOf(vtkImageData* domain)
{
  const ImageGrid grid = gridOf(domain, false);
  return hasPointValues(domain) ? grid.WithDualCells() : grid;
}

// The bounds of sites, 10 % longer along each axis.
ImageGrid boxAround(vtkPointSet* sites)
{
  constexpr double margin = 0.05; // on each side
  double bounds[6];
  findBounds(sites, bounds);
  for (int a = 0; a < 3; ++a)
  {
    const double length = bounds[2 * a + 1] - bounds[2 * a];
    bounds[2 * a] -= margin * length;
    bounds[2 * a + 1] += margin * length;
  }
  return gridOfBox(bounds);
}
} // namespace

struct vtkEqualMassCells::vtkInternals
{
  SiteLabels Labels;
};

//------------------------------------------------------------------------------
vtkEqualMassCells::vtkEqualMassCells()
  : Resolution(512)
  , NormExponent(2.0)
  , CostExponent(2.0)
  , Internals(new vtkInternals)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

//------------------------------------------------------------------------------
vtkEqualMassCells::~vtkEqualMassCells() = default;

//------------------------------------------------------------------------------
void vtkEqualMassCells::SetDomainConnection(vtkAlgorithmOutput* domain)
{
  this->SetInputConnection(1, domain);
}

//------------------------------------------------------------------------------
void vtkEqualMassCells::SetDomainData(vtkDataObject* domain)
{
  this->SetInputData(1, domain);
}

//------------------------------------------------------------------------------
vtkImageData* vtkEqualMassCells::GetLabels()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
vtkPointSet* vtkEqualMassCells::GetSites()
{
  return vtkPointSet::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
vtkPolyData* vtkEqualMassCells::GetOutlines()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(2));
}

//------------------------------------------------------------------------------
int vtkEqualMassCells::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
    return 1;
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkEqualMassCells::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[] = { "vtkImageData", "vtkPointSet", "vtkPolyData" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------
int vtkEqualMassCells::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkGuardedAlgorithm::MakeOutputLike(inputVector[0], outputVector, 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkEqualMassCells::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  ImageGrid box;
  if (inputVector[1]->GetNumberOfInformationObjects() > 0)
  {
    // The announced association of the values may be missing or wrong.
    this->UpdateInputBeforeData(1, inputVector, outputVector);
    vtkImageData* domain = vtkImageData::GetData(inputVector[1], 0);
    box = domain && domain->GetNumberOfPoints() > 0
      ? boxOf(domain)
      : announcedGrid(inputVector[1]->GetInformationObject(0), false);
  }
  else
  {
    this->UpdateInputBeforeData(0, inputVector, outputVector);
    vtkPointSet* sites = vtkPointSet::GetData(inputVector[0]);
    const double unit[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 0.0 };
    box = sites && sites->GetNumberOfPoints() > 1 ? boxAround(sites) : gridOfBox(unit);
  }
  box = box.IsEmpty() ? box : gridWithResolution(box, this->Resolution, "Resolution");
  announceGrid(box, outputVector->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
int vtkEqualMassCells::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireThat(
    this->NormExponent >= 1.0, "NormExponent", this->NormExponent, "at least 1, or infinite");
  requireThat(this->CostExponent > 0.0 && std::isfinite(this->CostExponent), "CostExponent",
    this->CostExponent, "a number above 0");
  requireResolution("Resolution", this->Resolution);
  const FlowOptions options = this->GetFlowSettings().Options();
  AlgorithmProgress progress(this, this->Threading);

  // All data are in piece 0, whatever pieces are requested.
  vtkInformation* labelInformation = outputVector->GetInformationObject(0);
  if (vtkGuardedAlgorithm::IsLaterPiece(request, outputVector))
  {
    return 1;
  }
  vtkPointSet* input = pointSetOf(inputVector[0]);
  auto* domain = requireBlock<vtkImageData>(
    vtkDataObject::GetData(inputVector[1]), "The Domain", "a vtkImageData");
  if (!input || input->GetNumberOfPoints() == 0 || (domain && domain->GetNumberOfPoints() == 0))
  {
    return 1;
  }
  if (!domain)
  {
    // Coordinates that are not finite have no bounds.
    visitPoints(input, "input point set", progress, [](std::int64_t, const double*) {});
  }
  const ImageGrid box = domain ? boxOf(domain) : boxAround(input);
  if (box.Dimension() == 0)
  {
    throw Failure(domain
        ? "The Domain has one point along every axis; it needs at least one axis "
          "of two points or more"
        : "The input's sites are all at one point, about which there is no domain; "
          "connect an image as the Domain");
  }
  const ImageGrid grid = gridWithResolution(box, this->Resolution, "Resolution");
  requireCells(grid);
  announceGrid(grid, labelInformation); // without a Domain possibly not known before the data

  const EqualMassCells cells{ options, { this->NormExponent, this->CostExponent } };
  const std::int64_t outside = cells.Run(input, grid, this->Internals->Labels, progress,
    { vtkImageData::GetData(outputVector, 0), vtkPointSet::GetData(outputVector, 1),
      vtkPolyData::GetData(outputVector, 2) });
  if (outside > 0)
  {
    vtkWarningMacro(<< outside << " of " << input->GetNumberOfPoints()
                    << (outside == 1 ? " sites is outside the domain; its cell is that of the "
                                       "nearest point of the border"
                                     : " sites are outside the domain; their cells are those of "
                                       "the nearest points of its border"));
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkEqualMassCells::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "NormExponent: " << this->NormExponent << "\n";
  os << indent << "CostExponent: " << this->CostExponent << "\n";
  this->GetFlowSettings().Print(os, indent);
}
VTK_ABI_NAMESPACE_END
