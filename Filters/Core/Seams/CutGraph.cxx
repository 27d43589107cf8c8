// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Seams/CutGraph.h"

#include "Core/Mesh/Trees.h"
#include "Core/Parallel/KeySort.h"
#include "Core/Parallel/Progress.h"
#include "Core/Seams/SeamSearch.h"

#include <limits>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The last point that a search from another one reaches.
std::int64_t farthestFrom(SeamSearch& search, std::int64_t point)
{
  search.Clear();
  search.Enter(point, 0.0, -1);
  std::int64_t last = point;
  for (std::int64_t next = search.Next(); next >= 0; next = search.Next())
  {
    search.EnterNeighbours(next);
    last = next;
  }
  return last;
}

void openSphere(SeamMesh& mesh, SeamSearch& search)
{
  const std::int64_t from = farthestFrom(search, 0);
  const std::int64_t to = farthestFrom(search, from);
  std::vector<std::int64_t> path = search.PathTo(to);
  if (path.size() == 1) // a single edge is no cut: no point would be double
  {
    mesh.VisitEdges(to, [&](std::int64_t side, std::int64_t neighbour) {
      if (path.size() == 1 && neighbour != from && mesh.MayBeSeam(side))
      {
        path.push_back(side);
      }
    });
  }
  mesh.SetSeams(path, true);
}

struct KeyedSide
{
  double Key;
  std::int64_t Side;
};

class CutGraph
{
public:
  CutGraph(SeamMesh& mesh, SeamSearch& search)
    : Mesh(mesh)
    , Search(search)
  {
  }

  void Run(Progress& progress)
  {
    const std::int64_t root = this->FindForest();
    const std::vector<std::int64_t> bridges = this->FindBridges(progress);
    const std::vector<unsigned char> isStart = this->Starts();
    for (const std::int64_t side : bridges)
    {
      this->Mesh.SetSeam(side, true);
      for (std::int64_t point : { this->Mesh.From(side), this->Mesh.To(side) })
      {
        this->SetWayBack(point, isStart);
      }
    }
    if (root >= 0)
    {
      this->RemoveTrunk(root);
    }
  }

private:
  // Shortest paths from the boundary, or else from the first point, which is returned.
  std::int64_t FindForest()
  {
    std::int64_t root = -1;
    if (this->Mesh.IsClosed())
    {
      root = 0;
      this->Search.Enter(root, 0.0, -1);
    }
    else
    {
      for (std::int64_t point = 0; point < this->Mesh.NumberOfPoints(); ++point)
      {
        if (this->Mesh.IsOnSeam(point))
        {
          this->Search.Enter(point, 0.0, -1);
        }
      }
    }
    for (std::int64_t next = this->Search.Next(); next >= 0; next = this->Search.Next())
    {
      this->Search.EnterNeighbours(next);
    }
    return root;
  }

  // The edges outside of the forest that the tree of triangles does not cross.
  std::vector<std::int64_t> FindBridges(Progress& progress) const
  {
    std::vector<KeyedSide> sides;
    for (std::int64_t side = 0; side < this->Mesh.NumberOfSides(); ++side)
    {
      if (!this->Mesh.IsFirst(side) || this->Mesh.Other(side) < 0 || this->IsInForest(side))
      {
        continue;
      }
      const double length = this->Search.Distance(this->Mesh.From(side)) +
        this->Search.Distance(this->Mesh.To(side)) + this->Mesh.Length(side);
      sides.push_back(
        { this->Mesh.MayBeSeam(side) ? -length : -std::numeric_limits<double>::infinity(), side });
    }
    sortByKey(sides, progress);
    std::vector<std::int64_t> trees(static_cast<std::size_t>(this->Mesh.NumberOfTriangles()));
    std::iota(trees.begin(), trees.end(), std::int64_t{ 0 });
    std::vector<std::int64_t> bridges;
    for (const KeyedSide& keyed : sides)
    {
      const std::int64_t a = rootOf(trees.data(), keyed.Side / 3);
      const std::int64_t b = rootOf(trees.data(), this->Mesh.Other(keyed.Side) / 3);
      if (a == b)
      {
        bridges.push_back(keyed.Side);
      }
      joinTrees(trees.data(), a, b);
      progress.Add(1);
    }
    return bridges;
  }

  bool IsInForest(std::int64_t side) const
  {
    return this->Search.SideTo(this->Mesh.From(side)) == side ||
      this->Search.SideTo(this->Mesh.To(side)) == side;
  }

  std::vector<unsigned char> Starts() const
  {
    std::vector<unsigned char> isStart(static_cast<std::size_t>(this->Mesh.NumberOfPoints()));
    for (std::size_t point = 0; point < isStart.size(); ++point)
    {
      isStart[point] = this->Search.SideTo(static_cast<std::int64_t>(point)) < 0 ? 1 : 0;
    }
    return isStart;
  }

  void SetWayBack(std::int64_t point, const std::vector<unsigned char>& isStart)
  {
    while (!isStart[static_cast<std::size_t>(point)])
    {
      const std::int64_t side = this->Search.SideTo(point);
      if (this->Mesh.IsSeam(side))
      {
        return;
      }
      this->Mesh.SetSeam(side, true);
      point = this->Mesh.OtherEnd(side, point);
    }
  }

  // Seams from the root that end at their other end only.
  void RemoveTrunk(std::int64_t point)
  {
    while (this->Mesh.SeamsAt(point) == 1)
    {
      std::int64_t seam = -1;
      this->Mesh.VisitEdges(point,
        [&](std::int64_t side, std::int64_t) { seam = this->Mesh.IsSeam(side) ? side : seam; });
      this->Mesh.SetSeam(seam, false);
      point = this->Mesh.OtherEnd(seam, point);
    }
  }

  SeamMesh& Mesh;
  SeamSearch& Search;
};

} // namespace

void openToDisk(SeamMesh& mesh, Progress& progress)
{
  SeamSearch search(mesh, progress);
  constexpr std::int64_t sphere = 2; // the Euler characteristic
  if (mesh.EulerCharacteristic() == sphere)
  {
    openSphere(mesh, search);
  }
  else
  {
    CutGraph(mesh, search).Run(progress);
  }
}

} // namespace RectifiedTransport
