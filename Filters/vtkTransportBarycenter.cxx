// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportBarycenter.h"

#include "Bridge/Run/Failure.h"

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
// Many more than there are inputs: each takes memory when it is set, before anything is checked.
constexpr int mostWeights = 1000000;
} // namespace

struct vtkTransportBarycenter::vtkWeights
{
  std::vector<double> List;
};

//------------------------------------------------------------------------------
vtkTransportBarycenter::vtkTransportBarycenter()
  : Weights(new vtkWeights)
{
  this->SetNumberOfInputPorts(1);
}

//------------------------------------------------------------------------------
vtkTransportBarycenter::~vtkTransportBarycenter() = default;

//------------------------------------------------------------------------------
void vtkTransportBarycenter::SetNumberOfWeights(int count)
{
  if (count < 0 || count > mostWeights)
  {
    vtkErrorMacro(<< "The number of weights is " << count << "; it must be from 0 to "
                  << mostWeights);
    return;
  }
  if (count != this->GetNumberOfWeights())
  {
    this->Weights->List.resize(static_cast<std::size_t>(count));
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkTransportBarycenter::GetNumberOfWeights()
{
  return static_cast<int>(this->Weights->List.size());
}

//------------------------------------------------------------------------------
void vtkTransportBarycenter::SetWeight(int index, double weight)
{
  if (index < 0 || index >= mostWeights)
  {
    vtkErrorMacro(<< "The index of a weight is " << index << "; it must be from 0 to "
                  << mostWeights - 1);
    return;
  }
  this->SetNumberOfWeights(std::max(index + 1, this->GetNumberOfWeights()));
  double& known = this->Weights->List[static_cast<std::size_t>(index)];
  if (known != weight)
  {
    known = weight;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkTransportBarycenter::GetWeight(int index)
{
  return index >= 0 && index < this->GetNumberOfWeights()
    ? this->Weights->List[static_cast<std::size_t>(index)]
    : 0.0;
}

//------------------------------------------------------------------------------
int vtkTransportBarycenter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  // Else an executive would run the filter once for each block.
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportBarycenter::ComputeWeights(int numberOfInputs, double* weights)
{
  const std::vector<double>& list = this->Weights->List;
  if (list.empty())
  {
    std::fill_n(weights, numberOfInputs, 1.0 / numberOfInputs);
    return;
  }
  std::ostringstream message;
  if (list.size() != static_cast<std::size_t>(numberOfInputs))
  {
    message << "The number of Weights is " << list.size() << " and that of inputs "
            << numberOfInputs << "; there must be one for each, or none for equal weights";
    throw RectifiedTransport::Failure(message.str());
  }
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    if (!(list[i] >= 0.0) || std::isinf(list[i]))
    {
      message << "Weight " << i << " of the Weights is " << list[i]
              << "; weights must be finite and at least 0";
      throw RectifiedTransport::Failure(message.str());
    }
  }
  const double largest = *std::max_element(list.begin(), list.end());
  if (largest == 0.0)
  {
    throw RectifiedTransport::Failure("All Weights are 0; at least one must be above 0");
  }
  // Those whose sum is 1 stay as they are; by the largest first only where the sum is not finite.
  const bool fits = std::isfinite(std::accumulate(list.begin(), list.end(), 0.0));
  std::transform(list.begin(), list.end(), weights,
    [=](double weight) { return fits ? weight : weight / largest; });
  const double sum = std::accumulate(weights, weights + numberOfInputs, 0.0);
  std::for_each(weights, weights + numberOfInputs, [=](double& weight) { weight /= sum; });
}

//------------------------------------------------------------------------------
void vtkTransportBarycenter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Weights:";
  for (const double weight : this->Weights->List)
  {
    os << " " << weight;
  }
  os << (this->Weights->List.empty() ? " equal\n" : "\n");
}
VTK_ABI_NAMESPACE_END
