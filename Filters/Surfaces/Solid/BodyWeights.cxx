// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Solid/BodyWeights.h"

#include "Core/Geometry/PointBounds.h"
#include "Core/Geometry/Trees/Bins.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Solid/SurfaceCuts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Index = std::int64_t;

// Numbers the bodies of a surface without gaps, by union-find over given numbers or over points. A
// root that is numbered holds -1 - number in the place of its parent.
class Bodies
{
public:
  Bodies(const SolidSurface& surface, Progress& progress)
    : Surface(surface.Triangles)
    , Given(surface.Bodies)
    , Parents(this->Given ? this->Surface.NumberOfTriangles : this->Surface.Points.size())
  {
    // Given numbers are below the number of triangles, which therefore is enough for the array.
    std::iota(this->Parents.data(), this->Parents.data() + this->Parents.size(), Index{ 0 });
    Stages stages(progress, { { "trees", this->Given ? 0.0 : 3.0 }, { "numbers", 1 } });
    Progress& trees = stages["trees"].Expect(this->Surface.NumberOfTriangles);
    for (Index i = 0; !this->Given && i < this->Surface.NumberOfTriangles; ++i)
    {
      const Index* ids = this->Surface.Triangles + 3 * i;
      this->Join(this->Join(this->RootOf(ids[0]), this->RootOf(ids[1])), this->RootOf(ids[2]));
      trees.Add(1);
    }
    Progress& numbers = stages["numbers"].Expect(this->Surface.NumberOfTriangles);
    // Bodies are numbered in the order of their first triangles.
    for (Index i = 0; i < this->Surface.NumberOfTriangles; ++i)
    {
      const Index root = this->RootOf(this->NodeOf(i));
      if (root >= 0)
      {
        this->Parents.data()[root] = -1 - this->Number++;
      }
      numbers.Add(1);
    }
  }

  Index Count() const { return this->Number; }
  Index Of(Index triangle) { return -1 - this->RootOf(this->NodeOf(triangle)); }

private:
  // Nodes of trees are given numbers of bodies, or points.
  Index NodeOf(Index triangle) const
  {
    return this->Given ? this->Given[triangle] : this->Surface.Triangles[3 * triangle];
  }
  // A node without a parent except itself, or the negative value of a numbered root. Path halving.
  Index RootOf(Index node)
  {
    Index* parents = this->Parents.data();
    while (parents[node] >= 0 && parents[node] != node)
    {
      const Index parent = parents[node];
      if (parents[parent] < 0)
      {
        return parents[parent];
      }
      parents[node] = parents[parent];
      node = parent;
    }
    return parents[node];
  }
  // Both are roots without numbers; the lower one becomes the root.
  Index Join(Index a, Index b)
  {
    const Index root = std::min(a, b);
    this->Parents.data()[std::max(a, b)] = root;
    return root;
  }

  TriangleSurface Surface;
  const Index* Given;
  LargeBuffer<Index> Parents;
  Index Number = 0;
};

// What a triangle is chosen by (its projected area or its centre), and where a line passes it.
struct Place
{
  double Area = 0.0; // projected along axis 0, with the sign of the triangle's side
  Corner Centre{};
};

// The projected area is half of component 0 of (t1 - t0) x (t2 - t0); the centre is the centroid.
Place placeOf(const std::array<Corner, 3>& t)
{
  Place place;
  place.Area =
    0.5 * ((t[1][1] - t[0][1]) * (t[2][2] - t[0][2]) - (t[1][2] - t[0][2]) * (t[2][1] - t[0][1]));
  place.Centre = (t[0] + t[1] + t[2]) / 3.0;
  return place;
}

// A line along axis 0 through the centre of a triangle: what the winding number is just before and
// after the triangle says whether it bounds the solid, and on which side.
struct Probe
{
  Index Triangle = -1;
  double Key = -HUGE_VAL;
  Place At;
  double X = 0.0;   // where it passes the triangle
  int Side = 0;     // and the change of the winding number there
  Index Before = 0; // the winding number before it

  // Whether another triangle is passed before this one. Triangles at one place are ordered by a
  // rule: as if one body were within the other, and bodies that touch had a gap between them.
  bool IsBehind(double x, int side, Index triangle) const
  {
    if (x != this->X)
    {
      return x < this->X;
    }
    if (side != this->Side)
    {
      return side < 0;
    }
    return side > 0 ? triangle < this->Triangle : triangle > this->Triangle;
  }

  // Keeps the triangle with the largest key. Equal keys are decided by places, so that the choice
  // does not depend on the order of the triangles.
  void Choose(Index triangle, double key, const Place& place)
  {
    if (this->Triangle < 0 || key > this->Key ||
      (key == this->Key && place.Centre < this->At.Centre))
    {
      this->Triangle = triangle;
      this->Key = key;
      this->At = place;
    }
  }
};

// Calls visit(segment) if the line at (y, z) passes a triangle. The half-open range of y, like
// that of z in cutTriangle, makes a line through an edge pass one of its triangles.
template <class Visit>
void passTriangle(const std::array<Corner, 3>& triangle, double y, double z, const Visit& visit)
{
  cutTriangle(triangle, z, [&](const PlanePoint& in, const PlanePoint& out) {
    if (std::min(in.Y, out.Y) <= y && y < std::max(in.Y, out.Y))
    {
      visit(PlaneSegment(in, out));
    }
  });
}

// Up to eight probes a body, and the winding numbers of the whole surface before each of them.
class BodyProbes
{
public:
  // Probes 0 and 1: the largest triangles of either side. Probes 2 to 7: the last and the first
  // along each axis, so that a probe is on the outside of a body within which another one lies.
  static constexpr std::size_t PerBody = 8;

  BodyProbes(const TriangleSurface& surface, Bodies& bodies)
    : Surface(surface)
    , Own(bodies)
    , Probes(PerBody * static_cast<std::size_t>(bodies.Count()))
  {
  }

  // There are two passes, because the outermost triangles are compared with the largest ones.
  void Choose(Progress& progress)
  {
    Stages stages(progress, { { "largest", 1 }, { "outermost", 1 } });
    this->ForTriangles(stages["largest"], [](Probe* probes, Index triangle, const Place& place) {
      probes[place.Area > 0.0 ? 0 : 1].Choose(triangle, std::abs(place.Area), place);
    });
    this->ForTriangles(stages["outermost"], [](Probe* probes, Index triangle, const Place& place) {
      // Slivers at the rim tell nothing: their centres are within rounding of other triangles.
      constexpr double least = 0.01;
      if (std::abs(place.Area) >= least * std::max(probes[0].Key, probes[1].Key))
      {
        for (std::size_t a = 0; a < 3; ++a)
        {
          probes[2 + 2 * a].Choose(triangle, place.Centre[a], place);
          probes[3 + 2 * a].Choose(triangle, -place.Centre[a], place);
        }
      }
    });
    // The line passes its own triangle at the centroid, where rounding is least likely to miss it.
    // Probes without a triangle, or whose triangle the line misses, are removed.
    const auto isNone = [this](Probe& probe) {
      if (probe.Triangle >= 0)
      {
        passTriangle(cornersOf(this->Surface, probe.Triangle), probe.At.Centre[1],
          probe.At.Centre[2], [&probe](const PlaneSegment& segment) {
            probe.X = segment.At(probe.At.Centre[1]);
            probe.Side = segment.Side();
          });
      }
      return probe.Side == 0; // 0 by rounding, or as there is no triangle
    };
    this->Probes.erase(
      std::remove_if(this->Probes.begin(), this->Probes.end(), isNone), this->Probes.end());
  }

  // Counts the winding number before each probe: the sides of all triangles that its line passes
  // before. A lattice of boxes in the plane of axes 1 and 2 finds the probes near a triangle.
  void Count(Progress& progress)
  {
    progress.Expect(this->Surface.NumberOfTriangles);
    this->SortIntoBoxes();
    for (Index i = 0; i < this->Surface.NumberOfTriangles; ++i)
    {
      const std::array<Corner, 3> triangle = cornersOf(this->Surface, i);
      this->ForBoxes(triangle, [&](Index box) {
        for (const std::size_t number : this->InBoxes[static_cast<std::size_t>(box)])
        {
          Probe& probe = this->Probes[number];
          const double y = probe.At.Centre[1];
          passTriangle(triangle, y, probe.At.Centre[2], [&](const PlaneSegment& segment) {
            probe.Before += probe.IsBehind(segment.At(y), segment.Side(), i) ? segment.Side() : 0;
          });
        }
      });
      progress.Add(1);
    }
  }

  // Returns the weights by bodies. Votes are summed, so that a few probes at places where bodies
  // touch or intersect do not decide.
  std::vector<signed char> Weights()
  {
    // Each probe votes on its body. Its side is +1 where the line enters an outward body; after -
    // before is +1 where the line enters the solid (winding number not 0), -1 where it leaves it.
    // The product is 1 if the body adds to the solid, -1 if it is inside out, 0 if it bounds
    // nothing.
    std::vector<Index> sums(static_cast<std::size_t>(this->Own.Count()), 0);
    for (const Probe& probe : this->Probes)
    {
      const int before = probe.Before != 0 ? 1 : 0;
      const int after = probe.Before + probe.Side != 0 ? 1 : 0;
      sums[static_cast<std::size_t>(this->Own.Of(probe.Triangle))] += (after - before) * probe.Side;
    }
    std::vector<signed char> weights(sums.size());
    std::transform(sums.begin(), sums.end(), weights.begin(),
      [](Index sum) { return static_cast<signed char>((sum > 0 ? 1 : 0) - (sum < 0 ? 1 : 0)); });
    return weights;
  }

private:
  // Calls visit(probes, triangle, place) with the probes of the triangle's body. A triangle
  // parallel to axis 0 has no projected area, and no line along the axis passes it.
  template <class Visit>
  void ForTriangles(Progress& progress, const Visit& visit)
  {
    progress.Expect(this->Surface.NumberOfTriangles);
    for (Index i = 0; i < this->Surface.NumberOfTriangles; ++i)
    {
      const Place place = placeOf(cornersOf(this->Surface, i));
      if (place.Area != 0.0)
      {
        visit(this->Probes.data() + PerBody * static_cast<std::size_t>(this->Own.Of(i)), i, place);
      }
      progress.Add(1);
    }
  }

  // Sorts the probes into a square lattice of boxes across axis 0, about as many boxes as probes.
  void SortIntoBoxes()
  {
    this->Boxes =
      std::max<Index>(1, static_cast<Index>(std::sqrt(static_cast<double>(this->Probes.size()))));
    PointBounds bounds;
    for (const Probe& probe : this->Probes)
    {
      bounds.Add(probe.At.Centre.data());
    }
    this->Low = bounds.Low;
    for (std::size_t a = 1; a < 3; ++a)
    {
      const double length = bounds.Length(a);
      this->Scale[a] = length > 0.0 ? static_cast<double>(this->Boxes) / length : 0.0;
    }
    this->InBoxes.Fill(
      static_cast<std::size_t>(this->Boxes * this->Boxes), [this](const auto& add) {
        for (std::size_t number = 0; number < this->Probes.size(); ++number)
        {
          const Corner& at = this->Probes[number].At.Centre;
          const Index box = this->BoxOf(2, at[2]) * this->Boxes + this->BoxOf(1, at[1]);
          add(static_cast<std::size_t>(box), number);
        }
      });
  }
  // Coordinates beyond those of the probes are in the boxes at the border.
  Index BoxOf(std::size_t axis, double coordinate) const
  {
    const double box = (coordinate - this->Low[axis]) * this->Scale[axis];
    return static_cast<Index>(std::max(0.0, std::min(box, static_cast<double>(this->Boxes - 1))));
  }

  // Calls visit(box) for those that a triangle has a part in, and maybe for their neighbours. Long
  // triangles are cut by rows, so that a thin diagonal one visits a row of boxes, not its bounds.
  template <class Visit>
  void ForBoxes(const std::array<Corner, 3>& triangle, const Visit& visit) const
  {
    std::array<Corner, 3> scaled = triangle;
    for (Corner& corner : scaled)
    {
      // Cuts are made in the units of rows, as BoxOf() sees them: rounding must not move a part
      // into another row.
      corner[2] = (corner[2] - this->Low[2]) * this->Scale[2];
    }
    const auto visitRow = [&](Index row, const std::array<double, 2>& range) {
      for (Index j = this->BoxOf(1, range[0]); j <= this->BoxOf(1, range[1]); ++j)
      {
        visit(row * this->Boxes + j);
      }
    };
    const CutPolygon whole(scaled);
    const std::array<double, 2> rows = whole.Range(2);
    const Index first =
      this->BoxOf(2, std::min({ triangle[0][2], triangle[1][2], triangle[2][2] }));
    const Index last = this->BoxOf(2, std::max({ triangle[0][2], triangle[1][2], triangle[2][2] }));
    // No probe is there.
    if (rows[1] < 0.0 || rows[0] > static_cast<double>(this->Boxes))
    {
      return;
    }
    if (last - first < 2)
    {
      for (Index row = first; row <= last; ++row)
      {
        visitRow(row, whole.Range(1));
      }
      return;
    }
    // From the lowest row up: `below` is the triangle's part in the row, `rest` what is above it.
    CutPolygon rest = whole;
    CutPolygon below;
    CutPolygon above;
    for (Index row = first; row <= last; ++row)
    {
      below = rest;
      if (row < last)
      {
        cutPolygon<2>(rest, static_cast<double>(row + 1), below, above);
        rest = above;
      }
      if (below.Size > 0)
      {
        visitRow(row, below.Range(1));
      }
    }
  }

  TriangleSurface Surface;
  Bodies& Own;
  std::vector<Probe> Probes;
  Index Boxes = 1;
  std::array<double, 3> Low{};
  std::array<double, 3> Scale{};
  Bins<std::size_t> InBoxes; // numbers of probes, by boxes
};

// The weight of a single body: -1 if it is inside out. By the divergence theorem its volume is the
// sum over the triangles of projected area times x of the centre; x from a point of the body, to
// keep the sum free of cancellation.
signed char weightOfOne(const TriangleSurface& surface, Progress& progress)
{
  progress.Expect(surface.NumberOfTriangles);
  double volume = 0.0;
  for (Index i = 0; i < surface.NumberOfTriangles; ++i)
  {
    const Place place = placeOf(cornersOf(surface, i));
    const double origin = surface.Points[surface.Triangles[0]][0];
    volume += place.Area * (place.Centre[0] - origin);
    progress.Add(1);
  }
  return volume < 0.0 ? -1 : 1;
}

} // namespace

LargeBuffer<signed char> weighBodies(const SolidSurface& solid, const Context& context)
{
  const TriangleSurface& surface = solid.Triangles;
  LargeBuffer<signed char> weights(surface.NumberOfTriangles);
  Progress progress(context);
  Stages stages(progress, { { "bodies", 4 }, { "weights", 6 } });
  Bodies bodies(solid, stages["bodies"]);
  if (bodies.Count() < 2)
  {
    // A single body needs no probes, only the sign of its volume. Without triangles nothing is
    // written.
    const signed char weight = bodies.Count() == 1 ? weightOfOne(surface, stages["weights"]) : 1;
    std::fill_n(weights.data(), surface.NumberOfTriangles, weight);
    return weights;
  }
  BodyProbes probes(surface, bodies);
  Stages steps(
    stages["weights"], { { "probes", 2 }, { "winding numbers", 3 }, { "triangles", 1 } });
  probes.Choose(steps["probes"]);
  probes.Count(steps["winding numbers"]);
  const std::vector<signed char> ofBodies = probes.Weights();
  Progress& triangles = steps["triangles"].Expect(surface.NumberOfTriangles);
  for (Index i = 0; i < surface.NumberOfTriangles; ++i)
  {
    weights.data()[i] = ofBodies[static_cast<std::size_t>(bodies.Of(i))];
    triangles.Add(1);
  }
  return weights;
}

} // namespace RectifiedTransport
