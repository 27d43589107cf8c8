// SPDX-License-Identifier: BSD-3-Clause
// Where tables get their memory from. By itself the C library hands the blocks of the last
// repetition out again if they are small enough, and asks the system for new pages if not: sides
// would be compared that pay for different things.
#ifndef RectifiedTransport_FreshMemory_h
#define RectifiedTransport_FreshMemory_h

#include <cstddef>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace RectifiedTransport
{

// Large blocks come from the system, as in the one build that most programs do. The default here.
inline void useFreshMemory()
{
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 65536);
  mallopt(M_MMAP_THRESHOLD, 128 * 1024);
  mallopt(M_TRIM_THRESHOLD, 128 * 1024);
#endif
}

// For the life of the object blocks are kept and handed out again: the time is that of the
// construction alone.
class ReusedMemory
{
public:
  ReusedMemory()
  {
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
#endif
  }
  ~ReusedMemory()
  {
    useFreshMemory();
  }
  ReusedMemory(const ReusedMemory&) = delete;
  ReusedMemory& operator=(const ReusedMemory&) = delete;

  // What was taken from the system so far, in bytes; 0 if that is not known.
  std::size_t Size() const
  {
#ifdef __GLIBC__
    return mallinfo2().arena;
#else
    return 0;
#endif
  }
};

} // namespace RectifiedTransport

#endif
