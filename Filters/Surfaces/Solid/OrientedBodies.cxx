// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Solid/OrientedBodies.h"

#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/DisjointSets.h"
#include "Surfaces/Mesh/SurfaceOrientation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Index = std::int64_t;

// A side of a triangle at an edge of more than two.
struct FanSide
{
  Index Low; // the lower and the higher of its ends
  Index High;
  Index Side;
  double Angle; // about the edge, in radians
};

// A condition on two patches: that both keep or both change their orientations (1), or that one of
// them changes alone (-1).
struct Relation
{
  Index Patch;
  Index Other;
  int Same; // 1 or -1
};

// Works on patches, not triangles: edges of two triangles fix the orientations within a patch
// (breadth first), so that only the edges of four or more are left to decide.
class OrientationRun
{
public:
  OrientationRun(const TriangleSurface& surface, const SurfaceEdges& edges)
    : Surface(surface)
    , Edges(edges)
    , Signs(surface.NumberOfTriangles)
    , Patches(surface.NumberOfTriangles)
  {
  }

  // Turns triangles in place. Without edges of more than two triangles each patch is a body; else
  // fans decide how patches are turned, and then which of them enclose a body together.
  OrientedBodies Run(Index* triangles, Progress& progress)
  {
    Stages stages(progress,
      { { "patches", 80 }, { "fans", this->Edges.NonManifold() > 0 ? 10.0 : 0.0 },
        { "triangles", 10 } });
    if (!this->FindPatches(stages["patches"]))
    {
      return { false, {} };
    }
    this->Turns.assign(this->Areas.size(), 1);
    this->Roots.resize(this->Areas.size());
    std::iota(this->Roots.begin(), this->Roots.end(), Index{ 0 });
    if (this->Edges.NonManifold() > 0)
    {
      this->FindFans(stages["fans"]);
      if (!this->TurnUnbalanced())
      {
        return { false, {} };
      }
      this->JoinPatches();
    }
    Progress& turns = stages["triangles"].Expect(this->Surface.NumberOfTriangles);
    for (Index i = 0; i < this->Surface.NumberOfTriangles; ++i)
    {
      Index& patch = this->Patches.data()[i];
      // A triangle is turned if exactly one of the two asks for it: its patch's own orientation, or
      // the turn of the patch. The array of patches becomes the result.
      if (this->Signs.data()[i] * this->Turns[static_cast<std::size_t>(patch)] < 0)
      {
        std::swap(triangles[3 * i + 1], triangles[3 * i + 2]);
      }
      patch = this->RootOf(patch);
      turns.Add(1);
    }
    return { true, std::move(this->Patches) };
  }

private:
  // Numbers the patches and orients each as most of its area is. Returns false if a patch is not
  // orientable.
  bool FindPatches(Progress& progress)
  {
    progress.Expect(this->Surface.NumberOfTriangles);
    return visitPatches(
      this->Surface, this->Edges, this->Signs.data(), progress, [this](const SurfacePatch& patch) {
        bool isMended = false;
        for (Index i = 0; i < patch.Count; ++i)
        {
          const Index triangle = patch.Triangles[i];
          this->Patches.data()[triangle] = static_cast<Index>(this->Areas.size());
          isMended = isMended || this->Signs.data()[triangle] < 0;
        }
        this->Areas.push_back(patch.Area);
        this->IsMended.push_back(isMended);
      });
  }

  // Finds the sides at edges of more than two triangles, sorted by edges.
  void FindFans(Progress& progress)
  {
    progress.Expect(this->Surface.NumberOfTriangles);
    for (Index side = 0; side < 3 * this->Surface.NumberOfTriangles; ++side)
    {
      // A closed surface has no open edges, so that -1 says that the edge has more than two
      // triangles.
      if (this->Edges.Other(side) < 0)
      {
        const Index from = this->Surface.Triangles[side];
        const Index to = this->Surface.Triangles[nextSide(side)];
        this->Fans.push_back({ std::min(from, to), std::max(from, to), side, 0.0 });
      }
      progress.Add(side % 3 == 2 ? 1 : 0);
    }
    std::sort(this->Fans.begin(), this->Fans.end(), [](const FanSide& a, const FanSide& b) {
      return std::tie(a.Low, a.High, a.Side) < std::tie(b.Low, b.High, b.Side);
    });
  }

  // Calls visit(begin, end) for the sides of each edge, its fan.
  template <class Visit>
  void ForFans(const Visit& visit)
  {
    FanSide* end = this->Fans.data() + this->Fans.size();
    for (FanSide* begin = this->Fans.data(); begin < end;)
    {
      FanSide* next = std::find_if(begin, end, [begin](const FanSide& side) {
        return side.Low != begin->Low || side.High != begin->High;
      });
      visit(begin, next);
      begin = next;
    }
  }

  Index PatchOf(const FanSide& side) const { return this->Patches.data()[side.Side / 3]; }

  // 1 where the triangle, as its patch is oriented, passes the edge from the lower to the higher
  // end, else -1.
  int DirectionOf(const FanSide& side) const
  {
    const int sign = this->Signs.data()[side.Side / 3];
    return this->Surface.Triangles[side.Side] == side.Low ? sign : -sign;
  }

  Index RootOf(Index patch) { return rootOf(this->Roots.data(), patch); }
  void Join(Index a, Index b) { uniteSets(this->Roots.data(), a, b); }

  // Joins patches into bodies of which each is closed. At an edge, sides that pass it one way are
  // paired with sides that pass it the other way: first those of the same body, then the rest.
  void JoinPatches()
  {
    // TurnUnbalanced has joined whole groups in this array, which are too coarse for bodies.
    std::iota(this->Roots.begin(), this->Roots.end(), Index{ 0 });
    this->ForFans([&](FanSide* begin, FanSide* end) {
      std::vector<std::array<Index, 2>> sums; // roots, with 1 or -1 for the direction
      for (const FanSide* side = begin; side < end; ++side)
      {
        const Index patch = this->PatchOf(*side);
        const Index way = this->DirectionOf(*side) * this->Turns[static_cast<std::size_t>(patch)];
        sums.push_back({ this->RootOf(patch), way });
      }
      std::sort(sums.begin(), sums.end());
      // What is left of each body at the edge after pairs of opposite directions cancel.
      std::vector<std::array<Index, 2>> left;
      for (const std::array<Index, 2>& sum : sums)
      {
        if (!left.empty() && left.back()[0] == sum[0] && left.back()[1] == -sum[1])
        {
          left.pop_back();
        }
        else
        {
          left.push_back(sum);
        }
      }
      this->JoinOpposite(left);
    });
  }

  // Joins the bodies of the i-th side of each direction; a balanced edge has as many of both.
  void JoinOpposite(std::vector<std::array<Index, 2>>& left)
  {
    std::vector<Index> ways[2];
    for (const std::array<Index, 2>& side : left)
    {
      ways[side[1] > 0 ? 0 : 1].push_back(side[0]);
    }
    for (std::size_t i = 0; i < std::min(ways[0].size(), ways[1].size()); ++i)
    {
      this->Join(ways[0][i], ways[1][i]);
    }
  }

  // Turns the patches of those groups (patches joined by edges of more than two triangles) that are
  // not balanced, or whose patches were mended.
  bool TurnUnbalanced()
  {
    this->ForFans([&](const FanSide* begin, const FanSide* end) {
      for (const FanSide* side = begin + 1; side < end; ++side)
      {
        this->Join(this->PatchOf(*begin), this->PatchOf(*side));
      }
    });
    this->Groups.assign(this->Roots.size(), Group::Agrees);
    this->ForFans([&](const FanSide* begin, const FanSide* end) {
      Group& group = this->GroupOf(this->PatchOf(*begin));
      // A balanced edge is passed as often one way as the other: the directions sum to 0.
      const int sum = std::accumulate(begin, end, 0,
        [this](int before, const FanSide& side) { return before + this->DirectionOf(side); });
      const bool isMended = std::any_of(begin, end, [this](const FanSide& side) {
        return this->IsMended[static_cast<std::size_t>(this->PatchOf(side))];
      });
      group = std::max(group,
        sum != 0     ? Group::Unbalanced
          : isMended ? Group::Mended
                     : Group::Agrees);
    });
    std::vector<Relation> relations;
    this->ForFans([&](FanSide* begin, FanSide* end) {
      if (this->GroupOf(this->PatchOf(*begin)) != Group::Agrees)
      {
        this->RelateFan(begin, end, relations);
      }
    });
    return this->TurnAsRelated(relations);
  }

  // The state of a group of patches that are joined by edges; the larger value wins.
  enum class Group
  {
    Agrees, // as given
    Mended, // as each patch is oriented alone
    Unbalanced
  };

  Group& GroupOf(Index patch)
  {
    return this->Groups[static_cast<std::size_t>(this->RootOf(patch))];
  }

  // What the order of angles about an edge asks of its patches: between neighbours in the order,
  // solid and empty space alternate, so that neighbours 2k and 2k + 1 face each other and those in
  // between, too. They pass the edge in opposite directions then.
  void RelateFan(FanSide* begin, FanSide* end, std::vector<Relation>& relations)
  {
    this->SortByAngles(begin, end);
    const auto relate = [&](const FanSide& a, const FanSide& b) {
      const int same = -this->DirectionOf(a) * this->DirectionOf(b);
      relations.push_back({ this->PatchOf(a), this->PatchOf(b), same });
      relations.push_back({ this->PatchOf(b), this->PatchOf(a), same });
    };
    // Pairs at one angle face each other, whatever is beside them.
    std::vector<FanSide> single;
    for (const FanSide* side = begin; side < end; ++side)
    {
      constexpr double rounding = 1e-9;
      if (side + 1 < end && side[1].Angle - side[0].Angle < rounding)
      {
        relate(side[0], side[1]);
        ++side;
        continue;
      }
      single.push_back(*side);
    }
    for (std::size_t i = 1; i < single.size(); ++i)
    {
      relate(single[i - 1], single[i]);
    }
  }

  // Sorts a fan by the angles about the edge, from the first side's triangle on, in [0, 2 pi).
  void SortByAngles(FanSide* begin, FanSide* end) const
  {
    const Point<3> low = pointAt(this->Surface.Points, begin->Low);
    const Point<3> along = pointAt(this->Surface.Points, begin->High) - low;
    const double length = std::sqrt(dot(along, along));
    Point<3> across{}; // unit vector in the first triangle's plane, across the edge
    Point<3> normal{};
    for (FanSide* side = begin; side < end; ++side)
    {
      const Index third = this->Surface.Triangles[lastSide(side->Side)];
      const Point<3> out = pointAt(this->Surface.Points, third) - low;
      if (side == begin)
      {
        normal = cross(along, out);
        across = cross(normal, along);
        across = across / std::hypot(across[0], across[1], across[2]);
        // `across` and `normal` are unit vectors perpendicular to the edge.
        normal = normal / std::hypot(normal[0], normal[1], normal[2]);
      }
      side->Angle = length > 0.0 ? std::atan2(dot(out, normal), dot(out, across)) : 0.0;
      // Angles within rounding below 0 are those of the first triangle's plane; they must not go to
      // 2 pi.
      constexpr double rounding = 1e-9;
      side->Angle += side->Angle < -rounding ? 2.0 * std::acos(-1.0) : 0.0;
    }
    std::sort(begin, end, [](const FanSide& a, const FanSide& b) {
      return a.Angle != b.Angle ? a.Angle < b.Angle : a.Side < b.Side;
    });
  }

  // Chooses the turns of all related patches, by a breadth-first two-colouring of the relations. Of
  // the two colourings, the one that keeps most of the area is used. Where relations disagree, as
  // where a surface passes through itself, patches stay as they are; returns false if these are not
  // balanced.
  bool TurnAsRelated(std::vector<Relation>& relations)
  {
    // Sorted by patches, a binary search finds the neighbours of each.
    std::sort(relations.begin(), relations.end(),
      [](const Relation& a, const Relation& b) { return a.Patch < b.Patch; });
    std::vector<bool> isFound(this->Areas.size(), false);
    std::vector<Index> queue;
    for (const Relation& start : relations)
    {
      if (isFound[static_cast<std::size_t>(start.Patch)])
      {
        continue;
      }
      queue.assign(1, start.Patch);
      isFound[static_cast<std::size_t>(start.Patch)] = true;
      double area = 0.0;
      bool agrees = true;
      for (std::size_t next = 0; next < queue.size(); ++next)
      {
        const auto patch = static_cast<std::size_t>(queue[next]);
        area += this->Turns[patch] * this->Areas[patch];
        auto relation = std::lower_bound(relations.begin(), relations.end(), queue[next],
          [](const Relation& a, Index b) { return a.Patch < b; });
        for (; relation != relations.end() && relation->Patch == queue[next]; ++relation)
        {
          const auto other = static_cast<std::size_t>(relation->Other);
          const int wanted = relation->Same * this->Turns[patch];
          agrees = agrees && (!isFound[other] || this->Turns[other] == wanted);
          if (!isFound[other])
          {
            isFound[other] = true;
            this->Turns[other] = wanted;
            queue.push_back(relation->Other);
          }
        }
      }
      if (!agrees && this->GroupOf(start.Patch) == Group::Unbalanced)
      {
        return false;
      }
      for (const Index patch : queue)
      {
        int& turn = this->Turns[static_cast<std::size_t>(patch)];
        turn = agrees ? (area < 0.0 ? -turn : turn) : 1;
      }
    }
    return true;
  }

  const TriangleSurface& Surface;
  const SurfaceEdges& Edges;
  LargeBuffer<signed char> Signs; // by triangles: 1 as given, -1 opposite
  LargeBuffer<Index> Patches;     // by triangles; at the end roots of patches
  // By patches: area of the triangles that agree minus that of the others.
  std::vector<double> Areas;
  std::vector<bool> IsMended; // by patches: some of the triangles disagree
  std::vector<FanSide> Fans;  // sorted by edges
  std::vector<int> Turns;     // by patches: 1 as oriented alone, -1 opposite
  std::vector<Group> Groups;  // by roots, while patches are joined by edges
  std::vector<Index> Roots;   // by patches: another one of the same body, or itself
};

} // namespace

OrientedBodies orientBodies(const TriangleSurface& surface, const SurfaceEdges& edges,
  std::int64_t* triangles, const Context& context)
{
  Progress progress(context);
  return OrientationRun(surface, edges).Run(triangles, progress);
}

} // namespace RectifiedTransport
