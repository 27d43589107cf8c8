// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDensityEqualizingWarp.h"

#include "Bridge/Data/Cells/CellCheck.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/PaddedDensity.h"
#include "Bridge/Flow/DensityEqualizingWarp.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Settings/MissingData.h"
#include "Bridge/Run/StepReport.h"
#include "Core/Device/DeviceUse.h"
#include "Core/Messages/PartText.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <memory>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkDensityEqualizingWarp);

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

//------------------------------------------------------------------------------
vtkDensityEqualizingWarp::vtkDensityEqualizingWarp()
  : vtkTransportAlgorithm(1)
{
  // Each point is moved independently of the others.
  this->AddInputPort(PORT_PIECES, { "vtkPointSet" });
  this->AddDensityPort(PORT_PARTITIONED_DENSITY);
  this->AddOutputPort("vtkPointSet");
  this->EmptyCells = EMPTY_CELLS_MEAN;
}

//------------------------------------------------------------------------------
const char* vtkDensityEqualizingWarp::GetEmptyCellsAsString()
{
  return choiceText(EmptyCellsTexts, this->EmptyCells);
}

//------------------------------------------------------------------------------
int vtkDensityEqualizingWarp::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireThat(this->Blend >= 0.0 && this->Blend <= 1.0, "Blend", this->Blend, "from 0 to 1");
  requireThat(this->Margin >= 0.0 && this->Margin <= LargestMargin, "Margin", this->Margin,
    "from 0 to 10 (times the longest axis)");
  DensityEqualizingWarp warp{ this->GetTransportSettings() };
  warp.Blend = this->Blend;
  warp.EqualizeAreas = this->EqualizeAreas != 0;
  const Ranks& ranks = this->GetRanks();
  DeviceUse device = this->BeginDevice();
  AlgorithmProgress progress(this, this->Threading, ranks, &device);
  vtkPointSet* input = pointSetOf(inputVector[0]);
  Stages stages(progress, { { "reading", 5 }, { "warp", 95 } });
  const std::unique_ptr<InputDensity> density =
    withMargin(this->ReadDensity(inputVector, stages["reading"]), this->Margin,
      emptyRule(this->EmptyCells, this->EmptyValue));
  // A rank without points takes part in what is collective.
  if (!density || !input || (input->GetNumberOfPoints() == 0 && !ranks.AreSeveral()))
  {
    return 1;
  }
  requireReadableCells(input, "input");
  vtkPointSet* output = vtkPointSet::GetData(outputVector);
  output->CopyStructure(input);
  output->GetPointData()->PassData(input->GetPointData());
  output->GetCellData()->PassData(input->GetCellData());
  const DensityEqualizingWarp::Report report =
    warp.Run(*density, input, this->GetFlowCache(), stages["warp"], output);
  addReadings(output, { density->HowRead() });
  this->EndDevice(device);
  const std::int64_t outside = sumOverRanks(ranks, report.Outside);
  const std::int64_t points = sumOverRanks<std::int64_t>(ranks, input->GetNumberOfPoints());
  addFieldValue(output, "OutsidePoints", static_cast<double>(outside));
  if (isWorthWarning(outside, points))
  {
    this->WarnOnFirstRank(std::to_string(outside) + " of " + std::to_string(points) +
      " points outside the domain of the density moved as its border does");
  }
  const InvertedCells cells = sumOverRanks(ranks, report.Cells);
  addFieldValue(output, "FoldedCells", static_cast<double>(cells.Inverted));
  if (isWorthWarning(cells.Inverted, cells.All) ||
    isWorthWarning(cells.InvertedArea.Value(), cells.Area.Value()))
  {
    this->WarnOnFirstRank(describePart(cells.Inverted, cells.All, "cells") + " turned over" +
      report.Transport.WithSteps(
        "; more NumberOfSteps turn most of them back, an input of smaller cells does not") +
      " (where there is no mass, add a small part of the mean to the density)");
  }
  this->WarnOnFirstRank(report.Transport.Warning);
  this->WarnOnFirstRank(stepWarning(report.Flow, warp.Flow, FlowDirection::Backward));
  if (report.IsUncorrected)
  {
    this->WarnOfAreas();
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkDensityEqualizingWarp::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Blend: " << this->Blend << "\n";
  os << indent << "EmptyCells: " << this->GetEmptyCellsAsString() << "\n";
  os << indent << "EmptyValue: " << this->EmptyValue << "\n";
  os << indent << "Margin: " << this->Margin << "\n";
  os << indent << "EqualizeAreas: " << (this->EqualizeAreas ? "On" : "Off") << "\n";
}
VTK_ABI_NAMESPACE_END
