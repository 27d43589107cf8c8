// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PowerCells/PowerDiagram.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

// One cell while it is cut; coordinates are relative to its site.
class PowerDiagram::Cutter
{
public:
  // Begins with the rectangle.
  void Begin(const Point<2>& site, const Point<2>& lengths)
  {
    const Point<2> low = { -site[0], -site[1] };
    const Point<2> high = { lengths[0] - site[0], lengths[1] - site[1] };
    this->Polygon = { { low, -1 }, { { high[0], low[1] }, -1 }, { high, -1 },
      { { low[0], high[1] }, -1 } };
    this->FindRadius();
  }

  // Cuts away what belongs to a site at an offset, whose weight is larger by `gain` than the
  // cell's.
  void Cut(std::int64_t neighbour, const Point<2>& offset, double gain)
  {
    const double square = offset[0] * offset[0] + offset[1] * offset[1];
    const double limit = square - gain;
    // The bisector is limit / (2 distance) from the site.
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
  std::vector<double> Excess; // of each corner beyond the bisector
  double SquaredRadius = 0.0;
  double LargestDistance = 0.0;
};

void PowerDiagram::SetSites(ConstPointSpan<2> sites, Progress& progress)
{
  this->Tree.Build(sites, progress);
  this->Sites.resize(static_cast<std::size_t>(sites.size()));
  for (std::int64_t i = 0; i < sites.size(); ++i)
  {
    this->Sites[static_cast<std::size_t>(i)] = { sites[i][0], sites[i][1] };
  }
  if (this->Places.size() != this->Sites.size())
  {
    this->Places.assign(this->Sites.size(), Place());
  }
}

void PowerDiagram::Update(const double* weights, Progress& progress)
{
  this->Tree.SetWeights(weights, progress);
  this->LastChunks.swap(this->Chunks);
  this->Chunks.resize(static_cast<std::size_t>(this->NumberOfChunks()));
  this->LastChunks.resize(this->Chunks.size());
  constexpr std::int64_t firstSlice = 1 << 8; // where all cells meet in a point they are slow
  progress.For(
    this->NumberOfCells(), cellsOfChunk,
    [&](std::int64_t first, std::int64_t last) {
      Cutter cutter;
      for (std::int64_t place = first; place < last; ++place)
      {
        if (place % cellsOfChunk == 0)
        {
          this->Chunks[static_cast<std::size_t>(place / cellsOfChunk)].clear();
        }
        this->UpdateCell(place, weights, cutter);
      }
    },
    firstSlice);
}

void PowerDiagram::UpdateCell(std::int64_t at, const double* weights, Cutter& cutter)
{
  const std::int64_t id = this->Tree.Site(at);
  const Point<2>& site = this->Sites[static_cast<std::size_t>(id)];
  const double weight = weights[id];
  Place& place = this->Places[static_cast<std::size_t>(id)];
  cutter.Begin(site, this->Lengths);
  const Corner* known =
    this->LastChunks[static_cast<std::size_t>(place.Chunk)].data() + place.First;
  for (std::int64_t k = 0; k < place.Count; ++k)
  {
    const std::int64_t j = known[k].Neighbour;
    if (j >= 0)
    {
      const Point<2>& other = this->Sites[static_cast<std::size_t>(j)];
      cutter.Cut(j, { other[0] - site[0], other[1] - site[1] }, weights[j] - weight);
    }
  }
  this->CutByRivals(id, weight, cutter);
  const std::int64_t chunk = at / cellsOfChunk;
  std::vector<Corner>& corners = this->Chunks[static_cast<std::size_t>(chunk)];
  place = { chunk, static_cast<std::int64_t>(corners.size()), cutter.Size() };
  cutter.Append(site, corners);
}

void PowerDiagram::CutByRivals(std::int64_t site, double weight, Cutter& cutter) const
{
  this->Tree.VisitRivals(this->Sites[static_cast<std::size_t>(site)], weight, cutter,
    [&](std::int64_t j, const Point<2>& offset, double otherWeight) {
      if (j != site)
      {
        cutter.Cut(j, offset, otherWeight - weight);
      }
    });
}

void PowerDiagram::CutCell(std::int64_t site, double weight, std::vector<Corner>& corners) const
{
  const Point<2>& x = this->Sites[static_cast<std::size_t>(site)];
  Cutter cutter;
  cutter.Begin(x, this->Lengths);
  this->CutByRivals(site, weight, cutter);
  corners.clear();
  cutter.Append(x, corners);
}

} // namespace RectifiedTransport
