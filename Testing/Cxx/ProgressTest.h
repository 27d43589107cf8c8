// SPDX-License-Identifier: BSD-3-Clause
// Records the progress of an algorithm, and aborts it from a given value on, at once or from
// another thread some time later: in the middle of its work.
#ifndef ProgressTest_h
#define ProgressTest_h

#include "TestData.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <string>
#include <thread>

class ProgressTest
{
public:
  using Clock = std::chrono::steady_clock;

  explicit ProgressTest(vtkAlgorithm* algorithm)
    : Algorithm(algorithm)
  {
    this->Observer->SetClientData(this);
    this->Observer->SetCallback([](vtkObject*, unsigned long, void* self, void* data) {
      static_cast<ProgressTest*>(self)->Record(*static_cast<double*>(data));
    });
    algorithm->AddObserver(vtkCommand::ProgressEvent, this->Observer);
  }
  ~ProgressTest()
  {
    this->Wait();
    this->Algorithm->RemoveObserver(this->Observer);
  }
  ProgressTest(const ProgressTest&) = delete;
  ProgressTest& operator=(const ProgressTest&) = delete;

  // Until a delayed abort has been set.
  void Wait()
  {
    if (this->DelayedAbort.joinable())
    {
      this->DelayedAbort.join();
    }
  }

  // At least so many values, ascending from 0 to 1.
  void ExpectRising(
    Checks& checks, std::size_t calls, int line, const std::string& what = "progress") const
  {
    std::ostringstream detail;
    detail << what << ":";
    for (const double value : this->Recorded)
    {
      detail << " " << value;
    }
    const auto first = this->Recorded.begin();
    const auto last = this->Recorded.end();
    checks.That(this->Recorded.size() >= calls, "often", line, detail.str());
    checks.That(std::is_sorted(first, last), "rising", line, detail.str());
    checks.That(
      first != last && *first >= 0.0 && *(last - 1) == 1.0, "from 0 to 1", line, detail.str());
  }

  double AbortFrom = 2.0;
  std::chrono::milliseconds Delay{ 0 };
  std::vector<double> Recorded;
  std::size_t NumberAfterAbort = 0;
  Clock::time_point AbortTime;

private:
  void Record(double progress)
  {
    this->Recorded.push_back(progress);
    if (this->Algorithm->GetAbortExecute())
    {
      ++this->NumberAfterAbort;
      return;
    }
    if (progress < this->AbortFrom || this->DelayedAbort.joinable())
    {
      return;
    }
    if (this->Delay.count() == 0)
    {
      this->Abort();
      return;
    }
    this->DelayedAbort = std::thread([this]() {
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
  vtkNew<vtkCallbackCommand> Observer;
  std::thread DelayedAbort;
};

// An abort once the progress passes `from`, or `delay` milliseconds later: the outputs are empty,
// and the work ends: progress is reported at most at the end of a slice and of the run. The time
// until then is printed, but not checked: other processes may delay this one. `outdate`
// makes the next update run.
template <class Outdate>
void checkAbort(Checks& checks, vtkAlgorithm* algorithm, double from, const Outdate& outdate,
  int line, int delay = 0)
{
  ProgressTest test(algorithm);
  test.AbortFrom = from;
  test.Delay = std::chrono::milliseconds(delay);
  outdate();
  algorithm->Update();
  const auto end = ProgressTest::Clock::now();
  test.Wait();
  checks.That(!test.Recorded.empty() && algorithm->GetAbortExecute() != 0, "aborted", line);
  checks.That(isEmpty(algorithm), "empty output", line);
  checks.That(test.NumberAfterAbort <= 2, "soon over", line, std::to_string(test.NumberAfterAbort));
  algorithm->SetAbortExecute(0);
  const std::chrono::duration<double, std::milli> wait = end - test.AbortTime;
  std::cout << "line " << line << ": the abort took " << wait.count() << " ms\n";
}

#endif
