// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportBarycenter.h"

#include "Bridge/Ensembles/DensityBlend.h"
#include "Bridge/Run/Settings/IndexedList.h"

#include "vtkObjectFactory.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportBarycenter);

using namespace RectifiedTransport::Bridge;

struct vtkTransportBarycenter::vtkWeights
{
  IndexedList<double> List{ "weights", "index of a weight", 0.0 };
};

//------------------------------------------------------------------------------
vtkTransportBarycenter::vtkTransportBarycenter()
  : vtkTransportBlend(true)
  , Weights(new vtkWeights)
{
  this->AddDensityPort(PORT_PARTITIONED_DENSITY, PORT_SEVERAL_INPUTS);
}

//------------------------------------------------------------------------------
vtkTransportBarycenter::~vtkTransportBarycenter() = default;

//------------------------------------------------------------------------------
void vtkTransportBarycenter::SetNumberOfWeights(int count)
{
  this->Weights->List.Resize(this, count);
}

//------------------------------------------------------------------------------
int vtkTransportBarycenter::GetNumberOfWeights()
{
  return this->Weights->List.Number();
}

//------------------------------------------------------------------------------
void vtkTransportBarycenter::SetWeight(int index, double weight)
{
  this->Weights->List.Set(this, index, weight);
}

//------------------------------------------------------------------------------
double vtkTransportBarycenter::GetWeight(int index)
{
  return this->Weights->List.At(index);
}

//------------------------------------------------------------------------------
int vtkTransportBarycenter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->BlendInputs(
    inputVector, outputVector, this->GetBlendSettings(), nullptr, this->Weights->List.All);
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportBarycenter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Weights:";
  this->Weights->List.Print(os, " equal");
}
VTK_ABI_NAMESPACE_END
