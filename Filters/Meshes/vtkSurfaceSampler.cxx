// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceSampler.h"

#include "Bridge/Blocks/OptionalArray.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Settings/FlowSettings.h"
#include "Bridge/Run/Settings/SeedSettings.h"
#include "Bridge/Triangles/SurfaceDensityArray.h"
#include "Bridge/Triangles/SurfaceInput.h"
#include "Bridge/Triangles/SurfaceSampler.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Parameterization/CornerSettings.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkSurfaceSampler);

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

//------------------------------------------------------------------------------
vtkSurfaceSampler::vtkSurfaceSampler()
{
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "");
}

//------------------------------------------------------------------------------
const char* vtkSurfaceSampler::GetMethodAsString()
{
  return choiceText(SurfaceMethodTexts, this->Method);
}

//------------------------------------------------------------------------------
const char* vtkSurfaceSampler::GetSeedPatternAsString()
{
  return choiceText(SeedPatternTexts, this->SeedPattern);
}

//------------------------------------------------------------------------------
const char* vtkSurfaceSampler::GetIntegratorAsString()
{
  return choiceText(IntegratorTexts, this->Integrator);
}

//------------------------------------------------------------------------------
const char* vtkSurfaceSampler::GetTableLookupAsString()
{
  return choiceText(TableLookupTexts, this->TableLookup);
}

//------------------------------------------------------------------------------
const char* vtkSurfaceSampler::GetFlowMapsAsString()
{
  return choiceText(FlowMapsTexts, this->FlowMaps);
}

//------------------------------------------------------------------------------
int vtkSurfaceSampler::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  SurfaceSampler sampler{};
  requireChoice("Method", this->Method, SurfaceMethodTexts);
  sampler.Method = this->Method == FLOW ? SurfaceMethod::Flow : SurfaceMethod::Relaxation;
  sampler.RelaxationIterations = this->RelaxationIterations;
  sampler.Corners = this->GetCorners();
  sampler.Options.NumberOfSamples = this->NumberOfParticles;
  sampler.Options.RandomSeed = static_cast<std::uint64_t>(this->RandomSeed);
  sampler.Options.Resolution = this->Resolution;
  sampler.Options.Pattern = seedPattern("SeedPattern", this->SeedPattern);
  sampler.Options.Flow = flowOptionsOf(*this);
  sampler.Check();
  AlgorithmProgress progress(this, this->Threading);
  Stages stages(progress, { { "surface", 1 }, { "particles", 99 } });

  const SurfaceInput input(vtkDataObject::GetData(inputVector[0]), stages["surface"]);
  if (!input.Get())
  {
    return 1;
  }
  const OptionalArray chosen =
    findOptionalArray(this->GetInputArrayInformation(0), input.Get(), "density array");
  const SurfaceDensityArray density = chosen.IsChosen
    ? SurfaceDensityArray(input.Get(), chosen.Array, chosen.OnPoints, chosen.Name)
    : SurfaceDensityArray();
  const SurfaceSamplingReport report =
    sampler.Run(input, density, stages["particles"], vtkPolyData::GetData(outputVector));
  this->WarnOnFirstRank(report.Warnings());
  return 1;
}

//------------------------------------------------------------------------------
void vtkSurfaceSampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfParticles: " << this->NumberOfParticles << "\n";
  os << indent << "Method: " << this->GetMethodAsString() << "\n";
  os << indent << "RelaxationIterations: " << this->RelaxationIterations << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "SeedPattern: " << this->GetSeedPatternAsString() << "\n";
  os << indent << "RandomSeed: " << this->RandomSeed << "\n";
  printFlowOptions(*this, os, indent);
}
VTK_ABI_NAMESPACE_END
