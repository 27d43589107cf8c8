// SPDX-License-Identifier: BSD-3-Clause
// Turns the core's exceptions into errors, and adjusts the pipeline information of outputs that are
// empty or partial. No exception may reach the executive.
#ifndef RectifiedTransport_ExceptionBarrier_h
#define RectifiedTransport_ExceptionBarrier_h

#include "Bridge/VTKCompatibility.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkInformation;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class RankRun;

// To be called within catch (...) around the processing of a request: empties the outputs and
// announces empty extents; any exception but Cancelled becomes one error of the algorithm, of all
// ranks of its run, if there is one, together. Returns the return value of ProcessRequest.
int handleException(vtkAlgorithm* algorithm, vtkInformationVector* outputs, RankRun* run = nullptr);

// Sets empty whole and update extents on structured outputs, and on those of the filters
// downstream, which would otherwise read the extent announced before. Returns false where not all
// of them can be reached: the request must then fail, so that they do not execute.
bool announceEmptyExtents(vtkInformationVector* outputs);

// Empties the update extents downstream of structured outputs that hold less than the requested
// extent (pieces after the first), for this update only. Returns as above.
bool clearUnmetRequests(vtkInformationVector* outputs);

// Calls UpdateInformation of all filters downstream of a structured output whose extent changed
// within an update. Returns false where not all of them can be reached.
bool updateConsumerInformation(vtkInformation* output);

} // namespace RectifiedTransport

#endif
