// SPDX-License-Identifier: BSD-3-Clause
// The masses that optimal maps deliver. 100,000 samples of a density are moved to another one; the
// errors of their masses in blocks and boxes are given as multiples of those that samples of the
// target have, and their cost in percent over the bound.
#include "BenchmarkInputs.h"
#include "OptimalPairs.h"

#include "Core/OptimalMap/OptimalMap.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

constexpr std::size_t sampleCount = 100000;

double sumOf(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum;
}

// In index space, stratified in the order of the cells.
template <int D>
Particles<D> stratifiedSamples(const TestDensity<D>& density, std::uint64_t seed)
{
  std::mt19937_64 engine(seed);
  const double total = sumOf(density.Values);
  Particles<D> samples(sampleCount);
  double before = 0.0; // the mass of the cells before `cell`
  std::size_t cell = 0;
  for (std::size_t i = 0; i < sampleCount; ++i)
  {
    const double place = static_cast<double>(i) + uniformNumber(engine);
    const double mass = place / static_cast<double>(sampleCount) * total;
    while (cell + 1 < density.Values.size() && before + density.Values[cell] < mass)
    {
      before += density.Values[cell++];
    }
    while (density.Values[cell] == 0.0)
    {
      before -= density.Values[--cell];
    }
    const GridSize<D> corner = cellAt<D>(static_cast<std::int64_t>(cell), density.Size);
    for (int axis = 0; axis < D; ++axis)
    {
      samples[i][axis] = static_cast<double>(corner[axis]) + uniformNumber(engine);
    }
  }
  return samples;
}

// The relative L2 error of the masses in blocks of `side` cells, the first of which begins `offset`
// cells outside the grid.
template <int D>
double blockError(const TestDensity<D>& density, const Particles<D>& particles, std::int64_t side,
  std::int64_t offset = 0)
{
  GridSize<D> blocks;
  for (int axis = 0; axis < D; ++axis)
  {
    blocks[axis] = (density.Size[axis] + offset + side - 1) / side;
  }
  const auto blockOf = [&](GridSize<D> cell) {
    for (std::int64_t& coordinate : cell)
    {
      coordinate = (coordinate + offset) / side;
    }
    return static_cast<std::size_t>(cellIndex<D>(cell, blocks));
  };
  std::vector<double> wanted(static_cast<std::size_t>(cellCount<D>(blocks)), 0.0);
  std::vector<double> found(wanted.size(), 0.0);
  const double total = sumOf(density.Values);
  for (std::size_t cell = 0; cell < density.Values.size(); ++cell)
  {
    wanted[blockOf(cellAt<D>(static_cast<std::int64_t>(cell), density.Size))] +=
      density.Values[cell] / total;
  }
  for (const Point<D>& particle : particles)
  {
    found[blockOf(cellOf<D>(particle, density.Size))] += 1.0 / static_cast<double>(sampleCount);
  }
  double errors = 0.0;
  double squares = 0.0;
  for (std::size_t block = 0; block < wanted.size(); ++block)
  {
    errors += (found[block] - wanted[block]) * (found[block] - wanted[block]);
    squares += wanted[block] * wanted[block];
  }
  return std::sqrt(errors / squares);
}

// Boxes at any place, not only at whole cells, of 4 to 32 cells a side, that hold mass.
template <int D>
class RandomBoxes
{
public:
  explicit RandomBoxes(const TestDensity<D>& density)
    : Corners(density.Size)
  {
    for (std::int64_t& corners : this->Corners)
    {
      ++corners;
    }
    this->AddUp(density);
    constexpr std::size_t count = 300;
    constexpr double leastMass = 1e-6;
    std::mt19937_64 engine(11);
    while (this->Boxes.size() < count)
    {
      Box box;
      for (int axis = 0; axis < D; ++axis)
      {
        const double side = 4.0 * std::pow(8.0, uniformNumber(engine));
        box.Low[axis] = uniformNumber(engine) * (static_cast<double>(density.Size[axis]) - side);
        box.High[axis] = box.Low[axis] + side;
      }
      box.Mass = this->MassOf(box);
      if (box.Mass >= leastMass)
      {
        this->Boxes.push_back(box);
      }
    }
  }

  // The root mean square of the errors of the masses in them.
  double Error(const Particles<D>& particles) const
  {
    double squares = 0.0;
    for (const Box& box : this->Boxes)
    {
      const auto count = std::count_if(
        particles.begin(), particles.end(), [&](const Point<D>& p) { return box.Holds(p); });
      const double error = static_cast<double>(count) / sampleCount - box.Mass;
      squares += error * error;
    }
    return std::sqrt(squares / static_cast<double>(this->Boxes.size()));
  }

private:
  struct Box
  {
    bool Holds(const Point<D>& p) const
    {
      bool isIn = true;
      for (int axis = 0; axis < D; ++axis)
      {
        isIn = isIn && p[axis] >= this->Low[axis] && p[axis] < this->High[axis];
      }
      return isIn;
    }

    Point<D> Low;
    Point<D> High;
    double Mass;
  };

  // The mass between the origin and each corner of the cells.
  void AddUp(const TestDensity<D>& density)
  {
    const double total = sumOf(density.Values);
    this->Sums.assign(static_cast<std::size_t>(cellCount<D>(this->Corners)), 0.0);
    for (std::size_t i = 0; i < density.Values.size(); ++i)
    {
      GridSize<D> corner = cellAt<D>(static_cast<std::int64_t>(i), density.Size);
      for (std::int64_t& coordinate : corner)
      {
        ++coordinate;
      }
      this->Sums[static_cast<std::size_t>(cellIndex<D>(corner, this->Corners))] =
        density.Values[i] / total;
    }
    std::size_t stride = 1;
    for (int axis = 0; axis < D; ++axis)
    {
      const auto corners = static_cast<std::size_t>(this->Corners[axis]);
      for (std::size_t i = stride; i < this->Sums.size(); ++i)
      {
        this->Sums[i] += i / stride % corners > 0 ? this->Sums[i - stride] : 0.0;
      }
      stride *= corners;
    }
  }

  double SumAt(const Point<D>& place) const
  {
    double sum = 0.0;
    for (int corner = 0; corner < 1 << D; ++corner)
    {
      double weight = 1.0;
      GridSize<D> at;
      for (int axis = 0; axis < D; ++axis)
      {
        const double low =
          std::min(std::floor(place[axis]), static_cast<double>(this->Corners[axis] - 2));
        const int high = corner >> axis & 1;
        at[axis] = static_cast<std::int64_t>(low) + high;
        weight *= high == 1 ? place[axis] - low : 1.0 - (place[axis] - low);
      }
      sum += weight * this->Sums[static_cast<std::size_t>(cellIndex<D>(at, this->Corners))];
    }
    return sum;
  }

  double MassOf(const Box& box) const
  {
    double mass = 0.0;
    for (int corner = 0; corner < 1 << D; ++corner)
    {
      double sign = 1.0;
      Point<D> at;
      for (int axis = 0; axis < D; ++axis)
      {
        const bool isHigh = (corner >> axis & 1) == 1;
        at[axis] = isHigh ? box.High[axis] : box.Low[axis];
        sign = isHigh ? sign : -sign;
      }
      mass += sign * this->SumAt(at);
    }
    return mass;
  }

  GridSize<D> Corners;
  std::vector<double> Sums;
  std::vector<Box> Boxes;
};

struct MassErrors
{
  double Eight = 0.0; // blocks of 8 cells
  double Four = 0.0;
  double Six = 0.0; // off the planes that halve the grid
  double Boxes = 0.0;
};

template <int D>
MassErrors errorsOf(
  const TestDensity<D>& density, const RandomBoxes<D>& boxes, const Particles<D>& particles)
{
  return { blockError<D>(density, particles, 8), blockError<D>(density, particles, 4),
    blockError<D>(density, particles, 6, 3), boxes.Error(particles) };
}

// The root mean square of the errors of several sets of samples.
template <int D>
MassErrors noiseOf(const TestDensity<D>& density, const RandomBoxes<D>& boxes)
{
  constexpr int sets = 4;
  constexpr double MassErrors::*kinds[] = { &MassErrors::Eight, &MassErrors::Four, &MassErrors::Six,
    &MassErrors::Boxes };
  MassErrors noise;
  for (std::uint64_t seed = 2; seed < 2 + sets; ++seed)
  {
    const MassErrors errors = errorsOf<D>(density, boxes, stratifiedSamples<D>(density, seed));
    for (const auto kind : kinds)
    {
      noise.*kind += errors.*kind * (errors.*kind) / sets;
    }
  }
  for (const auto kind : kinds)
  {
    noise.*kind = std::sqrt(noise.*kind);
  }
  return noise;
}

// What moves samples.
enum class Mover
{
  Points, // the map of single points
  Samples,
  Flow
};

template <int D>
struct SolvedPair
{
  explicit SolvedPair(const OptimalPair<D>& pair)
    : IsFixed(pair.IsFixed)
    , Source(pair.Source())
    , Target(pair.Target())
    , From(stratifiedSamples<D>(this->Source, 1))
    , Boxes(this->Target)
    , Noise(noiseOf<D>(this->Target, this->Boxes))
  {
    const auto from = this->Source.Source();
    const auto to = this->Target.Source();
    const Point<D> unit = evenPoint<D>(1.0);
    this->Map = std::make_unique<OptimalMap<D>>(
      PlacedDensity<D>{ DensitySource<D>(this->Source.Size, from), {}, unit },
      PlacedDensity<D>{ DensitySource<D>(this->Target.Size, to), {}, unit });
    this->Map->Solve();
  }

  void Move(Mover mover, Particles<D>& images) const
  {
    const FlowSeeds<D> seeds(this->From);
    if (mover == Mover::Flow)
    {
      RectifiedFlow<D>(this->Source.Source()).Backward(this->From, images);
      RectifiedFlow<D>(this->Target.Source()).Forward(images, images);
    }
    else
    {
      this->Map->Forward(mover == Mover::Samples ? seeds.AsSamples() : seeds, images);
    }
  }

  std::function<bool(const Point<D>&)> IsFixed;
  TestDensity<D> Source;
  TestDensity<D> Target;
  Particles<D> From;
  RandomBoxes<D> Boxes;
  MassErrors Noise;
  std::unique_ptr<OptimalMap<D>> Map;
};

template <int D>
void report(benchmark::State& state, const SolvedPair<D>& pair, const Particles<D>& images)
{
  const MassErrors errors = errorsOf<D>(pair.Target, pair.Boxes, images);
  state.counters["8"] = errors.Eight / pair.Noise.Eight;
  state.counters["4"] = errors.Four / pair.Noise.Four;
  state.counters["6"] = errors.Six / pair.Noise.Six;
  state.counters["boxes"] = errors.Boxes / pair.Noise.Boxes;
  const auto side = static_cast<double>(pair.Target.Size[0]);
  double cost = 0.0;
  double ways = 0.0;
  double still = 0.0;
  double inVoid = 0.0;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    Point<D> start = pair.From[i];
    double square = 0.0;
    for (int axis = 0; axis < D; ++axis)
    {
      square += (images[i][axis] - start[axis]) * (images[i][axis] - start[axis]);
      start[axis] /= side;
    }
    cost += square / (side * side) / static_cast<double>(images.size());
    if (pair.IsFixed && pair.IsFixed(start))
    {
      still += 1.0;
      ways += std::sqrt(square);
    }
    const GridSize<D> cell = cellOf<D>(images[i], pair.Target.Size);
    inVoid +=
      pair.Target.Values[static_cast<std::size_t>(cellIndex<D>(cell, pair.Target.Size))] > 0.0
      ? 0.0
      : 1.0;
  }
  state.counters["cost"] = 100.0 * (cost / pair.Map->LowerBound() - 1.0); // percent
  state.counters["still"] = still > 0.0 ? ways / still : 0.0;             // cells, on average
  state.counters["in_empty_cells"] = inVoid;
}

// Of the pairs of a dimension, the one that was measured last is kept.
template <int D>
const SolvedPair<D>& solved(const OptimalPair<D>& pair)
{
  static std::string last;
  static std::unique_ptr<SolvedPair<D>> kept;
  if (last != pair.Name)
  {
    kept = std::make_unique<SolvedPair<D>>(pair);
    last = pair.Name;
  }
  return *kept;
}

template <int D>
void registerPairs(const std::vector<OptimalPair<D>>& pairs)
{
  for (const OptimalPair<D>& pair : pairs)
  {
    for (const auto& [mover, text] : { std::make_pair(Mover::Flow, "flow"),
           std::make_pair(Mover::Points, "points"), std::make_pair(Mover::Samples, "samples") })
    {
      const std::string name = "OptimalMasses" + std::to_string(D) + "D/" + pair.Name + "/" + text;
      benchmark::RegisterBenchmark(name.c_str(),
        [pair, mover = mover](benchmark::State& state) {
          const OpenMPThreads threads(1);
          const SolvedPair<D>& two = solved<D>(pair);
          Particles<D> images(sampleCount);
          two.Move(mover, images); // makes the map
          for (auto _ : state)
          {
            two.Move(mover, images);
          }
          report<D>(state, two, images);
        })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
    }
  }
}

const bool areRegistered = [] {
  registerPairs<2>(optimalPairs2D(256));
  registerPairs<3>(optimalPairs3D(64));
  return true;
}();

} // namespace
} // namespace RectifiedTransport
