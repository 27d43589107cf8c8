// SPDX-License-Identifier: BSD-3-Clause
// Memory for tables and results: aligned to cache lines, not initialised, on huge pages if the
// system has them. Tables are read with large strides, and page faults of small pages cost as much
// as filling the memory.
#ifndef RectifiedTransport_LargeBuffer_h
#define RectifiedTransport_LargeBuffer_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

#if defined(__linux__)
#include <sys/mman.h>
#elif defined(_WIN32)
#include <malloc.h>
#endif

namespace RectifiedTransport
{

constexpr std::size_t hugePageBytes = std::size_t{ 1 } << 21;

// How many of so many bytes lie on huge pages, a multiple of these. The system clears a page whole
// and counts all of it as used. Hence a rest lies on one of them only if it takes a good part of
// the page, and what it leaves unused is little beside all bytes: buffers of a megabyte that are
// kept by the hundred would take twice their size.
constexpr std::size_t bytesOnHugePages(std::size_t bytes)
{
  // From this part of a huge page on, clearing it is faster than clearing the small pages.
  constexpr std::size_t worthwhile = hugePageBytes / 8;
  constexpr std::size_t mostUnused = 8; // a part of all bytes
  const std::size_t rest = bytes % hugePageBytes;
  const bool isWorthwhile = rest >= worthwhile && hugePageBytes - rest <= bytes / mostUnused;
  return bytes - rest + (isWorthwhile ? hugePageBytes : 0);
}

// Free it with freeLarge; null if there is no memory.
inline void* allocateLarge(std::size_t bytes)
{
  constexpr std::size_t line = 64;
  if (bytes > std::numeric_limits<std::size_t>::max() / 2)
  {
    return nullptr;
  }
  const std::size_t onHugePages = bytesOnHugePages(bytes);
  const std::size_t alignment = onHugePages > 0 ? hugePageBytes : line;
#ifdef _WIN32
  void* memory = _aligned_malloc(bytes + 1, alignment);
#else
  void* memory = std::aligned_alloc(alignment, (bytes + alignment) / alignment * alignment);
#endif
#ifdef __linux__
  if (memory && onHugePages > 0)
  {
    // A hint: without huge pages everything is slower.
    (void)madvise(memory, onHugePages, MADV_HUGEPAGE);
  }
#endif
  return memory;
}

inline void freeLarge(void* memory)
{
#ifdef _WIN32
  _aligned_free(memory);
#else
  std::free(memory);
#endif
}

template <class T>
class LargeBuffer
{
  static_assert(std::is_trivially_copyable_v<T>, "the memory is not initialised");

public:
  LargeBuffer() = default;
  explicit LargeBuffer(std::int64_t count)
    : Count(count)
  {
    const bool possible =
      static_cast<std::uint64_t>(count) <= std::numeric_limits<std::size_t>::max() / sizeof(T);
    void* memory = possible ? allocateLarge(static_cast<std::size_t>(count) * sizeof(T)) : nullptr;
    if (!memory)
    {
      throw std::bad_alloc();
    }
    this->Memory.reset(static_cast<T*>(memory));
  }
  LargeBuffer(std::int64_t count, const T& value)
    : LargeBuffer(count)
  {
    std::fill_n(this->data(), count, value);
  }

  // The memory, for an owner that frees it with freeLarge.
  T* release()
  {
    this->Count = 0;
    return this->Memory.release();
  }
  T* data() { return this->Memory.get(); }
  const T* data() const { return this->Memory.get(); }
  std::int64_t size() const { return this->Count; }
  std::int64_t bytes() const { return this->Count * static_cast<std::int64_t>(sizeof(T)); }

private:
  struct Free
  {
    void operator()(T* memory) const { freeLarge(memory); }
  };
  std::unique_ptr<T, Free> Memory;
  std::int64_t Count = 0;
};

} // namespace RectifiedTransport

#endif
