// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportBarycenter.h"

#include "Bridge/Blend/DensityBlend.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Settings/IndexedList.h"
#include "Core/Device/DeviceUse.h"
#include "Core/Parallel/Stages.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportBarycenter);

namespace
{
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

// One weight an input, with the sum 1; equal ones for an empty list. Throws Failure for a list of
// another length, weights that are negative or not finite, and weights that are all 0.
std::vector<double> normalizedWeights(const std::vector<double>& list, std::size_t inputs)
{
  if (list.empty())
  {
    return std::vector<double>(inputs, 1.0 / static_cast<double>(inputs));
  }
  std::ostringstream message;
  if (list.size() != inputs)
  {
    message << "The number of Weights is " << list.size() << " and that of inputs " << inputs
            << "; there must be one for each, or none for equal weights";
    throw Failure(message.str());
  }
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    if (!(list[i] >= 0.0) || std::isinf(list[i]))
    {
      message << "Weight " << i << " of the Weights is " << list[i]
              << "; weights must be finite and at least 0";
      throw Failure(message.str());
    }
  }
  const double largest = *std::max_element(list.begin(), list.end());
  if (largest == 0.0)
  {
    throw Failure("All Weights are 0; at least one must be above 0");
  }
  // Divided by the largest first only where the sum overflows: weights of sum 1 remain unchanged.
  const bool fits = std::isfinite(std::accumulate(list.begin(), list.end(), 0.0));
  std::vector<double> weights;
  for (const double weight : list)
  {
    weights.push_back(fits ? weight : weight / largest);
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights)
  {
    weight /= sum;
  }
  return weights;
}
} // namespace

struct vtkTransportBarycenter::vtkWeights
{
  IndexedList<double> List{ "weights", "index of a weight", 0.0 };
};

//------------------------------------------------------------------------------
vtkTransportBarycenter::vtkTransportBarycenter()
  : vtkTransportBlend(true)
  , Weights(new vtkWeights)
  , Blend(new DensityBlend)
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
  const BlendSettings settings = this->GetBlendSettings();
  DeviceUse device = this->BeginDevice();
  AlgorithmProgress progress(this, this->Threading, this->GetRanks(), &device);
  Stages stages(progress, { { "reading", 5 }, { "blend", 95 } });

  std::vector<BlendInput> inputs = this->ReadInputs(inputVector, nullptr, stages["reading"]);
  if (inputs.empty())
  {
    return 1;
  }
  const std::vector<double> weights = normalizedWeights(this->Weights->List.All, inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    inputs[i].Weight = weights[i];
  }
  const BlendReport report = this->Blend->Run(
    inputs, settings, this->GetFlowCache(), stages["blend"], BlendOutput(outputVector));
  this->EndDevice(device);
  this->WarnOfMaps(report);
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
