// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/Masses/ExactCounts.h"

#include "Core/OptimalMap/Masses/KdTree.h"
#include "Core/Parallel/Polls.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t fewest = 5;    // particles: smaller boxes are not halved
constexpr double beyondVoid = 6.0;    // cells: what a way to an empty cell counts in addition
constexpr std::int64_t together = 64; // at least so many boxes are halved on one thread each

// Particles are copied, as they are sorted by boxes; Number is their place in the results.
template <int Dimension>
struct Particle
{
  Point<Dimension> At;
  std::int64_t Number;
};

// A box and its particles [First, Last) in the sorted array.
template <int Dimension>
struct BoxOfParticles
{
  KdBox<Dimension> Box;
  std::int64_t First;
  std::int64_t Last;

  std::int64_t Count() const { return this->Last - this->First; }
};

// A particle that may cross a plane, and its distance from there. Equal distances are ordered by
// Number, so that the choice does not depend on threads.
struct Candidate
{
  double Distance;
  std::int64_t Number; // the particle's place in the results
  std::int64_t Place;  // its place in the order of the boxes

  bool operator<(const Candidate& other) const
  {
    return std::make_pair(this->Distance, this->Number) <
      std::make_pair(other.Distance, other.Number);
  }
};

// Halves boxes and moves particles between the halves. Several objects may work on different boxes,
// as their ranges of particles do not overlap.
template <int Dimension>
class Bisection
{
public:
  using Part = BoxOfParticles<Dimension>;

  Bisection(const KdTree<Dimension>& tree, Particle<Dimension>* particles,
    PointSpan<Dimension> results, Progress& progress)
    : Tree(tree)
    , Particles(particles)
    , Results(results)
    , Work(progress)
  {
  }

  std::int64_t Moves() const { return this->MovesMade; }

  // Counts in boxes of few particles are chance, so only their voids are emptied.
  static bool IsHalved(const Part& part)
  {
    return part.Count() >= fewest && part.Box.IsDivisible();
  }

  // Moves particles across the plane until each half has its share of the particles, rounded.
  std::array<Part, 2> Halve(const Part& part)
  {
    const auto [low, high, axis] = this->Tree.Halves(part.Box);
    const auto plane = static_cast<double>(high.Low[axis]);
    std::int64_t middle = this->Divide(part.First, part.Last, axis, plane);
    const double lowMass = this->Tree.Mass(low);
    const double highMass = this->Tree.Mass(high);
    // n m_low / (m_low + m_high) is the share. Both integers next to it are exact enough, so that
    // nothing moves because of rounding; an empty half must be empty.
    const double share = static_cast<double>(part.Count()) * lowMass / (lowMass + highMass);
    const auto least = highMass > 0.0 ? static_cast<std::int64_t>(std::floor(share)) : part.Count();
    const auto most = lowMass > 0.0 ? static_cast<std::int64_t>(std::ceil(share)) : 0;
    const std::int64_t now = middle - part.First;
    if (now > most)
    {
      this->Cross({ low, part.First, middle }, now - most, axis, plane, high);
      middle = this->Divide(part.First, middle, axis, plane);
    }
    else if (now < least)
    {
      this->Cross({ high, middle, part.Last }, least - now, axis, plane, low);
      middle = this->Divide(middle, part.Last, axis, plane);
    }
    return { Part{ low, part.First, middle }, Part{ high, middle, part.Last } };
  }

  // Halves a box and its halves, depth first, to the end.
  void Finish(const Part& part)
  {
    if (!IsHalved(part))
    {
      this->LeaveVoids(part);
      return;
    }
    for (const Part& half : this->Halve(part))
    {
      this->Finish(half);
    }
  }

private:
  // Partitions particles [first, last): those below the plane come before the others. Returns where
  // the others begin.
  std::int64_t Divide(std::int64_t first, std::int64_t last, int axis, double plane)
  {
    std::int64_t middle = first;
    for (std::int64_t i = first; i < last; ++i)
    {
      // Swaps without a branch, as half of a branch's predictions would fail.
      const Particle<Dimension> particle = this->Particles[i];
      this->Particles[i] = this->Particles[middle];
      this->Particles[middle] = particle;
      middle += particle.At[axis] < plane ? 1 : 0;
      this->Work.Count();
    }
    return middle;
  }

  // Moves the `number` cheapest particles of a box across a plane into the box on the other side,
  // each to its mirror image: then the density across the plane stays as smooth as it was.
  void Cross(
    const Part& from, std::int64_t number, int axis, double plane, const KdBox<Dimension>& to)
  {
    // A layer that would hold the wanted number if the density were even, with a factor 4 and 8
    // particles to spare: particles are seldom far denser away from the plane. If it holds too few,
    // all of the box is searched.
    const auto reach = static_cast<double>(from.Box.High[axis] - from.Box.Low[axis]);
    const double near =
      reach * 4.0 * static_cast<double>(number + 8) / static_cast<double>(from.Count());
    if (!this->FindCandidates(from, number, axis, plane, to, std::min(near, reach)))
    {
      this->FindCandidates(from, number, axis, plane, to, std::numeric_limits<double>::infinity());
    }
    const auto last = this->Candidates.begin() + static_cast<std::ptrdiff_t>(number);
    // The nearest `number` ones are chosen in linear time, without sorting them.
    if (last != this->Candidates.end())
    {
      std::nth_element(this->Candidates.begin(), last, this->Candidates.end(),
        [&](const Candidate& a, const Candidate& b) {
          this->Work.Count();
          return a < b;
        });
    }
    for (auto candidate = this->Candidates.begin(); candidate != last; ++candidate)
    {
      Particle<Dimension>& particle = this->Particles[candidate->Place];
      particle.At[axis] = Mirrored(particle.At[axis], axis, plane, to);
      if (!this->Tree.Density().HasMass(particle.At.data()))
      {
        this->Tree.MoveToMass(particle.At, to);
        this->Work.Count();
      }
      this->Keep(particle);
    }
  }

  // Lists the particles nearer than `near` to the plane, farther by beyondVoid if their mirror
  // image is in a void. Returns whether these are sure to include the nearest `number` ones: only
  // those that stay nearer than `near` with that addition count.
  bool FindCandidates(const Part& from, std::int64_t number, int axis, double plane,
    const KdBox<Dimension>& to, double near)
  {
    this->Candidates.clear();
    std::int64_t sure = 0;
    for (std::int64_t i = from.First; i < from.Last; ++i)
    {
      const Particle<Dimension>& particle = this->Particles[i];
      double distance = std::abs(particle.At[axis] - plane);
      if (distance < near)
      {
        Point<Dimension> beyond = particle.At;
        beyond[axis] = Mirrored(particle.At[axis], axis, plane, to);
        distance += this->Tree.Density().HasMass(beyond.data()) ? 0.0 : beyondVoid;
        sure += distance < near ? 1 : 0;
        this->Candidates.push_back({ distance, particle.Number, i });
      }
      this->Work.Count();
    }
    return sure >= number;
  }

  // The mirror image of a coordinate at the plane, kept inside of the box beyond it.
  static double Mirrored(double at, int axis, double plane, const KdBox<Dimension>& to)
  {
    constexpr double inside = PlaceInCell<Dimension>::Inside;
    return std::clamp(2.0 * plane - at, static_cast<double>(to.Low[axis]) + inside,
      static_cast<double>(to.High[axis]) - inside);
  }

  // Moves the particles of a box out of its empty cells.
  void LeaveVoids(const Part& part)
  {
    if (!this->Tree.Density().HasVoids())
    {
      return;
    }
    for (std::int64_t i = part.First; i < part.Last; ++i)
    {
      Particle<Dimension>& particle = this->Particles[i];
      if (!this->Tree.Density().HasMass(particle.At.data()))
      {
        this->Tree.MoveToMass(particle.At, part.Box);
        this->Keep(particle);
      }
      this->Work.Count();
    }
  }

  // Writes a moved particle to the results.
  void Keep(const Particle<Dimension>& particle)
  {
    std::copy(particle.At.begin(), particle.At.end(), this->Results[particle.Number]);
    ++this->MovesMade;
  }

  const KdTree<Dimension>& Tree;
  Particle<Dimension>* Particles;
  PointSpan<Dimension> Results;
  Polls Work;
  std::vector<Candidate> Candidates;
  std::int64_t MovesMade = 0;
};

} // namespace

template <int Dimension>
std::int64_t makeCountsExact(const CellDensity<Dimension>& density, const Point<Dimension>& sides,
  PointSpan<Dimension> particles, Progress& progress)
{
  using Part = BoxOfParticles<Dimension>;
  // The work is a level of boxes at a time, then whole subtrees: both are independent of
  // threads.
  const std::int64_t number = particles.size();
  const KdTree<Dimension> tree(density, sides, progress);
  LargeBuffer<Particle<Dimension>> sorted(number);
  progress.Threads().For(
    number, std::int64_t{ 1 } << 14, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last && !progress.IsCancelled(); ++i)
      {
        Particle<Dimension>& particle = sorted.data()[i];
        std::copy_n(particles[i], Dimension, particle.At.begin());
        particle.Number = i;
      }
      progress.ShouldStop();
    });
  progress.Check();

  // One level of boxes after the other, until there are enough boxes for all threads. Larger boxes
  // than `most` particles stay open.
  std::atomic<std::int64_t> moves{ 0 };
  const std::int64_t most = std::max<std::int64_t>(2048, number / (4 * together));
  std::vector<Part> open;
  std::vector<Part> closed;
  const auto sort = [&](const Part& part) {
    if (part.Count() > 0)
    {
      (part.Count() > most && Bisection<Dimension>::IsHalved(part) ? open : closed).push_back(part);
    }
  };
  sort({ tree.Whole(), 0, number });
  while (!open.empty())
  {
    // The boxes of a level have separate ranges of particles, so that they can be halved in any
    // order.
    std::vector<std::array<Part, 2>> halves(open.size());
    progress.Threads().For(
      static_cast<std::int64_t>(open.size()), 1, [&](std::int64_t first, std::int64_t last) {
        Bisection<Dimension> bisection(tree, sorted.data(), particles, progress);
        for (std::int64_t i = first; i < last; ++i)
        {
          halves[static_cast<std::size_t>(i)] = bisection.Halve(open[static_cast<std::size_t>(i)]);
        }
        moves += bisection.Moves();
      });
    progress.Check();
    open.clear();
    for (const std::array<Part, 2>& two : halves)
    {
      sort(two[0]);
      sort(two[1]);
    }
  }

  // Each subtree counts as the work of its first particle, and ranges of particles become
  // ranges of subtrees.
  std::sort(
    closed.begin(), closed.end(), [](const Part& a, const Part& b) { return a.First < b.First; });
  progress.For(number, most, [&](std::int64_t first, std::int64_t last) {
    Bisection<Dimension> bisection(tree, sorted.data(), particles, progress);
    auto part = std::lower_bound(closed.begin(), closed.end(), first,
      [](const Part& a, std::int64_t begin) { return a.First < begin; });
    for (; part != closed.end() && part->First < last; ++part)
    {
      bisection.Finish(*part);
    }
    moves += bisection.Moves();
  });
  return moves;
}

// The tree, the sorted copy, and in the worst case a candidate for each particle.
template <int Dimension>
double memoryForExactCounts(const GridSize<Dimension>& size, std::int64_t particles)
{
  return KdTree<Dimension>::MemoryFor(size) +
    static_cast<double>(particles) * sizeof(Particle<Dimension>) +
    static_cast<double>(particles) * sizeof(Candidate);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(makeCountsExact);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(memoryForExactCounts);

} // namespace RectifiedTransport
