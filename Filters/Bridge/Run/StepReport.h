// SPDX-License-Identifier: BSD-3-Clause
// What outputs and warnings say of the steps of a flow, and of EqualizeAreas after it.
#ifndef RectifiedTransport_StepReport_h
#define RectifiedTransport_StepReport_h

#include "Bridge/Run/FieldValue.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Flow/Steps/ProbePlan.h"
#include "Core/Messages/PartText.h"
#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
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

// The text of a warning if a flow does not keep the AreaTolerance; else empty. `areParticles`: they
// show masses of larger blocks than those of 4 cells a side.
inline std::string stepWarning(const FlowReport& flow, const FlowOptions& options,
  FlowDirection direction, bool areParticles = false)
{
  if (!(flow.AreaError > options.AreaTolerance))
  {
    return {};
  }
  std::ostringstream text;
  text.precision(3);
  text << "AreaTolerance " << options.AreaTolerance << " is not reached: with "
       << flow.NumberOfSteps << " steps, the most that ";
  options.AreaTolerance == FlowOptions::UsualTolerance
    ? text << "take at most 8 times as long as " << options.LeastSteps
    : text << "NumberOfSteps 0 takes";
  text << ", " << (direction == FlowDirection::Backward ? "areas" : "masses") << " of blocks of ";
  areParticles ? text << std::round(particlesThatShow(options.AreaTolerance)) << " particles"
               : text << "4 cells a side";
  text << " are off by about " << percentText(flow.AreaError) << "; ";
  if (flow.StepsNeeded > FlowOptions::MaximumNumberOfSteps)
  {
    text << "more than " << FlowOptions::MaximumNumberOfSteps << " steps would be needed";
  }
  else
  {
    text << "NumberOfSteps " << flow.StepsNeeded << " reaches it, in about ";
    const double times = std::round(flow.TimesNeeded);
    times > 1.0 ? text << times << " times the time" : text << "the same time";
  }
  text << (options.Integrator == Integrator::Multistep
      ? " (less contrast helps, for example a part of the mean added with Calculator)"
      : " (Integrator Multistep needs fewer)");
  return text.str();
}

// The passes of EqualizeAreas that were kept, the same on all ranks; `own` is 0 on a rank that has
// nothing to correct. Collective. The estimate of the flow's error is none of the corrected map.
inline int addEqualAreas(vtkDataObject* output, const Ranks& ranks, int own, FlowReport& flow)
{
  const std::vector<int> all = gatherValues(ranks, own);
  const int passes = *std::max_element(all.begin(), all.end());
  addFieldValue(output, "EqualAreaPasses", passes);
  if (passes > 0)
  {
    flow.AreaError = std::numeric_limits<double>::quiet_NaN();
  }
  return passes;
}

} // namespace RectifiedTransport::Bridge

#endif
