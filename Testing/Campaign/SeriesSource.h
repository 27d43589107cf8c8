// SPDX-License-Identifier: BSD-3-Clause
// A series of data objects of one type: what a reader of several time steps gives.
#ifndef Campaign_SeriesSource_h
#define Campaign_SeriesSource_h

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <vector>

namespace Campaign
{

struct SeriesStep
{
  double Time;
  vtkSmartPointer<vtkDataObject> Data;
};

// Announces the times as they are, and the structure of the first step; to a request without a time
// it gives that step, else the nearest one, of several the first. Reports Modified when data of a
// step have changed.
vtkSmartPointer<vtkAlgorithm> newSeries(const std::vector<SeriesStep>& steps);

} // namespace Campaign

#endif
