// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Steps/ProbeBlocks.h"

#include "Core/Parallel/RankExchange.h"
#include "Core/Tables/BoxShare.h"
#include "Core/Tables/NearestMass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t enoughForContrast = 64; // blocks
constexpr std::int64_t blockSide = 4;          // cells, no more than a quarter of an axis

constexpr int power(int base, int exponent)
{
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

} // namespace

template <int Dimension>
ProbeBlocks<Dimension>::ProbeBlocks(
  FlowEngine<Dimension>& engine, FlowDirection direction, Progress& progress)
  : Engine(engine)
  , IsBackward(direction == FlowDirection::Backward)
{
  std::copy_n(engine.View().Cells, Dimension, this->Size.begin());
  this->Cells = numberOfCells<Dimension>(this->Size);
  for (int axis = 0; axis < Dimension; ++axis)
  {
    this->Side[axis] = std::clamp<std::int64_t>(this->Size[axis] / 4, 1, blockSide);
    this->Measure *= static_cast<double>(this->Side[axis]);
  }
  constexpr std::int64_t tries = 8; // a wanted block
  this->Draw(
    tries * this->WantedBlocks(), [this](std::int64_t number) { return this->BlockOf(number); },
    progress);
}

template <int Dimension>
template <class MakeBlock>
void ProbeBlocks<Dimension>::Draw(
  std::int64_t count, const MakeBlock& makeBlock, Progress& progress)
{
  const Ranks& ranks = progress.Group();
  const std::int64_t wanted = this->WantedBlocks();
  for (std::int64_t first = 1; first <= count; first += ranks.Count())
  {
    progress.Check();
    const std::int64_t own = std::min(first + ranks.Own(), count);
    ProbeBlock<Dimension> examined = makeBlock(own);
    this->Examine(own, first <= enoughForContrast, examined);
    const std::vector<ProbeBlock<Dimension>> blocks = gatherValues(ranks, examined);
    for (std::int64_t i = 0; i < std::min<std::int64_t>(ranks.Count(), count + 1 - first); ++i)
    {
      if (static_cast<std::int64_t>(this->Found.size()) == wanted)
      {
        return;
      }
      if (blocks[static_cast<std::size_t>(i)].Counts)
      {
        this->Found.push_back(blocks[static_cast<std::size_t>(i)]);
      }
    }
  }
}

template <int Dimension>
void ProbeBlocks<Dimension>::AddAbout(
  const std::vector<Point<Dimension>>& places, Progress& progress)
{
  this->Draw(
    static_cast<std::int64_t>(places.size()),
    [&](std::int64_t number) {
      Point<Dimension> low = places[static_cast<std::size_t>(number - 1)];
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const auto side = static_cast<double>(this->Side[axis]);
        low[axis] = std::clamp(std::floor(low[axis] - 0.5 * side + 0.5), 0.0,
          static_cast<double>(this->Size[axis]) - side);
      }
      return this->BlockAt(low);
    },
    progress);
}

template <int Dimension>
double ProbeBlocks<Dimension>::MeanIn(
  const Point<Dimension>& low, const Point<Dimension>& high) const
{
  double volume = 1.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    volume *= high[axis] - low[axis];
  }
  return boxShare<Dimension>(this->Engine.View(), low, high) * this->Cells / volume;
}

template <int Dimension>
bool ProbeBlocks<Dimension>::IsDense(const Point<Dimension>* corners) const
{
  constexpr int perAxis = 3;
  for (int place = 0; place < power(perAxis, Dimension); ++place)
  {
    Point<Dimension> x{};
    for (int corner = 0; corner < 1 << Dimension; ++corner)
    {
      double weight = 1.0;
      for (int axis = 0, rest = place; axis < Dimension; ++axis, rest /= perAxis)
      {
        const double u = 0.5 * (rest % perAxis);
        weight *= (corner >> axis & 1) != 0 ? u : 1.0 - u;
      }
      for (int axis = 0; axis < Dimension; ++axis)
      {
        x[axis] += weight * corners[corner][axis];
      }
    }
    Point<Dimension> low;
    Point<Dimension> high;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double last = static_cast<double>(this->Size[axis]) - 1.0;
      low[axis] = std::min(std::floor(x[axis]), last);
      high[axis] = low[axis] + 1.0;
    }
    if (!(this->MeanIn(low, high) > leastOfMean))
    {
      return false;
    }
  }
  return true;
}

// Of nine in ten of the blocks that have mass everywhere: photographs have contrasts of 1.04 to
// 1.34 and fine ones of 1.1 to 1.6, squares and discs of ten times the density around 2.2, a
// Gaussian 8; white noise has fine ones of 2.3, lines of ten times the density 3.
template <int Dimension>
bool ProbeBlocks<Dimension>::HaveLittleContrast() const
{
  constexpr double little = 1.5;
  constexpr double littleInBlocks = 2.0;
  return this->NearlyAllAreBelow(little, &ProbeBlock<Dimension>::Contrast) &&
    this->NearlyAllAreBelow(littleInBlocks, &ProbeBlock<Dimension>::FineContrast);
}

template <int Dimension>
bool ProbeBlocks<Dimension>::NearlyAllAreBelow(
  double most, double ProbeBlock<Dimension>::*contrast) const
{
  constexpr std::size_t fewest = 4;
  std::vector<double> contrasts;
  for (const ProbeBlock<Dimension>& block : this->Found)
  {
    if (block.Contrast > 0.0)
    {
      contrasts.push_back(block.*contrast);
    }
  }
  std::sort(contrasts.begin(), contrasts.end());
  return contrasts.size() >= fewest && contrasts[contrasts.size() * 9 / 10] < most;
}

// Many if their paths take no more than a tenth of the time of those of a particle a cell.
template <int Dimension>
std::int64_t ProbeBlocks<Dimension>::WantedBlocks() const
{
  constexpr std::int64_t many = 256;
  constexpr std::int64_t few = 128;
  constexpr std::int64_t runs = 3; // of all step counts up to 2 N, in runs of N steps
  constexpr std::int64_t part = 10;
  return static_cast<double>(many * power(2, Dimension) * runs * part) <= this->Cells ? many : few;
}

// The block of a number of the sequence.
template <int Dimension>
ProbeBlock<Dimension> ProbeBlocks<Dimension>::BlockOf(std::int64_t number) const
{
  Point<Dimension> low = evenPlace<Dimension>(number);
  for (int axis = 0; axis < Dimension; ++axis)
  {
    low[axis] =
      std::floor(low[axis] * static_cast<double>(this->Size[axis] - this->Side[axis] + 1));
  }
  return this->BlockAt(low);
}

template <int Dimension>
ProbeBlock<Dimension> ProbeBlocks<Dimension>::BlockAt(const Point<Dimension>& low) const
{
  ProbeBlock<Dimension> block;
  block.Low = low;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    block.High[axis] = low[axis] + static_cast<double>(this->Side[axis]);
  }
  return block;
}

// Collective; `isOfFirst` is the same on all ranks.
template <int Dimension>
void ProbeBlocks<Dimension>::Examine(
  std::int64_t number, bool isOfFirst, ProbeBlock<Dimension>& block)
{
  if (this->IsBackward)
  {
    this->ExamineCells(block);
    return;
  }
  if (!isOfFirst)
  {
    return;
  }
  this->PrepareShares(block.Low, block.High);
  if (number <= enoughForContrast && this->HasMassIn(block))
  {
    block.Contrast = this->ContrastAbout(block);
    block.FineContrast = this->FineContrastOf(block);
  }
}

// Whether all cells of a block have mass.
template <int Dimension>
bool ProbeBlocks<Dimension>::HasMassIn(const ProbeBlock<Dimension>& block) const
{
  const TableView<Dimension>& tables = this->Engine.View();
  bool hasMass = true;
  this->ForCells(block.Low, block.High, [&](const Point<Dimension>& from, const Point<Dimension>&) {
    Point<Dimension> centre = from;
    for (double& coordinate : centre)
    {
      coordinate += 0.5;
    }
    hasMass = hasMass && RectifiedTransport::hasMass<Dimension>(tables, centre);
  });
  return hasMass;
}

// For a box of whole cells.
template <int Dimension>
void ProbeBlocks<Dimension>::PrepareShares(
  const Point<Dimension>& low, const Point<Dimension>& high) const
{
  GridSize<Dimension> first;
  GridSize<Dimension> end;
  std::transform(low.begin(), low.end(), first.begin(),
    [](double place) { return static_cast<std::int64_t>(place); });
  std::transform(high.begin(), high.end(), end.begin(),
    [](double place) { return static_cast<std::int64_t>(place); });
  this->Engine.PrepareShares(first, end);
}

// Next to cells that do not count, corners have no certain image: an eighth of the block is left
// out at each of its sides then.
template <int Dimension>
void ProbeBlocks<Dimension>::ExamineCells(ProbeBlock<Dimension>& block)
{
  Point<Dimension> first;
  Point<Dimension> end;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    first[axis] = std::max(0.0, block.Low[axis] - 1.0);
    end[axis] = std::min(static_cast<double>(this->Size[axis]), block.High[axis] + 1.0);
  }
  this->PrepareShares(first, end);
  bool isSurrounded = true;
  this->ForCells(first, end, [&](const Point<Dimension>& from, const Point<Dimension>& to) {
    bool isInside = true;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      isInside = isInside && from[axis] >= block.Low[axis] && to[axis] <= block.High[axis];
    }
    const bool counts = this->Engine.Share(from, to) * this->Cells > leastOfMean;
    isSurrounded = isSurrounded && counts;
    block.Counts = block.Counts && (counts || !isInside);
  });
  for (int axis = 0; axis < Dimension && !isSurrounded; ++axis)
  {
    const double margin = (block.High[axis] - block.Low[axis]) / 8.0;
    block.Low[axis] += margin;
    block.High[axis] -= margin;
  }
  block.Mass = this->Engine.Share(block.Low, block.High) * this->Cells;
}

template <int Dimension>
double ProbeBlocks<Dimension>::FineContrastOf(const ProbeBlock<Dimension>& block) const
{
  double densest = 0.0;
  this->ForCells(
    block.Low, block.High, [&](const Point<Dimension>& from, const Point<Dimension>& to) {
      densest = std::max(densest, this->Engine.Share(from, to));
    });
  return densest * this->Measure / this->Engine.Share(block.Low, block.High);
}

// Boxes are in proportion to the domain, twice as wide each time, and cut at its border.
template <int Dimension>
double ProbeBlocks<Dimension>::ContrastAbout(const ProbeBlock<Dimension>& block) const
{
  const auto longest = static_cast<double>(*std::max_element(this->Size.begin(), this->Size.end()));
  constexpr double first = 2.0 * blockSide;
  double before = this->MeanIn(block.Low, block.High);
  double largest = 1.0;
  for (double width = first; width < 2.0 * longest && before > 0.0; width *= 2.0)
  {
    Point<Dimension> low;
    Point<Dimension> high;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto size = static_cast<double>(this->Size[axis]);
      const double centre = 0.5 * (block.Low[axis] + block.High[axis]);
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

template class ProbeBlocks<1>;
template class ProbeBlocks<2>;
template class ProbeBlocks<3>;

} // namespace RectifiedTransport
