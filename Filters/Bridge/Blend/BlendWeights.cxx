// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blend/BlendWeights.h"

#include "Bridge/Run/Failure.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace RectifiedTransport
{

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

} // namespace RectifiedTransport
