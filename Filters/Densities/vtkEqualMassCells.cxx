// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEqualMassCells.h"

#include "Bridge/Data/Cells/CellCheck.h"
#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Plan/FlowCache.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/StepReport.h"
#include "Bridge/SiteCells/CellOutputs.h"
#include "Bridge/SiteCells/EqualMassCells.h"
#include "Bridge/SiteCells/LabelGrid.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Messages/Failure.h"
#include "Core/Messages/PartText.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Core/SiteCells/DensitySiteCells.h"
#include "Core/SiteCells/LabelPixels.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

#include <cmath>
#include <memory>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkEqualMassCells);

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

namespace
{
// Both are indexed by the enumerations of the class.
constexpr const char* ShapeTexts[] = { "Flow", "Power" };
constexpr const char* MeasureTexts[] = { "Uniform", "Density" };
} // namespace

// The division into sites' cells is kept between executions: an execution that changes only the
// exponents of the cost measures the same labels again.
struct vtkEqualMassCells::vtkInternals
{
  StoreSlot Labels;
};

//------------------------------------------------------------------------------
vtkEqualMassCells::vtkEqualMassCells()
  : vtkFlowAlgorithm(1)
  , Internals(new vtkInternals)
{
  this->AddInputPort(PORT_GATHERED_POINTS, { "vtkPointSet" });
  this->AddDensityPort(PORT_GATHERED_DENSITY, PORT_OPTIONAL_INPUT);
  this->AddOutputPort("vtkImageData");
  this->AddOutputPort("vtkPointSet");
  this->AddOutputPort("vtkPolyData");
  this->AddOutputPort("vtkPolyData");
}

//------------------------------------------------------------------------------
vtkEqualMassCells::~vtkEqualMassCells() = default;

//------------------------------------------------------------------------------
const char* vtkEqualMassCells::GetShapeAsString()
{
  return choiceText(ShapeTexts, this->Shape);
}

//------------------------------------------------------------------------------
const char* vtkEqualMassCells::GetMeasureAsString()
{
  return choiceText(MeasureTexts, this->Measure);
}

//------------------------------------------------------------------------------
// Announces the grid of Labels before the data, as image filters downstream need it. The grid is
// that of the Domain; without one it surrounds the sites, whose bounds are in no information, so
// that the producer of the points is updated here.
int vtkEqualMassCells::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const LabelGrid pixels{ this->Resolution };
  ImageGrid grid;
  if (inputVector[1]->GetNumberOfInformationObjects() > 0)
  {
    // The announced association of the values may be missing or wrong.
    const Ranks& ranks = this->UpdateInputOnRanks(1, inputVector, outputVector);
    vtkInformation* information = inputVector[1]->GetInformationObject(0);
    vtkDataObject* domain = vtkDataObject::GetData(information);
    if (this->Measure == DENSITY)
    {
      // An unknown grid stays empty here, and the box that the information announces stands in for
      // it.
      const ImageGrid density = this->AnnouncedDensityGrid(information);
      grid = density.IsEmpty() ? density : pixels.On(density);
    }
    else if (domain)
    {
      grid = pixels.On(domain, ranks);
    }
    if (grid.IsEmpty())
    {
      const ImageGrid box = announcedGrid(information, false);
      grid = box.IsEmpty() ? box : pixels.On(box);
    }
  }
  else
  {
    const Ranks& ranks = this->UpdateInputOnRanks(0, inputVector, outputVector);
    vtkPointSet* sites = vtkPointSet::GetData(inputVector[0]);
    const auto count = sumOverRanks<std::int64_t>(ranks, sites ? sites->GetNumberOfPoints() : 0);
    // One site has bounds without volume: the domain is then a unit square, a placeholder for an
    // execution that reports an error or that has no sites.
    const double unit[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 0.0 };
    grid = count > 1 ? pixels.Around(sites, ranks) : labelPixels(gridOfBox(unit), this->Resolution);
  }
  announceSubExtents(outputVector->GetInformationObject(0));
  announceGrid(grid, outputVector->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
// The first rank has divided the whole image; each rank gets the extent that is requested of it.
// The sites and the polygons remain on the first rank.
void vtkEqualMassCells::ShareOutputs(const Ranks& ranks, vtkInformationVector* outputVector)
{
  distributeImage(
    vtkImageData::GetData(outputVector, 0), outputVector->GetInformationObject(0), ranks);
}

//------------------------------------------------------------------------------
// Both ports are gathered: with several ranks only the first one runs this, on all data, and
// nothing in it is collective.
int vtkEqualMassCells::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireThat(
    this->NormExponent >= 1.0, "NormExponent", this->NormExponent, "at least 1, or infinite");
  requireThat(this->CostExponent > 0.0 && std::isfinite(this->CostExponent), "CostExponent",
    this->CostExponent, "a number above 0");
  if (this->Resolution != 0)
  {
    requireResolution("Resolution", this->Resolution);
  }
  requireChoice("Shape", this->Shape, ShapeTexts);
  requireChoice("Measure", this->Measure, MeasureTexts);
  // A power diagram is optimal for the squared Euclidean distance alone, where both exponents are
  // 2.
  if (this->Shape == SHAPE_POWER)
  {
    constexpr const char* rule = "2, which Shape Power needs";
    requireThat(this->NormExponent == 2.0, "NormExponent", this->NormExponent, rule);
    requireThat(this->CostExponent == 2.0, "CostExponent", this->CostExponent, rule);
  }
  EqualMassCells cells{};
  cells.Flow = this->GetFlowOptions();
  cells.Norm = { this->NormExponent, this->CostExponent };
  cells.Resolution = this->Resolution;
  cells.IsPower = this->Shape == SHAPE_POWER;
  cells.Warn = [this](const std::string& text) { this->WarnOnFirstRank(text); };
  AlgorithmProgress progress(this, this->Threading);
  Stages stages(progress,
    { { "reading", this->Measure == DENSITY ? 5.0 : 0.0 }, { "cells", 94 }, { "colours", 1 } });

  vtkPointSet* input = pointSetOf(inputVector[0]);
  requireReadableCells(input, "input");
  // The connection is tested apart from its data: without data, as after an abort upstream, the
  // outputs are empty; without a connection, Measure Density cannot be what the user means.
  vtkDataObject* domain = vtkDataObject::GetData(inputVector[1], 0);
  if (this->Measure == DENSITY && inputVector[1]->GetNumberOfInformationObjects() == 0)
  {
    throw Failure("Measure is Density, but there is no Domain; connect data with a density as the "
                  "Domain, or set Measure to Uniform");
  }
  vtkImageData* labels = vtkImageData::GetData(outputVector, 0);
  const CellOutputs outputs{ labels, vtkPointSet::GetData(outputVector, 1),
    vtkPolyData::GetData(outputVector, 2), vtkPolyData::GetData(outputVector, 3) };
  EqualMassCells::Report report;
  if (this->Measure == DENSITY)
  {
    const std::unique_ptr<InputDensity> density = this->ReadDensity(inputVector, stages["reading"]);
    if (!density || !input || input->GetNumberOfPoints() == 0)
    {
      return 1;
    }
    report = cells.Run(
      input, *density, this->GetFlowCache(), this->Internals->Labels, stages["cells"], outputs);
    for (vtkDataObject* output : outputs.All())
    {
      addReadings(output, { density->HowRead() });
    }
  }
  else
  {
    // Measure Uniform needs no tables of a density; those of an earlier execution would stay in
    // memory.
    this->GetFlowCache().Release();
    if (!input || input->GetNumberOfPoints() == 0 ||
      (domain && LabelGrid{ this->Resolution }.On(domain).IsEmpty()))
    {
      return 1;
    }
    report = cells.Run(input, domain, this->Internals->Labels, stages["cells"], outputs);
  }
  // Colours come last, because they compare the neighbours among the final cells.
  addSiteColors(labels, outputs.Polygons, input->GetNumberOfPoints(), stages["colours"]);
  // Without a Domain the grid may not be known before the data.
  if (!this->RunsForAllRanks()) // else ShareOutputs does so
  {
    announceGrid(gridOf(labels, false), outputVector->GetInformationObject(0));
  }
  // All four outputs have the figures of the run, so that each can be used alone.
  const std::int64_t sites = input->GetNumberOfPoints();
  for (vtkDataObject* output : outputs.All())
  {
    addFieldValue(output, "OutsideSites", static_cast<double>(report.Outside));
    addFieldValue(output, "SitesWithoutMass", static_cast<double>(report.WithoutMass));
    if (this->Shape == SHAPE_FLOW)
    {
      addSteps(output, { report.Flow });
    }
  }
  // The flow of sites has at least this many steps, whatever NumberOfSteps says: the warning has to
  // compare with what was taken.
  FlowOptions taken = cells.Flow;
  taken.LeastSteps = leastStepsOfSiteCells;
  this->WarnOnFirstRank(stepWarning(report.Flow, taken, FlowDirection::Backward));
  if (isWorthWarning(report.Outside, sites))
  {
    const bool isOne = report.Outside == 1;
    const char* const cell = this->Shape == SHAPE_POWER
      ? (isOne ? "its cell is of least cost for where it is"
               : "their cells are of least cost for where they are")
      : (isOne ? "its cell is that of the nearest point of the border"
               : "their cells are those of the nearest points of its border");
    vtkWarningMacro(<< report.Outside << " of " << sites << (isOne ? " sites is" : " sites are")
                    << " outside the domain; " << cell);
  }
  if (isWorthWarning(report.WithoutMass, sites))
  {
    vtkWarningMacro(<< report.WithoutMass << " of " << sites
                    << " sites have cells without mass, because single pixels have more than an "
                       "equal share; raise Resolution, or set Shape to Power");
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
  os << indent << "Shape: " << this->GetShapeAsString() << "\n";
  os << indent << "Measure: " << this->GetMeasureAsString() << "\n";
}
VTK_ABI_NAMESPACE_END
