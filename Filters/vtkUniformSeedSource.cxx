// SPDX-License-Identifier: BSD-3-Clause
#include "vtkUniformSeedSource.h"

#include "Bridge/PropertyCheck.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkUniformSeedSource);

namespace
{
const char* const PatternTexts[] = { "BlueNoise", "Lattice", "Jittered", "LowDiscrepancy",
  "Random" };
}

//------------------------------------------------------------------------------
vtkUniformSeedSource::vtkUniformSeedSource()
  : Bounds{ 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 }
  , Dimension(2)
  , NumberOfPoints(8192)
  , Pattern(BLUE_NOISE)
  , RandomSeed(1)
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkUniformSeedSource::~vtkUniformSeedSource() = default;

//------------------------------------------------------------------------------
const char* vtkUniformSeedSource::GetPatternAsString()
{
  return RectifiedTransport::choiceText(PatternTexts, this->Pattern);
}

//------------------------------------------------------------------------------
int vtkUniformSeedSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

//------------------------------------------------------------------------------
void vtkUniformSeedSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Bounds: " << this->Bounds[0] << " " << this->Bounds[1] << " "
     << this->Bounds[2] << " " << this->Bounds[3] << " " << this->Bounds[4] << " "
     << this->Bounds[5] << "\n";
  os << indent << "Dimension: " << this->Dimension << "\n";
  os << indent << "NumberOfPoints: " << this->NumberOfPoints << "\n";
  os << indent << "Pattern: " << this->GetPatternAsString() << "\n";
  os << indent << "RandomSeed: " << this->RandomSeed << "\n";
}
VTK_ABI_NAMESPACE_END
