// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportSampler.h"

#include "Bridge/PropertyCheck.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportSampler);

namespace
{
const char* const SeedPatternTexts[] = { "BlueNoise", "Lattice", "Jittered", "LowDiscrepancy",
  "Random" };
}

//------------------------------------------------------------------------------
vtkTransportSampler::vtkTransportSampler()
  : NumberOfParticles(8192)
  , SeedPattern(BLUE_NOISE)
  , RandomSeed(1)
  , SamplesPerCell(0)
  , FlowTime(1.0)
  , OutputPaths(false)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(1);
}

//------------------------------------------------------------------------------
vtkTransportSampler::~vtkTransportSampler() = default;

//------------------------------------------------------------------------------
const char* vtkTransportSampler::GetSeedPatternAsString()
{
  return RectifiedTransport::choiceText(SeedPatternTexts, this->SeedPattern);
}

//------------------------------------------------------------------------------
void vtkTransportSampler::SetSeedsConnection(vtkAlgorithmOutput* seeds)
{
  this->SetInputConnection(1, seeds);
}

//------------------------------------------------------------------------------
void vtkTransportSampler::SetSeedsData(vtkDataObject* seeds)
{
  this->SetInputData(1, seeds);
}

//------------------------------------------------------------------------------
vtkPolyData* vtkTransportSampler::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
int vtkTransportSampler::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
    return 1;
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportSampler::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportSampler::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
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
}
VTK_ABI_NAMESPACE_END
