// SPDX-License-Identifier: BSD-3-Clause
// The register of filters: how to make one, its properties and inputs, and what its output has to
// be. Tests of Testing/Cxx that concern every filter go through it, too.
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
  // After inputs are connected: properties in their ranges with which a run takes milliseconds,
  // whatever is wrong with an input.
  void (*MakeQuick)(RandomSource& random, vtkAlgorithm* filter);
};

const std::vector<FilterKind>& filterKinds();

} // namespace Campaign

#endif
