// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/CutGraph.h"

#include "Core/Parallel/KeySort.h"
#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/DisjointSets.h"
#include "Surfaces/Seams/SeamSearch.h"

#include <limits>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The last point that Dijkstra's algorithm visits from another one: the farthest along edges.
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

// The pair of points farthest apart is found nearly by two searches, each from the other's end: the
// double sweep for a graph's diameter. The path between them is one seam, and a sphere less an arc
// is a disk.
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

// An edge for sorting; the least key comes first.
struct KeyedSide
{
  double Key;
  std::int64_t Side;
};

// Cuts along a shortest-path forest and "bridges": edges that neither the forest nor a spanning
// tree of the dual graph (triangles joined across edges) contains. Their number is that of the
// independent loops, 1 - chi with a boundary and 2 - chi without, chi being the Euler
// characteristic; each bridge with its two shortest paths back makes a loop, a greedy homotopy
// basis.
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
        this->SetPathBack(point, isStart);
      }
    }
    if (root >= 0)
    {
      this->RemoveTrunk(root);
    }
  }

private:
  // Shortest paths from the boundary, which is a seam already. A closed surface has a root instead,
  // the first point, which is returned; else -1.
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

  // The bridges, by Kruskal's algorithm for the maximum spanning tree of the dual graph. The
  // longest loops (both distances and the edge) come first, so that triangles are joined across
  // them and short ones are left as bridges. Edges that must not be seams come before all others,
  // so that they end in the tree.
  std::vector<std::int64_t> FindBridges(Progress& progress) const
  {
    std::vector<KeyedSide> sides;
    for (std::int64_t side = 0; side < this->Mesh.NumberOfSides(); ++side)
    {
      // An edge counts once, by its first side. Boundary edges join no triangles.
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
      uniteSets(trees.data(), a, b);
      progress.Add(1);
    }
    return bridges;
  }

  // An edge of the forest is the last one of the path to one of its ends.
  bool IsInForest(std::int64_t side) const
  {
    return this->Search.SideTo(this->Mesh.From(side)) == side ||
      this->Search.SideTo(this->Mesh.To(side)) == side;
  }

  // By points: 1 where a path of the forest begins.
  std::vector<unsigned char> Starts() const
  {
    std::vector<unsigned char> isStart(static_cast<std::size_t>(this->Mesh.NumberOfPoints()));
    for (std::size_t point = 0; point < isStart.size(); ++point)
    {
      isStart[point] = this->Search.SideTo(static_cast<std::int64_t>(point)) < 0 ? 1 : 0;
    }
    return isStart;
  }

  // Sets the path from a point back to its start as seams, up to a path that is set already.
  void SetPathBack(std::int64_t point, const std::vector<unsigned char>& isStart)
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

  // A closed surface's seams all lead to the root. The piece from there up to the first branch is
  // no part of a loop, and is removed edge by edge from its free end.
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
  // A sphere has no bridge, hence no seam: it is a case of its own.
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
