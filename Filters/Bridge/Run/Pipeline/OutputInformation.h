// SPDX-License-Identifier: BSD-3-Clause
// The information of outputs: their times, and what the executive leaves wrong in it and in data.
#ifndef RectifiedTransport_OutputInformation_h
#define RectifiedTransport_OutputInformation_h

#include "Bridge/VTKCompatibility.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The executive copies only the times of the first input; the outputs depend on all inputs.
void publishTimes(
  vtkInformationVector** inputVector, int numberOfPorts, vtkInformationVector* outputVector);

// The times of all outputs: a range of two, and steps; either may be empty.
void announceTimes(vtkInformationVector* outputVector, const std::vector<double>& range,
  const std::vector<double>& steps);

// The time that the data of all outputs are of.
void stampTime(vtkInformationVector* outputVector, double time);

// The executive copies the array information of the first input, which is wrong for every output.
void removeArrayInformation(vtkInformationVector* outputVector);

// The executive leaves the extent of an image and the scalars of its points from the last run.
void clearImages(vtkInformationVector* outputVector);

} // namespace RectifiedTransport::Bridge

#endif
