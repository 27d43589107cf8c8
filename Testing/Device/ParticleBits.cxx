// SPDX-License-Identifier: BSD-3-Clause
// The kernels that advect particles, on the processor's tables and maps.
#include "Bits.h"
#include "ReportInputs.h"

#include "Core/Device/DeviceUse.h"
#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/Devices/FlowOnDevices.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/SummedAreaTables.h"
#include "Devices/Device.h"
#include "Devices/DeviceTables.h"
#include "Devices/FlowPrograms.h"
#include "Devices/KernelRun.h"

#include <array>
#include <numeric>
#include <optional>

namespace RectifiedTransport
{

namespace
{

template <int Dimension>
using Map = std::shared_ptr<const FlowMap<Dimension>>;

template <int Dimension>
bool isSame(const Point<Dimension>& one, const Point<Dimension>& other)
{
  return std::memcmp(one.data(), other.data(), sizeof(one)) == 0;
}

template <int Dimension>
std::string describe(std::size_t particle, const Point<Dimension>& seed,
  const Point<Dimension>& device, const Point<Dimension>& processor)
{
  std::string from;
  std::string ofDevice;
  std::string ofProcessor;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const char* const comma = axis > 0 ? ", " : "";
    from += comma + exactly(seed[axis]);
    ofDevice += comma + exactly(device[axis]);
    ofProcessor += comma + exactly(processor[axis]);
  }
  return bothValues(
    "particle " + std::to_string(particle) + " from " + from, ofDevice, ofProcessor);
}

template <int Dimension>
BitsCount compare(const Particles<Dimension>& seeds, const Particles<Dimension>& device,
  const Particles<Dimension>& processor)
{
  BitsCount count;
  for (std::size_t i = 0; i < device.size(); ++i)
  {
    count.Add(isSame<Dimension>(device[i], processor[i]),
      [&]() { return describe<Dimension>(i, seeds[i], device[i], processor[i]); });
  }
  return count;
}

// The last pass that each particle takes forward (AdvectBlock): negative numbers are levels of the
// map, 0 the steps asked for, others more; one past the last pass: left for the nearest mass.
template <int Dimension>
std::vector<int> lastPasses(
  const AdvectionJob<Dimension>& shared, const Map<Dimension>& map, const Particles<Dimension>& all)
{
  Particles<Dimension> ends(all.size());
  FlowJob<Dimension> job = shared.Job;
  job.Map = map && map->View().LevelCount > 0 ? &map->View() : nullptr;
  job.Output = ends.empty() ? nullptr : ends.data()->data();
  std::vector<int> passes(all.size());
  OpenMPExecutor().For(
    static_cast<std::int64_t>(all.size()), BlockSize, [&](std::int64_t first, std::int64_t last) {
      std::vector<std::int64_t> left(static_cast<std::size_t>(last - first));
      std::iota(left.begin(), left.end(), first);
      for (int pass = job.Map ? -job.Map->LevelCount : 0; !left.empty(); ++pass)
      {
        std::vector<std::int64_t> unresolved;
        for (std::size_t begin = 0; begin < left.size(); begin += BlockSize)
        {
          double seeds[BlockSize * Dimension];
          bool marks[BlockSize] = {};
          const std::size_t count = std::min<std::size_t>(BlockSize, left.size() - begin);
          for (std::size_t i = 0; i < count; ++i)
          {
            const Point<Dimension>& seed = all[static_cast<std::size_t>(left[begin + i])];
            std::copy(seed.begin(), seed.end(), seeds + i * Dimension);
          }
          if (pass <= shared.LastPass())
          {
            flowKernels<Dimension>().Advect(
              job, seeds, left.data() + begin, static_cast<int>(count), pass, marks);
          }
          for (std::size_t i = 0; i < count; ++i)
          {
            passes[static_cast<std::size_t>(left[begin + i])] = pass;
            if (marks[i])
            {
              unresolved.push_back(left[begin + i]);
            }
          }
        }
        left = std::move(unresolved);
      }
    });
  return passes;
}

template <int Dimension>
class ParticleComparison
{
public:
  ParticleComparison(const std::shared_ptr<Device>& device, BitsTable& table, std::string name,
    TestDensity<Dimension> density)
    : Opened(device)
    , Table(table)
    , Name(std::move(name))
    , Density(std::move(density))
    , Work(Context())
    , Tables(this->Density.Source(), this->Work)
  {
  }

  const GridSize<Dimension>& Size() const { return this->Density.Size; }

  // Both ways, without and with maps.
  void Run(const Particles<Dimension>& seeds, int steps, const std::string& what = "")
  {
    for (const FlowMaps maps : { FlowMaps::Off, FlowMaps::On })
    {
      this->RunForward(seeds, seeds, withSteps(steps, maps), what);
      this->RunBackward(seeds, seeds, withSteps(steps, maps), what);
    }
  }

  void RunForward(const FlowSeeds<Dimension>& seeds, const Particles<Dimension>& places,
    const FlowOptions& options, const std::string& what = "")
  {
    const auto runs = this->Advect("advectForward", AdvectionKind::Forward, seeds, options, what);
    if (!runs)
    {
      return;
    }
    const AdvectionJob<Dimension> job(this->Tables.View(), AdvectionKind::Forward, options);
    const std::vector<int> passes = lastPasses<Dimension>(job, runs->Of, places);
    constexpr std::array<const char*, 4> groups{ "from a map", "from seeds", "more steps",
      "nearest mass" };
    std::array<BitsCount, 4> counts;
    for (std::size_t i = 0; i < passes.size(); ++i)
    {
      const std::size_t group = passes[i] < 0 ? 0
        : passes[i] == 0                      ? 1
        : passes[i] <= job.LastPass()         ? 2
                                              : 3;
      counts[group].Add(isSame<Dimension>(runs->Device[i], runs->Processor[i]),
        [&]() { return describe<Dimension>(i, places[i], runs->Device[i], runs->Processor[i]); });
    }
    for (std::size_t group = 0; group < groups.size(); ++group)
    {
      if (counts[group].Of > 0)
      {
        this->Table.Add(
          "advectForward", this->CaseOf(options, what) + ", " + groups[group], counts[group]);
      }
    }
    BitsCount numbers;
    const auto addNumber = [&](const char* of, std::int64_t device, std::int64_t processor) {
      numbers.Add(device == processor,
        [&]() { return bothValues(of, std::to_string(device), std::to_string(processor)); });
    };
    addNumber("redone", runs->OfDevice.Redone, runs->OfProcessor.Redone);
    addNumber("moved to mass", runs->OfDevice.MovedToMass, runs->OfProcessor.MovedToMass);
    if (numbers.Differ > 0 || runs->OfProcessor.Redone > 0)
    {
      this->Table.Add("advectForward", this->CaseOf(options, what) + ", counts", numbers);
    }
  }

  void RunBackward(const FlowSeeds<Dimension>& seeds, const Particles<Dimension>& places,
    const FlowOptions& options, const std::string& what = "")
  {
    const auto runs = this->Advect("advectBackward", AdvectionKind::Backward, seeds, options, what);
    if (runs)
    {
      this->Table.Add("advectBackward",
        this->CaseOf(options, what) + (runs->Of ? ", to a map" : ", no map"),
        compare<Dimension>(places, runs->Device, runs->Processor));
    }
  }

private:
  struct Runs
  {
    Map<Dimension> Of; // null without one
    Particles<Dimension> Device;
    Particles<Dimension> Processor;
    FlowReport OfDevice;
    FlowReport OfProcessor;
  };

  std::string CaseOf(const FlowOptions& options, const std::string& what) const
  {
    return this->Name + " " + nameOf<Dimension>(this->Size()) + ", " +
      std::to_string(options.NumberOfSteps) + " steps" + (what.empty() ? "" : ", " + what);
  }

  // Nothing where the density has no map, and Off does the same, or the device did not serve.
  std::optional<Runs> Advect(const std::string& kernel, AdvectionKind kind,
    const FlowSeeds<Dimension>& seeds, const FlowOptions& options, const std::string& what)
  {
    Runs runs;
    if (options.Maps == FlowMaps::On)
    {
      runs.Of = this->MakeMap(kind, options);
      if (!runs.Of)
      {
        return std::nullopt;
      }
    }
    const auto count = static_cast<std::size_t>(seeds.Count());
    const auto advect = [&](const Context& context, Particles<Dimension>& positions) {
      positions.resize(count);
      ParticleSource<Dimension> source(seeds, this->Size(), static_cast<std::int64_t>(count));
      const AdvectionJob<Dimension> job(this->Tables.View(), kind, options);
      Progress progress(context);
      AdvectionRun<Dimension> run(job, progress);
      if (runs.Of)
      {
        run.UseMap(runs.Of, false);
      }
      const auto flow = this->Devices.On(context.Device);
      if (flow)
      {
        run.UseDevice(*flow);
      }
      return run.Advect(source, positions);
    };
    runs.OfProcessor = advect(Context(), runs.Processor);
    DeviceUse use(this->Opened);
    Context context;
    context.Device = &use;
    const std::uint64_t before = this->Opened->Work().Kernels;
    runs.OfDevice = advect(context, runs.Device);
    if (!use.Serves() || this->Opened->Work().Kernels == before)
    {
      this->Table.AddFault(kernel, this->CaseOf(options, what), use.Fault());
      return std::nullopt;
    }
    return runs;
  }

  // The processor's, so that particles are compared alone. Null where there is none.
  Map<Dimension> MakeMap(AdvectionKind kind, const FlowOptions& options)
  {
    const FlowMapShape<Dimension> shape(this->Size(), options.NumberOfSteps, directionOf(kind));
    if (shape.Levels.empty())
    {
      return nullptr;
    }
    const AdvectionJob<Dimension> job(this->Tables.View(), kind, options);
    auto map = std::make_shared<const FlowMap<Dimension>>(shape, job.Job, Context());
    return map->View().LevelCount > 0 ? map : nullptr;
  }

  const std::shared_ptr<Device> Opened;
  BitsTable& Table;
  const std::string Name;
  const TestDensity<Dimension> Density;
  Progress Work;
  const SummedAreaTables<Dimension> Tables;
  FlowOnDevices<Dimension> Devices;
};

// The places of the particles of a lattice.
template <int Dimension>
Particles<Dimension> placesOf(
  const GridSize<Dimension>& size, const GridSize<Dimension>& cells, const Point<Dimension>& place)
{
  Particles<Dimension> places(static_cast<std::size_t>(cellCount<Dimension>(cells)));
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const GridSize<Dimension> cell = cellAt<Dimension>(static_cast<std::int64_t>(i), cells);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      places[i][axis] = (static_cast<double>(cell[axis]) + place[axis]) *
        static_cast<double>(size[axis]) / static_cast<double>(cells[axis]);
    }
  }
  return places;
}

// The cases of one dimension.
template <int Dimension>
class Cases
{
public:
  Cases(const std::shared_ptr<Device>& device, BitsTable& table)
    : Opened(device)
    , Table(table)
  {
  }

  void Random(const char* name, TestDensity<Dimension> density, int steps, std::size_t count)
  {
    ParticleComparison<Dimension> comparison(this->Opened, this->Table, name, std::move(density));
    comparison.Run(randomParticles<Dimension>(comparison.Size(), count), steps);
  }

  void Awkward(const char* name, TestDensity<Dimension> density, int steps, std::size_t count)
  {
    ParticleComparison<Dimension> comparison(this->Opened, this->Table, name, std::move(density));
    comparison.Run(
      awkwardParticles<Dimension>(comparison.Size(), count), steps, "on faces, outside");
  }

  void Lattice(const char* name, TestDensity<Dimension> density, int steps,
    const GridSize<Dimension>& cells, const Point<Dimension>& place)
  {
    ParticleComparison<Dimension> comparison(this->Opened, this->Table, name, std::move(density));
    const auto seeds = FlowSeeds<Dimension>::Lattice(cells, place);
    const Particles<Dimension> places = placesOf<Dimension>(comparison.Size(), cells, place);
    for (const FlowMaps maps : { FlowMaps::Off, FlowMaps::On })
    {
      comparison.RunForward(seeds, places, withSteps(steps, maps), "lattice");
      comparison.RunBackward(seeds, places, withSteps(steps, maps), "lattice");
    }
  }

  // So many steps, or so many in the last pass, that kernels take them in pieces.
  void InPieces(const char* name, TestDensity<Dimension> density)
  {
    ParticleComparison<Dimension> comparison(this->Opened, this->Table, name, std::move(density));
    const Particles<Dimension> seeds = awkwardParticles<Dimension>(comparison.Size(), 100);
    for (const int steps : { 1025, 100 })
    {
      comparison.RunForward(seeds, seeds, withSteps(steps, FlowMaps::Off), "in pieces");
      comparison.RunBackward(seeds, seeds, withSteps(steps, FlowMaps::Off), "in pieces");
    }
  }

private:
  const std::shared_ptr<Device> Opened;
  BitsTable& Table;
};

} // namespace

void compareParticles(const std::shared_ptr<Device>& device, bool isQuick, BitsTable& table)
{
  const char* const photograph = "photograph-like";
  const char* const random = "random";
  const char* const disc = "disc with a hole";
  const char* const oneCell = "one cell";
  const std::size_t many = isQuick ? 1500 : 20000;
  const std::size_t some = isQuick ? 300 : 1500;
  Cases<2> plane(device, table);
  plane.Random(random, randomCells<2>({ 385, 450 }), 32, many);
  plane.Random(disc, discWithHole<2>({ 448, 448 }), 32, many);
  plane.Random(oneCell, dirac<2>({ 64, 64 }, { 20, 41 }), 32, some);
  plane.InPieces(disc, discWithHole<2>({ 64, 64 }));
  plane.Lattice(random, randomCells<2>({ 300, 200 }), 32, { 61, 33 }, { 0.0, 1.0 });
  plane.Awkward(random, randomCells<2>({ 300, 200 }), 32, many);
  plane.Awkward(disc, discWithHole<2>({ 300, 200 }), 32, some);
  Cases<3> space(device, table);
  space.Random(disc, discWithHole<3>({ 64, 64, 64 }), 20, some);
  space.Lattice(disc, discWithHole<3>({ 64, 64, 64 }), 20, { 12, 11, 14 }, { 0.5, 0.5, 0.5 });
  space.Awkward(random, randomCells<3>({ 64, 50, 70 }), 20, some);
  if (isQuick)
  {
    return;
  }
  plane.Random(random, randomCells<2>({ 385, 450 }), 64, many);
  plane.Random(random, randomCells<2>({ 9, 300 }), 128, many);
  plane.Random("checker", checker<2>({ 128, 96 }, 4), 32, many);
  plane.Random(photograph, photographLike<2>({ 1024, 1024 }), 32, 200000);
  plane.Random(photograph, photographLike<2>({ 1024, 1024 }), 64, many);
  plane.Random(photograph, photographLike<2>({ 1000, 701 }), 128, many);
  space.Random(disc, discWithHole<3>({ 96, 96, 96 }), 32, many);
  space.Random("two Gaussians", twoGaussians<3>({ 150, 131, 97 }), 32, many);
  space.Random(oneCell, dirac<3>({ 32, 32, 32 }, { 20, 4, 30 }), 32, some);
  space.Random(random, randomCells<3>({ 20, 31, 66 }), 48, many);
  space.Awkward(disc, discWithHole<3>({ 96, 96, 96 }), 24, many);
  space.Random(photograph, photographLike<3>({ 128, 128, 128 }), 32, 100000);
}

void compareWrong(const std::shared_ptr<Device>& device)
{
  const TestDensity<2> density = randomCells<2>({ 385, 450 });
  Progress work{ Context() };
  const SummedAreaTables<2> tables(density.Source(), work);
  const FlowOptions options = withSteps(32, FlowMaps::Off);
  const Particles<2> seeds = randomParticles<2>(density.Size, 1500);
  Particles<2> right(seeds.size());
  ParticleSource<2> source(seeds, density.Size, static_cast<std::int64_t>(seeds.size()));
  const AdvectionJob<2> job(tables.View(), AdvectionKind::Forward, options);
  AdvectionRun<2>(job, work).Advect(source, right);

  Particles<2> found = right;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &found[700][1], sizeof(bits));
  bits ^= 1;
  std::memcpy(&found[700][1], &bits, sizeof(bits));
  BitsTable::Print("-", "a bit that was changed: 1 differs", compare<2>(seeds, found, right));

  DeviceUse use(device);
  use.Run([&]() {
    const DeviceProgram program = buildFlowProgram(*device, 2, "-D RT_WITH_CONTRACTION");
    KernelRun<2> run(*device, program, job,
      std::make_shared<const DeviceTables<2>>(*device, tables.View()), nullptr,
      std::make_shared<DeviceWeights>());
    run.Run(static_cast<std::int64_t>(found.size()), run.FromPoints(seeds.data()->data()),
      found.data()->data(), work);
  });
  BitsTable::Print("advectForward", "contraction on: most differ, if the compiler contracts",
    compare<2>(seeds, found, right));
}

} // namespace RectifiedTransport
