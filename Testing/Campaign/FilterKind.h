// SPDX-License-Identifier: BSD-3-Clause
// A class of filters: how to make one, its properties and inputs, and what its output has to be.
#ifndef Campaign_FilterKind_h
#define Campaign_FilterKind_h

#include "Input.h"
#include "Outcome.h"
#include "Settings.h"

#include <vector>

namespace Campaign
{

// The inputs of each port.
using Inputs = std::vector<std::vector<Input>>;

struct FilterKind
{
  const char* Name;
  vtkSmartPointer<vtkAlgorithm> (*New)();
  // Small enough to run in milliseconds, whatever the input.
  void (*DrawSettings)(Settings& settings);
  // May add how arrays are chosen.
  Inputs (*DrawInputs)(RandomSource& random, Settings& settings);
  // What has to come of these inputs with the settings that the filter has.
  State (*Expect)(vtkAlgorithm* filter, const Inputs& inputs);
  // Looks at an output that is not empty.
  void (*Check)(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings);
};

const std::vector<FilterKind>& filterKinds();

} // namespace Campaign

#endif
