// SPDX-License-Identifier: BSD-3-Clause
// Memory for tables: aligned to cache lines, not initialised, on huge pages where the system has
// them (a table is walked with large strides, and faulting it in page by page costs as much as
// filling it).
#ifndef RectifiedTransport_LargeBuffer_h
#define RectifiedTransport_LargeBuffer_h

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace RectifiedTransport
{

template <class T>
class LargeBuffer
{
  static_assert(std::is_trivially_copyable_v<T>, "the memory is not initialised");

public:
  LargeBuffer() = default;
  explicit LargeBuffer(std::int64_t count)
    : Count(count)
  {
    constexpr std::size_t hugePage = std::size_t{ 1 } << 21;
    constexpr std::size_t line = 64;
    if (static_cast<std::uint64_t>(count) >
      (std::numeric_limits<std::size_t>::max() / 2 - hugePage) / sizeof(T))
    {
      throw std::bad_alloc();
    }
    const std::size_t bytes = static_cast<std::size_t>(count) * sizeof(T);
    const std::size_t alignment = bytes >= 2 * hugePage ? hugePage : line;
    const std::size_t rounded = (bytes + alignment) / alignment * alignment;
    this->Memory.reset(static_cast<T*>(std::aligned_alloc(alignment, rounded)));
    if (!this->Memory)
    {
      throw std::bad_alloc();
    }
#ifdef __linux__
    if (alignment == hugePage)
    {
      // Only advice: where it is not taken, the tables work as well, but slower.
      (void)madvise(this->Memory.get(), rounded, MADV_HUGEPAGE);
    }
#endif
  }

  T* data()
  {
    return this->Memory.get();
  }
  const T* data() const
  {
    return this->Memory.get();
  }
  std::int64_t size() const
  {
    return this->Count;
  }
  std::int64_t bytes() const
  {
    return this->Count * static_cast<std::int64_t>(sizeof(T));
  }

private:
  struct Free
  {
    void operator()(T* memory) const { std::free(memory); }
  };
  std::unique_ptr<T, Free> Memory;
  std::int64_t Count = 0;
};

} // namespace RectifiedTransport

#endif
