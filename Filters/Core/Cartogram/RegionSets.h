// SPDX-License-Identifier: BSD-3-Clause
// Sets of regions that cover a cell together. Where regions lie on each other, many cells have the
// same set: a raster holds its number.
#ifndef RectifiedTransport_RegionSets_h
#define RectifiedTransport_RegionSets_h

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace RectifiedTransport
{

// The set of each region alone has the region's number. All others, of two regions or more, follow.
class RegionSets
{
public:
  static constexpr std::int32_t Empty = -1;

  explicit RegionSets(std::int32_t regions)
    : Regions(regions)
  {
  }

  // A set with one more region, or without one that it has. Throws std::bad_alloc.
  std::int32_t Toggled(std::int32_t set, std::int32_t region)
  {
    return set == Empty ? region : set == region ? Empty : this->FindToggled(set, region);
  }
  // Keeps the sets that `isUsed` marks, by their numbers, and numbers them anew: returns what each
  // becomes. No set can be added afterwards. Throws std::bad_alloc.
  std::vector<std::int32_t> Keep(const std::vector<unsigned char>& isUsed);

  std::int32_t First() const { return this->Regions; } // of two regions or more
  std::int32_t End() const
  {
    return this->Regions + static_cast<std::int32_t>(this->Pairs.size() + this->Begins.size() - 1);
  }
  // After Keep: visit(region) of a set of two or more.
  template <class Visit>
  void VisitRegions(std::int32_t set, const Visit& visit) const
  {
    const auto at = static_cast<std::size_t>(set - this->Regions);
    for (std::size_t i = this->Begins[at]; i < this->Begins[at + 1]; ++i)
    {
      visit(this->Members[i]);
    }
  }
  std::int64_t CountOf(std::int32_t set) const
  {
    const auto at = static_cast<std::size_t>(set - this->Regions);
    return static_cast<std::int64_t>(this->Begins[at + 1] - this->Begins[at]);
  }

private:
  struct Pair
  {
    std::int32_t Set;
    std::int32_t Region; // larger than all regions of the set
  };

  std::int32_t FindToggled(std::int32_t set, std::int32_t region);
  // Returns the last link of a set that is not empty.
  Pair PairOf(std::int32_t set) const
  {
    return set < this->Regions ? Pair{ Empty, set }
                               : this->Pairs[static_cast<std::size_t>(set - this->Regions)];
  }

  std::int32_t Regions;
  std::vector<Pair> Pairs; // sets of two or more regions
  // Results of Toggled, by set and region: neighbouring cells mostly have the same sets.
  std::unordered_map<std::int64_t, std::int32_t> Found;
  std::vector<std::size_t> Begins{ 0 };
  std::vector<std::int32_t> Members;
};

} // namespace RectifiedTransport

#endif
