// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/EqualMasses/BorderMaxFlow.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

// A distance beyond all others that can still be incremented.
constexpr std::int64_t unreached = std::numeric_limits<std::int64_t>::max() - 1;

} // namespace

// Each round of the callers begins without borders, as those of the round before have moved.
void BorderMaxFlow::Clear()
{
  this->Borders.clear();
  this->Numbers.clear();
}

std::int64_t BorderMaxFlow::Add(std::int64_t low, std::int64_t high)
{
  // Borders are numbered in the order in which they are found.
  const auto next = static_cast<std::int64_t>(this->Borders.size());
  const auto [found, isNew] = this->Numbers.try_emplace(this->Key(low, high), next);
  if (isNew)
  {
    this->Borders.push_back({ low, high });
  }
  return found->second;
}

std::int64_t BorderMaxFlow::Find(std::int64_t low, std::int64_t high) const
{
  return this->Numbers.find(this->Key(low, high))->second;
}

void BorderMaxFlow::Plan(const std::vector<std::int64_t>& excess,
  const std::vector<std::int64_t>& count, Progress& progress)
{
  this->FindNeighbours();
  this->Excess = excess;
  this->Movable = count;
  // A phase of Dinic's algorithm: distances to the sinks by breadth-first search, then a blocking
  // flow of shortest paths.
  while (this->FindDistances())
  {
    // Each cell tries its neighbours from the first one again.
    this->Next.assign(this->FirstNeighbour.begin(), this->FirstNeighbour.end() - 1);
    for (std::int64_t cell = 0; cell < this->Cells; ++cell)
    {
      if (this->Excess[cell] > 0 && this->Distance[cell] != unreached)
      {
        progress.Check();
      }
      while (this->Excess[cell] > 0 && this->FindPath(cell))
      {
        this->Augment(cell);
      }
    }
  }
  progress.Check();
}

// Makes adjacency lists from the borders, by counting sort.
void BorderMaxFlow::FindNeighbours()
{
  // The first neighbour of each cell, by prefix sums of their numbers.
  this->FirstNeighbour.assign(static_cast<std::size_t>(this->Cells) + 1, 0);
  for (const SiteCellBorder& border : this->Borders)
  {
    ++this->FirstNeighbour[border.Low + 1];
    ++this->FirstNeighbour[border.High + 1];
  }
  std::partial_sum(
    this->FirstNeighbour.begin(), this->FirstNeighbour.end(), this->FirstNeighbour.begin());
  this->Neighbours.resize(2 * this->Borders.size());
  this->Next = this->FirstNeighbour;
  for (std::size_t i = 0; i < this->Borders.size(); ++i)
  {
    const SiteCellBorder& border = this->Borders[i];
    const auto number = static_cast<std::int64_t>(i);
    this->Neighbours[this->Next[border.Low]++] = { border.High, number, 1 };
    this->Neighbours[this->Next[border.High]++] = { border.Low, number, -1 };
  }
}

// Returns the residual capacity of a border in one direction: half its extent, at least 1, less the
// flow in that direction.
std::int64_t BorderMaxFlow::Capacity(std::int64_t number, int sign) const
{
  const SiteCellBorder& border = this->Borders[number];
  return std::max<std::int64_t>(1, border.Extent / 2) - sign * border.Flow;
}

// Finds the distance in borders from each site cell to the nearest one with too few pixels,
// backwards from these. Returns false if no cell with too many has a path.
bool BorderMaxFlow::FindDistances()
{
  this->Distance.assign(static_cast<std::size_t>(this->Cells), unreached);
  this->Queue.clear();
  for (std::int64_t cell = 0; cell < this->Cells; ++cell)
  {
    if (this->Excess[cell] < 0)
    {
      this->Distance[cell] = 0;
      this->Queue.push_back(cell);
    }
  }
  bool found = false;
  for (std::size_t at = 0; at < this->Queue.size(); ++at)
  {
    const std::int64_t cell = this->Queue[at];
    found = found || this->Excess[cell] > 0;
    for (std::int64_t i = this->FirstNeighbour[cell]; i < this->FirstNeighbour[cell + 1]; ++i)
    {
      const Neighbour& from = this->Neighbours[i];
      // The residual edge leads from the neighbour to this cell, so its sign is reversed.
      if (this->Distance[from.Cell] == unreached && this->Movable[from.Cell] > 0 &&
        this->Capacity(from.Border, -from.Sign) > 0)
      {
        this->Distance[from.Cell] = this->Distance[cell] + 1;
        this->Queue.push_back(from.Cell);
      }
    }
  }
  return found;
}

// Finds a shortest path to a site cell with too few pixels by depth-first search in the level
// graph. A neighbour without a path is not tried again in this phase.
bool BorderMaxFlow::FindPath(std::int64_t start)
{
  this->Path.clear();
  std::int64_t cell = start;
  while (this->Excess[cell] >= 0)
  {
    std::int64_t& next = this->Next[cell];
    const std::int64_t end = this->FirstNeighbour[cell + 1];
    while (next < end && !this->IsAdmissible(cell, this->Neighbours[next]))
    {
      ++next;
    }
    if (next < end)
    {
      this->Path.push_back(next);
      cell = this->Neighbours[next].Cell;
    }
    else if (this->Path.empty())
    {
      return false;
    }
    else
    {
      // A dead end: one step back, and on to the next neighbour.
      const std::int64_t last = this->Path.back();
      this->Path.pop_back();
      cell = this->Path.empty() ? start : this->Neighbours[this->Path.back()].Cell;
      this->Next[cell] = last + 1;
    }
  }
  return true;
}

// An edge of the level graph leads one border nearer to a sink. It needs residual capacity, and its
// cell needs pixels to send.
bool BorderMaxFlow::IsAdmissible(std::int64_t cell, const Neighbour& to) const
{
  return this->Distance[to.Cell] + 1 == this->Distance[cell] && this->Movable[cell] > 0 &&
    this->Capacity(to.Border, to.Sign) > 0;
}

// Sends as much along the path as its narrowest border, its cells' pixels and both ends allow.
void BorderMaxFlow::Augment(std::int64_t start)
{
  // The bottleneck of the path.
  std::int64_t amount = this->Excess[start];
  std::int64_t cell = start;
  for (const std::int64_t step : this->Path)
  {
    const Neighbour& to = this->Neighbours[step];
    amount = std::min({ amount, this->Movable[cell], this->Capacity(to.Border, to.Sign) });
    cell = to.Cell;
  }
  amount = std::min(amount, -this->Excess[cell]);
  this->Excess[start] -= amount;
  this->Excess[cell] += amount;
  // Second pass: the flow of every border on the path changes by the amount.
  cell = start;
  for (const std::int64_t step : this->Path)
  {
    const Neighbour& to = this->Neighbours[step];
    this->Borders[to.Border].Flow += to.Sign * amount;
    this->Movable[cell] -= amount;
    cell = to.Cell;
  }
}

} // namespace RectifiedTransport
