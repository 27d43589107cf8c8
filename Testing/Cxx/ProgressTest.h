// SPDX-License-Identifier: BSD-3-Clause
// Listens to the progress of an algorithm, and aborts it from a chosen one on, at once or from
// another thread some time later: in the middle of what it then does.
#ifndef ProgressTest_h
#define ProgressTest_h

#include "SamplerTest.h"

#include <algorithm>
#include <chrono>
#include <thread>

class ProgressTest
{
public:
  using Clock = std::chrono::steady_clock;

  explicit ProgressTest(vtkAlgorithm* algorithm)
    : Algorithm(algorithm)
  {
    this->Ear->SetClientData(this);
    this->Ear->SetCallback([](vtkObject*, unsigned long, void* self, void* data) {
      static_cast<ProgressTest*>(self)->Hear(*static_cast<double*>(data));
    });
    algorithm->AddObserver(vtkCommand::ProgressEvent, this->Ear);
  }
  ~ProgressTest()
  {
    this->Wait();
    this->Algorithm->RemoveObserver(this->Ear);
  }
  ProgressTest(const ProgressTest&) = delete;
  ProgressTest& operator=(const ProgressTest&) = delete;

  // Until a late abort is done.
  void Wait()
  {
    if (this->Later.joinable())
    {
      this->Later.join();
    }
  }

  double AbortFrom = 2.0;
  std::chrono::milliseconds Delay{ 0 };
  std::vector<double> Heard;
  Clock::time_point AbortTime;

private:
  void Hear(double progress)
  {
    this->Heard.push_back(progress);
    if (progress < this->AbortFrom || this->Algorithm->GetAbortExecute() || this->Later.joinable())
    {
      return;
    }
    if (this->Delay.count() == 0)
    {
      this->Abort();
      return;
    }
    this->Later = std::thread([this]() {
      std::this_thread::sleep_for(this->Delay);
      this->Abort();
    });
  }
  void Abort()
  {
    this->AbortTime = Clock::now();
    this->Algorithm->SetAbortExecute(1);
  }

  vtkAlgorithm* Algorithm;
  vtkNew<vtkCallbackCommand> Ear;
  std::thread Later;
};

// How long it takes from the abort to the end of the run; the shortest of some, because other
// processes may hold this one up. `delay` is in milliseconds. `outdate` makes the next update run,
// `isEmpty` looks at what an abort has left.
template <class Outdate, class IsEmpty>
void checkAbort(Checks& checks, vtkAlgorithm* algorithm, double from, const Outdate& outdate,
  const IsEmpty& isEmpty, int line, int delay = 0)
{
  double seconds = HUGE_VAL;
  for (int attempt = 0; attempt < 4 && seconds > 0.1; ++attempt)
  {
    ProgressTest test(algorithm);
    test.AbortFrom = from;
    test.Delay = std::chrono::milliseconds(delay);
    outdate();
    algorithm->Update();
    const auto end = ProgressTest::Clock::now();
    test.Wait();
    checks.That(!test.Heard.empty() && algorithm->GetAbortExecute() != 0, "aborted", line);
    checks.That(isEmpty(), "empty output", line);
    seconds = std::min(seconds, std::chrono::duration<double>(end - test.AbortTime).count());
    algorithm->SetAbortExecute(0);
  }
  checks.That(seconds <= 0.1, "abort within 0.1 s", line, std::to_string(seconds));
}

#endif
