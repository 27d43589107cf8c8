// SPDX-License-Identifier: BSD-3-Clause
// The weights of densities in a barycenter.
#ifndef RectifiedTransport_BlendWeights_h
#define RectifiedTransport_BlendWeights_h

#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

// One weight an input, with the sum 1; equal ones for an empty list. Throws Failure for a list of
// another length, weights that are negative or not finite, and weights that are all 0.
std::vector<double> normalizedWeights(const std::vector<double>& list, std::size_t inputs);

} // namespace RectifiedTransport

#endif
