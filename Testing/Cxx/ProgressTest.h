// SPDX-License-Identifier: BSD-3-Clause
// Listens to the progress of an algorithm, and aborts it from a chosen one on, at once or from
// another thread some time later: in the middle of what it then does.
#ifndef ProgressTest_h
#define ProgressTest_h

#include "SamplerTest.h"

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

  // So many calls at least, from 0 up to 1.
  void ExpectRising(
    Checks& checks, std::size_t calls, int line, const std::string& what = "heard") const
  {
    std::ostringstream detail;
    detail << what << ":";
    for (const double heard : this->Heard)
    {
      detail << " " << heard;
    }
    const auto first = this->Heard.begin();
    const auto last = this->Heard.end();
    checks.That(this->Heard.size() >= calls, "often", line, detail.str());
    checks.That(std::is_sorted(first, last), "rising", line, detail.str());
    checks.That(
      first != last && *first >= 0.0 && *(last - 1) == 1.0, "from 0 to 1", line, detail.str());
  }

  double AbortFrom = 2.0;
  std::chrono::milliseconds Delay{ 0 };
  std::vector<double> Heard;
  std::size_t HeardAfter = 0; // the abort
  Clock::time_point AbortTime;

private:
  void Hear(double progress)
  {
    this->Heard.push_back(progress);
    if (this->Algorithm->GetAbortExecute())
    {
      ++this->HeardAfter;
      return;
    }
    if (progress < this->AbortFrom || this->Later.joinable())
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

// An abort once the progress passes `from`, or `delay` milliseconds later: nothing is left, and no
// work goes on; that would be heard of more often than at the end of a slice and of the run. How
// long it takes to the end is said, but decides nothing: other processes may hold this one up.
// `outdate` makes the next update run.
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
  checks.That(!test.Heard.empty() && algorithm->GetAbortExecute() != 0, "aborted", line);
  checks.That(isEmpty(algorithm), "empty output", line);
  checks.That(test.HeardAfter <= 2, "soon over", line, std::to_string(test.HeardAfter));
  algorithm->SetAbortExecute(0);
  const std::chrono::duration<double, std::milli> wait = end - test.AbortTime;
  std::cout << "line " << line << ": the abort took " << wait.count() << " ms\n";
}

#endif
