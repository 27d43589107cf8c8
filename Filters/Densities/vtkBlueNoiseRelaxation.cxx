// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBlueNoiseRelaxation.h"

#include "Bridge/Data/Cells/CellCheck.h"
#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Samples/BlueNoiseRelaxation.h"
#include "Bridge/Samples/DensityAgreement.h"
#include "Core/Messages/PartText.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <memory>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkBlueNoiseRelaxation);

namespace
{
const char* const RelaxationMethodTexts[] = { "GaussianBlueNoise", "OptimalTransport" };
} // namespace

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

//------------------------------------------------------------------------------
vtkBlueNoiseRelaxation::vtkBlueNoiseRelaxation()
  : vtkDensityAlgorithm(1)
{
  this->AddInputPort(PORT_GATHERED_POINTS, { "vtkPointSet" });
  this->AddDensityPort(PORT_GATHERED_DENSITY);
  this->AddOutputPort("vtkPointSet");
}

//------------------------------------------------------------------------------
const char* vtkBlueNoiseRelaxation::GetMethodAsString()
{
  return choiceText(RelaxationMethodTexts, this->Method);
}

//------------------------------------------------------------------------------
int vtkBlueNoiseRelaxation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireChoice("Method", this->Method, RelaxationMethodTexts);
  requireThat(
    this->MaximumIterations >= 0, "MaximumIterations", this->MaximumIterations, "at least 0");
  requireThat(this->Tolerance >= 0.0 && this->Tolerance < 1.0, "Tolerance", this->Tolerance,
    "at least 0 and less than 1");
  AlgorithmProgress progress(this, this->Threading);
  vtkPointSet* input = pointSetOf(inputVector[0]);
  Stages stages(progress, { { "reading", 5 }, { "relaxation", 95 } });
  const std::unique_ptr<InputDensity> density = this->ReadDensity(inputVector, stages["reading"]);
  if (!density || !input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  const NonGhostPoints counted(input, "input point set");
  requireReadableCells(input, "input");
  vtkPointSet* output = vtkPointSet::GetData(outputVector);
  output->CopyStructure(input);
  output->GetPointData()->PassData(input->GetPointData());
  output->GetCellData()->PassData(input->GetCellData());
  BlueNoiseRelaxation relaxation{};
  relaxation.ByTransport = this->Method == OPTIMAL_TRANSPORT;
  relaxation.Options.MaximumIterations = this->MaximumIterations;
  relaxation.Options.Tolerance = this->Tolerance;
  const BlueNoiseRelaxation::Report report =
    relaxation.Run(*density, input, counted, this->GetFlowCache(), stages["relaxation"], output);
  addReadings(output, { density->HowRead() });
  addFieldValues(output, "Energy", report.Energy);
  addFieldValue(output, "OutsidePoints", static_cast<double>(report.PointsMoved));
  this->WarnOnFirstRank(disagreementWarning(report.Correlation, this->InvertDensity != 0));
  if (isWorthWarning(report.PointsMoved, counted.Count()))
  {
    vtkWarningMacro(<< report.PointsMoved << " of " << counted.Count()
                    << " points outside the domain of the density moved to its border");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkBlueNoiseRelaxation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->GetMethodAsString() << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
}
VTK_ABI_NAMESPACE_END
