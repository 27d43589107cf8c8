// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/RegionRaster.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Overlap/RegionCoverage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace RectifiedTransport
{

namespace
{

struct CellShare
{
  std::int64_t Cell;
  RegionRaster::Share Share;
};

struct CellBox
{
  GridSize<2> Low;
  GridSize<2> High;
};

// The cells that the rings of a region lie in, in the grid.
CellBox boxOf(const RegionMap& map, const std::vector<std::int64_t>& rings, std::int64_t side)
{
  Point<2> low{ HUGE_VAL, HUGE_VAL };
  Point<2> high{ -HUGE_VAL, -HUGE_VAL };
  for (const std::int64_t ring : rings)
  {
    map.VisitEdges(ring, [&](std::int64_t from, std::int64_t) {
      const Point<2>& place = map.Points()[static_cast<std::size_t>(from)];
      for (int axis = 0; axis < 2; ++axis)
      {
        low[axis] = std::min(low[axis], place[axis]);
        high[axis] = std::max(high[axis], place[axis]);
      }
    });
  }
  CellBox box{ { 0, 0 }, { 0, 0 } };
  const auto last = static_cast<double>(side);
  for (int axis = 0; axis < 2 && low[0] <= high[0]; ++axis)
  {
    box.Low[axis] = static_cast<std::int64_t>(std::floor(std::clamp(low[axis], 0.0, last - 1.0)));
    box.High[axis] = std::max(
      box.Low[axis] + 1, static_cast<std::int64_t>(std::ceil(std::clamp(high[axis], 0.0, last))));
  }
  return box;
}

// Appends the shares of the cells of a region, by rows.
void cover(const RegionMap& map, std::int32_t region, const std::vector<std::int64_t>& rings,
  std::int64_t side, std::vector<CellShare>& shares)
{
  const CellBox box = boxOf(map, rings, side);
  const GridSize<2> size{ box.High[0] - box.Low[0], box.High[1] - box.Low[1] };
  std::vector<double> parts(static_cast<std::size_t>(size[0] * size[1]), 0.0);
  RegionCoverage coverage({ size, 0, size[1], parts.data() });
  const auto placeOf = [&](std::int64_t point) {
    const Point<2>& place = map.Points()[static_cast<std::size_t>(point)];
    return Point<2>{ place[0] - static_cast<double>(box.Low[0]),
      place[1] - static_cast<double>(box.Low[1]) };
  };
  for (const std::int64_t ring : rings)
  {
    map.VisitEdges(
      ring, [&](std::int64_t from, std::int64_t to) { coverage.Add(placeOf(from), placeOf(to)); });
  }
  coverage.FinishSigned(1.0);
  for (std::int64_t row = 0; row < size[1]; ++row)
  {
    for (std::int64_t i = 0; i < size[0]; ++i)
    {
      const double part = parts[static_cast<std::size_t>(row * size[0] + i)];
      if (part != 0.0)
      {
        shares.push_back({ (box.Low[1] + row) * side + box.Low[0] + i,
          { region, std::clamp(part, 0.0, 1.0), part } });
      }
    }
  }
}

} // namespace

RegionRaster::RegionRaster(
  const RegionMap& map, std::int32_t regions, std::int64_t side, Progress& progress)
  : CellsOfSide(side)
  , Owners(static_cast<std::size_t>(side * side), -1)
  , Whole(static_cast<std::size_t>(regions), 0.0)
{
  std::vector<std::vector<std::int64_t>> ringsOf = map.RingsOfRegions();
  ringsOf.resize(this->Whole.size());
  std::vector<CellShare> mixed;
  std::vector<CellShare> shares;
  for (std::int32_t region = 0; region < regions; ++region)
  {
    progress.Check();
    shares.clear();
    cover(map, region, ringsOf[static_cast<std::size_t>(region)], side, shares);
    for (const CellShare& share : shares)
    {
      std::int32_t& owner = this->Owners[static_cast<std::size_t>(share.Cell)];
      if (share.Share.Signed == 1.0 && owner < 0)
      {
        owner = region;
      }
      else
      {
        mixed.push_back(share);
      }
    }
  }
  // Cells of an owner and others are mixed.
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
      this->Begins.push_back(static_cast<std::int64_t>(i));
    }
    this->Shares.push_back(mixed[i].Share);
  }
  this->Begins.erase(this->Begins.begin());
  this->Begins.push_back(static_cast<std::int64_t>(this->Shares.size()));
  for (const std::int32_t owner : this->Owners)
  {
    if (owner >= 0)
    {
      this->Whole[static_cast<std::size_t>(owner)] += 1.0;
    }
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

void RegionRaster::Fill(
  const std::vector<double>& values, double around, std::vector<double>& cells) const
{
  cells.resize(this->Owners.size());
  std::transform(this->Owners.begin(), this->Owners.end(), cells.begin(), [&](std::int32_t owner) {
    return owner < 0 ? around : values[static_cast<std::size_t>(owner)];
  });
  std::size_t at = 0;
  this->VisitMixed([&](const Share* shares, std::int64_t count) {
    double value = around * restOf(shares, count);
    for (std::int64_t i = 0; i < count; ++i)
    {
      value += shares[i].Part * values[static_cast<std::size_t>(shares[i].Region)];
    }
    cells[static_cast<std::size_t>(this->Mixed[at++])] = value;
  });
}

void RegionRaster::Scale(
  const std::vector<double>& exponents, double least, std::vector<double>& cells) const
{
  std::vector<double> factors(exponents.size());
  std::transform(exponents.begin(), exponents.end(), factors.begin(),
    [](double exponent) { return exponential(exponent); });
  const auto scale = [least](double factor, double& cell) {
    cell = std::max(std::min(least, cell), factor * cell);
  };
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    const std::int32_t owner = this->Owners[cell];
    if (owner >= 0)
    {
      scale(factors[static_cast<std::size_t>(owner)], cells[cell]);
    }
  }
  std::size_t at = 0;
  this->VisitMixed([&](const Share* shares, std::int64_t count) {
    double exponent = 0.0;
    for (std::int64_t i = 0; i < count; ++i)
    {
      exponent += shares[i].Part * exponents[static_cast<std::size_t>(shares[i].Region)];
    }
    scale(exponential(exponent), cells[static_cast<std::size_t>(this->Mixed[at++])]);
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
