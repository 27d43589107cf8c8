// SPDX-License-Identifier: BSD-3-Clause
// Between the core, which throws, and the executive, which must not see exceptions.
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

// Ends the answer to a request within a catch (...): an abort leaves empty outputs, anything else
// becomes one error of the algorithm and empty outputs. Withdraws the extents of images. Returns
// what the executive is told.
int answerException(vtkAlgorithm* algorithm, vtkInformationVector* outputs);

// Announces that structured outputs have no points, after all. Filters that follow would read all
// of what was announced before, so that they are asked for nothing, too. Returns false where not
// all of them can be reached: they must then be kept from running, by a failure.
bool withdrawExtents(vtkInformationVector* outputs);

// The same for this update alone, where an output holds less than was asked for: a later piece.
bool withdrawUnmetRequests(vtkInformationVector* outputs);

// Has the filters that read a structured output ask again what it announces, within an update.
// Returns false where not all of them can be reached.
bool renewConsumers(vtkInformation* output);

} // namespace RectifiedTransport

#endif
