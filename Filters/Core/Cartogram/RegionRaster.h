// SPDX-License-Identifier: BSD-3-Clause
// What regions cover of each cell of a square grid, exactly.
#ifndef RectifiedTransport_RegionRaster_h
#define RectifiedTransport_RegionRaster_h

#include "Core/Cartogram/RegionMap.h"
#include "Core/Cartogram/RegionSets.h"
#include "Core/Geometry/GridSize.h"
#include "Core/Parallel/Context.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

class RegionRaster
{
public:
  // Points are in index space. Throws std::bad_alloc and Cancelled.
  RegionRaster(const RegionMap& map, std::int32_t regions, std::int64_t side,
    const Context& context = Context());

  // The bytes that a raster takes, and the values of its regions: at most, unless many sets of
  // regions cover cells together.
  static double BytesOf(const RegionMap& map, std::int64_t side);

  struct Share
  {
    std::int32_t Region;
    double Part; // part of the cell, in [0, 1]
    // The same, weighted by the winding number of the outline, which is negative where outlines
    // cross and run in reverse. This counts in the region's area.
    double Signed;
  };

  std::int64_t Side() const { return this->CellsOfSide; }
  std::int32_t Regions() const { return static_cast<std::int32_t>(this->Whole.size()); }
  // How many cells a region covers as the only one, and wholly.
  double WholeCells(std::int32_t region) const
  {
    return this->Whole[static_cast<std::size_t>(region)];
  }
  // The sets of regions that cover cells together, each of them wholly, and how many cells have no
  // others.
  const RegionSets& Sets() const { return this->Together; }
  std::int64_t WholeCellsOfSet(std::int32_t set) const
  {
    return this->WholeOfSets[this->IndexOfSet(set)];
  }
  // All that regions cover, in cells.
  std::vector<double> Covered() const;
  // What no region covers, in cells.
  double UncoveredArea() const;
  // The number of shares of all regions in mixed cells.
  std::int64_t NumberOfShares() const { return static_cast<std::int64_t>(this->Shares.size()); }
  // Calls visit(set, shares, count) for each mixed cell: a set whose regions cover it wholly, or
  // -1, and the shares of other regions.
  template <class Visit>
  void VisitMixed(const Visit& visit) const
  {
    for (std::size_t i = 0; i + 1 < this->Begins.size(); ++i)
    {
      visit(this->SetsOfMixed[i], this->Shares.data() + this->Begins[i],
        this->Begins[i + 1] - this->Begins[i]);
    }
  }
  // The mean of the regions' values in each cell; the rest of it has the value `around`. Throws
  // std::bad_alloc and Cancelled.
  void Fill(const std::vector<double>& values, double around, std::vector<double>& cells,
    const Context& context = Context()) const;
  // Multiplies each cell by e to the sum of parts times exponents of the regions, where that leaves
  // `least`, or the cell as it is if that is less. Throws as Fill.
  void Scale(const std::vector<double>& exponents, double least, std::vector<double>& cells,
    const Context& context = Context()) const;
  // What regions cover together beyond whole cells, in cells; `ofRegions` gets what each of them
  // shares with others.
  double Overlap(std::vector<double>& ofRegions) const;
  // The mean of what cells have where there are regions.
  double MeanOnLand(const std::vector<double>& cells) const;

private:
  struct CellShare
  {
    std::int64_t Cell;
    RegionRaster::Share Share;
  };
  // Where a run of cells along a row begins, which a region covers wholly, or has ended.
  struct RunEnd
  {
    std::int64_t Cell;
    std::int32_t Region;
    bool IsBegin;
  };
  void SetOwners(std::vector<RunEnd>& ends);
  void AddMixed(std::vector<CellShare>& mixed);
  void KeepSets();
  std::size_t IndexOfSet(std::int32_t set) const
  {
    return static_cast<std::size_t>(set - this->Together.First());
  }
  std::vector<double> CellsOfSets() const;
  void AddToRegions(const std::vector<double>& ofSets, std::vector<double>& ofRegions) const;
  std::vector<double> SumsOfSets(const std::vector<double>& values) const;
  // Calls visit(cell, set, shares, count) in parallel.
  template <class Visit>
  void ForMixed(Progress& progress, const Visit& visit) const;

  std::int64_t CellsOfSide;
  RegionSets Together;
  std::vector<std::int32_t> Owners; // set of each cell, or -1
  std::vector<double> Whole;
  std::vector<std::int64_t> WholeOfSets;
  std::vector<std::int64_t> Mixed;       // numbers of the other cells
  std::vector<std::int32_t> SetsOfMixed; // or -1
  std::vector<std::int64_t> Begins;
  std::vector<Share> Shares;
};

// Returns the part of a cell that regions leave.
double uncoveredPart(std::int32_t set, const RegionRaster::Share* shares, std::int64_t count);

} // namespace RectifiedTransport

#endif
