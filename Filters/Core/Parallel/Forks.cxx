// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Forks.h"

#ifndef _WIN32
#include <pthread.h>
#endif

namespace RectifiedTransport
{

namespace
{

#ifdef _WIN32
constexpr int forks = 0; // there is no fork()
#else
int forks = 0; // written while a child has one thread
[[maybe_unused]] const int isWatched = pthread_atfork(nullptr, nullptr, []() { ++forks; });
#endif

} // namespace

int forksSinceLoad() noexcept
{
  return forks;
}

} // namespace RectifiedTransport
