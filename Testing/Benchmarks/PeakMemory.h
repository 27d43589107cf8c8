// SPDX-License-Identifier: BSD-3-Clause
// The most memory that the process has had.
#ifndef RectifiedTransport_PeakMemory_h
#define RectifiedTransport_PeakMemory_h

#include <cstdio>

namespace RectifiedTransport
{

// The largest resident size since the last reset, in bytes; 0 where the system does not tell.
inline double peakMemory()
{
  double kilobytes = 0.0;
  if (std::FILE* status = std::fopen("/proc/self/status", "r"))
  {
    char line[256];
    while (std::fgets(line, sizeof(line), status))
    {
      std::sscanf(line, "VmHWM: %lf", &kilobytes);
    }
    std::fclose(status);
  }
  return 1024.0 * kilobytes;
}

inline void resetPeakMemory()
{
  if (std::FILE* references = std::fopen("/proc/self/clear_refs", "w"))
  {
    std::fputs("5", references);
    std::fclose(references);
  }
}

} // namespace RectifiedTransport

#endif
