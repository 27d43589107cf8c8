// SPDX-License-Identifier: BSD-3-Clause
// Between the core, which throws, and the executive, which must not see exceptions.
#ifndef RectifiedTransport_GuardedRun_h
#define RectifiedTransport_GuardedRun_h

#include <functional>

class vtkAlgorithm;
class vtkInformationVector;

namespace RectifiedTransport
{

// Runs the answer to a request. What it throws becomes one error of the algorithm and the result 0;
// both this and an abort leave empty outputs and withdraw the extents of images.
int runGuarded(
  vtkAlgorithm* algorithm, vtkInformationVector* outputs, const std::function<int()>& body);

// Announces that structured outputs have no points, after all. Filters that follow would read all
// of what was announced before, so that they are asked for nothing, too.
void withdrawExtents(vtkInformationVector* outputs);

} // namespace RectifiedTransport

#endif
