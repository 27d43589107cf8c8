// SPDX-License-Identifier: BSD-3-Clause
// Lets memory run out in a test, where the system can: not under AddressSanitizer, which reserves
// most of the addresses.
#ifndef MemoryLimit_h
#define MemoryLimit_h

#include <cstdint>

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define HAS_MEMORY_LIMIT
#include <fstream>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

// Large blocks go back to the system as soon as they are free: of what a process keeps it could make
// more without growing.
inline void keepNoLargeBlocks()
{
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 16);
#endif
}

// A process that may not grow by more than `bytes`, until the end of the scope. It gives back what
// it holds in reserve, but for some small blocks: VTK's own pipeline ends the program when it
// cannot have a few for itself. New threads cannot be made meanwhile.
class MemoryLimit
{
public:
  explicit MemoryLimit(std::int64_t bytes)
  {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    std::vector<std::vector<char>>(400, std::vector<char>(200));
    std::ifstream file("/proc/self/statm");
    rlim_t pages = 0;
    file >> pages;
    getrlimit(RLIMIT_AS, &this->Before);
    rlimit limit = this->Before;
    limit.rlim_cur =
      pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + static_cast<rlim_t>(bytes);
    setrlimit(RLIMIT_AS, &limit);
  }
  ~MemoryLimit()
  {
    setrlimit(RLIMIT_AS, &this->Before);
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
  rlimit Before;
};
#endif

#endif
