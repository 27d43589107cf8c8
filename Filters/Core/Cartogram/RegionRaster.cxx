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

constexpr std::int64_t grain = std::int64_t{ 1 } << 12; // of cells, in loops

// The rows of cells that a region lies in, in the grid.
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
  , Whole(static_cast<std::size_t>(regions), 0.0)
{
  std::vector<std::vector<std::int64_t>> ringsOf = map.RingsOfRegions();
  ringsOf.resize(this->Whole.size());
  std::vector<Rows> rowsOfRegions;
  // Bands of rows: what one takes is little.
  constexpr std::int64_t cellsOfBand = std::int64_t{ 1 } << 19;
  const std::int64_t band = std::max<std::int64_t>(1, cellsOfBand / side);
  std::int64_t edges = 0; // to visit, in all bands
  for (const std::vector<std::int64_t>& rings : ringsOf)
  {
    const Rows rows = rowsOf(map, rings, side);
    rowsOfRegions.push_back(rows);
    edges +=
      rows.First < rows.Last ? rows.Edges * ((rows.Last - 1) / band - rows.First / band + 1) : 0;
  }
  Progress progress(context);
  progress.BeginStage(1.0, edges);
  this->Owners.reserve(static_cast<std::size_t>(side * side));
  std::vector<CellShare> mixed;
  for (std::int64_t first = 0; first < side; first += band)
  {
    const std::int64_t last = std::min(side, first + band);
    this->Owners.resize(static_cast<std::size_t>(last * side), -1);
    RegionCoverage coverage({ { side, side }, first, last, nullptr });
    mixed.clear();
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
      coverage.FinishSigned([&](std::int64_t cell, double area) {
        std::int32_t& owner = this->Owners[static_cast<std::size_t>(cell)];
        if (area == 1.0 && owner < 0)
        {
          owner = region;
        }
        else
        {
          mixed.push_back({ cell, { region, std::clamp(area, 0.0, 1.0), area } });
        }
      });
      progress.Check();
    }
    this->AddMixed(mixed);
  }
  this->Begins.push_back(static_cast<std::int64_t>(this->Shares.size()));
  progress.Check();
  for (const std::int32_t owner : this->Owners)
  {
    if (owner >= 0)
    {
      this->Whole[static_cast<std::size_t>(owner)] += 1.0;
    }
  }
}

// Of a band. Cells of an owner and others are mixed.
void RegionRaster::AddMixed(std::vector<CellShare>& mixed)
{
  const std::size_t parts = mixed.size();
  for (std::size_t i = 0; i < parts; ++i)
  {
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
      this->Begins.push_back(static_cast<std::int64_t>(this->Shares.size()));
    }
    this->Shares.push_back(mixed[i].Share);
  }
}

double restOf(const RegionRaster::Share* shares, std::int64_t count)
{
  double rest = 1.0;
  for (std::int64_t i = 0; i < count; ++i)
  {
    rest -= shares[i].Part;
  }
  return std::max(0.0, rest);
}

std::vector<double> RegionRaster::Covered() const
{
  std::vector<double> covered = this->Whole;
  for (const Share& share : this->Shares)
  {
    covered[static_cast<std::size_t>(share.Region)] += share.Part;
  }
  return covered;
}

template <class Visit>
void RegionRaster::ForMixed(Progress& progress, const Visit& visit) const
{
  const auto mixed = static_cast<std::int64_t>(this->Mixed.size());
  progress.For(mixed, grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const auto at = static_cast<std::size_t>(i);
      visit(this->Mixed[at], this->Shares.data() + this->Begins[at],
        this->Begins[at + 1] - this->Begins[at]);
    }
  });
}

void RegionRaster::Fill(const std::vector<double>& values, double around,
  std::vector<double>& cells, const Context& context) const
{
  Progress progress(context);
  const auto all = static_cast<std::int64_t>(this->Owners.size());
  const auto mixed = static_cast<std::int64_t>(this->Mixed.size());
  progress.BeginStage(1.0, all + mixed);
  cells.clear();
  cells.reserve(this->Owners.size());
  progress.ForInOrder(all, grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const std::int32_t owner = this->Owners[static_cast<std::size_t>(i)];
      cells.push_back(owner < 0 ? around : values[static_cast<std::size_t>(owner)]);
    }
  });
  this->ForMixed(progress, [&](std::int64_t cell, const Share* shares, std::int64_t count) {
    double value = around * restOf(shares, count);
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
  progress.BeginStage(1.0, all + mixed);
  std::vector<double> factors(exponents.size());
  std::transform(exponents.begin(), exponents.end(), factors.begin(),
    [](double exponent) { return exponential(exponent); });
  const auto scale = [least](double factor, double& cell) {
    cell = std::max(std::min(least, cell), factor * cell);
  };
  progress.For(all, grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const std::int32_t owner = this->Owners[static_cast<std::size_t>(i)];
      if (owner >= 0)
      {
        scale(factors[static_cast<std::size_t>(owner)], cells[static_cast<std::size_t>(i)]);
      }
    }
  });
  this->ForMixed(progress, [&](std::int64_t cell, const Share* shares, std::int64_t count) {
    double exponent = 0.0;
    for (std::int64_t k = 0; k < count; ++k)
    {
      exponent += shares[k].Part * exponents[static_cast<std::size_t>(shares[k].Region)];
    }
    scale(exponential(exponent), cells[static_cast<std::size_t>(cell)]);
  });
}

double RegionRaster::Overlap(std::int32_t& region) const
{
  constexpr double rounding = 1e-9;
  double sum = 0.0;
  std::vector<double> own(this->Whole.size(), 0.0);
  this->VisitMixed([&](const Share* shares, std::int64_t count) {
    double covered = 0.0;
    for (std::int64_t i = 0; i < count; ++i)
    {
      covered += shares[i].Part;
    }
    for (std::int64_t i = 0; covered > 1.0 + rounding && i < count; ++i)
    {
      own[static_cast<std::size_t>(shares[i].Region)] += covered - 1.0;
    }
    sum += covered > 1.0 + rounding ? covered - 1.0 : 0.0;
  });
  region = static_cast<std::int32_t>(std::max_element(own.begin(), own.end()) - own.begin());
  return sum;
}

} // namespace RectifiedTransport
