// SPDX-License-Identifier: BSD-3-Clause
// Shortest paths along the edges of a component, between its seams.
#ifndef RectifiedTransport_SeamSearch_h
#define RectifiedTransport_SeamSearch_h

#include "Surfaces/Seams/SeamMesh.h"

#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Dijkstra's algorithm over points. Equal distances are in the order of the points, so that paths
// do not depend on anything else. Memory: 16 bytes a point, and the queue.
class SeamSearch
{
public:
  // Adds a unit to the progress for each point that it visits.
  SeamSearch(const SeamMesh& mesh, Progress& progress);

  // Forgets what was entered, in the time that this took.
  void Clear();
  // Enters a path to a point, unless one is known that is no longer. Its last edge is `side`, or -1
  // where it begins.
  void Enter(std::int64_t point, double distance, std::int64_t side);
  // The nearest point that was not visited yet; -1 if there is none. Throws Cancelled.
  std::int64_t Next();
  // Enters the neighbours of a visited point that are on no seam.
  void EnterNeighbours(std::int64_t point);

  double Distance(std::int64_t point) const
  {
    return this->Distances[static_cast<std::size_t>(point)];
  }
  std::int64_t SideTo(std::int64_t point) const
  {
    return this->SidesTo[static_cast<std::size_t>(point)];
  }
  // The edges from where a path began to a point, the last one first.
  std::vector<std::int64_t> PathTo(std::int64_t point) const;

  // The factor of the length of the next edge of the path to a point, which joins a seam or leads
  // on. It is above 1 where an edge would join a point of the path to one of a seam: what this edge
  // cuts off may have no area in the map.
  double FactorAt(std::int64_t point, bool joins) const;

private:
  const SeamMesh& Mesh;
  Progress& Run;
  std::vector<double> Distances;     // by points; infinite if not entered
  std::vector<std::int64_t> SidesTo; // last edges of paths, by points; -1 at starts
  std::vector<std::int64_t> Entered; // points, for Clear()
  using Item = std::pair<double, std::int64_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> Queue;
};

// Joins a point to the seams by a shortest path, if that is at least as long as `least`.
// Returns whether it is.
bool joinToSeams(SeamMesh& mesh, SeamSearch& search, std::int64_t point, double least = 0.0);

} // namespace RectifiedTransport

#endif
