// SPDX-License-Identifier: BSD-3-Clause
// How the loops of a filter run: on all threads from the first slice on, and what a kernel throws
// comes out, with every executor.
#include "TestData.h"

#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/SMPExecutor.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <new>

namespace
{

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

// Runs ranges one by one, with a concurrency of four.
class CountingExecutor final : public Executor
{
public:
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override
  {
    this->Ranges.push_back((count + grain - 1) / grain);
    for (std::int64_t first = 0; first < count; first += grain)
    {
      kernel(first, std::min(first + grain, count));
    }
  }
  int Concurrency() const override { return 4; }

  mutable std::vector<std::int64_t> Ranges; // of each call
};

// Work that is cut into few long ranges: all threads have one, but where the work ends.
void checkLongRanges(Checks& checks)
{
  const CountingExecutor executor;
  std::vector<std::int64_t>& called = executor.Ranges;
  Progress progress{ Context(executor) };
  constexpr std::int64_t count = 1030;
  std::vector<int> visits(count, 0);
  progress.For(
    count, 100,
    [&visits](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        ++visits[static_cast<std::size_t>(i)];
      }
    },
    1);
  CHECK(checks, std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
  called.pop_back();
  CHECK(checks, !called.empty());
  for (const std::int64_t ranges : called)
  {
    CHECK(checks, ranges >= 4);
  }
}

void checkThrows(Checks& checks, Threading threading, const std::string& what)
{
  const auto executor = makeExecutor(threading);
  for (const std::int64_t count : { 1, 500 })
  {
    bool caught = false;
    try
    {
      executor->For(count, 1, [](std::int64_t first, std::int64_t) {
        if (first % 7 == 0)
        {
          throw std::bad_alloc();
        }
      });
    }
    catch (const std::bad_alloc&)
    {
      caught = true;
    }
    checks.That(caught, "the exception comes out", __LINE__, what);
  }
}

} // namespace

int TestAlgorithmProgress(int, char*[])
{
  Checks checks;
  checkLongRanges(checks);
  checkThrows(checks, Threading::Serial, "Serial");
  checkThrows(checks, Threading::OpenMP, "OpenMP");
  for (const char* backend : { "Sequential", "STDThread", "TBB", "OpenMP" })
  {
    if (vtkSMPTools::SetBackend(backend))
    {
      vtkSMPTools::Initialize(3);
      checkThrows(checks, Threading::VTK, backend);
    }
  }
  return checks.Result();
}
