// SPDX-License-Identifier: BSD-3-Clause
// Polls for cancellation in code without an own loop, such as the comparisons of a sort.
#ifndef RectifiedTransport_Polls_h
#define RectifiedTransport_Polls_h

#include "Core/Parallel/Progress.h"

namespace RectifiedTransport
{

class Polls
{
public:
  explicit Polls(Progress& progress)
    : Work(progress)
  {
  }
  Polls(const Polls&) = delete;
  Polls& operator=(const Polls&) = delete;

  // Polls every 2^16 calls. Throws Cancelled.
  void Count()
  {
    constexpr int interval = 1 << 16;
    if (++this->Calls == interval)
    {
      this->Calls = 0;
      this->Work.Check();
    }
  }

private:
  Progress& Work;
  int Calls = 0;
};

} // namespace RectifiedTransport

#endif
