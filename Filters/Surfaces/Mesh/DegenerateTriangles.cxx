// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/DegenerateTriangles.h"

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/SurfaceEdges.h"
#include "Surfaces/Mesh/TriangleShape.h"

#include <algorithm>
#include <array>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// A triangle of the height 0 has its third point within its longest side. Flipping that side turns
// the triangle and the one beyond it into two that share the new edge: the side is then split at
// the point, as it should be. Each flip replaces an edge by a shorter one, so that the process
// ends.
class DegenerateTriangleRun
{
public:
  DegenerateTriangleRun(const EditedTriangles& triangles, double height, std::int64_t* nearest)
    : Edited(triangles)
    , Height(height)
    , Nearest(nearest)
    , Others(3 * triangles.Count)
  {
  }

  void Run(const Context& context)
  {
    Progress progress(context);
    Stages stages(progress, { { "edges", 1 }, { "triangles", 1 } });
    {
      // Only the other side of each side is kept from the edges; flips and removals update it.
      const SurfaceEdges edges(
        { this->Edited.Positions, this->Edited.Points, this->Edited.Count }, stages["edges"]);
      for (std::int64_t side = 0; side < this->Others.size(); ++side)
      {
        this->Others.data()[side] = edges.Other(side);
      }
    }
    Progress& triangles = stages["triangles"].Expect(this->Edited.Count);
    for (std::int64_t triangle = 0; triangle < this->Edited.Count; ++triangle)
    {
      this->Remove(triangle, triangles);
      triangles.Add(1);
    }
    triangles.EndSlice(0);
  }

private:
  std::int64_t& PointAt(std::int64_t side) { return this->Edited.Points[side]; }
  Point<3> At(std::int64_t point) const { return pointAt(this->Edited.Positions, point); }
  bool IsRemoved(std::int64_t triangle) { return this->Edited.Points[3 * triangle] < 0; }

  // Measures a triangle with the points that it has at this moment: flips change them.
  TriangleShape ShapeOf(std::int64_t triangle) const
  {
    const std::int64_t* points = this->Edited.Points + 3 * triangle;
    return { this->At(points[0]), this->At(points[1]), this->At(points[2]) };
  }

  bool IsFlat(std::int64_t triangle) const
  {
    return this->ShapeOf(triangle).Height <= this->Height;
  }

  // Removes a flat triangle, after those that have to be removed before it, and then those that
  // flips make flat.
  void Remove(std::int64_t triangle, Progress& progress)
  {
    // Lengths fall with every flip but for rounding, which must not let two sides flip for ever.
    constexpr std::int64_t most = 64; // flips and visits a triangle, on average
    this->Stack.assign(1, triangle);
    while (!this->Stack.empty() && this->Steps < most * this->Edited.Count)
    {
      ++this->Steps;
      const std::int64_t next = this->Stack.back();
      this->Stack.pop_back();
      if (!this->IsRemoved(next) && this->IsFlat(next))
      {
        this->Step(next);
        progress.Add(1);
      }
    }
  }

  // On the boundary a flat triangle is left out. If the triangle beyond is flat and its longest
  // side is longer, that one comes first: its flip changes the side in question.
  void Step(std::int64_t triangle)
  {
    const TriangleShape shape = this->ShapeOf(triangle);
    const std::int64_t side = 3 * triangle + shape.Longest;
    const std::int64_t other = this->Others.data()[side];
    if (other < 0)
    {
      this->LeaveOut(triangle);
      return;
    }
    const std::int64_t beyond = other / 3;
    const TriangleShape shapeBeyond = this->ShapeOf(beyond);
    const bool isLonger = shapeBeyond.Height <= this->Height &&
      3 * beyond + shapeBeyond.Longest != other && shapeBeyond.Length > shape.Length;
    if (isLonger)
    {
      this->Stack.push_back(triangle); // after that one
      this->Stack.push_back(beyond);
    }
    else if (this->CanFlip(side, other))
    {
      this->Flip(side, other);
      this->Stack.push_back(triangle);
      this->Stack.push_back(beyond);
    }
  }

  // Leaves a triangle out; its neighbours become open there. Each of its points notes the nearer
  // one of the other two, for points that no other triangle has.
  void LeaveOut(std::int64_t triangle)
  {
    for (std::int64_t side = 3 * triangle; side < 3 * triangle + 3; ++side)
    {
      const std::int64_t other = this->Others.data()[side];
      if (other >= 0)
      {
        this->Others.data()[other] = -1;
      }
      const Point<3> at = this->At(this->PointAt(side));
      const std::int64_t one = this->PointAt(nextSide(side));
      const std::int64_t two = this->PointAt(lastSide(side));
      // The nearer one of the two other corners.
      const bool isOne = squaredDistance(at, this->At(one)) <= squaredDistance(at, this->At(two));
      this->Nearest[this->PointAt(side)] = isOne ? one : two;
    }
    std::fill_n(this->Edited.Points + 3 * triangle, 3, std::int64_t{ -1 });
  }

  // Whether the two triangles agree in orientation, and the edge between the points across does not
  // exist yet: it would be an edge of more than two triangles.
  bool CanFlip(std::int64_t side, std::int64_t other)
  {
    // In triangles that agree, the sides of an edge run in opposite directions.
    const bool isOriented = this->PointAt(side) == this->PointAt(nextSide(other)) &&
      this->PointAt(nextSide(side)) == this->PointAt(other);
    const std::int64_t across = this->PointAt(lastSide(other));
    return isOriented && this->PointAt(lastSide(side)) != across &&
      !this->IsJoined(lastSide(side), across);
  }

  // Whether a triangle about the point that a side leaves has another point: walks the fan one way
  // and, if it is open, the other way from the start.
  bool IsJoined(std::int64_t leaving, std::int64_t point)
  {
    const auto has = [&](std::int64_t side) {
      return this->PointAt(nextSide(side)) == point || this->PointAt(lastSide(side)) == point;
    };
    std::int64_t side = leaving;
    do
    {
      if (has(side))
      {
        return true;
      }
      side = this->Others.data()[lastSide(side)];
    } while (side >= 0 && side != leaving && this->PointAt(side) == this->PointAt(leaving));
    if (side == leaving)
    {
      return false;
    }
    for (side = this->Others.data()[leaving]; side >= 0; side = this->Others.data()[side])
    {
      side = nextSide(side);
      if (this->PointAt(side) != this->PointAt(leaving) || side == leaving)
      {
        break;
      }
      if (has(side))
      {
        return true;
      }
    }
    return false;
  }

  // Changes the points, corners and origins of the two triangles as flipEdge changes their sides.
  // Both are then parts of the triangle beyond.
  void Flip(std::int64_t side, std::int64_t other)
  {
    const std::int64_t f = side / 3;
    const std::int64_t g = other / 3;
    std::int64_t* corners = this->Edited.Corners;
    // Side ab of the triangles abc and bad: the triangles become cad and dbc.
    const std::array<std::int64_t, 3> far{ lastSide(side), nextSide(other), lastSide(other) };
    const std::array<std::int64_t, 3> near{ lastSide(other), other, lastSide(side) };
    const auto at = [](const std::int64_t* values, const std::array<std::int64_t, 3>& sides) {
      return std::array<std::int64_t, 3>{ values[sides[0]], values[sides[1]], values[sides[2]] };
    };
    const auto pointsF = at(this->Edited.Points, far);
    const auto pointsG = at(this->Edited.Points, near);
    const auto cornersF = at(corners, far);
    const auto cornersG = at(corners, near);

    flipEdge(this->Others.data(), side, other);
    std::copy(pointsF.begin(), pointsF.end(), this->Edited.Points + 3 * f);
    std::copy(pointsG.begin(), pointsG.end(), this->Edited.Points + 3 * g);
    std::copy(cornersF.begin(), cornersF.end(), corners + 3 * f);
    std::copy(cornersG.begin(), cornersG.end(), corners + 3 * g);
    this->Edited.Origins[f] = this->Edited.Origins[g];
  }

  const EditedTriangles Edited;
  const double Height;
  std::int64_t* const Nearest;
  LargeBuffer<std::int64_t> Others; // other side of each side's edge; -1 if there is none
  std::vector<std::int64_t> Stack;  // triangles to look at
  std::int64_t Steps = 0;
};

} // namespace

void removeDegenerateTriangles(
  const EditedTriangles& triangles, double height, std::int64_t* nearest, const Context& context)
{
  DegenerateTriangleRun(triangles, height, nearest).Run(context);
}

} // namespace RectifiedTransport
