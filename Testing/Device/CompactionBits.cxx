// SPDX-License-Identifier: BSD-3-Clause
// The kernels that make the list of the particles that are left after a pass.
#include "Bits.h"

#include "Core/Device/DeviceUse.h"
#include "Core/Flow/Kernels/SharedInputs.h"
#include "Core/Flow/Particles/Compaction.h"
#include "Devices/Device.h"
#include "Devices/DeviceTables.h"
#include "Devices/FlowPrograms.h"

#include <random>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::size_t groupSize = RT_GROUP;

struct Compacted
{
  PassCounts Total{};
  std::vector<std::uint32_t> List;
};

// `list` is empty if all particles take part.
Compacted onDevice(
  Device& device, const std::vector<std::uint32_t>& status, const std::vector<std::uint32_t>& list)
{
  const char* const what = "a list";
  const auto count = static_cast<cl_uint>(status.size());
  const auto groups = static_cast<cl_uint>((status.size() + groupSize - 1) / groupSize);
  const DeviceProgram& program = flowProgram(device, 2);
  DeviceKernel countUnresolved = program.NewKernel("countUnresolved");
  DeviceKernel sumCounts = program.NewKernel("sumCounts");
  DeviceKernel keepUnresolved = program.NewKernel("keepUnresolved");
  const DeviceBuffer statuses = upload(device, status.data(), count, what);
  const DeviceBuffer before =
    upload(device, list.data(), static_cast<std::int64_t>(list.size()), what);
  const DeviceBuffer counts = device.Allocate(groups * sizeof(PassCounts), what);
  const DeviceBuffer total = device.Allocate(sizeof(PassCounts), what);
  const DeviceBuffer after = device.Allocate(count * sizeof(cl_uint), what);
  device.Run(countUnresolved.With(statuses, count, counts), count, groupSize);
  device.Run(sumCounts.With(counts, groups, total), groupSize, groupSize);
  device.Run(
    keepUnresolved.With(statuses, count, counts, cl_int{ list.empty() ? 0 : 1 }, before, after),
    count, groupSize);
  Compacted result;
  device.Read(total, &result.Total, sizeof(result.Total));
  const auto left = std::min<std::size_t>(result.Total.Unresolved, status.size());
  result.List.resize(left);
  device.Read(after, result.List.data(), left * sizeof(cl_uint));
  return result;
}

Compacted onProcessor(
  const std::vector<std::uint32_t>& status, const std::vector<std::uint32_t>& list)
{
  Compacted result;
  result.List.resize(status.size());
  result.List.resize(compact(
    status.size(), [&](std::size_t i) { return (status[i] & 1) != 0; },
    [&](std::size_t i, std::size_t place) {
      result.List[place] = list.empty() ? static_cast<std::uint32_t>(i) : list[i];
    }));
  result.Total.Unresolved = result.List.size();
  for (const std::uint32_t each : status)
  {
    result.Total.Evaluations += each >> 1;
  }
  return result;
}

BitsCount compare(const Compacted& device, const Compacted& processor)
{
  BitsCount count;
  const auto add = [&](const std::string& what, std::uint64_t found, std::uint64_t right) {
    count.Add(found == right,
      [&]() { return bothValues(what, std::to_string(found), std::to_string(right)); });
  };
  add("evaluations", device.Total.Evaluations, processor.Total.Evaluations);
  add("number of those left", device.Total.Unresolved, processor.Total.Unresolved);
  for (std::size_t i = 0; i < std::min(device.List.size(), processor.List.size()); ++i)
  {
    add("place " + std::to_string(i), device.List[i], processor.List[i]);
  }
  return count;
}

} // namespace

void compareCompaction(const std::shared_ptr<Device>& device, bool isQuick, BitsTable& table)
{
  std::mt19937_64 random(1);
  std::vector<std::size_t> sizes{ 1, 255, 256, 257, 100003 };
  if (!isQuick)
  {
    sizes.push_back(5000000);
  }
  for (const std::size_t size : sizes)
  {
    std::vector<std::uint32_t> status(size);
    std::vector<std::uint32_t> list;
    for (std::uint32_t& each : status)
    {
      each = static_cast<std::uint32_t>(random() >> 50);
    }
    // Of all, then of those left.
    for (const char* const of : { "all", "a list" })
    {
      const std::string what = grouped(static_cast<std::int64_t>(status.size())) + " of " + of;
      const Compacted right = onProcessor(status, list);
      Compacted found;
      DeviceUse use(device);
      if (!use.Run([&]() { found = onDevice(*device, status, list); }))
      {
        table.AddFault("compaction", what, use.Fault());
        continue;
      }
      table.Add("compaction", what, compare(found, right));
      list = right.List;
      status.resize(list.size());
      if (list.empty())
      {
        break;
      }
    }
  }
}

} // namespace RectifiedTransport
