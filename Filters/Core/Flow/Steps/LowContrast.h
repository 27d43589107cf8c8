// SPDX-License-Identifier: BSD-3-Clause
// Whether a density is like a photograph.
#ifndef RectifiedTransport_LowContrast_h
#define RectifiedTransport_LowContrast_h

#include "Core/Flow/FlowEngine.h"
#include "Core/Flow/Steps/BoxCells.h"
#include "Core/Flow/Steps/ProbePlan.h"
#include "Core/Flow/Steps/SymmetricPlace.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Ranks.h"
#include "Core/Tables/BoxShare.h"
#include "Core/Tables/NearestMass.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace RectifiedTransport
{

// Infinite if a block has an empty cell.
struct Contrasts
{
  // The largest ratio of mean densities in a box about the block and in one of half the width.
  double Scales = std::numeric_limits<double>::infinity();
  // The ratio of the densest cell to the block.
  double Cells = std::numeric_limits<double>::infinity();
};

template <int Dimension>
class ContrastMeter
{
public:
  explicit ContrastMeter(FlowEngine<Dimension>& engine)
    : Engine(engine)
    , Tables(engine.View())
  {
    std::copy_n(this->Tables.Cells, Dimension, this->Size.begin());
    this->Side = ProbePlan<Dimension>(this->Size).Side;
  }

  // Collective.
  Contrasts At(std::int64_t number) const
  {
    const SymmetricPlace<Dimension> place(number);
    Point<Dimension> low;
    Point<Dimension> high;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      low[axis] = place.Integer(axis, static_cast<double>(this->Size[axis] - this->Side[axis]));
      high[axis] = low[axis] + static_cast<double>(this->Side[axis]);
    }
    prepareShares<Dimension>(this->Engine, low, high);
    Contrasts found;
    if (this->HasMassIn(low, high))
    {
      found.Scales = this->OfScales(low, high);
      found.Cells = this->OfCells(low, high);
    }
    return found;
  }

private:
  // Whether all cells have mass.
  bool HasMassIn(const Point<Dimension>& low, const Point<Dimension>& high) const
  {
    bool found = true;
    forCells<Dimension>(low, high, [&](const Point<Dimension>& from, const Point<Dimension>&) {
      Point<Dimension> centre = from;
      for (double& coordinate : centre)
      {
        coordinate += 0.5;
      }
      found = found && hasMass<Dimension>(this->Tables, centre);
    });
    return found;
  }

  double OfCells(const Point<Dimension>& low, const Point<Dimension>& high) const
  {
    double densest = 0.0;
    forCells<Dimension>(low, high, [&](const Point<Dimension>& from, const Point<Dimension>& to) {
      densest = std::max(densest, this->Engine.Share(from, to));
    });
    return densest * boxVolume<Dimension>(low, high) / this->Engine.Share(low, high);
  }

  // Boxes are in proportion to the domain, twice as wide each time, and cut at its border.
  double OfScales(const Point<Dimension>& from, const Point<Dimension>& to) const
  {
    const auto longest =
      static_cast<double>(*std::max_element(this->Size.begin(), this->Size.end()));
    constexpr double first = 8.0;
    double before = this->MeanIn(from, to);
    double largest = 1.0;
    for (double width = first; width < 2.0 * longest && before > 0.0; width *= 2.0)
    {
      Point<Dimension> low;
      Point<Dimension> high;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const auto size = static_cast<double>(this->Size[axis]);
        const double centre = 0.5 * (from[axis] + to[axis]);
        const double half = 0.5 * width * size / longest;
        low[axis] = std::max(0.0, centre - half);
        high[axis] = std::min(size, centre + half);
      }
      const double density = this->MeanIn(low, high);
      largest = std::max(largest, density / before);
      before = density;
    }
    return largest;
  }

  double MeanIn(const Point<Dimension>& low, const Point<Dimension>& high) const
  {
    return boxShare<Dimension>(this->Tables, low, high) / boxVolume<Dimension>(low, high);
  }

  FlowEngine<Dimension>& Engine;
  const TableView<Dimension>& Tables;
  GridSize<Dimension> Size{};
  GridSize<Dimension> Side{};
};

// Nine in ten.
inline bool nearlyAllAreBelow(double most, std::vector<double> contrasts)
{
  std::sort(contrasts.begin(), contrasts.end());
  return contrasts[contrasts.size() * 9 / 10] < most;
}

// Whether densities about blocks of 4 cells a side hardly differ from scale to scale, nor those of
// the cells in a block. Not if one block in ten has empty cells. Collective. Throws Cancelled.
//
// Photographs have contrasts of 1.04 to 1.34 and fine ones of 1.1 to 1.6, squares and discs of ten
// times the density around 2.2, a Gaussian 8; white noise has fine ones of 2.3, lines of ten times
// the density 3.
template <int Dimension>
bool hasLowContrast(FlowEngine<Dimension>& engine, Progress& progress)
{
  constexpr double little = 1.5;
  constexpr double littleInBlocks = 2.0;
  constexpr std::int64_t images = SymmetricPlace<Dimension>::Images;
  constexpr std::int64_t blocks = (63 / images + 1) * images;
  const ContrastMeter<Dimension> meter(engine);
  const Ranks& ranks = engine.HasWholeTables() ? SoloRanks::Get() : progress.Group();
  std::vector<double> scales;
  std::vector<double> cells;
  for (std::int64_t first = 0; first < blocks; first += ranks.Count())
  {
    progress.Check();
    const Contrasts own = meter.At(std::min(first + ranks.Own(), blocks - 1));
    const std::vector<Contrasts> all = gatherValues(ranks, own);
    for (std::int64_t i = 0; i < std::min<std::int64_t>(ranks.Count(), blocks - first); ++i)
    {
      scales.push_back(all[static_cast<std::size_t>(i)].Scales);
      cells.push_back(all[static_cast<std::size_t>(i)].Cells);
    }
  }
  return nearlyAllAreBelow(little, scales) && nearlyAllAreBelow(littleInBlocks, cells);
}

} // namespace RectifiedTransport

#endif
