// SPDX-License-Identifier: BSD-3-Clause
// The flow maps of the last number of steps in both directions, kept for later runs.
#ifndef RectifiedTransport_KeptFlowMap_h
#define RectifiedTransport_KeptFlowMap_h

#include "Core/Flow/Devices/DeviceAdvection.h"
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
class KeptFlowMap
{
public:
  // Returns the map of a shape if all ranks have kept it; else makes it, with the context that
  // begin() returns and on the device that it may have set, and keeps it. Several runs may call it
  // concurrently. Throws NoMemoryForFlowMap and Cancelled.
  template <class Begin>
  std::shared_ptr<const FlowMap<Dimension>> FindOrMake(const FlowMapShape<Dimension>& shape,
    int refinement, const FlowJob<Dimension>& job, const Ranks& ranks, const Begin& begin,
    bool& isNew, const std::unique_ptr<DeviceNodes<Dimension>>& onDevice = nullptr)
  {
    const Steps steps{ shape.NumberOfSteps, shape.MapSteps, refinement };
    std::shared_ptr<const FlowMap<Dimension>> map = this->Get(steps);
    isNew = !onAllRanks(ranks, map != nullptr);
    if (isNew)
    {
      // Not locked: other runs make their own map meanwhile, with the same bits.
      map.reset();
      this->Set(steps, nullptr); // old and new maps side by side would double the peak
      const Context context = begin();
      try
      {
        map = std::make_shared<const FlowMap<Dimension>>(shape, job, context, onDevice.get());
      }
      catch (const std::bad_alloc&)
      {
        throw NoMemoryForFlowMap(shape.MemorySize());
      }
      this->Set(steps, map);
    }
    return map;
  }

  std::int64_t MemorySize()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->Map ? this->Map->MemorySize() : 0;
  }

private:
  using Steps = std::tuple<int, int, int>; // NumberOfSteps, MapSteps and the refinement

  std::shared_ptr<const FlowMap<Dimension>> Get(const Steps& steps)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return steps == this->Of ? this->Map : nullptr;
  }
  void Set(const Steps& steps, std::shared_ptr<const FlowMap<Dimension>> map)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Of = steps;
    this->Map.swap(map);
  }

  std::mutex Mutex;
  Steps Of;
  std::shared_ptr<const FlowMap<Dimension>> Map;
};

// One for each direction.
template <int Dimension>
class KeptFlowMaps
{
public:
  KeptFlowMap<Dimension>& At(FlowDirection direction)
  {
    return direction == FlowDirection::Backward ? this->Backward : this->Forward;
  }
  std::int64_t MemorySize() { return this->Forward.MemorySize() + this->Backward.MemorySize(); }

private:
  KeptFlowMap<Dimension> Forward;
  KeptFlowMap<Dimension> Backward;
};

} // namespace RectifiedTransport

#endif
