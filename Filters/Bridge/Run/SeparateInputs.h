// SPDX-License-Identifier: BSD-3-Clause
// Inputs that are two times of one source. The executive passes the requests of all inputs upstream
// before any data are made, so that the source makes those of the last request alone, and all
// inputs get them.
#ifndef RectifiedTransport_SeparateInputs_h
#define RectifiedTransport_SeparateInputs_h

#include "Bridge/VTKCompatibility.h"

#include <cstdint>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class Ranks;

// Of one filter.
class SeparateInputs
{
public:
  // Makes the inputs that share arrays and come from a source with times through filters of their
  // own one after the other. From RequestData. What they share then is theirs; it is not tried
  // again. On `ranks`, or nullptr, which call this together, all of them make the inputs where one
  // has to.
  void Update(vtkAlgorithm* filter, vtkInformationVector** inputVector, const Ranks* ranks);

private:
  std::vector<std::uint64_t> Shared; // the addresses and times of the arrays shared after the last
};

} // namespace RectifiedTransport

#endif
