// SPDX-License-Identifier: BSD-3-Clause
// The flow maps of the last number of steps in both directions, kept for later runs.
#ifndef RectifiedTransport_FlowMapCache_h
#define RectifiedTransport_FlowMapCache_h

#include "Core/Flow/FlowMap.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Flow/NoMemoryForFlowMap.h"
#include "Core/Parallel/RankExchange.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <tuple>

namespace RectifiedTransport
{

template <int Dimension>
class FlowMapCache
{
public:
  // Returns the map of a shape if all ranks have it; else what make() returns, and keeps it.
  // Several runs may call it concurrently. Throws NoMemoryForFlowMap and Cancelled.
  template <class Make>
  std::shared_ptr<const FlowMap<Dimension>> FindOrMake(
    const FlowMapShape<Dimension>& shape, int refinement, const Ranks& ranks, const Make& make)
  {
    Entry& entry = this->Maps[shape.Direction == FlowDirection::Backward ? 1 : 0];
    const Steps steps{ shape.NumberOfSteps, shape.MapSteps, refinement };
    std::shared_ptr<const FlowMap<Dimension>> map = this->Get(entry, steps);
    if (!onAllRanks(ranks, map != nullptr))
    {
      // Not locked: other runs make their own map meanwhile, with the same bits.
      map.reset();
      this->Set(entry, steps, nullptr); // old and new maps side by side would double the peak
      try
      {
        map = make();
      }
      catch (const std::bad_alloc&)
      {
        throw NoMemoryForFlowMap(shape.MemorySize());
      }
      this->Set(entry, steps, map);
    }
    return map;
  }

  std::int64_t MemorySize()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::int64_t bytes = 0;
    for (const Entry& entry : this->Maps)
    {
      bytes += entry.Map ? entry.Map->MemorySize() : 0;
    }
    return bytes;
  }

private:
  using Steps = std::tuple<int, int, int>; // NumberOfSteps, MapSteps and the refinement
  struct Entry
  {
    Steps Of;
    std::shared_ptr<const FlowMap<Dimension>> Map;
  };

  std::shared_ptr<const FlowMap<Dimension>> Get(const Entry& entry, const Steps& steps)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return steps == entry.Of ? entry.Map : nullptr;
  }
  void Set(Entry& entry, const Steps& steps, std::shared_ptr<const FlowMap<Dimension>> map)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    entry.Of = steps;
    entry.Map.swap(map);
  }

  std::mutex Mutex;
  Entry Maps[2]; // forward and backward
};

} // namespace RectifiedTransport

#endif
