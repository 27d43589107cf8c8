// SPDX-License-Identifier: BSD-3-Clause
// Corrects what the executive leaves wrong in the information and data of outputs.
#ifndef RectifiedTransport_OutputInformation_h
#define RectifiedTransport_OutputInformation_h

#include "Bridge/VTKCompatibility.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The executive copies only the times of the first input; the outputs depend on all inputs.
void publishTimes(
  vtkInformationVector** inputVector, int numberOfPorts, vtkInformationVector* outputVector);

// The executive copies the array information of the first input, which is wrong for every output.
void removeArrayInformation(vtkInformationVector* outputVector);

// The executive leaves the extent of an image and the scalars of its points from the last run.
void clearImages(vtkInformationVector* outputVector);

} // namespace RectifiedTransport::Bridge

#endif
