// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/RegionRaster.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Overlap/RegionCoverage.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12; // cells a chunk

// The rows of cells that a region touches.
struct Rows
{
  std::int64_t First;
  std::int64_t Last; // one beyond
  std::int64_t Edges;

  bool AreIn(std::int64_t first, std::int64_t last) const
  {
    return first < this->Last && last > this->First;
  }
};

// Finds the rows of a region, and the number of its edges, which measures the work.
Rows rowsOf(const RegionMap& map, const std::vector<std::int64_t>& rings, std::int64_t side)
{
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  std::int64_t edges = 0;
  for (const std::int64_t ring : rings)
  {
    edges += map.CountOf(ring);
    map.VisitEdges(ring, [&](std::int64_t from, std::int64_t) {
      const double y = map.Points()[static_cast<std::size_t>(from)][1];
      low = std::min(low, y);
      high = std::max(high, y);
    });
  }
  const auto last = static_cast<double>(side);
  return { static_cast<std::int64_t>(std::floor(std::clamp(low, 0.0, last))),
    static_cast<std::int64_t>(std::ceil(std::clamp(high, 0.0, last))), edges };
}

} // namespace

RegionRaster::RegionRaster(
  const RegionMap& map, std::int32_t regions, std::int64_t side, const Context& context)
  : CellsOfSide(side)
  , Together(regions)
  , Whole(static_cast<std::size_t>(regions), 0.0)
{
  std::vector<std::vector<std::int64_t>> ringsOf = map.RingsOfRegions();
  ringsOf.resize(this->Whole.size());
  std::vector<Rows> rowsOfRegions;
  // The raster is made in bands of rows, so that temporary memory is small.
  constexpr std::int64_t cellsOfBand = std::int64_t{ 1 } << 19;
  // The number of rows in a band.
  const std::int64_t band = std::max<std::int64_t>(1, cellsOfBand / side);
  std::int64_t edges = 0; // to visit, in all bands
  for (const std::vector<std::int64_t>& rings : ringsOf)
  {
    // The work of a region is its edges times the bands that it touches.
    const Rows rows = rowsOf(map, rings, side);
    rowsOfRegions.push_back(rows);
    edges +=
      rows.First < rows.Last ? rows.Edges * ((rows.Last - 1) / band - rows.First / band + 1) : 0;
  }
  Progress progress(context);
  progress.Expect(edges);
  this->Owners.reserve(static_cast<std::size_t>(side * side));
  // The shares of partly covered cells in a band, and the ends of runs of whole cells, for all
  // regions.
  std::vector<CellShare> mixed;
  std::vector<RunEnd> ends;
  // Each band visits only the regions that touch it.
  for (std::int64_t first = 0; first < side; first += band)
  {
    const std::int64_t last = std::min(side, first + band);
    this->Owners.resize(static_cast<std::size_t>(last * side), -1);
    RegionCoverage coverage({ { side, side }, first, last, nullptr });
    // Coverage finds the exact areas of a region in the cells of a band: runs of whole cells, and
    // single cells with a part.
    mixed.clear();
    ends.clear();
    for (std::int32_t region = 0; region < regions; ++region)
    {
      const auto at = static_cast<std::size_t>(region);
      if (!rowsOfRegions[at].AreIn(first, last))
      {
        continue;
      }
      for (const std::int64_t ring : ringsOf[at])
      {
        map.VisitEdges(ring, [&](std::int64_t from, std::int64_t to) {
          progress.Add(1);
          coverage.Add(map.Points()[static_cast<std::size_t>(from)],
            map.Points()[static_cast<std::size_t>(to)]);
        });
      }
      // Areas are signed: a part of an outline that runs in reverse counts negatively, hence the
      // clamped part and the signed one.
      coverage.FinishSigned([&](std::int64_t begin, std::int64_t end, double area) {
        if (area == 1.0)
        {
          // Runs that touch are joined.
          if (!ends.empty() && ends.back().Region == region && ends.back().Cell == begin)
          {
            ends.back().Cell = end;
            return;
          }
          ends.push_back({ begin, region, true });
          ends.push_back({ end, region, false });
          return;
        }
        for (std::int64_t cell = begin; cell < end; ++cell)
        {
          mixed.push_back({ cell, { region, std::clamp(area, 0.0, 1.0), area } });
        }
      });
      progress.Check();
    }
    this->SetOwners(ends);
    this->AddMixed(mixed);
  }
  this->Begins.push_back(static_cast<std::int64_t>(this->Shares.size()));
  progress.Check();
  this->KeepSets();
}

double RegionRaster::BytesOf(const RegionMap& map, std::int64_t side)
{
  // The bytes for a region's share of a cell: in the raster, sorted in its band, and twice during
  // the search for factors.
  constexpr double bytesOfShare = sizeof(Share) + sizeof(CellShare) + 6 * sizeof(double);
  double crossed = 0.0; // cells that edges cross
  for (std::int64_t ring = 0; ring < map.Rings(); ++ring)
  {
    map.VisitEdges(ring, [&](std::int64_t from, std::int64_t to) {
      const Point<2>& a = map.Points()[static_cast<std::size_t>(from)];
      const Point<2>& b = map.Points()[static_cast<std::size_t>(to)];
      // An edge crosses at most one cell, plus one for each row and column that it passes.
      crossed += 1.0 + std::abs(b[0] - a[0]) + std::abs(b[1] - a[1]);
    });
  }
  const auto cells = static_cast<double>(side) * static_cast<double>(side);
  return cells * sizeof(std::int32_t) + crossed * bytesOfShare;
}

// Sets the owners of a band's cells from the ends of runs, by a sweep along the rows. At the same
// cell, regions leave before others begin, and in the opposite order, so that few sets of
// overlapping regions arise.
void RegionRaster::SetOwners(std::vector<RunEnd>& ends)
{
  std::sort(ends.begin(), ends.end(), [](const RunEnd& a, const RunEnd& b) {
    return a.Cell != b.Cell    ? a.Cell < b.Cell
      : a.IsBegin != b.IsBegin ? b.IsBegin
                               : (a.Region < b.Region) == a.IsBegin && a.Region != b.Region;
  });
  // The set of regions that cover the current cell as a whole.
  std::int32_t set = RegionSets::Empty;
  for (std::size_t i = 0; i < ends.size(); ++i)
  {
    set = this->Together.Toggled(set, ends[i].Region);
    if (set != RegionSets::Empty)
    {
      std::fill(this->Owners.begin() + ends[i].Cell, this->Owners.begin() + ends[i + 1].Cell, set);
    }
  }
}

// Renumbers the sets that cells really have, and counts the whole cells of each.
void RegionRaster::KeepSets()
{
  std::vector<unsigned char> isUsed(static_cast<std::size_t>(this->Together.End()), 0);
  // Calls use(set) for the set of every cell, whole or mixed.
  const auto visit = [this](const auto& use) {
    for (std::vector<std::int32_t>* sets : { &this->Owners, &this->SetsOfMixed })
    {
      for (std::int32_t& set : *sets)
      {
        if (set >= 0)
        {
          use(set);
        }
      }
    }
  };
  visit([&](std::int32_t set) { isUsed[static_cast<std::size_t>(set)] = 1; });
  // Sets that arose only within the sweep are dropped.
  const std::vector<std::int32_t> numbers = this->Together.Keep(isUsed);
  visit([&](std::int32_t& set) { set = numbers[static_cast<std::size_t>(set)]; });
  this->WholeOfSets.assign(
    static_cast<std::size_t>(this->Together.End() - this->Together.First()), 0);
  for (const std::int32_t owner : this->Owners)
  {
    if (owner >= this->Together.First())
    {
      ++this->WholeOfSets[static_cast<std::size_t>(owner - this->Together.First())];
    }
    else if (owner >= 0)
    {
      this->Whole[static_cast<std::size_t>(owner)] += 1.0;
    }
  }
}

// Adds the shares of a band's cells. A cell with an owner and further regions is mixed; its owner's
// set takes the place of a region until the shares are sorted.
void RegionRaster::AddMixed(std::vector<CellShare>& mixed)
{
  // An owner of a mixed cell covers it as a whole: it gets a share of 1.
  const std::size_t parts = mixed.size();
  for (std::size_t i = 0; i < parts; ++i)
  {
    // The cell no longer has an owner; all its regions are in the list.
    std::int32_t& owner = this->Owners[static_cast<std::size_t>(mixed[i].Cell)];
    if (owner >= 0)
    {
      mixed.push_back({ mixed[i].Cell, { owner, 1.0, 1.0 } });
      owner = -1;
    }
  }
  std::sort(mixed.begin(), mixed.end(), [](const CellShare& a, const CellShare& b) {
    return a.Cell != b.Cell ? a.Cell < b.Cell : a.Share.Region < b.Share.Region;
  });
  for (std::size_t i = 0; i < mixed.size(); ++i)
  {
    if (i == 0 || mixed[i].Cell != mixed[i - 1].Cell)
    {
      this->Mixed.push_back(mixed[i].Cell);
      this->SetsOfMixed.push_back(-1);
      this->Begins.push_back(static_cast<std::int64_t>(this->Shares.size()));
    }
    if (mixed[i].Share.Region >= this->Together.First())
    {
      this->SetsOfMixed.back() = mixed[i].Share.Region;
    }
    else
    {
      this->Shares.push_back(mixed[i].Share);
    }
  }
}

// With a set that covers the cell there is no rest, even if parts add up to less than 1.
double uncoveredPart(std::int32_t set, const RegionRaster::Share* shares, std::int64_t count)
{
  double rest = set >= 0 ? 0.0 : 1.0;
  for (std::int64_t i = 0; i < count; ++i)
  {
    rest -= shares[i].Part;
  }
  return std::max(0.0, rest);
}

std::vector<double> RegionRaster::Covered() const
{
  // The area of a region: whole cells of its own, whole cells of its sets, and its parts of mixed
  // cells.
  std::vector<double> covered = this->Whole;
  std::vector<double> ofSets = this->CellsOfSets();
  this->VisitMixed([&](std::int32_t set, const Share* shares, std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i)
    {
      covered[static_cast<std::size_t>(shares[i].Region)] += shares[i].Part;
    }
    if (set >= 0)
    {
      ofSets[this->IndexOfSet(set)] += 1.0;
    }
  });
  this->AddToRegions(ofSets, covered);
  return covered;
}

// Returns the number of cells that each set covers without other regions.
std::vector<double> RegionRaster::CellsOfSets() const
{
  return { this->WholeOfSets.begin(), this->WholeOfSets.end() };
}

// Adds each set's value to all regions in it.
void RegionRaster::AddToRegions(
  const std::vector<double>& ofSets, std::vector<double>& ofRegions) const
{
  for (std::int32_t set = this->Together.First(); set < this->Together.End(); ++set)
  {
    const double value = ofSets[this->IndexOfSet(set)];
    this->Together.VisitRegions(
      set, [&](std::int32_t region) { ofRegions[static_cast<std::size_t>(region)] += value; });
  }
}

// Cells without an owner are empty or mixed; of the mixed ones only the rest counts.
double RegionRaster::UncoveredArea() const
{
  double rest = static_cast<double>(std::count(this->Owners.begin(), this->Owners.end(), -1) -
    static_cast<std::ptrdiff_t>(this->Mixed.size()));
  this->VisitMixed([&](std::int32_t set, const Share* shares, std::int64_t count) {
    rest += uncoveredPart(set, shares, count);
  });
  return rest;
}

template <class Visit>
void RegionRaster::ForMixed(Progress& progress, const Visit& visit) const
{
  const auto mixed = static_cast<std::int64_t>(this->Mixed.size());
  progress.ForEach(mixed, grain, [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    visit(this->Mixed[at], this->SetsOfMixed[at], this->Shares.data() + this->Begins[at],
      this->Begins[at + 1] - this->Begins[at]);
  });
}

// Returns the values of the regions, followed by the sums over each set.
std::vector<double> RegionRaster::SumsOfSets(const std::vector<double>& values) const
{
  std::vector<double> sums = values;
  for (std::int32_t set = this->Together.First(); set < this->Together.End(); ++set)
  {
    double sum = 0.0;
    this->Together.VisitRegions(
      set, [&](std::int32_t region) { sum += values[static_cast<std::size_t>(region)]; });
    sums.push_back(sum);
  }
  return sums;
}

// A cell's density is the sum over regions of part * value, plus the rest times `around`.
void RegionRaster::Fill(const std::vector<double>& values, double around,
  std::vector<double>& cells, const Context& context) const
{
  Progress progress(context);
  const auto all = static_cast<std::int64_t>(this->Owners.size());
  const auto mixed = static_cast<std::int64_t>(this->Mixed.size());
  progress.Expect(all + mixed);
  // Cells without regions have `around`; mixed cells are overwritten by the second loop.
  cells.clear();
  cells.reserve(this->Owners.size());
  // Overlapping regions add up their densities.
  const std::vector<double> sums = this->SumsOfSets(values);
  progress.ForEachInOrder(all, grain, [&](std::int64_t i) {
    const std::int32_t owner = this->Owners[static_cast<std::size_t>(i)];
    cells.push_back(owner < 0 ? around : sums[static_cast<std::size_t>(owner)]);
  });
  this->ForMixed(
    progress, [&](std::int64_t cell, std::int32_t set, const Share* shares, std::int64_t count) {
      // The densities of the set's regions count for the whole cell; otherwise the rest of the cell
      // has the density around.
      double value =
        set >= 0 ? sums[static_cast<std::size_t>(set)] : around * uncoveredPart(set, shares, count);
      for (std::int64_t k = 0; k < count; ++k)
      {
        value += shares[k].Part * values[static_cast<std::size_t>(shares[k].Region)];
      }
      cells[static_cast<std::size_t>(cell)] = value;
    });
}

void RegionRaster::Scale(const std::vector<double>& exponents, double least,
  std::vector<double>& cells, const Context& context) const
{
  Progress progress(context);
  const auto all = static_cast<std::int64_t>(this->Owners.size());
  const auto mixed = static_cast<std::int64_t>(this->Mixed.size());
  progress.Expect(all + mixed);
  const std::vector<double> sums = this->SumsOfSets(exponents);
  // Exponents of overlapping regions add up, so that their factors multiply.
  std::vector<double> factors(sums.size());
  std::transform(sums.begin(), sums.end(), factors.begin(),
    [](double exponent) { return exponential(exponent); });
  // The factor may not reduce a cell below `least`, or below itself if it is less already.
  const auto scale = [least](double factor, double& cell) {
    cell = std::max(std::min(least, cell), factor * cell);
  };
  progress.ForEach(all, grain, [&](std::int64_t i) {
    const std::int32_t owner = this->Owners[static_cast<std::size_t>(i)];
    if (owner >= 0)
    {
      scale(factors[static_cast<std::size_t>(owner)], cells[static_cast<std::size_t>(i)]);
    }
  });
  this->ForMixed(
    progress, [&](std::int64_t cell, std::int32_t set, const Share* shares, std::int64_t count) {
      // The factor of a mixed cell is exp(sum of part * exponent), a geometric mean of the regions'
      // factors.
      double exponent = set >= 0 ? sums[static_cast<std::size_t>(set)] : 0.0;
      for (std::int64_t k = 0; k < count; ++k)
      {
        exponent += shares[k].Part * exponents[static_cast<std::size_t>(shares[k].Region)];
      }
      scale(exponential(exponent), cells[static_cast<std::size_t>(cell)]);
    });
}

double RegionRaster::Overlap(std::vector<double>& ofRegions) const
{
  constexpr double rounding = 1e-9;
  double sum = 0.0;
  ofRegions.assign(this->Whole.size(), 0.0);
  std::vector<double> ofSets = this->CellsOfSets();
  // A set of n regions counts its cells n times, which is n - 1 too many.
  for (std::int32_t set = this->Together.First(); set < this->Together.End(); ++set)
  {
    double& more = ofSets[this->IndexOfSet(set)];
    more *= static_cast<double>(this->Together.CountOf(set) - 1);
    sum += more;
  }
  this->VisitMixed([&](std::int32_t set, const Share* shares, std::int64_t count) {
    // The regions that cover the cell, each with its part; more than 1 is an overlap.
    double covered = set >= 0 ? static_cast<double>(this->Together.CountOf(set)) : 0.0;
    for (std::int64_t i = 0; i < count; ++i)
    {
      covered += shares[i].Part;
    }
    // Parts of adjacent regions add up to 1 up to rounding.
    if (!(covered > 1.0 + rounding))
    {
      return;
    }
    for (std::int64_t i = 0; i < count; ++i)
    {
      // All regions of the cell share the excess.
      ofRegions[static_cast<std::size_t>(shares[i].Region)] += covered - 1.0;
    }
    if (set >= 0)
    {
      ofSets[this->IndexOfSet(set)] += covered - 1.0;
    }
    sum += covered - 1.0;
  });
  this->AddToRegions(ofSets, ofRegions);
  return sum;
}

// The mean weights each cell by the part that regions cover.
double RegionRaster::MeanOnLand(const std::vector<double>& cells) const
{
  double mass = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < this->Owners.size(); ++i)
  {
    mass += this->Owners[i] >= 0 ? cells[i] : 0.0;
    area += this->Owners[i] >= 0 ? 1.0 : 0.0;
  }
  for (std::size_t i = 0; i < this->Mixed.size(); ++i)
  {
    const double part = 1.0 -
      uncoveredPart(this->SetsOfMixed[i], this->Shares.data() + this->Begins[i],
        this->Begins[i + 1] - this->Begins[i]);
    mass += part * cells[static_cast<std::size_t>(this->Mixed[i])];
    area += part;
  }
  return mass / area;
}

} // namespace RectifiedTransport
