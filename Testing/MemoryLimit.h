// SPDX-License-Identifier: BSD-3-Clause
// Lets memory run out in a test, where the system can: not under AddressSanitizer, which reserves
// most of the addresses.
#ifndef MemoryLimit_h
#define MemoryLimit_h

#include <cstdint>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) // Clang's way to tell
#define HAS_ADDRESS_SANITIZER
#endif
#endif

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(HAS_ADDRESS_SANITIZER)
#define HAS_MEMORY_LIMIT
#include "Benchmarks/FreshMemory.h"

#include <cstdlib>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

// A process that can have no more than about `bytes` until the end of the scope: it may not grow by
// more, and what malloc holds in reserve is taken, but for some small blocks, since VTK's own
// pipeline ends the program when it cannot have a few for itself. New threads cannot be made
// meanwhile.
class MemoryLimit
{
public:
  explicit MemoryLimit(std::int64_t bytes)
  {
    RectifiedTransport::useFreshMemory(); // whatever was freed before
    const std::vector<std::vector<char>> change(400, std::vector<char>(200));
    constexpr std::size_t most = 1 << 16;
    this->Taken.reserve(most);
    getrlimit(RLIMIT_AS, &this->Before);
    const rlim_t now = sizeNow(); // later it cannot be read
    this->LimitSize(now);
    constexpr std::size_t smallest = 1 << 15;
    for (std::size_t size = std::size_t{ 1 } << 26; size >= smallest; size /= 2)
    {
      while (void* block = this->Taken.size() < most ? std::malloc(size) : nullptr)
      {
        this->Taken.push_back(block);
      }
    }
    this->LimitSize(now + static_cast<rlim_t>(bytes));
  }
  ~MemoryLimit()
  {
    for (void* block : this->Taken)
    {
      std::free(block);
    }
    setrlimit(RLIMIT_AS, &this->Before);
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
  static rlim_t sizeNow()
  {
    std::ifstream file("/proc/self/statm");
    rlim_t pages = 0;
    file >> pages;
    return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  }

  void LimitSize(rlim_t bytes) const
  {
    rlimit limit = this->Before;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_AS, &limit);
  }

  rlimit Before;
  std::vector<void*> Taken;
};
#endif

#endif
