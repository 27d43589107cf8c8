// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PowerCells/PowerDiagram.h"

#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t diagramSlice = 1 << 9; // cells; slow where all cells meet in a point

} // namespace

// One cell while it is cut; coordinates are relative to its site.
class PowerDiagram::Cutter
{
public:
  // Begins with the rectangle.
  void Begin(const Point<2>& site, const Point<2>& lengths)
  {
    // Coordinates relative to the site keep their digits, however far it is from the origin.
    const Point<2> low = { -site[0], -site[1] };
    const Point<2> high = { lengths[0] - site[0], lengths[1] - site[1] };
    this->Polygon = { { low, -1 }, { { high[0], low[1] }, -1 }, { high, -1 },
      { { low[0], high[1] }, -1 } };
    this->FindRadius();
  }

  // Clips the cell to the half-plane of points that are not nearer to a site at `offset` whose
  // weight is larger by `gain`: |x|^2 <= |x - offset|^2 - gain, that is, 2 offset . x <= |offset|^2
  // - gain.
  void Cut(std::int64_t neighbour, const Point<2>& offset, double gain)
  {
    const double square = offset[0] * offset[0] + offset[1] * offset[1];
    const double limit = square - gain;
    // The bisector is at the distance limit / (2 |offset|) from the site; beyond the farthest
    // corner it cuts nothing.
    if (limit > 0.0 && limit * limit >= 4.0 * square * this->SquaredRadius)
    {
      return;
    }
    const auto isNeighbour = [=](const Corner& corner) { return corner.Neighbour == neighbour; };
    if (std::any_of(this->Polygon.begin(), this->Polygon.end(), isNeighbour))
    {
      return; // rounding would cut it again
    }
    bool isCut = false;
    this->Excess.resize(this->Polygon.size());
    for (std::size_t k = 0; k < this->Polygon.size(); ++k)
    {
      const Point<2>& x = this->Polygon[k].X;
      this->Excess[k] = 2.0 * (offset[0] * x[0] + offset[1] * x[1]) - limit;
      isCut = isCut || this->Excess[k] > 0.0;
    }
    if (isCut)
    {
      this->KeepInside(neighbour);
    }
  }

  const std::vector<Corner>& Corners() const { return this->Polygon; }
  // The distance of the farthest corner from the site.
  double Radius() const { return this->LargestDistance; }

  // Adds the cell in the coordinates of the rectangle.
  void Append(const Point<2>& site, std::vector<Corner>& corners) const
  {
    for (const Corner& corner : this->Polygon)
    {
      corners.push_back({ { corner.X[0] + site[0], corner.X[1] + site[1] }, corner.Neighbour });
    }
  }
  std::int64_t Size() const { return static_cast<std::int64_t>(this->Polygon.size()); }

private:
  // Sutherland and Hodgman's clipping of a convex polygon by one half-plane. The new side gets the
  // neighbour that cuts it off.
  void KeepInside(std::int64_t neighbour)
  {
    const std::size_t count = this->Polygon.size();
    this->Clipped.clear();
    for (std::size_t k = 0; k < count; ++k)
    {
      const std::size_t next = k + 1 < count ? k + 1 : 0;
      const Corner& corner = this->Polygon[k];
      const bool isInside = !(this->Excess[k] > 0.0);
      if (isInside)
      {
        this->Clipped.push_back(corner);
      }
      if (isInside == (this->Excess[next] > 0.0))
      {
        // The corner where the side crosses the bisector.
        const double part = this->Excess[k] / (this->Excess[k] - this->Excess[next]);
        const Point<2>& a = corner.X;
        const Point<2>& b = this->Polygon[next].X;
        this->Clipped.push_back({ { a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]) },
          isInside ? neighbour : corner.Neighbour });
      }
    }
    this->Polygon.swap(this->Clipped);
    this->FindRadius();
  }

  // The radius decides which bisectors and boxes can still cut the cell.
  void FindRadius()
  {
    this->SquaredRadius = 0.0;
    for (const Corner& corner : this->Polygon)
    {
      this->SquaredRadius =
        std::max(this->SquaredRadius, corner.X[0] * corner.X[0] + corner.X[1] * corner.X[1]);
    }
    this->LargestDistance = std::sqrt(this->SquaredRadius);
  }

  std::vector<Corner> Polygon;
  std::vector<Corner> Clipped;
  std::vector<double> Excess; // excess of each corner beyond the bisector
  double SquaredRadius = 0.0;
  double LargestDistance = 0.0;
};

// As many sites as before keep the cells of the last update, whose neighbours Update tries first;
// other numbers begin without cells.
void PowerDiagram::SetSites(ConstPointSpan<2> sites, Progress& progress)
{
  this->Tree.Build(sites, progress);
  this->AllSites.resize(static_cast<std::size_t>(sites.size()));
  for (std::int64_t i = 0; i < sites.size(); ++i)
  {
    this->AllSites[static_cast<std::size_t>(i)] = { sites[i][0], sites[i][1] };
  }
  if (this->States.size() != this->AllSites.size())
  {
    this->Now.Clear(sites.size(), 1);
    this->States = std::vector<std::atomic<CutBy>>(this->AllSites.size());
  }
}

void PowerDiagram::Update(const double* weights, Progress& progress)
{
  // MarkInconsistent spreads by one ring of cells a round; a change of half of the diagram needs no
  // more than eight. After them, all cells that remain are cut by all rivals.
  constexpr int mostRounds = 8;
  this->Tree.SetWeights(weights, progress);
  this->CutByKnown(weights, progress);
  for (int round = 0; round < mostRounds; ++round)
  {
    // Only cells that fail to fit their neighbours are cut again.
    const std::vector<std::int64_t> inconsistent = this->FindInconsistent(progress);
    if (inconsistent.empty())
    {
      return;
    }
    this->CutByAll(inconsistent, weights, progress);
  }
  this->CutByAll(this->SitesCutBy(CutBy::Known), weights, progress);
}

void PowerDiagram::CutByKnown(const double* weights, Progress& progress)
{
  // The previous cells tell which neighbours to try first.
  std::swap(this->Last, this->Now);
  this->Now.Clear(this->NumberOfCells(), this->NumberOfChunks());
  progress.For(
    this->NumberOfCells(), cellsOfChunk,
    [&](std::int64_t first, std::int64_t last) {
      Cutter cutter;
      for (std::int64_t place = first; place < last; ++place)
      {
        const std::int64_t site = this->SiteAt(place);
        this->StateOf(site).store(CutBy::Known, std::memory_order_relaxed);
        this->CutByNeighbours(this->Last.At(site), site, weights, cutter);
        this->Now.Store(this->SiteOf(site), site, place / cellsOfChunk, cutter);
      }
    },
    diagramSlice);
}

// Cells cut by only some of the sites contain the true cells. If they fit together, side to side
// and corner to corner, they cover the rectangle equally often everywhere. If also only four of
// their corners are the rectangle's, they cover it once; since the true cells cover it once, too,
// none of them is too large.
std::vector<std::int64_t> PowerDiagram::FindInconsistent(Progress& progress)
{
  const std::int64_t corners = reduceChunks(
    progress, this->NumberOfCells(), cellsOfChunk, std::int64_t{ 0 },
    [this](std::int64_t first, std::int64_t last) {
      std::int64_t count = 0;
      for (std::int64_t place = first; place < last; ++place)
      {
        count += this->Compare(this->SiteAt(place));
      }
      return count;
    },
    std::plus<>());
  const std::vector<std::int64_t> inconsistent = this->SitesCutBy(CutBy::Inconsistent);
  return inconsistent.empty() && corners != 4 ? this->SitesCutBy(CutBy::Known) : inconsistent;
}

std::vector<std::int64_t> PowerDiagram::SitesCutBy(CutBy state)
{
  std::vector<std::int64_t> sites;
  for (std::int64_t place = 0; place < this->NumberOfCells(); ++place)
  {
    const std::int64_t site = this->SiteAt(place);
    if (this->StateOf(site).load(std::memory_order_relaxed) == state)
    {
      sites.push_back(site);
    }
  }
  return sites;
}

// Marks a cell and its neighbours if they do not fit. Returns how many corners of the rectangle
// belong to the cell.
std::int64_t PowerDiagram::Compare(std::int64_t site)
{
  const Cell cell = (*this)[site];
  const auto isNeighbour = [](const Corner& corner) { return corner.Neighbour >= 0; };
  if (this->NumberOfCells() > 1 && std::none_of(cell.First, cell.First + cell.Count, isNeighbour))
  {
    this->MarkInconsistent(site);
  }
  std::int64_t corners = 0;
  // The previous corner: a corner between two sides on the border is one of the rectangle's.
  std::int64_t before = cell.Count - 1;
  for (std::int64_t k = 0; k < cell.Count; before = k++)
  {
    const std::int64_t j = cell[k].Neighbour;
    if (j < 0)
    {
      corners += cell[before].Neighbour < 0 ? 1 : 0;
      continue;
    }
    // The neighbour must have a side with this cell.
    const Cell other = (*this)[j];
    std::int64_t same = 0;
    while (same < other.Count && other[same].Neighbour != site)
    {
      ++same;
    }
    // At the end of the side, both cells must have the same next neighbour. The other end is
    // compared from the other cell.
    const bool fits = same < other.Count && other.Before(same).Neighbour == cell.After(k).Neighbour;
    if (!fits)
    {
      this->MarkInconsistent(site);
      this->MarkInconsistent(j);
    }
  }
  return corners;
}

void PowerDiagram::MarkInconsistent(std::int64_t site)
{
  // Several threads may doubt the same cell: only the state Known changes, once.
  CutBy known = CutBy::Known;
  this->StateOf(site).compare_exchange_strong(
    known, CutBy::Inconsistent, std::memory_order_relaxed, std::memory_order_relaxed);
}

// Cuts cells by their known neighbours first, which makes them small, and then by all rivals that
// the tree finds. The new corners go to chunks behind those of the first pass.
void PowerDiagram::CutByAll(
  const std::vector<std::int64_t>& sites, const double* weights, Progress& progress)
{
  const auto count = static_cast<std::int64_t>(sites.size());
  const auto firstChunk = static_cast<std::int64_t>(this->Now.Chunks.size());
  this->Now.Chunks.resize(
    static_cast<std::size_t>(firstChunk + (count + cellsOfChunk - 1) / cellsOfChunk));
  progress.For(
    count, cellsOfChunk,
    [&](std::int64_t first, std::int64_t last) {
      Cutter cutter;
      for (std::int64_t i = first; i < last; ++i)
      {
        const std::int64_t site = sites[static_cast<std::size_t>(i)];
        // Known neighbours make the cell small at once, so that few boxes of the tree remain.
        this->CutByNeighbours((*this)[site], site, weights, cutter);
        this->CutByRivals(site, weights[site], cutter);
        this->Now.Store(this->SiteOf(site), site, firstChunk + i / cellsOfChunk, cutter);
        this->StateOf(site).store(CutBy::All, std::memory_order_relaxed);
      }
    },
    diagramSlice);
}

// Cuts the cell of a site by the neighbours of a known cell, with the new weights.
void PowerDiagram::CutByNeighbours(
  const Cell& known, std::int64_t id, const double* weights, Cutter& cutter) const
{
  const Point<2>& site = this->SiteOf(id);
  cutter.Begin(site, this->Lengths);
  for (std::int64_t k = 0; k < known.Count; ++k)
  {
    const std::int64_t j = known[k].Neighbour;
    if (j >= 0)
    {
      const Point<2>& other = this->SiteOf(j);
      cutter.Cut(j, { other[0] - site[0], other[1] - site[1] }, weights[j] - weights[id]);
    }
  }
}

void PowerDiagram::Cells::Clear(std::int64_t sites, std::int64_t chunks)
{
  this->Places.assign(static_cast<std::size_t>(sites), Place());
  this->Chunks.resize(static_cast<std::size_t>(chunks));
  for (std::vector<Corner>& chunk : this->Chunks)
  {
    chunk.clear();
  }
}

void PowerDiagram::Cells::Store(
  const Point<2>& at, std::int64_t site, std::int64_t chunk, const Cutter& cutter)
{
  std::vector<Corner>& corners = this->Chunks[static_cast<std::size_t>(chunk)];
  const auto first = static_cast<std::int64_t>(corners.size());
  cutter.Append(at, corners);
  this->Places[static_cast<std::size_t>(site)] = { chunk, first, cutter.Size() };
}

// Cuts the cell by all sites that the tree cannot rule out.
void PowerDiagram::CutByRivals(std::int64_t site, double weight, Cutter& cutter) const
{
  this->Tree.VisitRivals(this->SiteOf(site), weight, cutter,
    [&](std::int64_t j, const Point<2>& offset, double otherWeight) {
      if (j != site)
      {
        cutter.Cut(j, offset, otherWeight - weight);
      }
    });
}

// A trial cell for one weight: the diagram does not change, so that several threads may call this.
void PowerDiagram::CutCell(std::int64_t site, double weight, std::vector<Corner>& corners) const
{
  const Point<2>& x = this->SiteOf(site);
  Cutter cutter;
  cutter.Begin(x, this->Lengths);
  this->CutByRivals(site, weight, cutter);
  corners.clear();
  cutter.Append(x, corners);
}

} // namespace RectifiedTransport
