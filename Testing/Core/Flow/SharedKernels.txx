// SPDX-License-Identifier: BSD-3-Clause
// The kernels of devices, run as C++ particle by particle: in RT_D dimensions they have the bits of
// the processor's own kernels. Included by TestSharedKernels2D.cxx and TestSharedKernels3D.cxx.
#include "TestFlow.h"

#include "Core/Flow/AdvectionJob.h"
#include "Core/Flow/FlowMap.h"
#include "Core/Flow/Kernels/LatticePlaces.h"
#include "Core/Flow/Kernels/SharedInputs.h"
#include "Core/Flow/NodeAdvance.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/SummedAreaTables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>

#define RT_INLINE inline __attribute__((always_inline))

namespace RectifiedTransport
{
namespace
{

#include "Core/Flow/Kernels/Vectors.txx"

#include "Core/Flow/Kernels/Shared/Language.h"

#include "Core/Flow/Kernels/Shared/AdamsWeights.h"
#include "Core/Flow/Kernels/Shared/BoxMoments.h"
#include "Core/Flow/Kernels/Shared/BoxMoments3D.h"
#include "Core/Flow/Kernels/Shared/Velocity.h"

#include "Core/Flow/Kernels/Shared/MapRead.h"
#include "Core/Flow/Kernels/Shared/Multistep.h"

#include "Core/Flow/Kernels/Shared/Particle.h"

#include "Core/Flow/Kernels/Shared/Node.h"

// The tables of a density and a flow map, as processors have them and as kernels are given them.
class KernelInputs
{
public:
  KernelInputs(const TestDensity<RT_D>& density, AdvectionKind kind, const FlowOptions& options)
    : Work(Context())
    , Sums(density.Source(), this->Work)
    , Shared(this->Sums.View(), kind, options)
    , Input(flowInput<RT_D>(this->Shared.Job))
  {
    const TableView<RT_D>& view = this->Sums.View();
    this->Tables = { &this->Input, view.Levels[0].Nodes,
      view.LevelCount > 1 ? view.Levels[1].Nodes : nullptr, view.Occupied };
    const FlowMapShape<RT_D> shape(density.Size, options.NumberOfSteps, directionOf(kind));
    if (!shape.Levels.empty())
    {
      this->Map = std::make_unique<FlowMap<RT_D>>(shape, this->Shared.Job, Context());
      this->AddLevels();
    }
  }

  Progress Work;
  SummedAreaTables<RT_D> Sums;
  AdvectionJob<RT_D> Shared;
  FlowInput Input;
  TableInput Tables;
  std::unique_ptr<FlowMap<RT_D>> Map; // null if the grid has none
  MapInput Levels{};

private:
  void AddLevels()
  {
    const FlowMapView<RT_D>& view = this->Map->View();
    const int record = this->Input.Backward ? RT_BACKWARD_RECORD : RT_FORWARD_RECORD;
    for (int level = 0; level < view.LevelCount; ++level)
    {
      std::int64_t nodes = 1;
      std::int64_t cells = 1;
      for (const LatticeAxis& axis : view.Levels[level].Axes)
      {
        nodes *= axis.Cells + 1;
        cells *= axis.Cells;
      }
      this->MapLevels.push_back(
        mapLevelInput<RT_D>(view.Levels[level], static_cast<std::int64_t>(this->Records.size()),
          static_cast<std::int64_t>(this->Bad.size())));
      this->Records.insert(this->Records.end(), view.Levels[level].Records,
        view.Levels[level].Records + nodes * record);
      this->Bad.insert(this->Bad.end(), view.Levels[level].Bad, view.Levels[level].Bad + cells);
    }
    this->Levels = { view.Steps, view.LevelCount, this->MapLevels.data(), this->Records.data(),
      this->Bad.data() };
  }

  std::vector<MapLevelInput> MapLevels;
  std::vector<float> Records;
  std::vector<Byte> Bad;
};

// The flow's own result of one pass of the processor's kernel.
struct PassResult
{
  Points<RT_D> Positions;
  std::vector<char> Unresolved;
};

PassResult processorsPass(const KernelInputs& inputs, const Points<RT_D>& seeds, int pass)
{
  PassResult result{ seeds, std::vector<char>(seeds.size()) };
  FlowJob<RT_D> job = inputs.Shared.Job;
  job.Output = result.Positions.data()->data();
  job.Map = inputs.Map && pass < 1 ? &inputs.Map->View() : nullptr;
  std::vector<std::int64_t> index(seeds.size());
  std::iota(index.begin(), index.end(), std::int64_t{ 0 });
  for (std::size_t first = 0; first < seeds.size(); first += BlockSize)
  {
    const int count = static_cast<int>(std::min<std::size_t>(BlockSize, seeds.size() - first));
    bool unresolved[BlockSize] = {};
    flowKernels<RT_D>().Advect(
      job, seeds[first].data(), index.data() + first, count, pass, unresolved);
    std::copy_n(unresolved, count, result.Unresolved.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return result;
}

PassResult sharedPass(const KernelInputs& inputs, const Points<RT_D>& seeds, int pass)
{
  PassResult result{ seeds, std::vector<char>(seeds.size()) };
  const Int64 count = pass < 0 ? inputs.Levels.Steps : inputs.Shared.Job.Steps << pass;
  const std::vector<StepWeights> weights = multistepWeightsOf(count, FlowDirection::Forward);
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    ParticleState state = {};
    placeParticle(&inputs.Tables, seeds[i].data(), &state);
    Int64 first = 0;
    if (pass < 0)
    {
      const int level = -1 - pass;
      if (!advanceToHandOver(&inputs.Tables, &inputs.Levels, level, &state))
      {
        result.Unresolved[i] = 1;
        continue;
      }
      first = count - inputs.Levels.Levels[level].HandOver;
    }
    else
    {
      advanceStraightStart(&inputs.Tables, &state);
    }
    stepForward(&inputs.Tables, weights.data(), count, first, count, 0, &state);
    finishForward(&inputs.Tables, &weights.back(), &state);
    std::copy_n(state.End, RT_D, result.Positions[i].begin());
    result.Unresolved[i] = state.IsUnresolved != 0;
  }
  return result;
}

// Where a pass may not read the map, nothing is written.
void expectSame(const PassResult& found, const PassResult& right, bool all, const std::string& what)
{
  int differing = 0;
  for (std::size_t i = 0; i < right.Positions.size(); ++i)
  {
    const bool same = (!all && right.Unresolved[i]) ||
      std::memcmp(&found.Positions[i], &right.Positions[i], sizeof(right.Positions[i])) == 0;
    differing += same ? 0 : 1;
  }
  EXPECT_EQ(differing, 0) << what;
  EXPECT_EQ(found.Unresolved, right.Unresolved) << what;
}

// Odd and even sizes, one value and many, empty cells, and isolated ones.
std::vector<TestDensity<RT_D>> densities()
{
#if RT_D == 2
  return { randomCells<2>({ 300, 141 }), discWithHole<2>({ 256, 256 }),
    dirac<2>({ 64, 64 }, { 20, 41 }) };
#else
  return { randomCells<3>({ 41, 66, 37 }), discWithHole<3>({ 64, 64, 64 }) };
#endif
}

// Of sizes that have maps of two levels with 32 steps, forward and backward.
std::vector<TestDensity<RT_D>> mappedDensities()
{
#if RT_D == 2
  return { randomCells<2>({ 385, 450 }), discWithHole<2>({ 448, 448 }) };
#else
  return { twoGaussians<3>({ 112, 115, 128 }), discWithHole<3>({ 112, 112, 112 }) };
#endif
}

// Some on faces and corners, and outside.
Points<RT_D> seedsOf(const TestDensity<RT_D>& density)
{
  Points<RT_D> seeds = randomPoints<RT_D>(density.Size, 300);
  Point<RT_D> corner{};
  seeds.push_back(corner);
  corner.fill(1e4);
  seeds.push_back(corner);
  corner.fill(0.0);
  corner[1] = -3.0;
  corner[0] = 0.5 * static_cast<double>(density.Size[0]);
  seeds.push_back(corner);
  return seeds;
}

TEST(RT_SUITE, Forward)
{
  for (const TestDensity<RT_D>& density : densities())
  {
    for (const int count : { 32, 48, 128 }) // three ways to choose levels
    {
      const KernelInputs inputs(density, AdvectionKind::Forward, steps(count));
      const Points<RT_D> seeds = seedsOf(density);
      for (const int pass : { 0, 2 })
      {
        expectSame(sharedPass(inputs, seeds, pass), processorsPass(inputs, seeds, pass), true,
          "pass " + std::to_string(pass));
      }
    }
  }
}

TEST(RT_SUITE, FromMaps)
{
  int levels = 0;
  for (const TestDensity<RT_D>& density : mappedDensities())
  {
    const KernelInputs inputs(density, AdvectionKind::Forward, steps(32));
    const Points<RT_D> seeds = seedsOf(density);
    for (int pass = -static_cast<int>(inputs.Levels.LevelCount); pass < 0; ++pass, ++levels)
    {
      expectSame(sharedPass(inputs, seeds, pass), processorsPass(inputs, seeds, pass), false,
        "pass " + std::to_string(pass));
    }
  }
  EXPECT_EQ(levels, 4);
}

TEST(RT_SUITE, Backward)
{
  int levels = 0;
  for (const TestDensity<RT_D>& density : mappedDensities())
  {
    for (const bool withMap : { false, true })
    {
      KernelInputs inputs(density, AdvectionKind::Backward, steps(32));
      levels += withMap ? static_cast<int>(inputs.Levels.LevelCount) : 0;
      if (!withMap)
      {
        inputs.Map.reset();
        inputs.Levels.LevelCount = 0;
      }
      const Int64 count = inputs.Map ? inputs.Levels.Steps : inputs.Shared.Job.Steps;
      const std::vector<StepWeights> weights = multistepWeightsOf(count, FlowDirection::Backward);
      const Points<RT_D> points = seedsOf(density);
      PassResult found{ points, std::vector<char>(points.size()) };
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        ParticleState state = {};
        placeParticle(&inputs.Tables, points[i].data(), &state);
        startBackward(&inputs.Tables, &state);
        stepBackward(&inputs.Tables, &inputs.Levels, weights.data(), count, 0, count, &state);
        EXPECT_TRUE(state.IsDone);
        std::copy_n(state.End, RT_D, found.Positions[i].begin());
      }
      expectSame(found, processorsPass(inputs, points, 0), true, withMap ? "maps" : "no maps");
    }
  }
  EXPECT_EQ(levels, 4);
}

std::int64_t numberOfNodes(const MapLevelInput& level)
{
  std::int64_t nodes = 1;
  for (int axis = 0; axis < RT_D; ++axis)
  {
    nodes *= level.Cells[axis] + 1;
  }
  return nodes;
}

// What a device makes of the nodes of a level.
class NodeRun
{
public:
  NodeRun(const KernelInputs& inputs, int level)
    : Given(inputs)
    , Level(level)
    , View(inputs.Map->View())
  {
    for (int parent = -1; parent < level; ++parent)
    {
      this->Weights.push_back(nodeWeights<RT_D>(
        this->View, inputs.Input.Backward != 0, this->View.Levels[level].HandOver, parent));
    }
    for (const LatticeAxis& axis : this->View.Levels[level].Axes)
    {
      this->Places.push_back(placesOf(axis));
    }
    this->Particles = multistepWeightsOf(this->View.Steps, FlowDirection::Forward);
  }

  std::vector<float> RecordOf(std::int64_t node) const
  {
    Point<RT_D> place;
    for (int axis = 0; axis < RT_D; ++axis)
    {
      const std::int64_t nodes = this->View.Levels[this->Level].Axes[axis].Cells + 1;
      place[axis] =
        this->Places[static_cast<std::size_t>(axis)][static_cast<std::size_t>(node % nodes)];
      node /= nodes;
    }
    for (int parent = this->Level - 1; parent >= -1; --parent)
    {
      ParticleState state = {};
      placeParticle(&this->Given.Tables, place.data(), &state);
      if (this->Given.Input.Backward ? this->Return(parent, state) : this->Advance(parent, state))
      {
        std::vector<float> record(
          this->Given.Input.Backward ? RT_BACKWARD_RECORD : RT_FORWARD_RECORD);
        writeRecord(this->Given.Input.Backward, &state, record.data());
        return record;
      }
    }
    return {};
  }

private:
  bool Return(int parent, ParticleState& state) const
  {
    const auto timeAt = [&](std::int64_t step) {
      return step < this->View.Steps ? 1.0 - grading(step, this->View.Steps) : 0.0;
    };
    const std::vector<StepWeights>& weights = this->Weights[static_cast<std::size_t>(parent + 1)];
    const std::int64_t to = parent < 0 ? this->View.Steps : this->View.Levels[parent].HandOver;
    return advanceNodeBackward(&this->Given.Tables, &this->Given.Levels, weights.data(),
             static_cast<Int64>(weights.size()), parent,
             timeAt(this->View.Levels[this->Level].HandOver), timeAt(to), &state) != 0;
  }

  bool Advance(int parent, ParticleState& state) const
  {
    const int handOver = this->View.Levels[this->Level].HandOver;
    if (parent >= 0)
    {
      return continueNode(&this->Given.Tables, &this->Given.Levels, this->Particles.data(), parent,
               handOver, &state) != 0;
    }
    const auto timeAt = [&](std::int64_t left) {
      return commonStart + (1.0 - commonStart) * grading(this->View.Steps - left, this->View.Steps);
    };
    const std::vector<StepWeights>& weights = this->Weights.front();
    startNode(&this->Given.Tables, weights.data(), static_cast<Int64>(weights.size()),
      timeAt(handOver + 2), timeAt(handOver + 1), timeAt(handOver), &state);
    return true;
  }

  const KernelInputs& Given;
  const int Level;
  const FlowMapView<RT_D>& View;
  std::vector<std::vector<StepWeights>> Weights; // by the parent, the first from scratch
  std::vector<StepWeights> Particles;
  std::vector<std::vector<double>> Places; // by axis
};

// The records of a level of a map, made by the kernels of devices from the coarser levels.
TEST(RT_SUITE, Nodes)
{
  int levels = 0;
  for (const TestDensity<RT_D>& density : mappedDensities())
  {
    for (const AdvectionKind kind : { AdvectionKind::Forward, AdvectionKind::Backward })
    {
      const KernelInputs inputs(density, kind, steps(32));
      for (int level = 0; level < inputs.Levels.LevelCount; ++level, ++levels)
      {
        const NodeRun run(inputs, level);
        const MapLevelInput& input = inputs.Levels.Levels[level];
        std::int64_t differing = 0;
        for (std::int64_t node = 0; node < numberOfNodes(input); node += 31)
        {
          const std::vector<float> record = run.RecordOf(node);
          const float* right = inputs.Levels.Records + input.FirstRecord +
            node * static_cast<std::int64_t>(record.size());
          const bool same = std::memcmp(record.data(), right, record.size() * sizeof(float)) == 0;
          differing += same && !record.empty() ? 0 : 1;
        }
        EXPECT_EQ(differing, 0) << "level " << level;
      }
    }
  }
  EXPECT_EQ(levels, 8);
}

} // namespace
} // namespace RectifiedTransport
