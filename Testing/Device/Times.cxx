// SPDX-License-Identifier: BSD-3-Clause
#include "Times.h"
#include "ReportInputs.h"

#include "Core/Device/DeviceUse.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Seeds/Seeds.h"
#include "Devices/Device.h"

#include <algorithm>
#include <chrono>

namespace RectifiedTransport
{

namespace
{

constexpr int steps = 32;

struct Timing
{
  double Median = 0.0; // ms
  double Least = 0.0;
};

double millisecondsOf(const std::function<void()>& function)
{
  const auto start = std::chrono::steady_clock::now();
  function();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
    .count();
}

// before() is not timed.
Timing timingOf(
  int repetitions, const std::function<void()>& before, const std::function<void()>& function)
{
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i)
  {
    before();
    times.push_back(millisecondsOf(function));
  }
  std::sort(times.begin(), times.end());
  return { times[times.size() / 2], times.front() };
}

DeviceWork workSince(const DeviceWork& before, const DeviceWork& now)
{
  return { now.Kernels - before.Kernels, now.BytesTo - before.BytesTo,
    now.BytesFrom - before.BytesFrom };
}

void printHead(const TimesChoice& choice)
{
  if (choice.Form == TimesForm::CommaSeparated)
  {
    std::printf("case,tables,processor,processor_least,device,device_least,bytes_to,bytes_from,"
                "kernels\n");
    return;
  }
  std::printf(
    "\nTIMES, ms: %s; processor: all its threads\n"
    "  An H100-like card should take at most 0.3 for 8,192 particles on 1024^2, kept, and\n"
    "  150 for one a cell of 256^3, new\n"
    "  %-42s %-6s %21s %21s %9s %12s %12s %8s\n",
    choice.IsQuick ? "of one run" : "median of 5 (the least)", "case", "tables", "processor",
    "device", "proc/dev", "MB to", "MB from", "kernels");
}

void printRow(TimesForm form, const std::string& what, const char* tables, const Timing& processor,
  const Timing& device, const DeviceWork& work)
{
  if (form == TimesForm::CommaSeparated)
  {
    std::printf("\"%s\",%s,%.4f,%.4f,%.4f,%.4f,%llu,%llu,%llu\n", what.c_str(), tables,
      processor.Median, processor.Least, device.Median, device.Least,
      static_cast<unsigned long long>(work.BytesTo),
      static_cast<unsigned long long>(work.BytesFrom),
      static_cast<unsigned long long>(work.Kernels));
  }
  else
  {
    constexpr double megabyte = 1e6;
    std::printf("  %-42s %-6s %10.3f (%8.3f) %10.3f (%8.3f) %9.3f %12.3f %12.3f %8llu\n",
      what.c_str(), tables, processor.Median, processor.Least, device.Median, device.Least,
      processor.Median / device.Median, static_cast<double>(work.BytesTo) / megabyte,
      static_cast<double>(work.BytesFrom) / megabyte,
      static_cast<unsigned long long>(work.Kernels));
  }
  std::fflush(stdout);
}

template <int Dimension>
class TimesOfDensity
{
public:
  TimesOfDensity(const std::shared_ptr<Device>& device, const TimesChoice& choice, BitsTable& table,
    const TestDensity<Dimension>& density)
    : Opened(device)
    , Choice(choice)
    , Table(table)
    , Density(density)
  {
  }

  void Measure(const std::string& what, const FlowSeeds<Dimension>& seeds, FlowDirection direction)
  {
    const auto count = static_cast<std::size_t>(seeds.Count());
    Particles<Dimension> right(count);
    Particles<Dimension> found(count);
    const FlowOptions options = withSteps(steps, FlowMaps::Auto);
    const auto advect = [&](const Context& context, Particles<Dimension>& positions) {
      direction == FlowDirection::Forward
        ? this->Flow->Forward(seeds, positions, options, context)
        : this->Flow->Backward(seeds, positions, options, context);
    };
    DeviceUse use(this->Opened);
    const Context onProcessor;
    Context onDevice;
    onDevice.Device = &use;
    DeviceWork work[2];
    Timing times[2][2];
    for (const bool isDevice : { false, true })
    {
      const Context& context = isDevice ? onDevice : onProcessor;
      Particles<Dimension>& positions = isDevice ? found : right;
      const DeviceWork* const now = &this->Opened->Work();
      DeviceWork before;
      const int repetitions = this->Choice.IsQuick ? 1 : 5;
      times[isDevice][0] = timingOf(
        repetitions,
        [&]() {
          this->Flow.reset();
          before = *now;
        },
        [&]() {
          this->Flow =
            std::make_unique<const RectifiedFlow<Dimension>>(this->Density.Source(), context);
          advect(context, positions);
        });
      work[0] = workSince(before, *now);
      times[isDevice][1] = timingOf(
        repetitions, [&]() { before = *now; }, [&]() { advect(context, positions); });
      work[1] = workSince(before, *now);
    }
    if (!use.Serves() || work[1].Kernels == 0)
    {
      this->Table.AddFault("a whole flow", what, use.Fault());
      return;
    }
    for (const int kept : { 0, 1 })
    {
      printRow(
        this->Choice.Form, what, kept ? "kept" : "new", times[0][kept], times[1][kept], work[kept]);
    }
    BitsCount differing;
    for (std::size_t i = 0; i < count; ++i)
    {
      differing.Add(std::memcmp(found[i].data(), right[i].data(), sizeof(found[i])) == 0, [&]() {
        return bothValues(
          "particle " + std::to_string(i), exactly(found[i][0]), exactly(right[i][0]));
      });
    }
    if (differing.Differ > 0)
    {
      this->Table.Add("a whole flow", what, differing);
    }
  }

private:
  const std::shared_ptr<Device> Opened;
  const TimesChoice Choice;
  BitsTable& Table;
  const TestDensity<Dimension>& Density;
  std::unique_ptr<const RectifiedFlow<Dimension>> Flow;
};

// In the unit box's even pattern, on a square density.
Particles<2> evenSeeds(const GridSize<2>& size, std::size_t count)
{
  Particles<2> seeds(count);
  generateSeeds<2>(SeedPattern::BlueNoise, { 1.0, 1.0 }, 1, seeds);
  for (Point<2>& seed : seeds)
  {
    seed = { static_cast<double>(size[0]) * seed[0], static_cast<double>(size[1]) * seed[1] };
  }
  return seeds;
}

} // namespace

void measureTimes(
  const std::shared_ptr<Device>& device, const TimesChoice& choice, BitsTable& table)
{
  printHead(choice);
  const std::int64_t side = choice.IsQuick ? 256 : 1024;
  const GridSize<2> size = evenSize<2>(side);
  const std::string on = " on " + std::to_string(side) + "^2";
  const TestDensity<2> density = photographLike<2>(size);
  TimesOfDensity<2> plane(device, choice, table, density);
  plane.Measure("8,192 particles" + on, evenSeeds(size, 8192), FlowDirection::Forward);
  if (!choice.IsQuick)
  {
    plane.Measure("40,000 particles" + on, evenSeeds(size, 40000), FlowDirection::Forward);
    plane.Measure("one a cell of 1024^2", FlowSeeds<2>::Lattice(size), FlowDirection::Forward);
  }
  const GridSize<2> half = evenSize<2>(side / 2);
  plane.Measure("lattice of " + std::to_string(side / 2) + "^2, backward" + on,
    FlowSeeds<2>::Lattice(half), FlowDirection::Backward);
  if (choice.HasLarge)
  {
    const GridSize<3> cells = evenSize<3>(256);
    const TestDensity<3> volume = photographLike<3>(cells);
    TimesOfDensity<3>(device, choice, table, volume)
      .Measure("one a cell of 256^3", FlowSeeds<3>::Lattice(cells), FlowDirection::Forward);
  }
}

} // namespace RectifiedTransport
