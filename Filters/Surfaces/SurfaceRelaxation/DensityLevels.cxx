// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceRelaxation/DensityLevels.h"

#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/DisjointSets.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t levelGrain = std::int64_t{ 1 } << 12;

// Rounding to whole dots changes a part's share of 8 dots by up to 6 %, and that of fewer dots by
// more.
constexpr double fewestDots = 8.0; // least dots in a wide part, and around noise
constexpr double leastWidth = 1.0; // least width of a wide part, in spacings

// What is known of a part, stored at the number of its first triangle.
struct Part
{
  double Mass;
  double Area;
  double Border;     // its length towards other parts
  double MassAround; // mass of the triangles beside it, for parts of density 0
  double AreaAround;
};

// Parts (connected triangles without a jump between neighbours) are found by union-find. Where the
// density jumps between two wide parts, the sides are closed for walks. In parts that are not wide,
// the density is noise: it is smoothed over the mass of several dots.
class LevelsRun
{
public:
  LevelsRun(GeodesicTracer& tracer, const SurfaceDensity& density, double massOfDot, double* levels)
    : Tracer(tracer)
    , Density(density)
    , MassOfDot(massOfDot)
    , Levels(levels)
    , Count(tracer.NumberOfTriangles())
    , PartOf(this->Count)
  {
  }

  void Run(Progress& progress)
  {
    Stages stages(progress, { { "means", 1 }, { "parts", 2 }, { "roots", 1 }, { "levels", 6 } });
    stages["means"].ForEach(this->Count, levelGrain, [&](std::int64_t t) {
      this->Levels[t] = this->Density.MeanOf(t);
      this->PartOf.data()[t] = t;
    });
    // Without jumps all triangles are one part, and each has its own density.
    bool hasJumps = false;
    this->ForSides(stages["parts"], [&](std::int64_t side, std::int64_t other) {
      const bool isJump = this->IsJump(side, other);
      hasJumps = hasJumps || isJump;
      if (!isJump)
      {
        uniteSets(this->PartOf.data(), side / 3, other / 3);
      }
    });
    stages["roots"].ForEachInOrder(this->Count, levelGrain,
      [&](std::int64_t t) { this->PartOf.data()[t] = rootOf(this->PartOf.data(), t); });
    if (hasJumps)
    {
      Stages steps(
        stages["levels"], { { "measures", 2 }, { "wide", 1 }, { "jumps", 1 }, { "noise", 2 } });
      this->Measure(steps["measures"]);
      this->FindWide(steps["wide"]);
      this->CloseJumps(steps["jumps"]);
      this->SmoothNoise(steps["noise"]);
    }
    else
    {
      stages["levels"].ForEachInOrder(
        this->Count, levelGrain, [&](std::int64_t t) { this->SetLevel(t); });
    }
  }

private:
  // Calls visit(side, other) once for each pair of sides that are neighbours.
  template <class Visit>
  void ForSides(Progress& progress, const Visit& visit)
  {
    progress.ForEachInOrder(this->Count, levelGrain, [&](std::int64_t t) {
      for (std::int64_t side = 3 * t; side < 3 * t + 3; ++side)
      {
        const std::int64_t other = this->Tracer.Across(side);
        if (other > side)
        {
          visit(side, other);
        }
      }
    });
  }

  // Whether the density jumps between the means of two triangles, by a factor above 2. A linear
  // density is continuous: it jumps if it changes so much within a spacing, |way|^2 density <
  // mass of a dot.
  bool IsJump(std::int64_t side, std::int64_t other) const
  {
    const std::int64_t a = side / 3;
    const std::int64_t b = other / 3;
    const double low = std::min(this->Levels[a], this->Levels[b]);
    const double high = std::max(this->Levels[a], this->Levels[b]);
    if (high <= largestStep * low)
    {
      return false;
    }
    if (low == 0.0 || !this->Density.IsLinear())
    {
      return true;
    }
    const Point<3> way = (1.0 / 3.0) * (this->SumOfCorners(a) - this->SumOfCorners(b));
    return dot(way, way) * high < this->MassOfDot;
  }
  // Three times the centre of a triangle.
  Point<3> SumOfCorners(std::int64_t t) const
  {
    return this->Tracer.Corner(t, 0) + this->Tracer.Corner(t, 1) + this->Tracer.Corner(t, 2);
  }

  // Returns the length of a side in the tracer's frame, where the surface is in a unit box.
  double LengthOf(std::int64_t side) const
  {
    const Point<3> edge = this->Tracer.Edge(side);
    return std::sqrt(dot(edge, edge));
  }

  // Sums mass, area and border of each part, and what is beside it.
  void Measure(Progress& progress)
  {
    this->Parts = { this->Count, Part{} };
    progress.ForEachInOrder(this->Count, levelGrain, [&](std::int64_t t) {
      // Before they become levels, Levels are the triangles' mean densities.
      Part& part = this->Parts.data()[this->PartOf.data()[t]];
      const double area = this->Tracer.Area(t);
      part.Area += area;
      part.Mass += area * this->Levels[t];
    });
    this->ForSides(progress, [&](std::int64_t side, std::int64_t other) {
      // Each of the two parts gets the length of the side, and the triangle beyond.
      const std::int64_t sides[2] = { side, other };
      for (int i = 0; i < 2; ++i)
      {
        // A side between parts counts for both.
        const std::int64_t beside = sides[1 - i] / 3;
        if (this->PartOf.data()[sides[i] / 3] != this->PartOf.data()[beside])
        {
          Part& part = this->Parts.data()[this->PartOf.data()[sides[i] / 3]];
          const double area = this->Tracer.Area(beside);
          part.Border += this->LengthOf(side);
          part.AreaAround += area;
          part.MassAround += area * this->Levels[beside];
        }
      }
    });
  }

  // A part is wide if it is at least about a spacing wide and has the mass of several dots. Where
  // the density is 0, no spacing exists; that of the triangles beside the part counts.
  void FindWide(Progress& progress)
  {
    this->IsWide = LargeBuffer<char>(this->Count);
    progress.ForEachInOrder(this->Count, levelGrain, [&](std::int64_t t) {
      if (this->PartOf.data()[t] != t)
      {
        return;
      }
      const Part& part = this->Parts.data()[t];
      const bool isEmpty = part.Mass == 0.0;
      const double mass = isEmpty ? part.MassAround : part.Mass;
      const double area = isEmpty ? part.AreaAround : part.Area;
      // The condition has width = 2 area / border and spacing^2 = massOfDot area / mass; as a
      // product it needs neither a division nor a root.
      const double width = 2.0 * part.Area;
      const double least = leastWidth * part.Border;
      this->IsWide.data()[t] = part.Border == 0.0 ||
        ((isEmpty || part.Mass >= fewestDots * this->MassOfDot) &&
          width * width * mass >= least * least * this->MassOfDot * area);
    });
  }
  // The flag is stored at the root of the triangle's part.
  bool InWide(std::int64_t t) const { return this->IsWide.data()[this->PartOf.data()[t]]; }

  // Closes sides at jumps: with walls, or with boundaries towards density 0, where dots are
  // mirrored.
  void CloseJumps(Progress& progress)
  {
    this->SeenBy = { this->Count, -1 };
    this->ForSides(progress, [&](std::int64_t side, std::int64_t other) {
      const std::int64_t a = side / 3;
      const std::int64_t b = other / 3;
      // A side is closed where two wide parts meet, or one meets itself, across a jump.
      if (this->InWide(a) && this->InWide(b) && this->Tracer.Area(a) > 0.0 &&
        this->Tracer.Area(b) > 0.0 && this->IsJump(side, other) &&
        (this->PartOf.data()[a] != this->PartOf.data()[b] ||
          this->JumpsAround(side, other, progress)))
      {
        const bool isEmpty = this->Levels[a] == 0.0 || this->Levels[b] == 0.0;
        // A dot must not walk over the jump: the numbers of dots on both sides stay those of their
        // masses.
        const std::int64_t with = isEmpty ? GeodesicTracer::Boundary : GeodesicTracer::Wall;
        this->Tracer.Close(side, with);
        this->Tracer.Close(other, with);
      }
    });
  }

  // Where a part meets itself, whether the means of the triangles around both sides of an edge
  // jump, too. In a part with noise they do not.
  bool JumpsAround(std::int64_t side, std::int64_t other, Progress& progress)
  {
    constexpr std::size_t mostTriangles = 32;
    double means[2];
    for (int i = 0; i < 2; ++i)
    {
      const std::int64_t start = i == 0 ? side : other;
      means[i] = this->MeanAround(start / 3, start, mostTriangles, progress,
        [this](std::int64_t a, std::int64_t b) { return !this->IsJump(a, b); });
    }
    return std::max(means[0], means[1]) > largestStep * std::min(means[0], means[1]);
  }

  // The mean density of the nearest triangles over edges, breadth first, until they have the
  // mass of several dots. Leaves them in Queue, and marks them, and some more, by `mark`.
  template <class IsWay>
  double MeanAround(std::int64_t start, std::int64_t mark, std::size_t mostTriangles,
    Progress& progress, const IsWay& isWay)
  {
    double mass = 0.0;
    double area = 0.0;
    this->Queue.assign(1, start);
    this->SeenBy.data()[start] = mark;
    std::size_t next = 0;
    for (;
         next < std::min(this->Queue.size(), mostTriangles) && mass < fewestDots * this->MassOfDot;
         ++next)
    {
      const std::int64_t t = this->Queue[next];
      const double own = this->Tracer.Area(t);
      area += own;
      mass += own * this->Levels[t];
      for (std::int64_t side = 3 * t; side < 3 * t + 3; ++side)
      {
        const std::int64_t other = this->Tracer.Across(side);
        if (other >= 0 && this->SeenBy.data()[other / 3] != mark && isWay(side, other))
        {
          this->SeenBy.data()[other / 3] = mark;
          this->Queue.push_back(other / 3);
        }
      }
    }
    this->Queue.resize(next);
    progress.Add(static_cast<std::int64_t>(next));
    return area > 0.0 ? mass / area : 0.0;
  }

  // The level of a triangle whose own density counts.
  void SetLevel(std::int64_t t)
  {
    this->Levels[t] = this->Levels[t] > 0.0 ? DensityLevels::Given : 0.0;
  }

  // Gives each triangle that has noise the mean of the triangles around it; all noisy triangles of
  // that search get the same mean.
  void SmoothNoise(Progress& progress)
  {
    LargeBuffer<double> smooth(this->Count, DensityLevels::Given);
    std::fill_n(this->SeenBy.data(), this->Count, std::int64_t{ -1 });
    progress.ForEachInOrder(this->Count, levelGrain, [&](std::int64_t start) {
      if (this->InWide(start) || smooth.data()[start] >= 0.0)
      {
        return;
      }
      constexpr auto all = static_cast<std::size_t>(-1);
      // The search passes all jumps, because they are noise here, but not the walls that are
      // closed.
      const double mean = this->MeanAround(
        start, start, all, progress, [](std::int64_t, std::int64_t) { return true; });
      for (const std::int64_t t : this->Queue)
      {
        if (!this->InWide(t) && smooth.data()[t] < 0.0)
        {
          smooth.data()[t] = mean;
        }
      }
    });
    progress.ForEachInOrder(this->Count, levelGrain, [&](std::int64_t t) {
      if (this->Levels[t] > 0.0 && smooth.data()[t] > 0.0)
      {
        this->Levels[t] = smooth.data()[t];
      }
      else
      {
        this->SetLevel(t);
      }
    });
  }

  GeodesicTracer& Tracer;
  const SurfaceDensity& Density;
  const double MassOfDot;
  double* Levels; // by triangles; at first mean densities
  const std::int64_t Count;
  LargeBuffer<std::int64_t> PartOf; // roots, by triangles
  LargeBuffer<Part> Parts;          // by roots
  LargeBuffer<char> IsWide;         // by roots
  LargeBuffer<std::int64_t> SeenBy; // the last search that has met a triangle
  std::vector<std::int64_t> Queue;
};

} // namespace

DensityLevels::DensityLevels(
  GeodesicTracer& tracer, const SurfaceDensity& density, double massOfDot, Progress& progress)
  : Levels(tracer.NumberOfTriangles())
{
  LevelsRun(tracer, density, massOfDot, this->Levels.data()).Run(progress);
}

double DensityLevels::MemoryFor(std::int64_t triangles)
{
  return static_cast<double>(triangles) * (8.0 + 8.0 + sizeof(Part) + 1.0 + 16.0);
}

} // namespace RectifiedTransport
