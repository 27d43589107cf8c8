// SPDX-License-Identifier: BSD-3-Clause
#include "vtkUniformSeedSource.h"

#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Settings/SeedSettings.h"
#include "Bridge/Samples/UniformSeedSource.h"
#include "Core/Messages/PropertyCheck.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkUniformSeedSource);

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

//------------------------------------------------------------------------------
vtkUniformSeedSource::vtkUniformSeedSource()
{
  this->AddOutputPort("vtkPolyData");
}

//------------------------------------------------------------------------------
const char* vtkUniformSeedSource::GetPatternAsString()
{
  return choiceText(SeedPatternTexts, this->Pattern);
}

//------------------------------------------------------------------------------
int vtkUniformSeedSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  outputVector->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkUniformSeedSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  requireThat(this->Dimension == 2 || this->Dimension == 3, "Dimension", this->Dimension, "2 or 3");
  requireThat(this->NumberOfPoints >= 1, "NumberOfPoints", this->NumberOfPoints, "at least 1");
  UniformSeedSource source{};
  source.Pattern = seedPattern("Pattern", this->Pattern);
  source.Dimension = this->Dimension;
  source.NumberOfPoints = this->NumberOfPoints;
  source.RandomSeed = this->RandomSeed;
  std::copy_n(this->Bounds, 6, source.Bounds.begin());
  AlgorithmProgress progress(this, this->Threading);
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* output = outputVector->GetInformationObject(0);
  const int pieces = std::max(1, output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()));
  const int piece = output->Get(Pipeline::UPDATE_PIECE_NUMBER());
  if (piece >= 0 && piece < pieces) // there are no more points than in all pieces
  {
    source.Run(piece, pieces, progress, vtkPolyData::GetData(outputVector));
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkUniformSeedSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Bounds: " << this->Bounds[0] << " " << this->Bounds[1] << " " << this->Bounds[2]
     << " " << this->Bounds[3] << " " << this->Bounds[4] << " " << this->Bounds[5] << "\n";
  os << indent << "Dimension: " << this->Dimension << "\n";
  os << indent << "NumberOfPoints: " << this->NumberOfPoints << "\n";
  os << indent << "Pattern: " << this->GetPatternAsString() << "\n";
  os << indent << "RandomSeed: " << this->RandomSeed << "\n";
}
VTK_ABI_NAMESPACE_END
