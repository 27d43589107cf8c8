// SPDX-License-Identifier: BSD-3-Clause
#include "Watch.h"

#ifdef __linux__
#include <sys/time.h>
#endif

namespace Campaign
{

void startWatch([[maybe_unused]] int seconds)
{
#ifdef __linux__
  itimerval limit{};
  limit.it_value.tv_sec = seconds;
  setitimer(ITIMER_PROF, &limit, nullptr);
#endif
}

} // namespace Campaign
