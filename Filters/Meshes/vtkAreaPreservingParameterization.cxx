// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAreaPreservingParameterization.h"

#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Triangles/AreaPreservingParameterization.h"
#include "Bridge/Triangles/SurfaceInput.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Parameterization/CornerSettings.h"

#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkAreaPreservingParameterization);

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

//------------------------------------------------------------------------------
vtkAreaPreservingParameterization::vtkAreaPreservingParameterization()
{
  this->AddOutputPort("vtkPolyData"); // Flat
}

//------------------------------------------------------------------------------
const char* vtkAreaPreservingParameterization::GetSeamsAsString()
{
  return choiceText(SeamsTexts, this->Seams);
}

//------------------------------------------------------------------------------
int vtkAreaPreservingParameterization::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  AreaPreservingParameterization parameterization{};
  parameterization.Corners = this->GetCorners();
  parameterization.Resolution = this->Resolution;
  parameterization.Polish = this->Polish;
  parameterization.Seams = this->Seams;
  parameterization.Check();
  AlgorithmProgress progress(this, this->Threading);
  Stages stages(progress, { { "surface", 1 }, { "map", 99 } });

  const SurfaceInput input(vtkDataObject::GetData(inputVector[0]), stages["surface"]);
  if (!input.Get())
  {
    return 1;
  }
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  const ParameterizationReport report = parameterization.Run(input.Get(), stages["map"], output);
  layFlat(output, vtkPolyData::GetData(outputVector, 1));
  this->WarnOnFirstRank(report.Warnings());
  return 1;
}

//------------------------------------------------------------------------------
void vtkAreaPreservingParameterization::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Polish: " << (this->Polish ? "On" : "Off") << "\n";
  os << indent << "Seams: " << this->GetSeamsAsString() << "\n";
}
VTK_ABI_NAMESPACE_END
