// SPDX-License-Identifier: BSD-3-Clause
// Between the core, which throws, and the executive, which must not see exceptions.
#ifndef RectifiedTransport_GuardedRun_h
#define RectifiedTransport_GuardedRun_h

#include "VTKCompatibility.h"

#include <functional>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Runs the body of a RequestData. What it throws becomes one error of the algorithm and the result
// 0; both this and an abort leave empty outputs.
int runGuarded(
  vtkAlgorithm* algorithm, vtkInformationVector* outputs, const std::function<int()>& body);

} // namespace RectifiedTransport

#endif
