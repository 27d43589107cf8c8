// SPDX-License-Identifier: BSD-3-Clause
#include "Outcome.h"

#include "Listener.h"

#include "vtkSMPTools.h"

#include <cmath>
#include <memory>
#include <sstream>

#ifdef __linux__
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace Campaign
{

vtkStandardNewMacro(SilentWindow);

namespace
{

// A process that may not grow by more than `bytes`, until the end of the scope. Threads are made
// by nobody meanwhile: VTK's own cannot do without the memory for them.
class MemoryLimit
{
public:
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
  explicit MemoryLimit(std::int64_t bytes)
    : Backend(vtkSMPTools::GetBackend())
  {
    vtkSMPTools::SetBackend("Sequential");
    std::ifstream file("/proc/self/statm");
    rlim_t pages = 0;
    file >> pages;
    getrlimit(RLIMIT_AS, &this->Before);
    rlimit limit = this->Before;
    limit.rlim_cur =
      pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + static_cast<rlim_t>(bytes);
    setrlimit(RLIMIT_AS, &limit);
  }
  ~MemoryLimit()
  {
    setrlimit(RLIMIT_AS, &this->Before);
    vtkSMPTools::SetBackend(this->Backend.c_str());
  }
#else
  explicit MemoryLimit(std::int64_t) {}
#endif
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
  std::string Backend;
  rlimit Before;
#endif
};

void checkProgress(const std::vector<double>& heard, Findings& findings)
{
  double last = 0.0;
  for (const double progress : heard)
  {
    std::ostringstream text;
    text << "progress " << progress << " after " << last;
    findings.That(progress >= last && progress <= 1.0, text.str());
    last = progress;
  }
}

} // namespace

void Findings::Near(double a, double b, double tolerance, const std::string& what)
{
  std::ostringstream text;
  text.precision(17);
  text << what << ": " << a << " and " << b;
  this->That(std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b)), text.str());
}

Outcome update(vtkAlgorithm* filter, const Disturbance& disturbance, Findings& findings)
{
  Listener listener(filter, disturbance.AbortAt);
  {
    std::unique_ptr<MemoryLimit> limit;
    if (disturbance.Memory >= 0)
    {
      limit = std::make_unique<MemoryLimit>(disturbance.Memory);
    }
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
    checkProgress(listener.Heard, findings);
  }
  return outcome;
}

} // namespace Campaign
