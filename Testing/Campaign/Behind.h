// SPDX-License-Identifier: BSD-3-Clause
// What stands behind a filter in a pipeline.
#ifndef Campaign_Behind_h
#define Campaign_Behind_h

#include "Dice.h"

#include "vtkAlgorithm.h"
#include "vtkSmartPointer.h"

namespace Campaign
{

// A filter of VTK or of ours that takes the first output, connected; nullptr if none does.
vtkSmartPointer<vtkAlgorithm> drawBehind(Dice& dice, vtkAlgorithm* filter);

} // namespace Campaign

#endif
