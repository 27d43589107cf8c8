// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceRelaxation/StratifiedSampling.h"

#include "Core/Geometry/LowDiscrepancy.h"
#include "Core/Geometry/PointBounds.h"
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/SurfaceRelaxation/DotTree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t startGrain = std::int64_t{ 1 } << 12;

// Eight samples a dot make counts in patches a little more exact, four need less memory.
std::int64_t samplesOfDot(std::int64_t dots)
{
  constexpr std::int64_t many = std::int64_t{ 1 } << 18;
  return dots < many ? 8 : 4;
}

// Three axes fill 30 bits of a 32-bit key: boxes of 1/1024 of the surface's.
constexpr int bitsOfAxis = 10;

// The bits of a coordinate in [-1/2, 1/2], with two free ones after each, for a Morton number:
// masks and shifts move them apart in four steps.
std::uint32_t spreadBits(double x)
{
  constexpr double most = (1 << bitsOfAxis) - 1;
  auto bits = static_cast<std::uint32_t>(std::clamp((x + 0.5) * (most + 1.0), 0.0, most));
  bits = (bits | bits << 16) & 0x030000ffu;
  bits = (bits | bits << 8) & 0x0300f00fu;
  bits = (bits | bits << 4) & 0x030c30c3u;
  return (bits | bits << 2) & 0x09249249u;
}

// Triangles in Morton order of their centres. Samples at equal steps of the mass are then spread in
// space, even if triangles are much smaller than what a sample stands for.
class TriangleOrder
{
public:
  TriangleOrder(const GeodesicTracer& tracer, Progress& progress)
    : Order(tracer.NumberOfTriangles())
  {
    const std::int64_t count = this->Order.size();
    LargeBuffer<std::uint32_t> keys(count);
    Stages stages(progress, { { "keys", 3 }, { "low bits", 3 }, { "high bits", 4 } });
    stages["keys"].ForEach(count, startGrain, [&](std::int64_t t) {
      // The surface is in the box [-1/2, 1/2]^3.
      const Point<3> centre =
        (1.0 / 3.0) * (tracer.Corner(t, 0) + tracer.Corner(t, 1) + tracer.Corner(t, 2));
      keys.data()[t] =
        spreadBits(centre[0]) | spreadBits(centre[1]) << 1 | spreadBits(centre[2]) << 2;
    });
    LargeBuffer<std::int64_t> other(count);
    this->Pass(keys, nullptr, other.data(), 0, stages["low bits"]);
    this->Pass(keys, other.data(), this->Order.data(), 3 * bitsOfAxis / 2, stages["high bits"]);
  }

  std::int64_t operator[](std::int64_t place) const { return this->Order.data()[place]; }

private:
  // A stable counting sort by 15 bits; two passes sort the 30 bits of the keys.
  void Pass(const LargeBuffer<std::uint32_t>& keys, const std::int64_t* from, std::int64_t* to,
    int shift, Progress& progress)
  {
    constexpr std::uint32_t buckets = 1u << (3 * bitsOfAxis / 2);
    const auto bucketOf = [&](std::int64_t t) { return keys.data()[t] >> shift & (buckets - 1u); };
    std::vector<std::int64_t> next(buckets + 1, 0);
    const std::int64_t count = keys.size();
    progress.Expect(2 * count);
    progress.ForEachInOrder(count, startGrain, [&](std::int64_t t) { ++next[bucketOf(t) + 1]; });
    for (std::size_t bucket = 1; bucket <= buckets; ++bucket)
    {
      // Counts become the places where buckets begin.
      next[bucket] += next[bucket - 1];
    }
    progress.ForEachInOrder(count, startGrain, [&](std::int64_t i) {
      const std::int64_t t = from ? from[i] : i;
      to[next[bucketOf(t)]++] = t;
    });
  }

  LargeBuffer<std::int64_t> Order;
};

// A sequence of numbers in [0, 1) that fills the cube evenly: a random start plus multiples of the
// steps of lowDiscrepancyStep, modulo 1 in 64-bit integers.
template <int Dimension>
class KroneckerSequence
{
public:
  KroneckerSequence(std::uint64_t seed, std::uint64_t stream)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->At[axis] = randomWord(seed, Dimension * stream + static_cast<std::uint64_t>(axis));
    }
  }
  void Next()
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->At[axis] += lowDiscrepancyStep<Dimension>(axis);
    }
  }
  double operator[](int axis) const { return unitReal(this->At[axis]); }

private:
  std::uint64_t At[Dimension];
};

// Samples on one triangle, one after another.
class TriangleSamples
{
public:
  TriangleSamples(const GeodesicTracer& tracer, std::int64_t triangle)
    : Triangle(triangle)
    , A(tracer.Corner(triangle, 0))
    , AB(tracer.Corner(triangle, 1) - this->A)
    , BC(tracer.Corner(triangle, 2) - tracer.Corner(triangle, 1))
  {
  }
  SurfacePlace At(double u, double v) const
  {
    // A + sqrt(u) AB + sqrt(u) v BC is uniform for uniform u and v.
    const double root = std::sqrt(u);
    return { this->A + root * this->AB + (root * v) * this->BC, this->Triangle };
  }

  // Makes uniform samples.
  void Make(std::uint64_t seed, SurfacePlace* first, SurfacePlace* last) const
  {
    KroneckerSequence<2> even(seed, static_cast<std::uint64_t>(this->Triangle));
    for (SurfacePlace* sample = first; sample < last; ++sample)
    {
      even.Next();
      *sample = this->At(even[0], even[1]);
    }
  }
  // Makes samples of a density that is linear between its corners, by rejection: those of uniform
  // points in the prism over the triangle that are under the density.
  void Make(std::uint64_t seed, const std::array<double, 3>& corners, SurfacePlace* first,
    SurfacePlace* last) const
  {
    KroneckerSequence<3> even(seed, static_cast<std::uint64_t>(this->Triangle));
    const double most = std::max({ corners[0], corners[1], corners[2] });
    for (SurfacePlace* sample = first; sample < last;)
    {
      even.Next();
      // As in At(): weights 1 - root, root (1 - v), root v at the corners.
      const double root = std::sqrt(even[0]);
      const double density =
        corners[0] + root * (corners[1] - corners[0] + even[1] * (corners[2] - corners[1]));
      if (even[2] * most < density)
      {
        *sample++ = this->At(even[0], even[1]);
      }
    }
  }

private:
  std::int64_t Triangle;
  Point<3> A;
  Point<3> AB;
  Point<3> BC;
};

// Draws `count` samples in proportion to mass, which are grouped by triangles in Morton order. Each
// triangle has random numbers of its own, by its number, so that threads may fill them in any
// order.
LargeBuffer<SurfacePlace> makeSamples(const GeodesicTracer& tracer, const SurfaceDensity& density,
  double total, std::int64_t count, std::uint64_t seed, Progress& progress)
{
  Stages stages(progress, { { "order", 4 }, { "counts", 2 }, { "samples", 4 } });
  const std::int64_t triangles = tracer.NumberOfTriangles();
  const TriangleOrder order(tracer, stages["order"]);
  // The first sample of each triangle: systematic sampling at equal steps of the mass, from a
  // random one on.
  LargeBuffer<std::int64_t> firsts(triangles + 1);
  const double offset = unitReal(randomWord(seed + 2, 0));
  // Sample n belongs to the triangle where the running mass passes (n + 1 - offset) of `count`
  // equal steps: a triangle gets its expected number of samples, rounded up or down.
  double mass = 0.0;
  firsts.data()[0] = 0;
  stages["counts"].ForEachInOrder(triangles, startGrain, [&](std::int64_t i) {
    mass += density.MassOf(order[i]);
    const double before = mass / total * static_cast<double>(count) + offset;
    firsts.data()[i + 1] = std::clamp(static_cast<std::int64_t>(before), firsts.data()[i], count);
  });
  // Rounding may leave some to the last triangle that has any.
  std::int64_t used = triangles;
  while (firsts.data()[used - 1] == firsts.data()[triangles])
  {
    --used;
  }
  std::fill(firsts.data() + used, firsts.data() + triangles + 1, count);
  LargeBuffer<SurfacePlace> samples(count);
  constexpr std::int64_t triangleGrain = 256;
  stages["samples"].ForEach(
    triangles, triangleGrain,
    [&](std::int64_t i) {
      SurfacePlace* first = samples.data() + firsts.data()[i];
      SurfacePlace* last = samples.data() + firsts.data()[i + 1];
      if (first == last)
      {
        return;
      }
      const TriangleSamples triangle(tracer, order[i]);
      if (density.IsLinear())
      {
        triangle.Make(seed, density.AtCorners(order[i]), first, last);
      }
      else
      {
        triangle.Make(seed, first, last);
      }
    },
    triangleGrain);
  return samples;
}

// Dots [First, Last): at first all, halved by the cuts.
struct DotRange
{
  std::int64_t First;
  std::int64_t Last;
};

// k-d cuts of the samples: each half has a whole number of dots, hence of samples, so that each
// region of the tree has its share of dots to one sample.
class SampleCuts
{
public:
  SampleCuts(LargeBuffer<SurfacePlace>& samples, const SurfaceDensity& density, std::int64_t ofDot)
    : Samples(samples.data())
    , Density(density)
    , OfDot(ofDot)
  {
  }

  // Puts the sample that stands for each dot first among those of the dot.
  void Run(std::int64_t dots, Progress& progress)
  {
    constexpr int mostLevels = 8; // 256 ranges
    constexpr std::int64_t fewDots = 256;
    // Ranges of the upper levels are few: a level is shared by threads, range by range. Below, each
    // thread finishes whole ranges.
    int levels = 0;
    while (levels < mostLevels && (dots >> levels) > fewDots)
    {
      ++levels;
    }
    constexpr double ofLevel = 0.06; // share of a level's work; about log2(dots) equal levels
    Stages stages(progress, { { "levels", ofLevel * levels }, { "dots", 1.0 - ofLevel * levels } });
    Parts cuts(stages["levels"], levels);
    std::vector<DotRange> ranges{ { 0, dots } };
    for (int level = 0; level < levels; ++level)
    {
      Progress& cut = cuts[level];
      std::vector<DotRange> halves(2 * ranges.size());
      this->For(cut, ranges, [&](std::int64_t i) {
        const DotRange range = ranges[static_cast<std::size_t>(i)];
        const std::int64_t middle = this->Cut(range, cut);
        halves[static_cast<std::size_t>(2 * i)] = { range.First, middle };
        halves[static_cast<std::size_t>(2 * i + 1)] = { middle, range.Last };
      });
      ranges = std::move(halves);
    }
    Progress& rest = stages["dots"];
    this->For(rest, ranges,
      [&](std::int64_t i) { this->Finish(ranges[static_cast<std::size_t>(i)], rest); });
  }

  // Makes up for a bias. Where the density jumps among the samples of a dot, the one next to their
  // mean would be a sparse one too often. Chooses from the sparse or from the dense ones so that
  // both have their shares over all dots (error diffusion in `owed`).
  void ShareJumps(std::int64_t dots, Progress& progress)
  {
    double owed = 0.5; // part of a dot that is owed to the sparse side
    std::vector<std::pair<double, std::int64_t>> byDensity(static_cast<std::size_t>(this->OfDot));
    std::vector<SurfacePlace> side;
    progress.ForEachInOrder(dots, startGrain, [&](std::int64_t dot) {
      SurfacePlace* const first = this->At(dot);
      for (std::int64_t i = 0; i < this->OfDot; ++i)
      {
        byDensity[static_cast<std::size_t>(i)] = { this->Density.MeanOf(first[i].Triangle), i };
      }
      std::sort(byDensity.begin(), byDensity.end());
      // The largest quotient of neighbours in the order of densities is the jump: below it is the
      // sparse side.
      std::size_t jump = 0;
      double largest = largestStep;
      for (std::size_t i = 1; i < byDensity.size(); ++i)
      {
        if (byDensity[i].first > largest * byDensity[i - 1].first)
        {
          largest = byDensity[i].first / byDensity[i - 1].first;
          jump = i;
        }
      }
      if (jump == 0)
      {
        return;
      }
      owed += static_cast<double>(jump) / static_cast<double>(this->OfDot);
      const bool takesSparse = owed >= 1.0;
      owed -= takesSparse ? 1.0 : 0.0;
      side.clear();
      for (std::size_t i = takesSparse ? 0 : jump; i < (takesSparse ? jump : byDensity.size()); ++i)
      {
        side.push_back(first[byDensity[i].second]);
      }
      *first = *Middle(side.data(), side.data() + side.size());
    });
  }

private:
  // Calls visit(i) for each range, on any thread.
  template <class Visit>
  void For(Progress& progress, const std::vector<DotRange>& ranges, const Visit& visit)
  {
    progress.ForEach(
      static_cast<std::int64_t>(ranges.size()), 1, [&](std::int64_t i) { visit(i); }, 1);
  }

  // Returns the first of a dot's samples, which are contiguous.
  SurfacePlace* At(std::int64_t dot) const { return this->Samples + dot * this->OfDot; }

  // Polls for cancellation within a selection, which may take long at the first levels.
  static void countComparison(int& comparisons, Progress& progress)
  {
    constexpr int interval = 1 << 17;
    if (++comparisons == interval)
    {
      comparisons = 0;
      progress.Check();
    }
  }

  // Cuts the samples of a range across their longest extent, by selection in linear time. Returns
  // where the second half begins.
  std::int64_t Cut(const DotRange& range, Progress& progress) const
  {
    SurfacePlace* const first = this->At(range.First);
    SurfacePlace* const last = this->At(range.Last);
    PointBounds bounds;
    for (const SurfacePlace* sample = first; sample < last; ++sample)
    {
      bounds.Add(sample->X.data());
    }
    const std::size_t longest = bounds.Longest();
    // Whole blocks of dots in the first half: the tree of blocks has the cuts as its boxes.
    const std::int64_t middle = range.First + dotsBeforeCut(range.Last - range.First);
    int comparisons = 0;
    std::nth_element(first, this->At(middle), last, [&](const auto& a, const auto& b) {
      countComparison(comparisons, progress);
      return isBefore(a, b, longest);
    });
    return middle;
  }

  // A total order of samples: which of them are in a half must not depend on how they are sorted.
  static bool isBefore(const SurfacePlace& a, const SurfacePlace& b, std::size_t axis)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t at = (axis + i) % 3;
      if (a.X[at] != b.X[at])
      {
        return a.X[at] < b.X[at];
      }
    }
    return a.Triangle < b.Triangle;
  }

  // Cuts recursively down to single dots.
  void Finish(const DotRange& range, Progress& progress) const
  {
    if (range.Last - range.First > 1)
    {
      const std::int64_t middle = this->Cut(range, progress);
      this->Finish({ range.First, middle }, progress);
      this->Finish({ middle, range.Last }, progress);
    }
    else if (range.Last > range.First)
    {
      SurfacePlace* const first = this->At(range.First);
      SurfacePlace* const last = this->At(range.Last);
      // Sums of them must not depend on how they were sorted.
      std::sort(first, last, [](const auto& a, const auto& b) { return isBefore(a, b, 0); });
      std::swap(*first, *Middle(first, last));
    }
  }

  // The sample that is nearest to the mean of some samples.
  static SurfacePlace* Middle(SurfacePlace* first, SurfacePlace* last)
  {
    Point<3> mean{ 0.0, 0.0, 0.0 };
    for (const SurfacePlace* sample = first; sample < last; ++sample)
    {
      mean = mean + (1.0 / static_cast<double>(last - first)) * sample->X;
    }
    return std::min_element(first, last, [&](const SurfacePlace& a, const SurfacePlace& b) {
      const Point<3> fromA = a.X - mean;
      const Point<3> fromB = b.X - mean;
      return dot(fromA, fromA) < dot(fromB, fromB);
    });
  }

  SurfacePlace* Samples;
  const SurfaceDensity& Density;
  const std::int64_t OfDot; // samples of a dot
};

} // namespace

LargeBuffer<SurfacePlace> drawDots(const GeodesicTracer& tracer, const SurfaceDensity& density,
  double total, const SurfaceRelaxationOptions& options, Progress& progress)
{
  const std::int64_t dots = options.NumberOfSamples;
  const std::int64_t ofDot = samplesOfDot(dots);
  Stages stages(progress,
    { { "samples", 30 }, { "cuts", 60 }, { "jumps", density.IsUniform() ? 0.0 : 5.0 },
      { "dots", 5 } });
  LargeBuffer<SurfacePlace> samples =
    makeSamples(tracer, density, total, ofDot * dots, options.RandomSeed, stages["samples"]);
  SampleCuts cuts(samples, density, ofDot);
  cuts.Run(dots, stages["cuts"]);
  if (!density.IsUniform())
  {
    cuts.ShareJumps(dots, stages["jumps"]);
  }
  LargeBuffer<SurfacePlace> chosen(dots);
  stages["dots"].ForEach(
    dots, startGrain, [&](std::int64_t dot) { chosen.data()[dot] = samples.data()[dot * ofDot]; });
  return chosen;
}

double memoryForDots(std::int64_t triangles, std::int64_t dots)
{
  return 28.0 * static_cast<double>(triangles) +
    static_cast<double>(sizeof(SurfacePlace)) * static_cast<double>(dots) *
    static_cast<double>(samplesOfDot(dots) + 1);
}

} // namespace RectifiedTransport
