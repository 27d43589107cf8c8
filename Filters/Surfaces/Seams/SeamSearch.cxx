// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/SeamSearch.h"

#include "Core/Parallel/Progress.h"

#include <limits>

namespace RectifiedTransport
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

SeamSearch::SeamSearch(const SeamMesh& mesh, Progress& progress)
  : Mesh(mesh)
  , Run(progress)
  , Distances(static_cast<std::size_t>(mesh.NumberOfPoints()), infinity)
  , SidesTo(static_cast<std::size_t>(mesh.NumberOfPoints()), -1)
{
}

// Only what was entered is reset: a search may be small beside the surface.
void SeamSearch::Clear()
{
  for (const std::int64_t point : this->Entered)
  {
    this->Distances[static_cast<std::size_t>(point)] = infinity;
    this->SidesTo[static_cast<std::size_t>(point)] = -1;
  }
  this->Entered.clear();
  this->Queue = {};
}

// Relaxes the distance of a point. An older item of the queue with a larger distance stays there,
// and Next() skips it: lazy deletion in place of a decrease of keys.
void SeamSearch::Enter(std::int64_t point, double distance, std::int64_t side)
{
  double& known = this->Distances[static_cast<std::size_t>(point)];
  if (distance < known)
  {
    if (known == infinity)
    {
      this->Entered.push_back(point);
    }
    known = distance;
    this->SidesTo[static_cast<std::size_t>(point)] = side;
    this->Queue.emplace(distance, point);
  }
}

// Costs O(log n) an item; each edge adds at most one item for each of its ends.
std::int64_t SeamSearch::Next()
{
  while (!this->Queue.empty())
  {
    const auto [distance, point] = this->Queue.top();
    this->Queue.pop();
    // The item is out of date if a shorter path came later.
    if (distance == this->Distance(point)) // else a shorter path came later
    {
      this->Run.Add(1);
      return point;
    }
  }
  return -1;
}

// A path does not pass along or through seams: it may only end there.
void SeamSearch::EnterNeighbours(std::int64_t point)
{
  const double factor = this->FactorAt(point, false);
  this->Mesh.VisitEdges(point, [&](std::int64_t side, std::int64_t neighbour) {
    if (this->Mesh.MayBeSeam(side) && !this->Mesh.IsOnSeam(neighbour))
    {
      this->Enter(neighbour, this->Distance(point) + factor * this->Mesh.Length(side), side);
    }
  });
}

// From the point backward, up to the start or to where the path leaves a seam.
std::vector<std::int64_t> SeamSearch::PathTo(std::int64_t point) const
{
  std::vector<std::int64_t> path;
  for (std::int64_t side = this->SideTo(point); side >= 0; side = this->SideTo(point))
  {
    path.push_back(side);
    point = this->Mesh.OtherEnd(side, point);
    if (this->Mesh.IsOnSeam(point))
    {
      break;
    }
  }
  return path;
}

// A path beside a seam would leave a corridor one edge wide, whose edges join two boundary points.
// Each such edge costs 8 times its length: the path keeps away from seams where a detour is less
// than that.
double SeamSearch::FactorAt(std::int64_t point, bool joins) const
{
  constexpr double beside = 8.0;
  int neighbours = 0; // number on seams, without those that the path comes from and leads to
  this->Mesh.VisitEdges(point, [&](std::int64_t side, std::int64_t neighbour) {
    neighbours += this->Mesh.IsOnSeam(neighbour) && side != this->SideTo(point) ? 1 : 0;
  });
  return neighbours > (joins ? 1 : 0) ? beside : 1.0;
}

// Dijkstra's algorithm ends when the next point is farther than the best path to a seam.
bool joinToSeams(SeamMesh& mesh, SeamSearch& search, std::int64_t point, double least)
{
  if (mesh.IsOnSeam(point))
  {
    return false;
  }
  search.Clear();
  search.Enter(point, 0.0, -1);
  // The search keeps the cheapest path to a seam so far, with its cost.
  double cost = infinity;
  std::vector<std::int64_t> path;
  for (std::int64_t next = search.Next(); next >= 0 && search.Distance(next) < cost;
       next = search.Next())
  {
    const double factor = search.FactorAt(next, true);
    std::int64_t last = -1;
    mesh.VisitEdges(next, [&](std::int64_t side, std::int64_t neighbour) {
      const double found = search.Distance(next) + factor * mesh.Length(side);
      if (mesh.IsOnSeam(neighbour) && mesh.MayBeSeam(side) && found < cost)
      {
        cost = found;
        last = side;
      }
    });
    if (last >= 0)
    {
      path = search.PathTo(next);
      path.push_back(last);
    }
    // Points on seams are not entered: paths end there.
    search.EnterNeighbours(next);
  }
  // A path that is too short would not open anything.
  const bool isLong = !path.empty() && mesh.LengthOf(path) >= least;
  mesh.SetSeams(path, isLong);
  return isLong;
}

} // namespace RectifiedTransport
