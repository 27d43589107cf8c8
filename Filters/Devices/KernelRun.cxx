// SPDX-License-Identifier: BSD-3-Clause
#include "Devices/KernelRun.h"

#include "Core/Flow/Kernels/SharedInputs.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// Items of a work group; counts of unresolved particles are made by groups.
constexpr std::uint32_t groupSize = RT_GROUP;
// A kernel takes at most mostSteps steps, and so many of all its particles together: longer kernels
// would keep an abort waiting, or a watchdog, which some systems have at 2 s. Slow GPUs do
// workOfGpu steps in some 100 ms, OpenCL on a processor workOfOthers.
constexpr std::int64_t mostSteps = 512;
constexpr std::int64_t workOfGpu = std::int64_t{ 1 } << 23;
constexpr std::int64_t workOfOthers = std::int64_t{ 1 } << 18;

} // namespace

std::int64_t stepsAtOnce(const Device& device, std::int64_t particles)
{
  constexpr std::int64_t fewest = 8; // steps: storing a state between runs is little beside them
  const std::int64_t work = device.IsGpu() ? workOfGpu : workOfOthers;
  return std::clamp(work / particles, fewest, mostSteps);
}

// All levels' records and marks lie in one buffer each, one level after the other; the level inputs
// hold where each begins.
template <int Dimension>
DeviceMap<Dimension>::DeviceMap(Device& device, const FlowMapView<Dimension>& map, bool backward)
  : Steps(map.Steps)
  , LevelCount(map.LevelCount)
{
  // Floats a node: position and velocities at the hand-over, fewer backward.
  const std::int64_t record =
    backward ? FlowMapLevel<Dimension>::BackwardRecord : FlowMapLevel<Dimension>::ForwardRecord;
  std::vector<MapLevelInput> levels;
  std::int64_t records = 0;
  std::int64_t marks = 0;
  const auto forLevels = [&](const auto& function) {
    records = marks = 0;
    for (int level = 0; level < map.LevelCount; ++level)
    {
      std::int64_t nodes = 1;
      std::int64_t cells = 1;
      for (const LatticeAxis& axis : map.Levels[level].Axes)
      {
        nodes *= axis.Cells + 1;
        cells *= axis.Cells;
      }
      function(map.Levels[level], nodes * record, cells);
      records += nodes * record;
      marks += cells;
    }
  };
  forLevels([&](const FlowMapLevel<Dimension>& level, std::int64_t, std::int64_t) {
    levels.push_back(mapLevelInput<Dimension>(level, records, marks));
  });
  // Records are floats and marks are bytes: bad cells, from which a particle starts at its seed.
  this->Levels = upload(device, levels, "a flow map");
  this->Records = device.Allocate(static_cast<std::size_t>(records) * sizeof(float), "a flow map");
  this->Bad = device.Allocate(static_cast<std::size_t>(marks), "a flow map");
  forLevels([&](const FlowMapLevel<Dimension>& level, std::int64_t ofRecords, std::int64_t cells) {
    device.Write(this->Records, level.Records, static_cast<std::size_t>(ofRecords) * sizeof(float),
      static_cast<std::size_t>(records) * sizeof(float));
    device.Write(
      this->Bad, level.Bad, static_cast<std::size_t>(cells), static_cast<std::size_t>(marks));
  });
}

// Inputs that do not change between passes are transferred once.
template <int Dimension>
KernelRun<Dimension>::KernelRun(Device& device, const DeviceProgram& program,
  const AdvectionJob<Dimension>& job, std::shared_ptr<const DeviceTables<Dimension>> tables,
  std::shared_ptr<const DeviceMap<Dimension>> map, std::shared_ptr<DeviceWeights> weights,
  std::int64_t mostOfPart)
  : Owner(device)
  , Job(job)
  , Tables(std::move(tables))
  , Map(std::move(map))
  , OfSteps(std::move(weights))
  , PlaceKernel(program.NewKernel("placeLattice"))
  , AdvectKernel(program.NewKernel(job.Job.Backward ? "advectBackward" : "advectForward"))
  , CountKernel(program.NewKernel("countUnresolved"))
  , SumKernel(program.NewKernel("sumCounts"))
  , KeepKernel(program.NewKernel("keepUnresolved"))
  , MostOfPart(mostOfPart)
{
  // Tables' shape, direction, tolerance and other numbers of the job.
  const FlowInput input = flowInput<Dimension>(job.Job);
  this->Input = upload(device, &input, 1, "an advection");
  this->Total = device.Allocate(sizeof(PassCounts), "an advection");
  this->States = device.Allocate(sizeof(double), "an advection");
}

// The weights of so many graded steps in one direction. Few steps are those of nearly all runs, so
// their weights stay on the device.
std::shared_ptr<const DeviceBuffer> DeviceWeights::Of(
  Device& device, std::int64_t steps, FlowDirection direction)
{
  constexpr std::int64_t mostCached = std::int64_t{ 1 } << 14; // steps: 1 MiB
  const auto found = this->Cache.find({ steps, direction });
  if (found != this->Cache.end())
  {
    return found->second;
  }
  // The host computes the weights, so that they have its bits.
  const std::vector<StepWeights> weights = multistepWeightsOf(steps, direction);
  auto made = std::make_shared<const DeviceBuffer>(upload(device, weights, "weights of steps"));
  if (steps <= mostCached)
  {
    this->Cache.emplace(std::make_pair(steps, direction), made);
  }
  return made;
}

template <int Dimension>
std::shared_ptr<const DeviceBuffer> KernelRun<Dimension>::WeightsOf(std::int64_t steps)
{
  return this->OfSteps->Of(this->Owner, steps, directionOf(this->Job.Kind));
}

// Buffers for so many particles: seeds and positions in two sets if transfers overlap with kernels,
// a status and two lists for compaction.
template <int Dimension>
void KernelRun<Dimension>::MakeRoom(std::int64_t count, bool hasTwoSets)
{
  if (count <= this->Room && (this->HasTwoSets || !hasTwoSets))
  {
    return;
  }
  const auto particles = static_cast<std::size_t>(count);
  const auto allocate = [&](DeviceBuffer& buffer, std::size_t bytes) {
    buffer = {}; // frees the old one before the new one is allocated
    buffer = this->Owner.Allocate(bytes, "particles");
  };
  for (int set = 0; set < (hasTwoSets ? 2 : 1); ++set)
  {
    allocate(this->Seeds[set], particles * Dimension * sizeof(double));
    allocate(this->Positions[set], particles * Dimension * sizeof(double));
  }
  allocate(this->Status, particles * sizeof(std::uint32_t));
  allocate(this->Lists[0], particles * sizeof(std::uint32_t));
  allocate(this->Lists[1], particles * sizeof(std::uint32_t));
  allocate(this->Counts, (particles / groupSize + 1) * sizeof(PassCounts));
  this->Room = count;
  this->HasTwoSets = hasTwoSets;
}

// Starts the transfer of a part of the seeds.
template <int Dimension>
typename KernelRun<Dimension>::Prepare KernelRun<Dimension>::FromPoints(const double* points)
{
  return [this, points](std::int64_t first, std::int64_t count, const DeviceBuffer& seeds) {
    return this->Owner.StartWrite(seeds, points + first * Dimension,
      static_cast<std::size_t>(count) * Dimension * sizeof(double));
  };
}

// Makes seeds on the device from their numbers: nothing is transferred.
template <int Dimension>
typename KernelRun<Dimension>::Prepare KernelRun<Dimension>::FromLattice(
  const LatticeOrder<Dimension>& lattice, std::int64_t begin)
{
  LatticeInput shape{};
  for (int axis = 0; axis < Dimension; ++axis)
  {
    shape.Cells[axis] = lattice.Cells()[axis];
    shape.Size[axis] = static_cast<double>(lattice.Box()[axis]);
    shape.Place[axis] = lattice.PlaceInCell()[axis];
  }
  return [this, shape, begin](std::int64_t first, std::int64_t count, const DeviceBuffer& seeds) {
    this->Owner.Run(
      this->PlaceKernel.With(shape, begin + first, static_cast<cl_uint>(count), seeds),
      static_cast<std::size_t>(count));
    return DeviceTransfer();
  };
}

// Double buffering: while kernels advect a part in one set of buffers, the seeds of the next part
// and the positions of the last one are transferred in the other.
template <int Dimension>
KernelReport KernelRun<Dimension>::Run(
  std::int64_t count, const Prepare& prepare, double* positions, Progress& progress)
{
  const std::int64_t most = std::min(count, this->MostOfPart);
  this->MakeRoom(most, count > most);
  // The last part may be shorter.
  const auto lengthAt = [&](std::int64_t first) { return std::min(most, count - first); };
  KernelReport report;
  DeviceTransfer toDevice[2];
  DeviceTransfer fromDevice[2];
  if (count > 0)
  {
    toDevice[0] = prepare(0, lengthAt(0), this->Seeds[0]);
  }
  this->Set = 0;
  for (std::int64_t first = 0; first < count && !progress.ShouldStop(); first += most)
  {
    const int set = this->Set;
    // This set's seeds must be there, and its positions of the part before the last one must be
    // away.
    toDevice[set].Wait();
    fromDevice[set].Wait();
    const std::int64_t next = first + most;
    // Called while the first kernel of this part runs.
    const auto meanwhile = [&]() {
      if (next < count)
      {
        this->Owner.Start();
        toDevice[1 - set] = prepare(next, lengthAt(next), this->Seeds[1 - set]);
      }
    };
    const auto particles = static_cast<std::uint32_t>(lengthAt(first));
    const KernelReport part = this->Job.Job.Backward
      ? this->RunBackward(particles, meanwhile, progress)
      : this->RunForward(particles, meanwhile, progress);
    fromDevice[set] = this->Owner.StartRead(this->Positions[set], positions + first * Dimension,
      std::size_t{ particles } * Dimension * sizeof(double));
    report.Evaluations += part.Evaluations;
    report.Redone += part.Redone;
    for (const std::uint32_t particle : part.Unresolved)
    {
      // Numbers within the part become numbers within the run.
      report.Unresolved.push_back(static_cast<std::uint32_t>(first) + particle);
    }
    this->Set = 1 - set;
  }
  for (DeviceTransfer& transfer : fromDevice)
  {
    transfer.Wait();
  }
  return report;
}

// Cuts the steps into pieces that take bounded time. Between pieces a particle's state waits in
// memory: position, velocities and flags.
template <int Dimension>
template <class RunPiece>
void KernelRun<Dimension>::ForPieces(
  std::int64_t steps, std::uint32_t count, Progress& progress, const RunPiece& run)
{
  const std::int64_t atOnce = stepsAtOnce(this->Owner, count);
  if (steps > atOnce && this->States.Size() < count * stateSize<Dimension>)
  {
    this->States = {};
    this->States = this->Owner.Allocate(count * stateSize<Dimension>, "particles");
  }
  for (std::int64_t first = 0; first < steps && !progress.ShouldStop(); first += atOnce)
  {
    run(first, std::min(first + atOnce, steps));
    if (first + atOnce < steps)
    {
      // Kernels are enqueued without a wait: unless pieces finish one by one, all of them would be
      // in the queue when an abort comes.
      this->Owner.Finish();
    }
  }
}

// Runs passes `pass` to `lastPass` of all listed particles. Passes below 0 start from a level of
// the flow map, pass k >= 0 from the seed with Steps 2^k steps.
template <int Dimension>
void KernelRun<Dimension>::RunPass(int pass, int lastPass, std::uint32_t count, Progress& progress)
{
  const DeviceMap<Dimension>* map = this->Map.get();
  // Pass k takes 2^k times the job's steps.
  const std::int64_t steps = this->Job.Job.Steps << std::max(lastPass, 0);
  const auto weights = this->WeightsOf(steps);
  const auto ofMap = map ? this->WeightsOf(map->Steps) : weights;
  const DeviceBuffer& none = this->Total; // stands for buffers that the kernel does not read
  const auto run = [&](std::int64_t first, std::int64_t last) {
    this->AdvectKernel.With(this->Input, this->Tables->Fine, this->Tables->Coarse,
      this->Tables->Occupied, cl_long{ map ? map->Steps : 0 }, cl_long{ map ? map->LevelCount : 0 },
      map ? map->Levels : none, map ? map->Records : none, map ? map->Bad : none, *ofMap, *weights,
      cl_long{ steps }, cl_long{ first }, cl_long{ last }, cl_int{ pass }, cl_int{ lastPass },
      cl_int{ lastPass < this->Job.LastPass() ? 1 : 0 }, this->Seeds[this->Set],
      cl_int{ this->IsListed ? 1 : 0 }, this->Lists[0], cl_uint{ count }, this->States,
      this->Positions[this->Set], this->Status);
    this->Owner.Run(this->AdvectKernel, count);
  };
  if (lastPass < 0)
  {
    run(0, steps);
    return;
  }
  this->ForPieces(steps, count, progress, run);
}

// Counts the unresolved particles and lists them, in order, for the next pass: counts of groups,
// their prefix sums, then stable compaction.
template <int Dimension>
std::uint32_t KernelRun<Dimension>::CountPass(std::uint32_t count, KernelReport& report)
{
  // A count for each work group, and their sum, in an order that does not depend on the device.
  const std::uint32_t groups = (count + groupSize - 1) / groupSize;
  this->Owner.Run(
    this->CountKernel.With(this->Status, cl_uint{ count }, this->Counts), count, groupSize);
  this->Owner.Run(
    this->SumKernel.With(this->Counts, cl_uint{ groups }, this->Total), groupSize, groupSize);
  PassCounts total{};
  this->Owner.Read(this->Total, &total, sizeof(total));
  report.Evaluations += total.Evaluations;
  const auto left = static_cast<std::uint32_t>(total.Unresolved);
  if (left > 0)
  {
    this->Owner.Run(this->KeepKernel.With(this->Status, cl_uint{ count }, this->Counts,
                      cl_int{ this->IsListed ? 1 : 0 }, this->Lists[0], this->Lists[1]),
      count, groupSize);
    std::swap(this->Lists[0], this->Lists[1]);
    this->IsListed = true;
  }
  return left;
}

// Runs passes until no particle is unresolved. Passes from the map and pass 0 take one run of the
// kernel, if the steps are few; then those with 2^k times as many steps take the particles that are
// left, as in the redo rule for voids.
template <int Dimension>
template <class Meanwhile>
KernelReport KernelRun<Dimension>::RunForward(
  std::uint32_t count, const Meanwhile& meanwhile, Progress& progress)
{
  KernelReport report;
  this->IsListed = false;
  // Pass -l starts at level l - 1 of the map: the finest level comes first.
  const int levels = this->Map ? this->Map->LevelCount : 0;
  std::uint32_t left = count;
  for (int pass = -levels; pass <= this->Job.LastPass() && left > 0 && !progress.ShouldStop();)
  {
    const int lastPass = pass >= 0                             ? pass
      : this->Job.Job.Steps <= stepsAtOnce(this->Owner, count) ? 0
                                                               : -1;
    this->RunPass(pass, lastPass, left, progress);
    if (pass == -levels)
    {
      meanwhile();
    }
    left = this->CountPass(left, report);
    report.Redone += lastPass == 0 ? left : 0;
    pass = lastPass + 1;
  }
  if (this->IsListed) // otherwise none is left, or all was stopped
  {
    report.Unresolved.resize(left);
    this->Owner.Read(this->Lists[0], report.Unresolved.data(), left * sizeof(std::uint32_t));
  }
  return report;
}

// Backward there is one pass: a point in a void keeps its place in the box.
template <int Dimension>
template <class Meanwhile>
KernelReport KernelRun<Dimension>::RunBackward(
  std::uint32_t count, const Meanwhile& meanwhile, Progress& progress)
{
  KernelReport report;
  const DeviceMap<Dimension>* map = this->Map.get();
  // With a map the path ends at the hand-over, from where the map gives the seed.
  const std::int64_t steps = map ? map->Steps : this->Job.Job.Steps;
  const auto weights = this->WeightsOf(steps);
  const DeviceBuffer& none = this->Total;
  this->ForPieces(steps, count, progress, [&](std::int64_t first, std::int64_t last) {
    this->AdvectKernel.With(this->Input, this->Tables->Fine, this->Tables->Coarse,
      this->Tables->Occupied, cl_long{ steps }, cl_long{ map ? map->LevelCount : 0 },
      map ? map->Levels : none, map ? map->Records : none, map ? map->Bad : none, *weights,
      cl_long{ steps }, cl_long{ first }, cl_long{ last }, this->Seeds[this->Set], cl_uint{ count },
      this->States, this->Positions[this->Set], this->Status);
    this->Owner.Run(this->AdvectKernel, count);
  });
  meanwhile();
  this->IsListed = false;
  this->CountPass(count, report);
  return report;
}

template class DeviceMap<2>;
template class DeviceMap<3>;
template class KernelRun<2>;
template class KernelRun<3>;

} // namespace RectifiedTransport
