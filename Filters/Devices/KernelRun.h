// SPDX-License-Identifier: BSD-3-Clause
// What the kernels of an advection read on a device, and the order in which they run.
#ifndef RectifiedTransport_KernelRun_h
#define RectifiedTransport_KernelRun_h

#include "Core/Flow/AdvectionJob.h"
#include "Core/Flow/Kernels/FlowMapView.h"
#include "Core/Flow/Particles/LatticeOrder.h"
#include "Core/Parallel/Progress.h"
#include "Devices/Device.h"
#include "Devices/DeviceTables.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// A copy of a flow map on a device.
template <int Dimension>
class DeviceMap
{
public:
  // Copies that of the processor. Throws DeviceError.
  DeviceMap(Device& device, const FlowMapView<Dimension>& map, bool backward);

  const std::int64_t Steps; // the number of steps of particles that hand over
  const int LevelCount;
  DeviceBuffer Levels;
  DeviceBuffer Records;
  DeviceBuffer Bad;
};

// The weights of steps on a device, which all runs share.
class DeviceWeights
{
public:
  // Those of a run of so many steps. Throws DeviceError.
  std::shared_ptr<const DeviceBuffer> Of(
    Device& device, std::int64_t steps, FlowDirection direction);

private:
  std::map<std::pair<std::int64_t, FlowDirection>, std::shared_ptr<const DeviceBuffer>> Cache;
};

// The most steps that so many particles take in one run of a kernel.
std::int64_t stepsAtOnce(const Device& device, std::int64_t particles);

// ParticleState of the kernels, in bytes: numbers of 8, and three of 4 with a gap.
template <int Dimension>
constexpr std::size_t stateSize = (5 * Dimension + 1 + 2) * sizeof(double);

struct KernelReport
{
  std::int64_t Evaluations = 0;
  std::int64_t Redone = 0;
  std::vector<std::uint32_t> Unresolved; // particles after the last pass
};

// The kernels of one advection with their arguments.
template <int Dimension>
class KernelRun
{
public:
  // Particles for which transfers that overlap with kernels pay.
  static constexpr std::int64_t UsualPart = std::int64_t{ 1 } << 17;

  // The device and the job must outlive it. Without a map all particles take all steps. More
  // particles than `mostOfPart` are run in parts, one after the other. Throws DeviceError.
  KernelRun(Device& device, const DeviceProgram& program, const AdvectionJob<Dimension>& job,
    std::shared_ptr<const DeviceTables<Dimension>> tables,
    std::shared_ptr<const DeviceMap<Dimension>> map, std::shared_ptr<DeviceWeights> weights,
    std::int64_t mostOfPart = UsualPart);

  // Makes the seeds of a part of the particles on the device: from(first, count, seeds), where the
  // transfer of what is read there may be under way.
  using Prepare = std::function<DeviceTransfer(
    std::int64_t first, std::int64_t count, const DeviceBuffer& seeds)>;

  // Writes where `count` particles go, interleaved, after all passes. Stops early, with undefined
  // positions, where the progress is to stop. Throws DeviceError: positions are undefined.
  KernelReport Run(
    std::int64_t count, const Prepare& prepare, double* positions, Progress& progress);

  // Seeds in memory, which must not be used before the end of the run.
  Prepare FromPoints(const double* points);
  // The points of a lattice, in the order of its cells, from number `begin` on.
  Prepare FromLattice(const LatticeOrder<Dimension>& lattice, std::int64_t begin);

private:
  std::shared_ptr<const DeviceBuffer> WeightsOf(std::int64_t steps);
  void MakeRoom(std::int64_t count, bool hasTwoSets);
  template <class Meanwhile>
  KernelReport RunForward(std::uint32_t count, const Meanwhile& meanwhile, Progress& progress);
  template <class Meanwhile>
  KernelReport RunBackward(std::uint32_t count, const Meanwhile& meanwhile, Progress& progress);
  void RunPass(int pass, int lastPass, std::uint32_t count, Progress& progress);
  std::uint32_t CountPass(std::uint32_t count, KernelReport& report);
  // Calls run(first, last) for pieces of the steps, until the progress is to stop.
  template <class RunPiece>
  void ForPieces(std::int64_t steps, std::uint32_t count, Progress& progress, const RunPiece& run);

  Device& Owner;
  const AdvectionJob<Dimension>& Job;
  const std::shared_ptr<const DeviceTables<Dimension>> Tables;
  const std::shared_ptr<const DeviceMap<Dimension>> Map;
  const std::shared_ptr<DeviceWeights> OfSteps;
  DeviceBuffer Input;
  DeviceKernel PlaceKernel;
  DeviceKernel AdvectKernel;
  DeviceKernel CountKernel;
  DeviceKernel SumKernel;
  DeviceKernel KeepKernel;
  const std::int64_t MostOfPart; // particles
  // The buffers have room for as many particles as there were in any part. While kernels run on one
  // set of seeds and positions, the other set is transferred.
  std::int64_t Room = 0;
  bool HasTwoSets = false;
  DeviceBuffer Seeds[2];
  DeviceBuffer Positions[2];
  int Set = 0; // the set of the part that runs
  DeviceBuffer Status;
  DeviceBuffer Lists[2];
  DeviceBuffer Counts; // one for each group
  DeviceBuffer Total;
  DeviceBuffer States; // states of particles whose steps are cut into pieces
  bool IsListed = false;
};

} // namespace RectifiedTransport

#endif
