// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parameterization/MapRegions.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>

namespace RectifiedTransport
{

namespace
{

using Iterator = std::vector<std::int64_t>::iterator;

class RegionTree
{
public:
  RegionTree(ConstPointSpan<2> positions, std::int64_t most, int variant)
    : Positions(positions)
    , Most(most)
    , Variant(variant)
  {
  }

  std::vector<MapRegion> Cut()
  {
    std::vector<std::int64_t> points(static_cast<std::size_t>(this->Positions.size()));
    std::iota(points.begin(), points.end(), std::int64_t{ 0 });
    this->Split(points.begin(), points.end(), 0);
    return std::move(this->Regions);
  }

private:
  void Split(Iterator begin, Iterator end, int depth)
  {
    if (end - begin <= this->Most)
    {
      this->Regions.emplace_back(begin, end);
      std::sort(this->Regions.back().begin(), this->Regions.back().end());
      return;
    }
    constexpr std::array<double, 4> parts{ 0.5, 0.38, 0.62, 0.44 };
    constexpr int varied = 2; // levels
    const double part =
      depth < varied ? parts[static_cast<std::size_t>(this->Variant) % parts.size()] : 0.5;
    const int axis = (depth + this->Variant) % 2;
    const Iterator middle =
      begin + static_cast<std::ptrdiff_t>(static_cast<double>(end - begin) * part);
    std::nth_element(begin, middle, end, [this, axis](std::int64_t a, std::int64_t b) {
      return std::make_pair(this->Positions[a][axis], a) <
        std::make_pair(this->Positions[b][axis], b);
    });
    this->Split(begin, middle, depth + 1);
    this->Split(middle, end, depth + 1);
  }

  const ConstPointSpan<2> Positions;
  const std::int64_t Most;
  const int Variant;
  std::vector<MapRegion> Regions;
};

} // namespace

std::vector<std::vector<MapRegion>> makeRegions(
  const DiskMesh& disk, ConstPointSpan<2> positions, std::int64_t most, int variant)
{
  std::vector<MapRegion> regions = RegionTree(positions, most, variant).Cut();
  std::vector<std::size_t> regionOf(static_cast<std::size_t>(positions.size()));
  for (std::size_t region = 0; region < regions.size(); ++region)
  {
    for (const std::int64_t point : regions[region])
    {
      regionOf[static_cast<std::size_t>(point)] = region;
    }
  }
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
  // Each region goes into the first group that has no neighbour of it.
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
