// SPDX-License-Identifier: BSD-3-Clause
// Lets a host follow and stop the making of many seeds.
#ifndef RectifiedTransport_SeedPace_h
#define RectifiedTransport_SeedPace_h

#include "Core/Parallel/Pacer.h"

#include <cstdint>

namespace RectifiedTransport
{

class SeedPace
{
public:
  // What Add throws; it stays within generateSeeds and its like.
  struct Cancelled
  {
  };

  // `work` is the sum of all that will be added.
  SeedPace(const Monitor& monitor, std::int64_t work)
    : Pace(monitor)
  {
    this->Pace.BeginStage(1.0, work);
    this->Pace.NextSlice(1);
  }

  void Add(std::int64_t points)
  {
    constexpr std::int64_t interval = std::int64_t{ 1 } << 16;
    this->Pending += points;
    if (this->Pending >= interval)
    {
      if (!this->Pace.EndSlice(this->Pending))
      {
        throw Cancelled();
      }
      this->Pending = 0;
    }
  }

private:
  Pacer Pace;
  std::int64_t Pending = 0;
};

} // namespace RectifiedTransport

#endif
