// SPDX-License-Identifier: BSD-3-Clause
// Turns exceptions into errors and empty outputs. None may reach the executive.
#ifndef RectifiedTransport_ExceptionBarrier_h
#define RectifiedTransport_ExceptionBarrier_h

#include "Bridge/VTKCompatibility.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

class RankRun;

// Call it within catch (...) around the processing of a request. Empties the outputs and announces
// empty extents. Any exception except Cancelled becomes one error of the algorithm, or one for all
// ranks of `run`. Returns the return value of ProcessRequest.
// The request succeeds unless filters downstream would read what is not there: ParaView's views
// never look again at a pipeline whose request failed.
int handleException(vtkAlgorithm* algorithm, vtkInformationVector* outputs, RankRun* run = nullptr);

// Within catch (...), too: whether the run was aborted.
bool isCancelled();

} // namespace RectifiedTransport::Bridge

#endif
