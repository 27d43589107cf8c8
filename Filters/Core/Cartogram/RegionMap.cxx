// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/RegionMap.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace RectifiedTransport
{

namespace
{

struct Box
{
  Point<2> Low;
  Point<2> High;

  bool Contains(const Box& other) const
  {
    return this->Low[0] <= other.Low[0] && this->Low[1] <= other.Low[1] &&
      this->High[0] >= other.High[0] && this->High[1] >= other.High[1];
  }
};

struct Edge
{
  std::int64_t Low;
  std::int64_t High;
  bool operator==(const Edge& other) const
  {
    return this->Low == other.Low && this->High == other.High;
  }
};

struct EdgeHash
{
  std::size_t operator()(const Edge& edge) const
  {
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15u;
    const auto low = static_cast<std::uint64_t>(edge.Low);
    const auto high = static_cast<std::uint64_t>(edge.High);
    return static_cast<std::size_t>((low * odd ^ high) * odd);
  }
};

} // namespace

std::int64_t RegionMap::AddPoint(const Point<2>& place)
{
  this->Places.push_back(place);
  return static_cast<std::int64_t>(this->Places.size()) - 1;
}

void RegionMap::AddRing(std::int32_t region, const std::vector<std::int64_t>& points)
{
  this->Corners.insert(this->Corners.end(), points.begin(), points.end());
  this->Begins.push_back(static_cast<std::int64_t>(this->Corners.size()));
  this->Regions.push_back(region);
  this->Holes.push_back(0);
  this->Turned.push_back(0);
}

// Relative to the ring's first point, so that maps far from the origin lose no digits.
double RegionMap::WindingArea(std::int64_t ring) const
{
  const std::int64_t begin = this->Begins[Index(ring)];
  const std::int64_t end = this->Begins[Index(ring) + 1];
  if (begin == end)
  {
    return 0.0;
  }
  const Point<2>& origin = this->Places[Index(this->Corners[Index(begin)])];
  double sum = 0.0;
  for (std::int64_t i = begin + 1; i + 1 < end; ++i)
  {
    const Point<2>& a = this->Places[Index(this->Corners[Index(i)])];
    const Point<2>& b = this->Places[Index(this->Corners[Index(i + 1)])];
    sum += (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]);
  }
  return 0.5 * sum;
}

double RegionMap::AreaOf(std::int64_t ring) const
{
  const double area = this->WindingArea(ring);
  return (this->Turned[Index(ring)] != 0) != this->IsHole(ring) ? -area : area;
}

std::vector<double> RegionMap::Areas(std::int32_t regions) const
{
  std::vector<double> areas(static_cast<std::size_t>(regions), 0.0);
  for (std::int64_t ring = 0; ring < this->Rings(); ++ring)
  {
    const double area = this->AreaOf(ring);
    areas[Index(this->RegionOf(ring))] += this->IsHole(ring) ? -area : area;
  }
  return areas;
}

bool RegionMap::Contains(std::int64_t ring, const Point<2>& place) const
{
  bool isInside = false;
  const std::int64_t begin = this->Begins[Index(ring)];
  const std::int64_t end = this->Begins[Index(ring) + 1];
  for (std::int64_t i = begin; i < end; ++i)
  {
    const Point<2>& a = this->Places[Index(this->Corners[Index(i)])];
    const Point<2>& b = this->Places[Index(this->Corners[Index(i + 1 < end ? i + 1 : begin)])];
    if ((a[1] > place[1]) != (b[1] > place[1]))
    {
      const double x = a[0] + (place[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
      isInside = isInside != (x > place[0]);
    }
  }
  return isInside;
}

std::vector<std::vector<std::int64_t>> RegionMap::RingsOfRegions() const
{
  std::vector<std::vector<std::int64_t>> rings;
  for (std::int64_t ring = 0; ring < this->Rings(); ++ring)
  {
    rings.resize(std::max(rings.size(), Index(this->RegionOf(ring)) + 1));
    rings[Index(this->RegionOf(ring))].push_back(ring);
  }
  return rings;
}

void RegionMap::FindHoles()
{
  std::vector<Box> boxes;
  for (std::int64_t ring = 0; ring < this->Rings(); ++ring)
  {
    Box box{ { HUGE_VAL, HUGE_VAL }, { -HUGE_VAL, -HUGE_VAL } };
    for (std::int64_t i = 0; i < this->CountOf(ring); ++i)
    {
      const Point<2>& place = this->Places[Index(this->CornerOf(ring, i))];
      for (int axis = 0; axis < 2; ++axis)
      {
        box.Low[axis] = std::min(box.Low[axis], place[axis]);
        box.High[axis] = std::max(box.High[axis], place[axis]);
      }
    }
    boxes.push_back(box);
  }
  // A ring may touch one around it in a few points, hardly in the middles of most of its edges.
  const auto isIn = [&](std::int64_t inner, std::int64_t outer) {
    constexpr std::int64_t most = 5;
    const std::int64_t count = this->CountOf(inner);
    const std::int64_t tries = std::min(most, count);
    std::int64_t inside = 0;
    for (std::int64_t i = 0; i < tries; ++i)
    {
      const std::int64_t corner = i * count / tries;
      const Point<2>& a = this->Places[Index(this->CornerOf(inner, corner))];
      const Point<2>& b = this->Places[Index(this->CornerOf(inner, (corner + 1) % count))];
      inside += this->Contains(outer, { 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) }) ? 1 : 0;
    }
    return 2 * inside > tries;
  };
  for (const std::vector<std::int64_t>& rings : this->RingsOfRegions())
  {
    for (const std::int64_t ring : rings)
    {
      int around = 0;
      for (const std::int64_t other : rings)
      {
        around +=
          other != ring && boxes[Index(other)].Contains(boxes[Index(ring)]) && isIn(ring, other)
          ? 1
          : 0;
      }
      this->Holes[Index(ring)] = around % 2 == 1;
      this->Turned[Index(ring)] = (this->WindingArea(ring) < 0.0) != this->IsHole(ring);
    }
  }
}

std::vector<DividingPoint> RegionMap::Divide(
  const std::function<double(const Point<2>&)>& longestAt)
{
  struct Parts
  {
    std::int64_t First; // of the new points, from the lower end
    std::int64_t Count;
  };
  std::unordered_map<Edge, Parts, EdgeHash> divided;
  std::vector<DividingPoint> added;
  std::vector<std::int64_t> corners;
  std::vector<std::int64_t> begins{ 0 };
  for (std::int64_t ring = 0; ring < this->Rings(); ++ring)
  {
    for (std::int64_t i = 0; i < this->CountOf(ring); ++i)
    {
      const std::int64_t from = this->CornerOf(ring, i);
      const std::int64_t to = this->CornerOf(ring, i + 1 < this->CountOf(ring) ? i + 1 : 0);
      corners.push_back(from);
      const Point<2> a = this->Places[Index(from)];
      const Point<2> b = this->Places[Index(to)];
      const bool isUp = a != b ? a < b : from < to;
      const Edge edge = isUp ? Edge{ from, to } : Edge{ to, from };
      const auto [found, isNew] = divided.insert({ edge, {} });
      if (isNew)
      {
        const Point<2> low = isUp ? a : b;
        const Point<2> high = isUp ? b : a;
        const double longest = longestAt({ 0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]) });
        const double parts =
          std::ceil(std::hypot(high[0] - low[0], high[1] - low[1]) / longest - 1e-9);
        found->second = { static_cast<std::int64_t>(this->Places.size()),
          std::max<std::int64_t>(1, static_cast<std::int64_t>(parts)) };
        for (std::int64_t k = 1; k < found->second.Count; ++k)
        {
          const double at = static_cast<double>(k) / static_cast<double>(found->second.Count);
          added.push_back({ edge.Low, edge.High, at });
          this->Places.push_back(
            { low[0] + at * (high[0] - low[0]), low[1] + at * (high[1] - low[1]) });
        }
      }
      const Parts& parts = found->second;
      for (std::int64_t k = 1; k < parts.Count; ++k)
      {
        corners.push_back(parts.First + (isUp ? k : parts.Count - k) - 1);
      }
    }
    begins.push_back(static_cast<std::int64_t>(corners.size()));
  }
  this->Corners = std::move(corners);
  this->Begins = std::move(begins);
  return added;
}

} // namespace RectifiedTransport
