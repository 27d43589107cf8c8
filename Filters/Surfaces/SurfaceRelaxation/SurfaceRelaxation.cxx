// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceRelaxation/SurfaceRelaxation.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Geometry/Trees/ItemTree.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Parallel/Stages.h"
#include "Core/Tables/Density.h"
#include "Surfaces/Mesh/SurfaceEdges.h"
#include "Surfaces/SurfaceRelaxation/DensityLevels.h"
#include "Surfaces/SurfaceRelaxation/DotTree.h"
#include "Surfaces/SurfaceRelaxation/GeodesicTracer.h"
#include "Surfaces/SurfaceRelaxation/StratifiedSampling.h"
#include "Surfaces/SurfaceRelaxation/SurfaceDensity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// A test of a box costs less than a side's distance; 16 sides keep the tree small.
constexpr std::int64_t sidesOfLeaf = 16;

// The boundary of a surface, and what is near it. A tree of the bounding boxes of the sides that
// are boundaries of triangles with area.
class SurfaceBoundary
{
public:
  // Keeps a view of the surface. Throws std::bad_alloc and Cancelled.
  SurfaceBoundary(const GeodesicTracer& tracer, Progress& progress)
    : Tracer(tracer)
  {
    // Counted first, so that the memory is what they need.
    const auto forSides = [&](const auto& visit) {
      for (std::int64_t triangle = 0; triangle < tracer.NumberOfTriangles(); ++triangle)
      {
        for (std::int64_t side = 3 * triangle; side < 3 * triangle + 3; ++side)
        {
          if (tracer.Across(side) == GeodesicTracer::Boundary && tracer.Area(triangle) > 0.0)
          {
            visit(side);
          }
        }
        progress.Add(1);
      }
    };
    std::size_t count = 0;
    forSides([&](std::int64_t) { ++count; });
    std::vector<std::int64_t> sides;
    sides.reserve(count);
    forSides([&](std::int64_t side) { sides.push_back(side); });
    this->Sides.emplace(
      std::move(sides), sidesOfLeaf,
      [&tracer](std::int64_t side, PointBounds& box) {
        box.Add(tracer.Start(side).data());
        box.Add(tracer.Start(nextSide(side)).data());
      },
      [&tracer](std::int64_t side, std::size_t axis) {
        // Sides are divided by their middles.
        return 0.5 * (tracer.Start(side)[axis] + tracer.Start(nextSide(side))[axis]);
      },
      progress);
  }

  // Bytes that it takes at most, about, for a number of sides.
  static double MemoryFor(double sides)
  {
    // Leaves are half full or more, about; the vector of boxes doubles as it grows.
    return sides * (sizeof(std::int64_t) + 3.0 * 2.0 * sizeof(ItemBox) / (0.5 * sidesOfLeaf));
  }

  // The sides that may be nearer to a box than a distance. The gap between boxes bounds the
  // distance of their contents from below.
  void FindNear(const DotBox& box, double distance, std::vector<std::int64_t>& found) const
  {
    found.clear();
    this->Sides->VisitNear(
      [&](const PointBounds& part) {
        double squared = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const double gap =
            std::max({ part.Low[axis] - box.High[axis], box.Low[axis] - part.High[axis], 0.0 });
          squared += gap * gap;
        }
        return squared < distance * distance;
      },
      [&found](std::int64_t side) { found.push_back(side); });
  }

  // The vector to a point from the nearest point of some sides. The projection on each side is
  // clamped to its ends.
  Point<3> FromNearest(const std::vector<std::int64_t>& sides, const Point<3>& x) const
  {
    double least = std::numeric_limits<double>::infinity();
    Point<3> nearest{ least, least, least };
    for (const std::int64_t side : sides)
    {
      const Point<3> from = x - this->Tracer.Start(side);
      const Point<3> edge = this->Tracer.Edge(side);
      // The nearest point of a side is start + place edge, place = from . edge / |edge|^2 within
      // [0, 1].
      const double place = std::clamp(dot(from, edge) / dot(edge, edge), 0.0, 1.0);
      const Point<3> gap = from - place * edge;
      if (dot(gap, gap) < least)
      {
        least = dot(gap, gap);
        nearest = gap;
      }
    }
    return nearest;
  }

private:
  const GeodesicTracer& Tracer;
  std::optional<ItemTree> Sides; // ids of sides
};

// Factors of the pushes, chosen by experiment. Long steps at first, short ones at the end: with
// longer ones dots swing.
constexpr double firstStep = 2.8;
constexpr double lastStep = 1.4;
constexpr double longestStep = 0.3; // in spacings
// The weight of a dot's own mirror image. A boundary would need the images of all other dots, too.
// With this weight of its own one, as many dots are within a spacing of the boundary as elsewhere.
constexpr double mirrorWeight = 0.25;
// The sum of 1 - q^2 / R^2 over a lattice of one dot for each unit of area is the integral, R^2 pi
// / 2. Where the sum is larger by 1.2, sheets are nearer to each other than the spacing: dots there
// take a smaller one.
constexpr double mostCrowded = 1.2 * 0.5 * 3.14159265358979 * squaredDotReach;

constexpr std::int64_t relaxationGrain = std::int64_t{ 1 } << 12;

// The sums over all triangles.
struct Sum
{
  double Area = 0.0;
  double Mass = 0.0;
};

// Sums over fixed chunks: the total mass, and all that follows, has the same bits for any number of
// threads.
Sum measure(const GeodesicTracer& surface, const SurfaceDensity& density, Progress& progress)
{
  return reduceEach(
    progress, surface.NumberOfTriangles(), relaxationGrain, Sum(),
    [&](std::int64_t t, Sum& sum) {
      const double area = surface.Area(t);
      sum.Area += area;
      sum.Mass += area * density.MeanOf(t);
    },
    [](Sum all, const Sum& more) {
      all.Area += more.Area;
      all.Mass += more.Mass;
      return all;
    });
}

// Gradient descent of the dots' repulsion, all dots at once from the places of the iteration before
// (Jacobi): the result does not depend on the order or on threads.
class DotRelaxation
{
public:
  DotRelaxation(const GeodesicTracer& surface, const SurfaceDensity& density, const double* levels,
    double massOfDot, LargeBuffer<SurfacePlace> start, Progress& progress)
    : Surface(surface)
    , Density(density)
    , Levels(levels)
    , MassOfDot(massOfDot)
    , Places(std::move(start))
    , Dots(this->Places.size())
    , Squares(this->Places.size())
    , Shares(this->Places.size())
    , Tree(this->Places.size())
    , Boundary(surface, progress)
  {
  }

  // One iteration. `part` goes from 0 in the first to 1 in the last one, and the factor of the
  // steps from firstStep to lastStep.
  void Iterate(double part, Progress& progress)
  {
    progress.Expect(this->Dots.size() + 2 * this->Tree.Blocks());
    this->Step = firstStep + part * (lastStep - firstStep);
    const bool isFirst = !this->HasSquares;
    this->HasSquares = true;
    progress.ForEach(this->Dots.size(), relaxationGrain, [&](std::int64_t i) {
      const SurfacePlace& place = this->Places.data()[i];
      const double square = this->SquaredSpacing(place);
      if (isFirst)
      {
        this->Squares.data()[i] = square;
        this->Shares.data()[i] = 1.0;
      }
      // The spacing that dots push with is the mean over neighbours from the iteration before, less
      // where it is crowded. At first, it is that of the density at the dot.
      const double used = this->Shares.data()[i] * this->Squares.data()[i];
      const double inverse = 1.0 / std::sqrt(used);
      this->Dots.data()[i] = { { place.X[0], place.X[1], place.X[2] }, inverse, std::sqrt(inverse),
        square };
    });
    this->Tree.Update(this->Dots.data(), progress);
    // Eight blocks search the tree together; each one then selects from what was found.
    constexpr std::int64_t blocksOfGroup = 8;
    constexpr std::int64_t blockGrain = 4 * blocksOfGroup;
    progress.For(
      this->Tree.Blocks(), blockGrain,
      [&](std::int64_t first, std::int64_t last) {
        Scratch scratch;
        for (std::int64_t group = first; group < last; group += blocksOfGroup)
        {
          const std::int64_t end = std::min(group + blocksOfGroup, last);
          this->Tree.FindNearby(group, end, scratch.InReachOfGroup);
          for (std::int64_t block = group; block < end; ++block)
          {
            this->Move(block, scratch);
          }
        }
      },
      blockGrain);
  }

  LargeBuffer<PlaceOnTriangle> Result(Progress& progress) const
  {
    LargeBuffer<PlaceOnTriangle> places(this->Places.size());
    progress.ForEach(places.size(), relaxationGrain, [&](std::int64_t i) {
      places.data()[i] = this->Surface.GivenPlace(this->Surface.WeightsOf(this->Places.data()[i]));
    });
    return places;
  }

private:
  // Memory of a thread, kept from block to block.
  struct Scratch
  {
    std::vector<std::int64_t> InReachOfGroup; // blocks
    std::vector<std::int64_t> Neighbourhood;
    std::vector<std::int64_t> Sides;
    DotBlock Block;
  };

  // The squared spacing h^2 at a place: times the density, it is the mass of a dot.
  double SquaredSpacing(const SurfacePlace& place) const
  {
    double density = 1.0;
    if (this->Levels)
    {
      const double level = this->Levels[place.Triangle];
      density = level > 0.0        ? level
        : this->Density.IsLinear() ? this->LinearDensity(place)
                                   : this->Density.MeanOf(place.Triangle);
    }
    return this->MassOfDot / density;
  }

  // The density of a linear one, but not less than the mean of a dot's surroundings where it goes
  // to 0: there the spacing s and the density d = gradient s meet, d s^2 = m, so that d = (gradient
  // sqrt(m))^(2/3).
  double LinearDensity(const SurfacePlace& place) const
  {
    const std::array<double, 3> corners = this->Density.AtCorners(place.Triangle);
    const PlaceOnTriangle on = this->Surface.WeightsOf(place);
    double density = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      density += on.Weights[i] * corners[i];
    }
    const Point<3> a = this->Surface.Corner(place.Triangle, 0);
    const Point<3> b = this->Surface.Corner(place.Triangle, 1) - a;
    const Point<3> c = this->Surface.Corner(place.Triangle, 2) - a;
    const double rise = std::max({ corners[0], corners[1], corners[2] }) -
      std::min({ corners[0], corners[1], corners[2] });
    const double gradient = rise / std::sqrt(std::max(dot(b, b), dot(c, c)));
    const double root = cubeRoot(gradient * std::sqrt(this->MassOfDot));
    return std::max(density, 0.5 * root * root);
  }

  // Moves the dots of a block by their pushes.
  void Move(std::int64_t block, Scratch& scratch)
  {
    DotBlock& own = scratch.Block;
    const std::int64_t first = block * dotBlock;
    const std::int64_t count = std::min<std::int64_t>(dotBlock, this->Dots.size() - first);
    // Empty lanes of the last block repeat its last dot.
    for (int lane = 0; lane < dotBlock; ++lane)
    {
      const ScaledDot& dot = this->Dots.data()[first + std::min<std::int64_t>(lane, count - 1)];
      for (int axis = 0; axis < 3; ++axis)
      {
        own.X[axis][lane] = dot.X[axis];
      }
      own.Inverse[lane] = dot.Inverse;
      // The layout of the kernel: coordinates by axes, a lane for each dot.
      own.Square[lane] = dot.Square;
    }
    this->Tree.Select(scratch.InReachOfGroup, block, scratch.Neighbourhood);
    const DotNeighbourhood inReach{ this->Dots.data(), this->Dots.size(),
      scratch.Neighbourhood.data(), static_cast<std::int64_t>(scratch.Neighbourhood.size()) };
    this->Sum(inReach, own);
    const DotBox& box = this->Tree.BoxOf(block);
    // A mirror image is twice as far as the boundary.
    this->Boundary.FindNear(box, 0.5 * std::sqrt(squaredDotReach) * box.Largest, scratch.Sides);
    for (std::int64_t lane = 0; lane < count; ++lane)
    {
      const ScaledDot& at = this->Dots.data()[first + lane];
      Point<3> push{ own.Push[0][lane], own.Push[1][lane], own.Push[2][lane] };
      if (!scratch.Sides.empty())
      {
        push = push + this->MirrorPush(at, scratch.Sides);
      }
      // The step is Step times the sum of (x - y) sqrt(h / k) b^8, at most longestStep spacings.
      Point<3> step = (this->Step * at.Root / at.Inverse) * push;
      const double squared = dot(step, step) * at.Inverse * at.Inverse;
      if (squared > longestStep * longestStep)
      {
        step = (longestStep / std::sqrt(squared)) * step;
      }
      this->Surface.Trace(this->Places.data()[first + lane], step, this->Levels);
      // The mean of the neighbours' squared spacings, weighted by b.
      this->Squares.data()[first + lane] = own.Mean[lane] / own.Weight[lane];
      double& share = this->Shares.data()[first + lane];
      // The square root damps the correction: the share approaches its value over some iterations.
      share = std::min(1.0, share * std::sqrt(mostCrowded / own.Weight[lane]));
    }
  }

  // The push of the dot's own mirror image behind the nearest place of the boundary: at twice the
  // vector from there, with the same spacing.
  Point<3> MirrorPush(const ScaledDot& at, const std::vector<std::int64_t>& sides) const
  {
    const Point<3> gap = 2.0 * this->Boundary.FromNearest(sides, { at.X[0], at.X[1], at.X[2] });
    const double bump = 1.0 - dot(gap, gap) * (at.Inverse * at.Inverse * (1.0 / squaredDotReach));
    if (!(bump > 0.0))
    {
      return { 0.0, 0.0, 0.0 };
    }
    const double squared = bump * bump;
    const double fourth = squared * squared;
    return (mirrorWeight * fourth * fourth * at.Root) * gap;
  }

  const GeodesicTracer& Surface;
  const SurfaceDensity& Density;
  const double* Levels; // null for a uniform density
  const double MassOfDot;
  LargeBuffer<SurfacePlace> Places;
  LargeBuffer<ScaledDot> Dots;
  // By dots: the squared spacings, and the part of them that dots take where it is crowded.
  LargeBuffer<double> Squares;
  LargeBuffer<double> Shares;
  DotTree Tree;
  const SurfaceBoundary Boundary;
  double Step = 0.0;
  bool HasSquares = false;
  const SumDots Sum = dotKernel();
};

// Checks what the stages do not: the options.
void check(const SurfaceRelaxationOptions& options)
{
  if (options.NumberOfSamples < 0)
  {
    throw std::invalid_argument("the number of samples is " +
      std::to_string(options.NumberOfSamples) + "; it must be at least 0");
  }
  if (options.Iterations < 0)
  {
    throw std::invalid_argument("the number of iterations is " +
      std::to_string(options.Iterations) + "; it must be at least 0");
  }
}

} // namespace

SurfaceRelaxation relaxOnSurface(const TriangleSurface& given, const SurfaceDensityValues& values,
  const SurfaceRelaxationOptions& options, const Context& context)
{
  check(options);
  Progress progress(context);
  Stages stages(progress,
    { { "surface", 10 }, { "density", 1 }, { "sums", 1 }, { "levels", 3 }, { "start", 15 },
      { "boundary", 2 }, { "iterations", 66 }, { "places", 2 } });
  GeodesicTracer surface(given, options.Rounding, stages["surface"]);
  const SurfaceDensity density(surface, values, stages["density"]);
  const Sum sum = measure(surface, density, stages["sums"]);
  if (!(sum.Area > 0.0))
  {
    throw std::invalid_argument("no triangle of the surface has an area");
  }
  if (!(sum.Mass > 0.0))
  {
    throw InvalidDensity(DensitySummary());
  }
  SurfaceRelaxation relaxed;
  relaxed.WeldedPoints = surface.WeldedPoints();
  relaxed.TJunctions = surface.TJunctions();
  relaxed.OpenEdges = surface.OpenEdges();
  relaxed.NonManifoldEdges = surface.NonManifoldEdges();
  if (options.NumberOfSamples == 0)
  {
    progress.EndSlice(1);
    return relaxed;
  }
  // Each dot stands for the same mass m; at the density d it has the area m / d.
  const double massOfDot = sum.Mass / static_cast<double>(options.NumberOfSamples);
  std::unique_ptr<DensityLevels> levels;
  if (!density.IsUniform())
  {
    levels = std::make_unique<DensityLevels>(surface, density, massOfDot, stages["levels"]);
  }
  LargeBuffer<SurfacePlace> start = drawDots(surface, density, sum.Mass, options, stages["start"]);
  DotRelaxation relaxation(surface, density, levels ? levels->data() : nullptr, massOfDot,
    std::move(start), stages["boundary"]);
  Parts iterations(stages["iterations"], options.Iterations);
  for (int i = 0; i < options.Iterations; ++i)
  {
    relaxation.Iterate(i / std::max(options.Iterations - 1.0, 1.0), iterations[i]);
  }
  relaxed.Places = relaxation.Result(stages["places"]);
  return relaxed;
}

double memoryForSurfaceRelaxation(
  std::int64_t points, std::int64_t triangles, bool hasDensity, std::int64_t samples)
{
  // Positions (24 bytes a point), sides and parts (56 a triangle), and levels stay; the largest of
  // the stages is added.
  const double kept = 24.0 * static_cast<double>(points) + 56.0 * static_cast<double>(triangles) +
    (hasDensity ? 8.0 * static_cast<double>(triangles) : 0.0);
  const double levels = hasDensity ? DensityLevels::MemoryFor(triangles) : 0.0;
  const double dots = static_cast<double>(samples) *
      (sizeof(SurfacePlace) + sizeof(ScaledDot) + sizeof(PlaceOnTriangle) + 16.0) +
    DotTree::MemoryFor(samples) + SurfaceBoundary::MemoryFor(3.0 * static_cast<double>(triangles));
  constexpr double rounding = 0x1p23; // to whole huge pages
  return rounding +
    std::max(GeodesicTracer::MemoryFor(points, triangles),
      kept + std::max({ levels, memoryForDots(triangles, samples), dots }));
}

} // namespace RectifiedTransport
