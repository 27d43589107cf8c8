// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Steps/StepWarning.h"

#include "Core/Flow/Steps/ProbePlan.h"
#include "Core/Messages/PartText.h"

#include <cmath>
#include <sstream>

namespace RectifiedTransport
{

std::string stepWarning(
  const FlowReport& flow, const FlowOptions& options, FlowDirection direction, bool areParticles)
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

} // namespace RectifiedTransport
