// SPDX-License-Identifier: BSD-3-Clause
// Memory that runs out after a number of allocations. It replaces the program's operator new: one
// source of a program may include it.
#ifndef FailingAllocations_h
#define FailingAllocations_h

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>

// How many more allocations there is memory for.
inline std::atomic<std::int64_t> allocationsLeft{ std::numeric_limits<std::int64_t>::max() };

#if defined(__has_feature) // Clang's, which has no macros of GCC's names
#if __has_feature(thread_sanitizer) || __has_feature(address_sanitizer)
#define HAS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HAS_SANITIZER
#endif

#ifdef HAS_SANITIZER
constexpr bool canRunOut = false; // the sanitizer has operators of its own
#else
constexpr bool canRunOut = true;

void* operator new(std::size_t bytes)
{
  void* memory = allocationsLeft-- > 0 ? std::malloc(bytes > 0 ? bytes : 1) : nullptr;
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

// Not inline: GCC says that std::free does not suit a call of operator new.
[[gnu::noinline]] void operator delete(void* memory) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}
#endif

namespace RectifiedTransport
{

// Runs work again and again, each time with one allocation more, until there is memory for all of
// it. Before that it must throw bad_alloc, on whatever thread the memory ran out.
template <class Work>
void expectBadAlloc(const char* what, const Work& work)
{
  constexpr std::int64_t most = 20000;
  std::int64_t memory = 0;
  for (bool complete = false; !complete && memory < most; ++memory)
  {
    allocationsLeft = memory;
    try
    {
      work();
      complete = true;
    }
    catch (const std::bad_alloc&)
    {
    }
    allocationsLeft = std::numeric_limits<std::int64_t>::max();
  }
  EXPECT_GT(memory, 1) << what << " allocates nothing";
  EXPECT_LT(memory, most) << what;
}

} // namespace RectifiedTransport

#endif
