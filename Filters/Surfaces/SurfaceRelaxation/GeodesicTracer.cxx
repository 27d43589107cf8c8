// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceRelaxation/GeodesicTracer.h"

#include "Core/Geometry/CoincidentPoints.h"
#include "Core/Geometry/PointBounds.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/EdgeSides.h"
#include "Surfaces/Mesh/Repair/TJunctions.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t walkGrain = std::int64_t{ 1 } << 12;

// Triangles lower than this part of their longest sides have no area.
constexpr double flatHeight = 1e-12;
// Nor have those so small beside the surface that their squared normals have no inverse.
constexpr double leastSquaredNormal = 1e-290;

// squaredNormal = (2 area)^2 and height = 2 area / side, so that the test is height <= 1e-12 side,
// without roots. The sum of two squared sides stands for the longest one.
bool isFlat(double squaredNormal, double squaredSides)
{
  return !(squaredNormal > flatHeight * flatHeight * squaredSides * squaredSides) ||
    squaredNormal < leastSquaredNormal;
}

} // namespace

GeodesicTracer::GeodesicTracer(const TriangleSurface& surface, double rounding, Progress& progress)
  : GivenSurface(surface)
  , Triangles(surface.Triangles)
  , Count(surface.NumberOfTriangles)
{
  if (this->Count == 0)
  {
    throw std::invalid_argument("the surface has no triangles");
  }
  Stages stages(progress,
    { { "bounds", 10 }, { "positions", 10 }, { "equal points", 30 }, { "sides", 40 },
      { "T-junctions", 5 }, { "sides of parts", 5 } });
  // Only points of triangles count; the others may have any coordinates.
  const PointBounds bounds = reduceEach(
    stages["bounds"], this->Count, walkGrain, PointBounds(),
    [&](std::int64_t triangle, PointBounds& part) {
      for (std::int64_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner)
      {
        const std::int64_t point = cornerPoint(surface, corner);
        const double* x = surface.Points[point];
        if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
        {
          throw std::invalid_argument("point " + std::to_string(point) + " is not finite");
        }
        part.Add(x);
      }
    },
    [](PointBounds all, const PointBounds& more) {
      all.Add(more);
      return all;
    });
  Point<3> centre;
  double half = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    centre[axis] = 0.5 * bounds.Low[axis] + 0.5 * bounds.High[axis];
    half = std::max(half, 0.5 * bounds.High[axis] - 0.5 * bounds.Low[axis]);
  }
  // The scale is a power of two, so that scaling does not round. It is applied in two steps,
  // neither of which overflows.
  int exponent = 0;
  std::frexp(half, &exponent);
  const double scales[2] = { std::ldexp(1.0, -exponent / 2),
    std::ldexp(1.0, -exponent - -exponent / 2 - 1) };
  const std::int64_t points = surface.Points.size();
  this->Positions = LargeBuffer<double>(3 * points);
  stages["positions"].ForEach(points, walkGrain, [&](std::int64_t point) {
    const Point<3> x = scales[1] * (scales[0] * (pointAt(surface.Points, point) - centre));
    std::copy(x.begin(), x.end(), this->Positions.data() + 3 * point);
  });
  LargeBuffer<std::int64_t> welded(points);
  mergePoints<3>(surface.Points, welded.data(), stages["equal points"]);
  for (std::int64_t point = 0; point < points; ++point)
  {
    this->NumberWelded += welded.data()[point] != point ? 1 : 0;
  }
  this->PairSides(welded.data(), points, stages["sides"]);
  if (this->Cut(welded.data(), rounding, stages["T-junctions"]))
  {
    this->PairSides(welded.data(), points, stages["sides of parts"]);
  }
}

double GeodesicTracer::MemoryFor(std::int64_t points, std::int64_t triangles)
{
  // Positions, sides and parts of triangles stay; the welded points with their hash table, or the
  // sorted sides, go.
  return 24.0 * static_cast<double>(points) + 56.0 * static_cast<double>(triangles) +
    std::max(40.0 * static_cast<double>(points),
      16.0 * static_cast<double>(points) + 24.0 * static_cast<double>(triangles));
}

double GeodesicTracer::Area(std::int64_t triangle) const
{
  const Point<3> a = this->Corner(triangle, 0);
  const Point<3> b = this->Corner(triangle, 1) - a;
  const Point<3> c = this->Corner(triangle, 2) - a;
  // |b x c| / 2, with b and c the sides from corner 0.
  const Point<3> normal = cross(b, c);
  const double squared = dot(normal, normal);
  return isFlat(squared, dot(b, b) + dot(c, c)) ? 0.0 : 0.5 * std::sqrt(squared);
}

// Finds for each side the one across. Points at one place count as one.
// Each side is written by the thread that visits its edge alone; counts are atomic integers, so
// that nothing depends on threads.
void GeodesicTracer::PairSides(const std::int64_t* welded, std::int64_t points, Progress& progress)
{
  this->Sides = { 3 * this->Count, Boundary };
  std::atomic<std::int64_t> open{ 0 };
  std::atomic<std::int64_t> nonManifold{ 0 };
  visitEdges(
    this->Count, points, [=](std::int64_t corner) { return welded[this->Triangles[corner]]; },
    [=](std::int64_t triangle) { return this->IsLine(triangle, welded); }, progress,
    [&](const std::int64_t* sides, std::int64_t count) {
      open += count == 1 ? 1 : 0;
      nonManifold += count > 2 ? 1 : 0;
      this->PairEdge(sides, count);
    });
  this->NumberOpen = open;
  this->NumberNonManifold = nonManifold;
}

// Whether a triangle has a point twice. It is a line, which other triangles have as an edge.
bool GeodesicTracer::IsLine(std::int64_t triangle, const std::int64_t* welded) const
{
  const std::int64_t* t = this->Triangle(triangle);
  return welded[t[0]] == welded[t[1]] || welded[t[1]] == welded[t[2]] ||
    welded[t[2]] == welded[t[0]];
}

// Cuts triangles at T-junctions; returns whether there are any.
bool GeodesicTracer::Cut(const std::int64_t* welded, double rounding, Progress& progress)
{
  std::vector<OpenSide> open;
  open.reserve(static_cast<std::size_t>(this->NumberOpen));
  const auto at = [&](std::int64_t corner) { return welded[this->Triangles[corner]]; };
  const std::int64_t sides = this->NumberOpen > 0 ? 3 * this->Count : 0;
  for (std::int64_t side = 0; side < sides; ++side)
  {
    if (this->Across(side) == Boundary && !this->IsLine(side / 3, welded))
    {
      open.push_back({ side, at(side), at(nextSide(side)), at(lastSide(side)) });
    }
    progress.Add(1);
  }
  if (open.empty())
  {
    return false;
  }
  const std::vector<TJunction> junctions =
    findTJunctions(this->GivenSurface.Points, open, rounding, progress);
  if (junctions.empty())
  {
    return false;
  }
  this->Split.emplace(this->GivenSurface, junctions, progress);
  this->Triangles = this->Split->Triangles();
  this->Count = this->Split->NumberOfTriangles();
  return true;
}

// Pairs the sides of one edge. At an edge of more than two triangles, the pair that continues most
// straightly (the least cosine of the directions into the triangles, near -1) comes first. What is
// left alone ends there.
void GeodesicTracer::PairEdge(const std::int64_t* sides, std::int64_t count)
{
  const auto pair = [this](std::int64_t a, std::int64_t b) {
    this->Sides.data()[a] = b;
    this->Sides.data()[b] = a;
  };
  if (count == 2)
  {
    pair(sides[0], sides[1]);
  }
  if (count <= 2)
  {
    return;
  }
  std::vector<std::int64_t> left(sides, sides + count);
  // Edges of more take cubic time; their sides are paired in order.
  constexpr std::size_t mostCompared = 32;
  if (left.size() > mostCompared)
  {
    for (std::int64_t i = 0; i < count / 2; ++i)
    {
      pair(sides[i], sides[i + count / 2]);
    }
    left.assign(sides + count / 2 * 2, sides + count);
  }
  while (left.size() > 1)
  {
    std::size_t first = 0;
    std::size_t second = 1;
    double least = 2.0;
    for (std::size_t i = 0; i < left.size(); ++i)
    {
      const Point<3> inwards = this->Inwards(left[i]);
      for (std::size_t j = i + 1; j < left.size(); ++j)
      {
        const double cosine = dot(inwards, this->Inwards(left[j]));
        if (cosine < least)
        {
          least = cosine;
          first = i;
          second = j;
        }
      }
    }
    pair(left[first], left[second]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(second));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(first));
  }
  if (!left.empty())
  {
    this->Sides.data()[left[0]] = Wall;
  }
}

// The unit vector from a side into its triangle, perpendicular to the side; 0 for flat triangles.
Point<3> GeodesicTracer::Inwards(std::int64_t side) const
{
  const Point<3> edge = this->Edge(side);
  const Point<3> to = this->Start(lastSide(side)) - this->Start(side);
  const Point<3> inwards = to - (dot(to, edge) / dot(edge, edge)) * edge;
  const double squared = dot(inwards, inwards);
  return squared > 0.0 ? (1.0 / std::sqrt(squared)) * inwards : Point<3>{ 0.0, 0.0, 0.0 };
}

// The unit vector along a side.
Point<3> GeodesicTracer::Along(std::int64_t side) const
{
  const Point<3> edge = this->Edge(side);
  return (1.0 / std::sqrt(dot(edge, edge))) * edge;
}

// The side of a triangle with area that is across a side at one of its points. Flat triangles
// between are passed through the side that has the point. Without such a triangle, Boundary or
// Wall.
std::int64_t GeodesicTracer::Beyond(std::int64_t side, const Point<3>& x) const
{
  constexpr int mostFlat = 1000;
  std::int64_t at = this->Across(side);
  for (int i = 0; i < mostFlat && at >= 0 && this->Area(at / 3) == 0.0; ++i)
  {
    // Through the one of both other sides that has the point.
    double least = std::numeric_limits<double>::infinity();
    std::int64_t through = at;
    for (const std::int64_t other : { nextSide(at), lastSide(at) })
    {
      const Point<3> a = this->Start(other);
      const Point<3> edge = this->Edge(other);
      const double squared = dot(edge, edge);
      const double place = squared > 0.0 ? std::clamp(dot(x - a, edge) / squared, 0.0, 1.0) : 0.0;
      const Point<3> gap = x - a - place * edge;
      if (dot(gap, gap) < least)
      {
        least = dot(gap, gap);
        through = other;
      }
    }
    at = this->Across(through);
  }
  return at >= 0 && this->Area(at / 3) == 0.0 ? Wall : at;
}

// What a geodesic needs of a triangle: weight b of corner 1 has the gradient (c x n) / |n|^2,
// weight c of corner 2 has (n x b) / |n|^2, where n = b x c. The weights sum to 1.
struct GeodesicTracer::Frame
{
  Frame(const GeodesicTracer& surface, std::int64_t triangle)
    : A(surface.Corner(triangle, 0))
  {
    const Point<3> b = surface.Corner(triangle, 1) - this->A;
    const Point<3> c = surface.Corner(triangle, 2) - this->A;
    this->Normal = cross(b, c);
    this->PerSquare = 1.0 / dot(this->Normal, this->Normal);
    this->ToB = this->PerSquare * cross(c, this->Normal);
    this->ToC = this->PerSquare * cross(this->Normal, b);
  }

  // How the three barycentric weights change by a vector.
  std::array<double, 3> Change(const Point<3>& by) const
  {
    const double b = dot(this->ToB, by);
    const double c = dot(this->ToC, by);
    return { -b - c, b, c };
  }
  // Weights at A are (1, 0, 0).
  std::array<double, 3> Weights(const Point<3>& x) const
  {
    std::array<double, 3> weights = this->Change(x - this->A);
    weights[0] += 1.0;
    return weights;
  }

  Point<3> A;
  Point<3> Normal;
  double PerSquare; // 1 / |Normal|^2
  Point<3> ToB;
  Point<3> ToC;
};

// A geodesic in pieces: straight within a triangle up to the side whose weight becomes 0 first,
// then unfolded about that side, which keeps the components along and across it.
void GeodesicTracer::Trace(SurfacePlace& place, const Point<3>& by, const double* levels) const
{
  constexpr int mostCrossings = 1 << 16;
  constexpr int mostSlides = 4;     // at one corner
  constexpr int mostStanding = 100; // crossings without a way: around a point
  SurfacePlace kept = place;
  Frame frame(*this, place.Triangle);
  // The part of the step in the triangle's plane.
  Point<3> left = by - (frame.PerSquare * dot(by, frame.Normal)) * frame.Normal;
  std::size_t from = 3; // the corner opposite to the side that is just left behind
  int slides = 0;
  int standing = 0;
  for (int crossing = 0; crossing < mostCrossings; ++crossing)
  {
    const std::array<double, 3> weights = frame.Weights(place.X);
    const std::array<double, 3> change = frame.Change(left);
    // The first weight w_i + s change_i to reach 0 ends the straight piece, at s = -w_i / change_i.
    double part = 1.0;
    std::size_t through = 3;
    // Rounding may leave a weight below 0 at the side of entry, which does not count as a side to
    // leave by.
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (i != from && weights[i] + change[i] < 0.0)
      {
        const double until = weights[i] > 0.0 ? weights[i] / -change[i] : 0.0;
        if (change[i] < 0.0 && until < part)
        {
          part = until;
          through = i;
        }
      }
    }
    place.X = place.X + part * left;
    if (through == 3)
    {
      break;
    }
    // What is left of the way after the crossing.
    left = (1.0 - part) * left;
    standing = part > 0.0 ? 0 : standing + 1;
    slides = part > 0.0 ? 0 : slides;
    const std::int64_t side = 3 * place.Triangle + static_cast<std::int64_t>(through + 1) % 3;
    Point<3> edge = this->Along(side);
    // Unfolding keeps the component along the side, and turns the one across it into the next
    // triangle's plane.
    // left^2 = along^2 + across^2; rounding may make the difference negative.
    const double along = dot(left, edge);
    const double across = std::sqrt(std::max(0.0, dot(left, left) - along * along));
    const std::int64_t beyond = this->Beyond(side, place.X);
    if (beyond < 0)
    {
      // At a corner between two boundaries a slide leads to and fro.
      if (++slides > mostSlides || standing > mostStanding)
      {
        // At a boundary, only the component along it goes on: the walk slides. Corners stop it
        // after some slides.
        break;
      }
      left = along * edge;
      from = through;
      continue;
    }
    if (standing > mostStanding)
    {
      break;
    }
    // The last place before a triangle of density 0, to which the walk returns if it ends in one.
    if (levels && levels[beyond / 3] == 0.0 && levels[place.Triangle] > 0.0)
    {
      kept = place;
    }
    place.Triangle = beyond / 3;
    frame = Frame(*this, place.Triangle);
    from = static_cast<std::size_t>(lastSide(beyond) % 3);
    // Through flat triangles, the side may have another direction.
    const Point<3> next = this->Along(beyond);
    edge = dot(next, edge) < 0.0 ? -1.0 * next : next;
    Point<3> inwards = this->Start(lastSide(beyond)) - this->Start(beyond);
    inwards = inwards - dot(inwards, edge) * edge;
    inwards = (1.0 / std::sqrt(dot(inwards, inwards))) * inwards;
    left = along * edge + across * inwards;
  }
  if (levels && levels[place.Triangle] == 0.0)
  {
    place = kept;
  }
  // Onto the triangle, off which rounding may have led.
  const PlaceOnTriangle on = this->WeightsOf(place);
  place.X = { 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    place.X = place.X + on.Weights[i] * this->Corner(place.Triangle, static_cast<std::int64_t>(i));
  }
}

// Negative weights, by rounding, become 0; the others are scaled to the sum 1.
PlaceOnTriangle GeodesicTracer::WeightsOf(const SurfacePlace& place) const
{
  PlaceOnTriangle on{ place.Triangle, Frame(*this, place.Triangle).Weights(place.X) };
  double sum = 0.0;
  for (double& weight : on.Weights)
  {
    weight = std::max(weight, 0.0);
    sum += weight;
  }
  for (double& weight : on.Weights)
  {
    weight /= sum;
  }
  return on;
}

} // namespace RectifiedTransport
