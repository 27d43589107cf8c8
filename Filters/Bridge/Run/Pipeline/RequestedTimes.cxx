// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Pipeline/RequestedTimes.h"

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

namespace
{

void addUpstream(vtkAlgorithm* algorithm, Algorithms& found)
{
  if (!found.insert(algorithm).second)
  {
    return;
  }
  for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < algorithm->GetNumberOfInputConnections(port); ++i)
    {
      if (vtkAlgorithm* upstream = algorithm->GetInputAlgorithm(port, i))
      {
        addUpstream(upstream, found);
      }
    }
  }
}

} // namespace

Algorithms upstreamOf(vtkAlgorithm* algorithm)
{
  Algorithms found;
  addUpstream(algorithm, found);
  return found;
}

std::optional<TimeRange> announcedTimes(vtkInformation* output)
{
  const int steps = output->Length(Pipeline::TIME_STEPS());
  if (steps > 0)
  {
    const double* times = output->Get(Pipeline::TIME_STEPS());
    const auto ends = std::minmax_element(times, times + steps);
    return TimeRange{ *ends.first, *ends.second, steps };
  }
  if (output->Length(Pipeline::TIME_RANGE()) == 2)
  {
    const double* range = output->Get(Pipeline::TIME_RANGE());
    return TimeRange{ range[0], range[1], 0 };
  }
  return std::nullopt;
}

std::optional<TimeRange> timesOf(vtkAlgorithm* algorithm)
{
  for (int port = 0; port < algorithm->GetNumberOfOutputPorts(); ++port)
  {
    if (const auto times = announcedTimes(algorithm->GetOutputInformation(port)))
    {
      return times;
    }
  }
  return std::nullopt;
}

RequestedTimes::RequestedTimes(vtkAlgorithm* algorithm)
{
  for (vtkAlgorithm* upstream : upstreamOf(algorithm))
  {
    for (int port = 0; port < upstream->GetNumberOfOutputPorts() && upstream != algorithm; ++port)
    {
      vtkInformation* output = upstream->GetOutputInformation(port);
      std::optional<double>& time = this->Times[output];
      if (output->Has(Pipeline::UPDATE_TIME_STEP()))
      {
        time = output->Get(Pipeline::UPDATE_TIME_STEP());
      }
    }
  }
}

RequestedTimes::~RequestedTimes()
{
  for (const auto& [output, time] : this->Times)
  {
    if (time)
    {
      output->Set(Pipeline::UPDATE_TIME_STEP(), *time);
    }
    else
    {
      output->Remove(Pipeline::UPDATE_TIME_STEP());
    }
  }
}

} // namespace RectifiedTransport::Bridge
