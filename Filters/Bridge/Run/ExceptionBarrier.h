// SPDX-License-Identifier: BSD-3-Clause
// Turns exceptions into errors and empty outputs. None may reach the executive.
#ifndef RectifiedTransport_ExceptionBarrier_h
#define RectifiedTransport_ExceptionBarrier_h

#include "Bridge/VTKCompatibility.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class RankRun;

// To be called within catch (...) around the processing of a request: empties the outputs and
// announces empty extents; any exception but Cancelled becomes one error of the algorithm, of all
// ranks of its run, if there is one, together. Returns the return value of ProcessRequest.
int handleException(vtkAlgorithm* algorithm, vtkInformationVector* outputs, RankRun* run = nullptr);

} // namespace RectifiedTransport

#endif
