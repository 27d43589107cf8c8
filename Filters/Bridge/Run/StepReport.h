// SPDX-License-Identifier: BSD-3-Clause
// What outputs and warnings say of the steps of a flow.
#ifndef RectifiedTransport_StepReport_h
#define RectifiedTransport_StepReport_h

#include "Bridge/Run/FieldValue.h"
#include "Core/Flow/FlowOptions.h"

#include <sstream>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// One value for each flow.
inline void addSteps(vtkDataObject* output, const std::vector<FlowReport>& flows)
{
  std::vector<double> steps;
  std::vector<double> errors;
  for (const FlowReport& flow : flows)
  {
    steps.push_back(flow.NumberOfSteps);
    errors.push_back(flow.AreaError);
  }
  addFieldValues(output, "StepsTaken", steps);
  addFieldValues(output, "AreaErrorEstimate", errors);
}

// The text of a warning if a flow does not keep the AreaTolerance; else empty.
inline std::string stepWarning(
  const FlowReport& flow, const FlowOptions& options, FlowDirection direction)
{
  if (!(flow.AreaError > options.AreaTolerance))
  {
    return {};
  }
  std::ostringstream text;
  text.precision(2);
  text << "AreaTolerance " << options.AreaTolerance << " is not reached: with "
       << flow.NumberOfSteps << " steps, the most that NumberOfSteps 0 takes, "
       << (direction == FlowDirection::Backward ? "areas" : "masses")
       << " of blocks of 4 cells a side are off by about " << 100.0 * flow.AreaError
       << (options.Integrator == Integrator::Multistep
              ? " % (less contrast helps, for example a part of the mean added with Calculator)"
              : " % (Integrator Multistep needs fewer)");
  return text.str();
}

} // namespace RectifiedTransport

#endif
