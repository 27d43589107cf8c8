// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Seams/SeamSearch.h"

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

std::int64_t SeamSearch::Next()
{
  while (!this->Queue.empty())
  {
    const auto [distance, point] = this->Queue.top();
    this->Queue.pop();
    if (distance == this->Distance(point)) // else a shorter path came later
    {
      this->Run.Add(1);
      return point;
    }
  }
  return -1;
}

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

double SeamSearch::FactorAt(std::int64_t point, bool joins) const
{
  constexpr double beside = 8.0;
  int neighbours = 0; // on seams, besides those that the path comes from and leads to
  this->Mesh.VisitEdges(point, [&](std::int64_t side, std::int64_t neighbour) {
    neighbours += this->Mesh.IsOnSeam(neighbour) && side != this->SideTo(point) ? 1 : 0;
  });
  return neighbours > (joins ? 1 : 0) ? beside : 1.0;
}

bool joinToSeams(SeamMesh& mesh, SeamSearch& search, std::int64_t point, double least)
{
  if (mesh.IsOnSeam(point))
  {
    return false;
  }
  search.Clear();
  search.Enter(point, 0.0, -1);
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
    search.EnterNeighbours(next);
  }
  const bool isLong = !path.empty() && mesh.LengthOf(path) >= least;
  mesh.SetSeams(path, isLong);
  return isLong;
}

} // namespace RectifiedTransport
