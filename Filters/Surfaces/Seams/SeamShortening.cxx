// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/CutGraph.h"

#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/DisjointSets.h"
#include "Surfaces/Seams/SeamSearch.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Seam = std::vector<std::int64_t>; // edges in the order of the path

// Local search on the cut graph: a seam is removed, the boundary then has two loops, and a shortest
// path between the loops takes the seam's place if it costs less. The topology stays that of a
// disk, as any path that joins two boundary loops of an annulus opens it.
class SeamShortening
{
public:
  SeamShortening(SeamMesh& mesh, Progress& progress)
    : Mesh(mesh)
    , Run(progress)
    , Search(mesh, progress)
    , Loops(static_cast<std::size_t>(mesh.NumberOfSides()))
  {
  }

  // Tries the `most` longest seams, the longest first. Returns whether one is shorter now.
  bool Pass(std::size_t most)
  {
    std::vector<std::pair<double, std::int64_t>> seams = this->FindSeams();
    // Long seams have most to gain, and equal lengths keep the order of their sides.
    std::stable_sort(
      seams.begin(), seams.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    seams.resize(std::min(seams.size(), most));
    bool isShorter = false;
    for (const auto& [length, side] : seams)
    {
      // Others may have moved: where they did, a seam may end elsewhere.
      if (this->Mesh.IsSeam(side))
      {
        isShorter = this->Shorten(this->SeamOf(side)) || isShorter;
      }
      this->Run.Check();
    }
    return isShorter;
  }

private:
  // Appends the edges from a point along a seam, up to where it ends or meets others: inside of a
  // seam a point has two edges.
  void Follow(std::int64_t from, std::int64_t side, Seam& seam) const
  {
    const std::int64_t first = side;
    std::int64_t point = this->Mesh.OtherEnd(side, from);
    seam.push_back(side);
    while (this->Mesh.SeamsAt(point) == 2)
    {
      std::int64_t next = -1;
      this->Mesh.VisitEdges(point, [&](std::int64_t other, std::int64_t) {
        next = this->Mesh.IsSeam(other) && other != side ? other : next;
      });
      // The seam is a closed curve.
      if (next == first)
      {
        return;
      }
      side = next;
      seam.push_back(side);
      point = this->Mesh.OtherEnd(side, point);
    }
  }

  // The whole seam that an edge is part of: followed in one direction and, reversed, in the other.
  Seam SeamOf(std::int64_t side) const
  {
    Seam back;
    this->Follow(this->Mesh.To(side), side, back);
    Seam seam(back.rbegin(), back.rend());
    seam.pop_back();
    this->Follow(this->Mesh.From(side), side, seam);
    return seam;
  }

  // The point where the first edge begins: the end that the second edge does not have.
  std::int64_t StartOf(const Seam& seam) const
  {
    const std::int64_t from = this->Mesh.From(seam[0]);
    const bool isBack =
      seam.size() > 1 && (from == this->Mesh.From(seam[1]) || from == this->Mesh.To(seam[1]));
    return isBack ? this->Mesh.To(seam[0]) : from;
  }

  // The length of each seam, without those of the boundary, and its first side.
  std::vector<std::pair<double, std::int64_t>> FindSeams() const
  {
    std::vector<std::pair<double, std::int64_t>> seams;
    std::vector<unsigned char> isKnown(static_cast<std::size_t>(this->Mesh.NumberOfSides()), 0);
    for (std::int64_t side = 0; side < this->Mesh.NumberOfSides(); ++side)
    {
      if (this->Mesh.IsFirst(side) && this->Mesh.Other(side) >= 0 && this->Mesh.IsSeam(side) &&
        !isKnown[static_cast<std::size_t>(side)])
      {
        const Seam seam = this->SeamOf(side);
        for (const std::int64_t one : seam)
        {
          isKnown[static_cast<std::size_t>(one)] = 1;
        }
        seams.emplace_back(this->Mesh.LengthOf(seam), side);
      }
    }
    return seams;
  }

  // Finds the boundary loops of the cut surface, by union-find over the corners at points on seams:
  // a corner joins the next one along a seam, and the one across an edge that is no seam.
  // Corners of one loop then have one root. Returns the roots.
  std::vector<std::int64_t> FindLoops()
  {
    std::int64_t* trees = this->Loops.data();
    const auto visitSeamCorners = [this](const auto& visit) {
      for (std::int64_t point = 0; point < this->Mesh.NumberOfPoints(); ++point)
      {
        if (this->Mesh.IsOnSeam(point))
        {
          this->Mesh.VisitCorners(point, visit);
        }
      }
    };
    // Only corners at points on seams are set; entries of others are from earlier calls.
    visitSeamCorners([&](std::int64_t corner) { trees[corner] = corner; });
    visitSeamCorners([&](std::int64_t corner) {
      for (const std::int64_t side : { corner, lastSide(corner) })
      {
        const std::int64_t from = this->Mesh.From(side);
        if (this->Mesh.IsSeam(side))
        {
          uniteSets(trees, side, nextSide(side));
        }
        else
        {
          const std::int64_t other = this->Mesh.Other(side);
          // Where the triangles agree in orientation, the other side runs the opposite way.
          const bool isOpposite = this->Mesh.From(other) != from;
          const std::int64_t own = side == corner ? side : nextSide(side);
          const std::int64_t opposite = (side == corner) == isOpposite ? nextSide(other) : other;
          uniteSets(trees, own, opposite);
        }
      }
    });
    std::vector<std::int64_t> roots;
    visitSeamCorners([&](std::int64_t corner) {
      if (trees[corner] == corner)
      {
        roots.push_back(corner);
      }
    });
    return roots;
  }

  // A path between two loops, with its cost.
  struct Join
  {
    double Cost;
    Seam Sides;
  };

  // A shortest path from one loop to another one, by Dijkstra's algorithm from all points of the
  // first; its cost must be less than `most`, or it has no sides.
  Join FindJoin(std::int64_t fromLoop, std::int64_t toLoop, double most)
  {
    Join join{ most, {} };
    std::int64_t end = -1;
    const auto isOf = [this](std::int64_t corner, std::int64_t loop) {
      return rootOf(this->Loops.data(), corner) == loop;
    };
    // The corner at a point, on a seam, of the triangle of a side that begins or ends there.
    const auto cornerAt = [this](std::int64_t side, std::int64_t point) {
      return this->Mesh.From(side) == point ? side : nextSide(side);
    };
    this->Search.Clear();
    for (std::int64_t point = 0; point < this->Mesh.NumberOfPoints(); ++point)
    {
      if (!this->Mesh.IsOnSeam(point))
      {
        continue;
      }
      this->Mesh.VisitEdges(point, [&](std::int64_t side, std::int64_t neighbour) {
        if (this->Mesh.IsSeam(side) || !this->Mesh.MayBeSeam(side) ||
          !isOf(cornerAt(side, point), fromLoop))
        {
          return;
        }
        // An edge from loop to loop is a path by itself.
        const double length = this->Mesh.Length(side);
        if (!this->Mesh.IsOnSeam(neighbour))
        {
          this->Search.Enter(neighbour, length, side);
        }
        else if (isOf(cornerAt(side, neighbour), toLoop) && length < join.Cost)
        {
          join = { length, { side } };
        }
      });
    }
    for (std::int64_t next = this->Search.Next();
         next >= 0 && this->Search.Distance(next) < join.Cost; next = this->Search.Next())
    {
      const double factor = this->Search.FactorAt(next, true);
      this->Mesh.VisitEdges(next, [&](std::int64_t side, std::int64_t neighbour) {
        const double cost = this->Search.Distance(next) + factor * this->Mesh.Length(side);
        if (this->Mesh.IsOnSeam(neighbour) && this->Mesh.MayBeSeam(side) && cost < join.Cost &&
          isOf(cornerAt(side, neighbour), toLoop))
        {
          join = { cost, { side } };
          end = next;
        }
      });
      this->Search.EnterNeighbours(next);
    }
    if (end >= 0)
    {
      // The edges are in order from the end to the start; their set alone matters.
      const Seam rest = this->Search.PathTo(end);
      join.Sides.insert(join.Sides.end(), rest.begin(), rest.end());
    }
    return join;
  }

  // The cost of a path that is no seam now, from its first edge on: with the same factors as in a
  // search, so that both are comparable.
  double CostOf(const Seam& path, std::int64_t start)
  {
    this->Search.Clear();
    double cost = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i)
    {
      const bool joins = i + 1 == path.size();
      cost += (i == 0 ? 1.0 : this->Search.FactorAt(start, joins)) * this->Mesh.Length(path[i]);
      start = this->Mesh.OtherEnd(path[i], start);
      this->Search.Enter(start, cost, path[i]);
    }
    return cost;
  }

  // Replaces a seam by a cheaper one. With one loop left, the seam has the same loop on both sides
  // (a handle): another path would not be guaranteed to open the surface.
  bool Shorten(const Seam& seam)
  {
    this->Mesh.SetSeams(seam, false);
    const std::vector<std::int64_t> loops = this->FindLoops();
    if (loops.size() == 2)
    {
      // The largest ratio of costs that is worth while; above, rounding.
      constexpr double least = 1.0 - 1e-9;
      const double cost = least * this->CostOf(seam, this->StartOf(seam));
      // The seam is taken off while the path is sought, so that the new one may run along it.
      const Join join = this->FindJoin(loops[0], loops[1], cost);
      if (!join.Sides.empty())
      {
        this->Mesh.SetSeams(join.Sides, true);
        return true;
      }
    }
    this->Mesh.SetSeams(seam, true);
    return false;
  }

  SeamMesh& Mesh;
  Progress& Run;
  SeamSearch Search;
  std::vector<std::int64_t> Loops; // trees, by corners on seams
};

} // namespace

void shortenSeams(SeamMesh& mesh, Progress& progress)
{
  // Each pass lets seams follow those that moved before; gains fall off quickly.
  constexpr int passes = 3;
  constexpr std::size_t most = 64; // seams in a pass: each takes the time to find all loops
  SeamShortening shortening(mesh, progress);
  for (int pass = 0; pass < passes && shortening.Pass(most); ++pass)
  {
  }
}

} // namespace RectifiedTransport
