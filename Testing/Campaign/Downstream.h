// SPDX-License-Identifier: BSD-3-Clause
// Filters downstream of a filter in a pipeline.
#ifndef Campaign_Downstream_h
#define Campaign_Downstream_h

#include "RandomSource.h"

#include "vtkAlgorithm.h"
#include "vtkSmartPointer.h"

namespace Campaign
{

// A filter of VTK or of ours that takes the first output, connected; nullptr if none does.
vtkSmartPointer<vtkAlgorithm> drawDownstream(RandomSource& random, vtkAlgorithm* filter);

} // namespace Campaign

#endif
