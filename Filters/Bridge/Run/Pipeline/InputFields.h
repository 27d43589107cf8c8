// SPDX-License-Identifier: BSD-3-Clause
// The field data of inputs in outputs.
#ifndef RectifiedTransport_InputFields_h
#define RectifiedTransport_InputFields_h

#include "Bridge/VTKCompatibility.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The executive passes the field data of the first input on to every output. If an output has a new
// array of the same name, this removes the input's from the other outputs, where it would look like
// a figure of this run. `inputVectors` may be several for the same ports.
void removeReplacedFields(const std::vector<vtkInformationVector**>& inputVectors,
  int numberOfPorts, vtkInformationVector* outputVector);

} // namespace RectifiedTransport::Bridge

#endif
