// SPDX-License-Identifier: BSD-3-Clause
#include "Outcome.h"

#include "../MemoryLimit.h"
#include "Listener.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace Campaign
{

vtkStandardNewMacro(SilentWindow);

namespace
{

#ifdef HAS_MEMORY_LIMIT
// Threads are made by nobody meanwhile: VTK's own cannot do without the memory for them.
class MemoryLimitOfOneThread
{
public:
  explicit MemoryLimitOfOneThread(std::int64_t bytes)
    : Backend(vtkSMPTools::GetBackend())
  {
    vtkSMPTools::SetBackend("Sequential");
    this->Limit.emplace(bytes);
  }
  ~MemoryLimitOfOneThread()
  {
    this->Limit.reset();
    vtkSMPTools::SetBackend(this->Backend.c_str());
  }
  MemoryLimitOfOneThread(const MemoryLimitOfOneThread&) = delete;
  MemoryLimitOfOneThread& operator=(const MemoryLimitOfOneThread&) = delete;

private:
  std::string Backend;
  std::optional<MemoryLimit> Limit;
};
#endif

void checkProgress(const std::vector<double>& reported, Findings& findings)
{
  double last = 0.0;
  for (const double progress : reported)
  {
    std::ostringstream text;
    text << "progress " << progress << " after " << last;
    findings.That(progress >= last && progress <= 1.0, text.str());
    last = progress;
  }
}

} // namespace

Outcome update(vtkAlgorithm* filter, const Disturbance& disturbance, Findings& findings)
{
  Listener listener(filter, disturbance.AbortAt);
  {
#ifdef HAS_MEMORY_LIMIT
    std::optional<MemoryLimitOfOneThread> limit;
    if (disturbance.Memory >= 0)
    {
      limit.emplace(disturbance.Memory);
    }
#endif
    filter->Update();
  }
  Outcome outcome;
  outcome.Errors = listener.Errors;
  outcome.Warnings = listener.Warnings;
  outcome.Others = listener.Others();
  outcome.Aborted = listener.HasAborted;
  filter->SetAbortExecute(0);
  outcome.Digest = static_cast<std::uint64_t>(outcome.Errors.size());
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    vtkDataObject* output = filter->GetOutputDataObject(port);
    outcome.IsEmpty = outcome.IsEmpty && isEmpty(output);
    outcome.Digest = digest(output, outcome.Digest);
  }
  if (outcome.Errors.empty() && !outcome.Aborted)
  {
    checkProgress(listener.Progress, findings);
  }
  return outcome;
}

} // namespace Campaign
