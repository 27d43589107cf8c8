// SPDX-License-Identifier: BSD-3-Clause
// How exactly areas (backward) and masses (forward, in 2D) of blocks of 4^d cells are kept: with
// the steps that NumberOfSteps 0 takes, with 32, and by the transcription of the paper with 50. The
// estimate of the first, and how many times the velocities of 32 steps they take.
// Errors are those that 99.9 % of the blocks keep (Documentation/Flow.md), relative to many steps,
// whose blocks have the same straight sides; forward of blocks that do not touch the border.
#include "BenchmarkInputs.h"
#include "PaperTransport.h"

#include "../Core/AreaErrors.h"
#include "AreaPhotographs.h"
#include "AreaSuite.h"

#include "Core/Parallel/Progress.h"
#include "Core/Quality/BoundaryIntegrals.h"
#include "Core/Quality/DensityRows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>

namespace RectifiedTransport
{
namespace
{

constexpr int paperSteps = 50;

template <int Dimension>
class BlockImages
{
public:
  BlockImages(TestDensity<Dimension> density, FlowDirection direction)
    : Density(std::move(density))
    , Direction(direction)
    , Flow(this->Density.Source(), SerialExecutor())
    , Corners(cornerLattice<Dimension>(this->Density.Size))
    , Exact(this->Move(many()))
    , ExactBlocks(this->Measure(this->Exact))
  {
  }

  StepChoice Choice() const
  {
    return this->Flow.ChooseSteps({}, this->Direction, SerialExecutor());
  }

  Particles<Dimension> Move(const FlowOptions& options, FlowReport* report = nullptr) const
  {
    Particles<Dimension> images(this->Corners.size());
    const FlowReport of = this->Direction == FlowDirection::Backward
      ? this->Flow.Backward(this->Corners, images, options, SerialExecutor())
      : this->Flow.Forward(this->Corners, images, options, SerialExecutor());
    if (report != nullptr)
    {
      *report = of;
    }
    return images;
  }

  Particles<Dimension> MoveAsThePaper() const
  {
    Particles<Dimension> images = this->Corners;
    const auto tables = Paper::buildTables(this->Density.Values, this->Density.Size);
    this->Direction == FlowDirection::Backward
      ? Paper::retrace(tables, images, paperSteps)
      : Paper::advect(tables, images, paperSteps, Paper::FinalVelocity::Zero);
    return images;
  }

  void Report(
    const std::string& name, const Particles<Dimension>& images, benchmark::State& state) const
  {
    const BlockAreas blocks = this->Measure(images);
    state.counters[name + "error"] = quantileOf(this->Errors(blocks), 0.999);
    state.counters[name + "folded"] = static_cast<double>(blocks.Folded);
  }

private:
  static FlowOptions many()
  {
    FlowOptions options;
    options.NumberOfSteps = Dimension == 3 ? 1024 : 2048;
    options.Maps = FlowMaps::Off;
    return options;
  }

  // Forward with the masses in the images as areas, and shares of the domain as masses.
  BlockAreas Measure(const Particles<Dimension>& images) const
  {
    if (this->Direction == FlowDirection::Backward)
    {
      return blockAreas<Dimension>(this->Density, images);
    }
    const TestDensity<Dimension> even = uniformDensity<Dimension>(this->Density.Size);
    BlockAreas blocks = blockAreas<Dimension>(even, images);
    this->TakeMasses(images, blocks);
    return blocks;
  }

  std::vector<double> Errors(const BlockAreas& blocks) const
  {
    GridSize<Dimension> inner;
    double least = LeastOfMean;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      inner[axis] = this->Density.Size[axis] / AreaBlock;
      least *= AreaBlock;
    }
    std::vector<double> errors;
    for (std::size_t block = 0; block < blocks.Area.size(); ++block)
    {
      const GridSize<Dimension> at = cellAt<Dimension>(static_cast<std::int64_t>(block), inner);
      bool touches = false;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        touches = touches || at[axis] == 0 || at[axis] + 1 == inner[axis];
      }
      if (this->Direction == FlowDirection::Backward || !touches)
      {
        errors.push_back(std::abs(blocks.Area[block] - this->ExactBlocks.Area[block]) /
          std::max(blocks.Mass[block], least));
      }
    }
    std::sort(errors.begin(), errors.end());
    return errors;
  }

  void TakeMasses(const Particles<Dimension>& images, BlockAreas& blocks) const
  {
    if constexpr (Dimension == 2)
    {
      const SerialExecutor serial;
      Progress progress(serial);
      const DensityArray<2, double> source = this->Density.Source();
      DensityRows<2> rows(source, this->Flow.Total());
      rows.Read(LatticePart<2>::WholeOf(this->Density.Size), progress);
      const MassIntegral<2> integral(rows);
      const GridSize<2> inner{ this->Density.Size[0] / AreaBlock,
        this->Density.Size[1] / AreaBlock };
      const GridSize<2> points{ this->Density.Size[0] + 1, this->Density.Size[1] + 1 };
      const auto cells = static_cast<double>(this->Density.Values.size());
      for (std::size_t block = 0; block < blocks.Area.size(); ++block)
      {
        const auto at = cellAt<2>(static_cast<std::int64_t>(block), inner);
        constexpr std::int64_t sides[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
        GridSize<2> point{ AreaBlock * at[0], AreaBlock * at[1] };
        double mass = 0.0;
        for (const auto& side : sides)
        {
          for (std::int64_t i = 0; i < AreaBlock; ++i)
          {
            const auto from = static_cast<std::size_t>(cellIndex<2>(point, points));
            point[0] += side[0];
            point[1] += side[1];
            const auto to = static_cast<std::size_t>(cellIndex<2>(point, points));
            mass += integral.Edge(images[from].data(), images[to].data());
          }
        }
        blocks.Area[block] = mass / rows.TotalMass() * cells;
      }
    }
  }

  const TestDensity<Dimension> Density;
  const FlowDirection Direction;
  const RectifiedFlow<Dimension> Flow;
  const Particles<Dimension> Corners;
  const Particles<Dimension> Exact;
  const BlockAreas ExactBlocks;
};

template <int Dimension>
void measure(
  benchmark::State& state, const TestDensity<Dimension>& density, FlowDirection direction)
{
  const BlockImages<Dimension> blocks(density, direction);
  const StepChoice choice = blocks.Choice();
  const FlowOptions automatic = choice.Of({});
  FlowOptions few;
  few.NumberOfSteps = FlowOptions::FewestSteps;
  Particles<Dimension> images;
  FlowReport taken;
  for (auto _ : state)
  {
    images = blocks.Move(automatic, &taken);
  }
  blocks.Report("", images, state);
  FlowReport fewest;
  blocks.Report("few_", blocks.Move(few, &fewest), state);
  blocks.Report("paper_", blocks.MoveAsThePaper(), state);
  state.counters["steps"] = automatic.NumberOfSteps;
  state.counters["estimate"] = choice.AreaError;
  state.counters["cost"] =
    static_cast<double>(taken.Evaluations) / static_cast<double>(fewest.Evaluations);
}

template <int Dimension>
void add(const std::string& name, const std::function<TestDensity<Dimension>()>& make)
{
  for (const FlowDirection direction : { FlowDirection::Backward, FlowDirection::Forward })
  {
    if (Dimension == 3 && direction == FlowDirection::Forward)
    {
      continue; // the mass in a bent cell has no closed form
    }
    const std::string way = direction == FlowDirection::Backward ? "backward/" : "forward/";
    addBenchmark("Steps/" + way + name, {},
      [make, direction](benchmark::State& state) { measure<Dimension>(state, make(), direction); })
      ->Iterations(1)
      ->Repetitions(1);
  }
}

const bool added = []() {
  forAreaDensities([](const std::string& name, const auto& make) { add(name, make); });
  for (const std::int64_t side : { 64, 512, 1024 })
  {
    add<2>("disc100-" + std::to_string(side), [side]() {
      return areaDensity2D("disc100", { side, side });
    });
  }
  add<2>("disc1000-512", []() { return areaDensity2D("disc1000", { 512, 512 }); });
  return true;
}();

} // namespace
} // namespace RectifiedTransport
