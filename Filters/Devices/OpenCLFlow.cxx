// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Device/DeviceUse.h"
#include "Core/Flow/AdvectionCounters.h"
#include "Core/Flow/Devices/DeviceFlow.h"
#include "Core/Tables/ScaledDensity.h"
#include "Devices/Device.h"
#include "Devices/FlowPrograms.h"
#include "Devices/KernelRun.h"
#include "Devices/NodeRun.h"

#include <algorithm>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// What ends the wait for a device that another thread uses.
std::function<bool()> stopsOf(Progress& progress)
{
  return [&progress]() { return progress.ShouldStop(); };
}

// An advection on a device. The tables and the map stay on the device between calls of Run; seeds
// and positions are transferred. Without the device, the caller advects on the processor, with the
// same bits.
template <int Dimension>
class Advection final : public DeviceAdvection<Dimension>
{
public:
  Advection(DeviceUse& use, const AdvectionJob<Dimension>& job,
    std::unique_ptr<KernelRun<Dimension>> kernels, bool isGpu)
    : Use(use)
    , Job(job)
    , Kernels(std::move(kernels))
    , IsGpu(isGpu)
  {
  }

  // The fewest particles of a call: a GPU takes 32768 of them in about the time of few, an OpenCL
  // processor needs no more than fill its work groups.
  std::int64_t FewestParticles() const override
  {
    return std::int64_t{ 1 } << (this->IsGpu ? 15 : 12);
  }

  // A source that is a whole lattice needs no seeds from the host; any other one has its seeds
  // read.
  bool Run(const ParticleSource<Dimension>& source, std::int64_t first, std::int64_t count,
    double* positions, FlowReport& counts, Progress& progress) override
  {
    return source.WholeLattice()
      ? this->RunLattice(*source.WholeLattice(), first, count, positions, counts, progress)
      : this->RunParticles(source, first, count, positions, counts, progress);
  }

private:
  // A thread reads so many seeds at a time: whole blocks, because sources fill block by block.
  static constexpr std::int64_t grain = 32 * BlockSize;

  // A whole lattice is advected in its own order: its seeds are made on the device, and its
  // positions come back in their places.
  bool RunLattice(const LatticeOrder<Dimension>& lattice, std::int64_t first, std::int64_t count,
    double* positions, FlowReport& counts, Progress& progress)
  {
    KernelReport report;
    // Particle `first` and those after it have contiguous positions.
    double* own = positions + first * Dimension;
    if (!this->Use.Run(
          [&]() {
            report =
              this->Kernels->Run(count, this->Kernels->FromLattice(lattice, first), own, progress);
          },
          stopsOf(progress)))
    {
      return false;
    }
    this->Finish(report, counts, progress,
      [&](std::uint32_t i) { return own + std::int64_t{ i } * Dimension; });
    return true;
  }

  // Seeds of a particle source: filled by blocks, in the source's order, and positions scattered
  // back to their places.
  bool RunParticles(const ParticleSource<Dimension>& source, std::int64_t first, std::int64_t count,
    double* positions, FlowReport& counts, Progress& progress)
  {
    const Executor& threads = progress.Threads();
    this->Index.resize(static_cast<std::size_t>(count));
    this->Points.resize(static_cast<std::size_t>(count * Dimension));
    double* const points = this->Points.data();
    // Seeds are read when their part of them is needed: the device works meanwhile.
    const auto fill = [&](std::int64_t begin, std::int64_t length) {
      threads.For(length, grain, [&](std::int64_t from, std::int64_t to) {
        for (; from < to; from += BlockSize)
        {
          const auto number = static_cast<int>(std::min<std::int64_t>(BlockSize, to - from));
          const std::int64_t at = begin + from;
          source.Fill(first + at, number, this->Index.data() + at, points + at * Dimension);
        }
      });
    };
    KernelReport report;
    if (!this->Use.Run(
          [&]() {
            // Seeds of the next part are read and transferred while kernels move this one.
            const auto transfer = this->Kernels->FromPoints(points);
            const auto prepare = [&](std::int64_t begin, std::int64_t length,
                                   const DeviceBuffer& seeds) {
              fill(begin, length);
              return transfer(begin, length, seeds);
            };
            report = this->Kernels->Run(count, prepare, points, progress);
          },
          stopsOf(progress)))
    {
      return false;
    }
    threads.For(count, grain, [&](std::int64_t from, std::int64_t to) {
      for (; from < to; ++from)
      {
        std::copy_n(this->Points.data() + from * Dimension, Dimension,
          // Index says where in the output each particle of the sorted order belongs.
          positions + this->Index[static_cast<std::size_t>(from)] * Dimension);
      }
    });
    this->Finish(report, counts, progress,
      [&](std::uint32_t i) { return positions + this->Index[i] * Dimension; });
    return true;
  }

  // Moves the particles that no pass has resolved to the nearest mass; place(i) is the position of
  // particle i. Their number is small, so the processor does it.
  template <class Place>
  void Finish(
    const KernelReport& report, FlowReport& counts, Progress& progress, const Place& place)
  {
    Counters moved;
    progress.Threads().For(static_cast<std::int64_t>(report.Unresolved.size()), BlockSize,
      [&](std::int64_t from, std::int64_t to) {
        for (; from < to && !progress.ShouldStop(); ++from)
        {
          moveToMass<Dimension>(
            this->Job.Job.Tables, place(report.Unresolved[static_cast<std::size_t>(from)]), moved);
        }
      });
    counts.MovedToMass += moved.MovedToMass;
    counts.Evaluations += report.Evaluations;
    counts.Redone += report.Redone;
  }

  DeviceUse& Use;
  const AdvectionJob<Dimension>& Job;
  const std::unique_ptr<KernelRun<Dimension>> Kernels;
  const bool IsGpu;
  // The particles of one call: the places of their results, and their seeds, then positions.
  std::vector<std::int64_t> Index;
  std::vector<double> Points;
};

template <int Dimension>
class OpenCLFlow final : public DeviceFlow<Dimension>
{
public:
  explicit OpenCLFlow(Device& device)
    : Owner(device)
  {
  }

  // Devices have the multistep method on interpolated tables alone; its bits are those of the
  // processor.
  bool Serves(AdvectionKind kind, const FlowOptions& options) const override
  {
    return kind != AdvectionKind::ForwardToCells && takesFlowMaps(options);
  }
  void MakeTables(DeviceUse& use, const DensitySource<Dimension>& density,
    const SummedAreaTables<Dimension>& tables, Progress& progress) override;
  std::unique_ptr<DeviceAdvection<Dimension>> Begin(DeviceUse& use,
    const AdvectionJob<Dimension>& job, std::shared_ptr<const FlowMap<Dimension>> map,
    Progress& progress) override;
  DeviceNodes<Dimension> BeginNodes(DeviceUse& use, const AdvectionJob<Dimension>& job) override;

private:
  struct Map
  {
    std::weak_ptr<const FlowMap<Dimension>> Of;
    std::shared_ptr<const DeviceMap<Dimension>> Copy;
  };

  // The tables, copied once: later runs find them there.
  std::shared_ptr<const DeviceTables<Dimension>> Copied(const TableView<Dimension>& tables)
  {
    if (!this->Tables)
    {
      this->Tables = std::make_shared<const DeviceTables<Dimension>>(this->Owner, tables);
    }
    return this->Tables;
  }
  // The copy of the flow map. Another map of the same direction replaces it.
  std::shared_ptr<const DeviceMap<Dimension>> Copied(
    const std::shared_ptr<const FlowMap<Dimension>>& map, bool backward)
  {
    Map& cached = this->Maps[backward ? 1 : 0];
    if (map && cached.Of.lock() != map)
    {
      cached = {}; // two side by side would double the peak
      cached.Copy =
        std::make_shared<const DeviceMap<Dimension>>(this->Owner, map->View(), backward);
      cached.Of = map;
    }
    return map ? cached.Copy : nullptr;
  }

  Device& Owner;
  // Whoever has locked the device reads and writes these.
  std::shared_ptr<const DeviceTables<Dimension>> Tables;
  Map Maps[2]; // forward and backward
  const std::shared_ptr<DeviceWeights> Weights = std::make_shared<DeviceWeights>();
};

template <int Dimension>
void OpenCLFlow<Dimension>::MakeTables(DeviceUse& use, const DensitySource<Dimension>& density,
  const SummedAreaTables<Dimension>& tables, Progress& progress)
{
  // Distributed densities would make this collective, so the processor's tables are copied when
  // they are needed. So they are for long axes: a device sums along an axis in one run of a kernel,
  // and drivers limit the groups along an axis to 65535.
  constexpr std::int64_t longest = 65535;
  if (!use.Serves() || density.IsDistributed() ||
    *std::max_element(density.Size.begin(), density.Size.end()) >= longest)
  {
    return;
  }
  const auto cells = static_cast<std::int64_t>(numberOfCells<Dimension>(density.Size));
  // All values are on this rank here, since distributed densities have returned.
  const std::shared_ptr<const DensityValues> source = density.Whole();
  // The same scaling as for the processor's tables, so that sums have the same bits.
  const ScaledDensity given(*source, scalingOf(tables.Summary().Maximum));
  const auto stops = stopsOf(progress);
  // Values are transferred 8 MiB at a time: the density may be of any type, and its doubles are
  // never all in memory.
  const std::int64_t most = std::min(cells, std::int64_t{ 1 } << 20);
  std::vector<double> part(static_cast<std::size_t>(most));
  DeviceBuffer values;
  if (!use.Run(
        [&]() {
          values =
            this->Owner.Allocate(static_cast<std::size_t>(cells) * sizeof(double), "the tables");
        },
        stops))
  {
    return;
  }
  progress.Expect(cells);
  for (std::int64_t first = 0; first < cells && use.Serves();)
  {
    // A slice is read by the threads and then written to the device: the device is locked only for
    // the transfer, so that an abort or another run need not wait for all values.
    const std::int64_t count =
      std::min({ cells - first, most, progress.NextSlice(std::int64_t{ 1 } << 16) });
    progress.Threads().For(count, std::int64_t{ 1 } << 14, [&](std::int64_t from, std::int64_t to) {
      given.Read(first + from, to - from, part.data() + from);
    });
    use.Run(
      [&]() {
        this->Owner.Write(values, part.data(), static_cast<std::size_t>(count) * sizeof(double),
          static_cast<std::size_t>(first) * sizeof(double));
      },
      stops);
    first += count;
    progress.EndSlice(count);
  }
  use.Run(
    [&]() {
      // A run that has found the device locked until an abort leaves no tables; Begin then copies
      // the processor's.
      this->Tables = std::make_shared<const DeviceTables<Dimension>>(
        this->Owner, flowProgram(this->Owner, Dimension), tables.View(), values);
    },
    stops);
}

template <int Dimension>
std::unique_ptr<DeviceAdvection<Dimension>> OpenCLFlow<Dimension>::Begin(DeviceUse& use,
  const AdvectionJob<Dimension>& job, std::shared_ptr<const FlowMap<Dimension>> map,
  Progress& progress)
{
  // Null if the device does not serve: the reason is in `use`.
  std::unique_ptr<DeviceAdvection<Dimension>> advection;
  use.Run(
    [&]() {
      auto tables = this->Copied(job.Job.Tables);
      advection = std::make_unique<Advection<Dimension>>(use, job,
        std::make_unique<KernelRun<Dimension>>(this->Owner, flowProgram(this->Owner, Dimension),
          job, std::move(tables), this->Copied(map, job.Job.Backward), this->Weights),
        this->Owner.IsGpu());
    },
    stopsOf(progress));
  return advection;
}

template <int Dimension>
DeviceNodes<Dimension> OpenCLFlow<Dimension>::BeginNodes(
  DeviceUse& use, const AdvectionJob<Dimension>& job)
{
  return [this, &use, &job](const FlowMapView<Dimension>& map, const FlowMapLevel<Dimension>& level,
           std::int64_t first, std::int64_t count, unsigned char* marks,
           Progress& progress) -> std::int64_t {
    const auto stops = stopsOf(progress);
    // -1 says that the device failed; the processor then makes all nodes of the level.
    std::unique_ptr<NodeRun<Dimension>> run;
    if (!use.Run(
          [&]() {
            run =
              std::make_unique<NodeRun<Dimension>>(this->Owner, flowProgram(this->Owner, Dimension),
                job.Job, this->Copied(job.Job.Tables), map, level);
          },
          stops))
    {
      return -1;
    }
    progress.Expect(count);
    std::int64_t evaluations = 0;
    for (std::int64_t done = 0; done < count && use.Serves();)
    {
      // The device is free for others while progress is reported.
      const std::int64_t slice = std::min(count - done, progress.NextSlice(run->FewestNodes()));
      use.Run([&]() { evaluations += run->Run(first + done, slice, marks); }, stops);
      done += slice;
      progress.EndSlice(slice);
    }
    // After a fault the marks of nodes made so far are not used.
    return use.Serves() ? evaluations : -1;
  };
}

} // namespace

template <int Dimension>
std::shared_ptr<DeviceFlow<Dimension>> Device::FlowOf(const void* owner)
{
  const std::lock_guard<std::mutex> lock(this->FlowsMutex);
  std::shared_ptr<void>& flow = this->Flows[owner];
  if (!flow)
  {
    flow = std::make_shared<OpenCLFlow<Dimension>>(*this);
  }
  return std::static_pointer_cast<OpenCLFlow<Dimension>>(flow);
}

void Device::Find(const void* owner, std::shared_ptr<DeviceFlow<2>>& flow)
{
  flow = this->FlowOf<2>(owner);
}

void Device::Find(const void* owner, std::shared_ptr<DeviceFlow<3>>& flow)
{
  flow = this->FlowOf<3>(owner);
}

} // namespace RectifiedTransport
