// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportSampler.h"

#include "Bridge/Data/PointInput.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Flow/TransportSampler.h"
#include "Bridge/Ranks/DistributedPoints.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Settings/SeedSettings.h"
#include "Bridge/Run/StepReport.h"
#include "Core/Device/DeviceUse.h"
#include "Core/Messages/PartText.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <memory>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportSampler);

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

//------------------------------------------------------------------------------
vtkTransportSampler::vtkTransportSampler()
{
  this->AddDensityPort(PORT_PARTITIONED_DENSITY);
  this->AddInputPort(PORT_PARTITIONED_POINTS, { "vtkPointSet" }, PORT_OPTIONAL_INPUT);
  this->AddOutputPort("vtkPolyData");
}

//------------------------------------------------------------------------------
const char* vtkTransportSampler::GetSeedPatternAsString()
{
  return choiceText(SeedPatternTexts, this->SeedPattern);
}

//------------------------------------------------------------------------------
int vtkTransportSampler::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* seeds = pointSetOf(inputVector[1]);
  TransportSampler sampler{ this->GetTransportSettings() };
  sampler.Pattern = seedPattern("SeedPattern", this->SeedPattern);
  sampler.NumberOfParticles = this->NumberOfParticles;
  sampler.RandomSeed = this->RandomSeed;
  sampler.SamplesPerCell = this->SamplesPerCell;
  sampler.FlowTime = this->FlowTime;
  sampler.OutputPaths = this->OutputPaths != 0;
  sampler.SampleArrays = this->SampleArrays != 0;
  requireThat(
    this->SamplesPerCell >= 0, "SamplesPerCell", this->SamplesPerCell, "0 (not used) or greater");
  requireThat(this->NumberOfParticles >= 1 || seeds || sampler.UsesGrid(), "NumberOfParticles",
    this->NumberOfParticles, "at least 1");
  requireThat(
    this->FlowTime >= 0.0 && this->FlowTime <= 1.0, "FlowTime", this->FlowTime, "from 0 to 1");
  const Ranks& ranks = this->GetRanks();
  DeviceUse device = this->BeginDevice();
  AlgorithmProgress progress(this, this->Threading, ranks, &device);
  Stages stages(progress, { { "reading", 5 }, { "particles", 95 } });

  const std::unique_ptr<InputDensity> density = this->ReadDensity(inputVector, stages["reading"]);
  if (!density)
  {
    return 1;
  }
  vtkSmartPointer<vtkPointSet> counted;
  if (inputVector[1]->GetNumberOfInformationObjects() > 0)
  {
    counted = countedPoints(seeds, ranks);
    seeds = counted;
  }
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const TransportSampler::Report report =
    sampler.Run(*density, seeds, this->GetFlowCache(), stages["particles"], output);
  addReadings(output, { density->HowRead() });
  this->EndDevice(device);
  this->WarnOnFirstRank(report.Transport.Warning);
  this->WarnOnFirstRank(stepWarning(report.Flow, sampler.Flow, FlowDirection::Forward, true));
  const std::string ofAll = " of " + std::to_string(report.Particles);
  if (report.SeedsMoved > 0)
  {
    this->WarnOnFirstRank(std::to_string(report.SeedsMoved) + ofAll +
      " seeds outside the domain of the density moved to its border");
  }
  if (isWorthWarning(report.ParticlesMoved, report.Particles))
  {
    this->WarnOnFirstRank(std::to_string(report.ParticlesMoved) + ofAll +
      " particles in empty cells moved to the nearest cell with mass" +
      report.Transport.WithSteps(" (more NumberOfSteps may spare them that)"));
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportSampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfParticles: " << this->NumberOfParticles << "\n";
  os << indent << "SeedPattern: " << this->GetSeedPatternAsString() << "\n";
  os << indent << "RandomSeed: " << this->RandomSeed << "\n";
  os << indent << "SamplesPerCell: " << this->SamplesPerCell << "\n";
  os << indent << "FlowTime: " << this->FlowTime << "\n";
  os << indent << "OutputPaths: " << (this->OutputPaths ? "On" : "Off") << "\n";
  os << indent << "SampleArrays: " << (this->SampleArrays ? "On" : "Off") << "\n";
}
VTK_ABI_NAMESPACE_END
