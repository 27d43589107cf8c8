// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/FlowMapShape.h"

#include "Core/Flow/Kernels/FlowKernels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// Measured.
template <int Dimension>
struct Constants
{
  static constexpr double Steps = 0.95;    // of particles that hand over, a NumberOfSteps
  static constexpr double Error = 1.2;     // the interpolation's, times NumberOfSteps^2 / size
  static constexpr double LeastRatio = 5;  // width of the box over the spacing
  static constexpr double LeastCells = 40; // in the coarsest lattice: paths start with kinks
  // Times of an interpolation, and of an evaluation of a node, as nodes lie far apart. Both are in
  // velocity evaluations of particles.
  static constexpr double Interpolation = 1.2;
  static constexpr double Node = 1.3;
  static constexpr double Particles = 0.1; // a grid cell, for which levels are chosen, forwards
};

template <>
struct Constants<3>
{
  static constexpr double Steps = 1.0;
  static constexpr double Error = 1.9;
  static constexpr double LeastRatio = 4.5;
  static constexpr double LeastCells = 22;
  static constexpr double Interpolation = 1.3;
  static constexpr double Node = 1.8;
  static constexpr double Particles = 0.5;
};

// Particles a grid cell, for which levels are chosen, backwards: samples of a map.
constexpr double particlesBackward = 1.0;
// Steps that a particle takes backwards, a NumberOfSteps, before its box is the whole domain.
constexpr double stepsBackward = 0.72;
// Steps at which half of the cells of a photograph's lattices are bad.
constexpr double stepsOfBad = 256.0;

// The narrowest box, in cells, that a lattice may serve: below, grid cells are not smoothed.
constexpr double narrowest = 6.0;
// Each lattice's spacing is at least this many times that of the next finer one.
constexpr double coarsening = 2.0;
constexpr double leastCoarsening = 1.5; // where there are two alone
constexpr std::int64_t fewestCells = 5; // along an axis of a lattice
constexpr double mostNodes = 0.25;      // a grid cell, of all levels
// The rounding of records, and what bends see of it, relative to the domain.
constexpr double finestDeviation = 0x1p-20;
// 1 - t two steps before the first hand-over. Forwards straight starts last until t = 1/2: from
// there on a node must get away from its start, or the velocities that it has known say little of
// those ahead. Backwards the way to the seeds is the less smooth the longer it is.
constexpr double mostRest(FlowDirection direction)
{
  return direction == FlowDirection::Forward ? 0.4 : 0.3;
}

// Everything in units of the geometric mean of the axes' sizes: the flow commutes with scalings of
// axes, and so do the lattices. With S that mean and s = 1 - t at a hand-over, the box there is
//   W = S s / (1 - s)
// wide, and the flow is smooth at that scale. The error that the interpolation may have is
//   e = Error S / N^2,
// in proportion to that of N = MapSteps steps. A lattice costs its nodes, and saves steps of all
// particles: the finer it is, the later it may hand over.
template <int Dimension>
class LevelChooser
{
public:
  using Level = typename FlowMapShape<Dimension>::Level;

  LevelChooser(const GridSize<Dimension>& size, int mapSteps, int steps, FlowDirection direction)
    : Size(size)
    , Steps(steps)
    , Direction(direction)
  {
    const double cells = numberOfCells<Dimension>(size);
    // Rounded: roots other than the square root differ from one library to the next.
    this->Mean = std::round(Dimension == 3 ? std::cbrt(cells) : std::sqrt(cells));
    this->Particles =
      cells * (direction == FlowDirection::Forward ? Fixed::Particles : particlesBackward);
    this->Error = Fixed::Error * this->Mean / (static_cast<double>(mapSteps) * mapSteps);
    for (int handOver = 0; handOver < steps; ++handOver)
    {
      this->Spacings.push_back(this->FindSpacing(handOver));
    }
  }

  bool IsAboveRounding() const { return this->Deviation() >= finestDeviation; }

  Point<Dimension> Deviations() const
  {
    Point<Dimension> deviations;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      deviations[axis] = this->Deviation() * static_cast<double>(this->Size[axis]);
    }
    return deviations;
  }

  double WidestSpacing() const { return this->Mean / Fixed::LeastCells; }

  // The first hand-over with a spacing; the number of steps if there is none.
  int FirstWith(double spacing) const
  {
    const auto first = std::lower_bound(this->Spacings.begin(), this->Spacings.end(), spacing);
    return static_cast<int>(first - this->Spacings.begin());
  }

  // The mean width of the box at a hand-over, W = S s / (1 - s), in cells.
  double Width(int handOver) const
  {
    const double rest = this->Rest(handOver);
    return this->Mean * rest / (1.0 - rest);
  }

  // The spacing h at which the error of the interpolation, W (h / W)^(16/7) but for a factor, is
  // the allowed one. It grows with the hand-over.
  double Spacing(int handOver) const { return this->Spacings[static_cast<std::size_t>(handOver)]; }

  bool MayBeFinest(int handOver) const
  {
    return this->IsAfterStart(handOver) && this->Width(handOver) >= narrowest;
  }

  bool IsAfterStart(int handOver) const
  {
    return isAfterStart(this->Direction, handOver, this->Steps);
  }

  // The levels from the finest, whose hand-over is given, to the coarsest.
  std::vector<Level> Levels(int finest) const
  {
    // Nodes of the coarsest take the whole way from their seeds: as few as may be.
    int coarsest = std::max(finest, this->FirstWith(this->WidestSpacing()) - 1);
    while (!this->IsAfterStart(coarsest))
    {
      --coarsest;
    }
    // Each next level has at least `coarsening` times the spacing, and so 2^d times fewer nodes.
    // The last one that would be chosen is replaced by the coarsest, so that few nodes take all
    // steps.
    std::vector<int> handOvers = { finest };
    const auto isCoarser = [&](int handOver, double ratio) {
      return this->Spacing(handOver) >= ratio * this->Spacing(handOvers.back());
    };
    while (isCoarser(coarsest, coarsening) &&
      handOvers.size() + 1 < FlowMapView<Dimension>::MaximumLevels)
    {
      handOvers.push_back(this->FirstWith(coarsening * this->Spacing(handOvers.back())));
    }
    if (handOvers.size() > 1)
    {
      handOvers.back() = coarsest;
    }
    else if (isCoarser(coarsest, leastCoarsening))
    {
      handOvers.push_back(coarsest);
    }
    std::vector<Level> levels;
    for (const int handOver : handOvers)
    {
      levels.push_back(this->At(handOver));
    }
    for (std::size_t i = 0; i < levels.size(); ++i)
    {
      const int here = levels[i].HandOver;
      // Evaluations of a node: those between two hand-overs, or all from its seed on the coarsest
      // level.
      const double evaluations = i + 1 < levels.size()
        ? Fixed::Interpolation + this->FromCoarser(levels[i + 1].HandOver, here)
        : latticeSteps * (this->Steps - here);
      levels[i].Cost = numberOfCorners<Dimension>(levels[i].Cells) * evaluations * Fixed::Node;
    }
    return levels;
  }

  // Evaluations of a particle from a hand-over on.
  double Remaining(int handOver) const
  {
    return this->Direction == FlowDirection::Forward ? handOver - 1 + Fixed::Interpolation
                                                     : handOver + Fixed::Interpolation;
  }

  double TimeOfParticles(int finest) const { return this->Particles * this->Remaining(finest); }

private:
  using Fixed = Constants<Dimension>;

  // Relative to the domain.
  double Deviation() const
  {
    return (this->Direction == FlowDirection::Forward ? 0.8 : 0.5) * this->Error / this->Mean;
  }

  // 1 - t at a hand-over.
  double Rest(int handOver) const { return timeLeft(this->Direction, handOver, this->Steps); }

  // h = W (e / W)^(7/16), but no more than W / LeastRatio: 7/16 = 1/4 + 1/8 + 1/16, by square roots
  // alone, which have the same bits everywhere.
  double FindSpacing(int handOver) const
  {
    const double width = this->Width(handOver);
    const double fourth = std::sqrt(std::sqrt(this->Error / std::max(width, 1e-300)));
    const double eighth = std::sqrt(fourth);
    return width * std::min(fourth * eighth * std::sqrt(eighth), 1.0 / Fixed::LeastRatio);
  }

  // Evaluations of a node between two hand-overs.
  double FromCoarser(int coarser, int handOver) const
  {
    return this->Direction == FlowDirection::Forward
      ? coarser - handOver
      : static_cast<double>(nodeSteps(handOver, coarser) + 1);
  }

  // The lattice of a hand-over: the same number of spacings to the box's width on every axis.
  // Forwards with layers as wide as the box at both ends, where it is clipped.
  Level At(int handOver) const
  {
    const double spacing = std::min(this->Spacing(handOver), this->WidestSpacing());
    const double ratio = this->Width(handOver) / spacing;
    Level level{ handOver, this->Rest(handOver), {}, {}, 0.0 };
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double size = static_cast<double>(this->Size[axis]);
      const double width = size * (this->Width(handOver) / this->Mean);
      level.Layers[axis] =
        this->Direction == FlowDirection::Forward ? std::min(width, size / 2.0) : 0.0;
      const double length = size + 2.0 * level.Layers[axis];
      level.Cells[axis] =
        std::max(fewestCells, static_cast<std::int64_t>(std::ceil(length * ratio / width)));
    }
    return level;
  }

  const GridSize<Dimension> Size;
  const int Steps;
  const FlowDirection Direction;
  double Mean;                  // S, in cells
  double Particles;             // for which the levels are chosen
  double Error;                 // e, in cells
  std::vector<double> Spacings; // h by hand-over, ascending
};

} // namespace

double timeLeft(FlowDirection direction, int handOver, int steps)
{
  // By symmetry 1 - G_k = G_N-k. Forwards, G divides the interval from commonStart to 1.
  const double graded = grading(handOver, steps);
  return direction == FlowDirection::Forward ? (1.0 - commonStart) * graded : graded;
}

bool isAfterStart(FlowDirection direction, int handOver, int steps)
{
  return handOver + 2 < steps && timeLeft(direction, handOver + 2, steps) <= mostRest(direction);
}

// Tries every hand-over of the finest level, as there are no more than steps.
template <int Dimension>
FlowMapShape<Dimension>::FlowMapShape(const GridSize<Dimension>& size, int numberOfSteps,
  FlowDirection direction, int refinement, int leastHandOver, int mapSteps)
  : NumberOfSteps(numberOfSteps << refinement)
  , MapSteps(mapSteps > 0 ? std::min(mapSteps, numberOfSteps) : numberOfSteps)
  , Steps(direction == FlowDirection::Backward
        ? numberOfSteps
        : static_cast<int>(std::ceil(Constants<Dimension>::Steps * this->NumberOfSteps)))
  , Direction(direction)
{
  if constexpr (Dimension > 1)
  {
    const int steps = this->Steps;
    const LevelChooser<Dimension> chooser(size, this->MapSteps, steps, direction);
    if (!chooser.IsAboveRounding())
    {
      return;
    }
    this->Deviation = chooser.Deviations();
    // The hand-over of the finest level that takes the least time, of the map and the particles, of
    // those whose levels have few enough nodes.
    double least = std::numeric_limits<double>::infinity();
    for (int handOver = leastHandOver; handOver < steps; ++handOver)
    {
      if (!chooser.MayBeFinest(handOver))
      {
        continue;
      }
      std::vector<Level> levels = chooser.Levels(handOver);
      double nodes = 0.0;
      double cost = 0.0;
      for (const Level& level : levels)
      {
        nodes += numberOfCorners<Dimension>(level.Cells);
        cost += level.Cost;
      }
      if (nodes > mostNodes * numberOfCells<Dimension>(size))
      {
        continue;
      }
      const double time = cost + chooser.TimeOfParticles(handOver);
      if (time < least)
      {
        least = time;
        this->Cost = cost;
        this->Levels.assign(levels.rbegin(), levels.rend());
      }
    }
  }
}

template <int Dimension>
double FlowMapShape<Dimension>::MemorySize() const
{
  using View = FlowMapLevel<Dimension>;
  const int record =
    this->Direction == FlowDirection::Forward ? View::ForwardRecord : View::BackwardRecord;
  double bytes = 0.0;
  for (const Level& level : this->Levels)
  {
    bytes += numberOfCorners<Dimension>(level.Cells) * record * sizeof(float) +
      numberOfCells<Dimension>(level.Cells);
  }
  return bytes;
}

double velocitiesOf(FlowDirection direction, int numberOfSteps)
{
  return (direction == FlowDirection::Backward ? stepsBackward : 1.0) * numberOfSteps;
}

template <int Dimension>
double FlowMapShape<Dimension>::Saved() const
{
  return velocitiesOf(this->Direction, this->NumberOfSteps) - this->Levels.back().HandOver -
    Constants<Dimension>::Interpolation;
}

// Whether cost < particles * saved evaluations, both in velocity evaluations of particles.
template <int Dimension>
bool FlowMapShape<Dimension>::PaysFor(double particles) const
{
  if (this->Levels.empty())
  {
    return false;
  }
  // Evaluations that a particle saves in a good cell, times the share of these, against those of
  // the nodes.
  const double share = 1.0 / (1.0 + this->MapSteps / stepsOfBad);
  return particles * share * this->Saved() > this->Cost;
}

template <int Dimension>
double FlowMapShape<Dimension>::CostWith(double particles, double bad) const
{
  const double saved = (1.0 - bad) * this->Saved();
  return this->Cost + particles * (velocitiesOf(this->Direction, this->NumberOfSteps) - saved);
}

template <int Dimension>
FlowOptions withFlowMaps(
  FlowOptions options, const GridSize<Dimension>& size, FlowDirection direction, double particles)
{
  if (options.Maps == FlowMaps::Auto && takesFlowMaps(options))
  {
    const FlowMapShape<Dimension> shape(
      size, options.NumberOfSteps, direction, 0, 1, options.MapSteps);
    options.Maps = shape.PaysFor(particles) ? FlowMaps::On : FlowMaps::Off;
  }
  return options;
}

template struct FlowMapShape<1>;
template struct FlowMapShape<2>;
template struct FlowMapShape<3>;
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(withFlowMaps);

} // namespace RectifiedTransport
