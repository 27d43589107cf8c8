// SPDX-License-Identifier: BSD-3-Clause
// What outputs and warnings say of the steps of a flow, and of EqualizeAreas after it.
#ifndef RectifiedTransport_StepReport_h
#define RectifiedTransport_StepReport_h

#include "Bridge/Run/FieldValue.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Flow/Steps/StepWarning.h"
#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace RectifiedTransport::Bridge
{

// One value for each flow; AreaErrorEstimate only where one of them was estimated.
inline void addSteps(vtkDataObject* output, const std::vector<FlowReport>& flows)
{
  std::vector<double> steps;
  std::vector<double> errors;
  bool isEstimated = false;
  for (const FlowReport& flow : flows)
  {
    steps.push_back(flow.NumberOfSteps);
    errors.push_back(flow.AreaError);
    isEstimated = isEstimated || !std::isnan(flow.AreaError);
  }
  addFieldValues(output, "StepsTaken", steps);
  if (isEstimated)
  {
    addFieldValues(output, "AreaErrorEstimate", errors);
  }
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
