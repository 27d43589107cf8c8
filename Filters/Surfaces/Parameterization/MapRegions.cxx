// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/MapRegions.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// A node of the k-d tree: points [First, Last) of an order, after Depth cuts.
struct Cell
{
  std::ptrdiff_t First;
  std::ptrdiff_t Last;
  int Depth;
};

std::vector<MapRegion> cutRegions(ConstPointSpan<2> positions, std::int64_t most, int variant)
{
  // The places of cuts, by variant. Any unequal places do: borders that stay at the same points
  // over several sweeps would leave errors there, as points on both sides never move together.
  constexpr std::array<double, 4> parts{ 0.5, 0.38, 0.62, 0.44 };
  constexpr int varied = 2; // number of levels whose cuts differ
  std::vector<std::int64_t> points(static_cast<std::size_t>(positions.size()));
  std::iota(points.begin(), points.end(), std::int64_t{ 0 });
  std::vector<MapRegion> regions;
  std::vector<Cell> left{ { 0, static_cast<std::ptrdiff_t>(points.size()), 0 } };
  while (!left.empty())
  {
    const Cell cell = left.back();
    left.pop_back();
    const auto begin = points.begin() + cell.First;
    const auto end = points.begin() + cell.Last;
    if (end - begin <= most)
    {
      regions.emplace_back(begin, end);
      std::sort(regions.back().begin(), regions.back().end());
      continue;
    }
    const double part =
      cell.Depth < varied ? parts[static_cast<std::size_t>(variant) % parts.size()] : 0.5;
    // Axes alternate; an odd variant starts with y.
    const int axis = (cell.Depth + variant) % 2;
    const auto middle =
      begin + static_cast<std::ptrdiff_t>(static_cast<double>(end - begin) * part);
    std::nth_element(begin, middle, end, [&](std::int64_t a, std::int64_t b) {
      // Ties are broken by number: the regions are then the same on every machine.
      return std::make_pair(positions[a][axis], a) < std::make_pair(positions[b][axis], b);
    });
    left.push_back({ middle - points.begin(), cell.Last, cell.Depth + 1 });
    left.push_back({ cell.First, middle - points.begin(), cell.Depth + 1 });
  }
  return regions;
}

} // namespace

std::vector<std::vector<MapRegion>> makeRegions(
  const DiskMesh& disk, ConstPointSpan<2> positions, std::int64_t most, int variant)
{
  std::vector<MapRegion> regions = cutRegions(positions, most, variant);
  std::vector<std::size_t> regionOf(static_cast<std::size_t>(positions.size()));
  for (std::size_t region = 0; region < regions.size(); ++region)
  {
    for (const std::int64_t point : regions[region])
    {
      regionOf[static_cast<std::size_t>(point)] = region;
    }
  }
  // The graph of regions that share a triangle, each edge at the larger number.
  std::vector<std::set<std::size_t>> neighbours(regions.size());
  for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const std::size_t a = regionOf[static_cast<std::size_t>(disk.Triangle(t)[i])];
      const std::size_t b = regionOf[static_cast<std::size_t>(disk.Triangle(t)[(i + 1) % 3])];
      if (a != b)
      {
        neighbours[std::max(a, b)].insert(std::min(a, b));
      }
    }
  }
  // Greedy colouring: each region goes into the first group that has no neighbour of it.
  std::vector<std::vector<MapRegion>> groups;
  std::vector<std::size_t> groupOf(regions.size());
  for (std::size_t region = 0; region < regions.size(); ++region)
  {
    std::set<std::size_t> taken;
    for (const std::size_t neighbour : neighbours[region])
    {
      taken.insert(groupOf[neighbour]);
    }
    std::size_t group = 0;
    while (taken.count(group) > 0)
    {
      ++group;
    }
    groupOf[region] = group;
    groups.resize(std::max(groups.size(), group + 1));
    groups[group].push_back(std::move(regions[region]));
  }
  return groups;
}

} // namespace RectifiedTransport
