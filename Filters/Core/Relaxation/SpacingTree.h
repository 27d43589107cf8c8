// SPDX-License-Identifier: BSD-3-Clause
// A tree of boxes that divides the domain as finely as the spacing of points for a density, and
// smooth functions on it.
#ifndef RectifiedTransport_SpacingTree_h
#define RectifiedTransport_SpacingTree_h

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/Points.h"
#include "Core/Relaxation/RelaxationFrame.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Tensor products of cubic Hermite polynomials on a box. The data at a corner are the function's
// mixed derivatives of order 0 or 1 along each axis: entry b is the derivative along the axes of
// the bits of b. Boxes that share a face and the data there join with continuous derivatives.
template <int Dimension>
constexpr int hermiteCorners = 1 << Dimension;

template <int Dimension, class Value = double>
using HermiteData = std::array<Value, hermiteCorners<Dimension>>;

// The values of two functions, which are interpolated as one: the weights are computed once.
struct ValuePair
{
  // Every processor has registers of this size.
  using Register = double __attribute__((vector_size(16)));

  ValuePair() = default;
  explicit ValuePair(const Register& both)
    : Both(both)
  {
  }
  ValuePair(double first, double second)
    : Both{ first, second }
  {
  }
  double First() const { return this->Both[0]; }
  double Second() const { return this->Both[1]; }
  friend ValuePair operator+(const ValuePair& a, const ValuePair& b)
  {
    return ValuePair(a.Both + b.Both);
  }
  friend ValuePair operator*(double a, const ValuePair& b) { return ValuePair(a * b.Both); }

  Register Both{};
};

// The data at the place `at`, in [0, 1], of a box with these sides. Corner c is at the upper end of
// the axes of the bits of c.
template <int Dimension, class Value>
HermiteData<Dimension, Value> interpolateHermite(
  const std::array<const Value*, hermiteCorners<Dimension>>& corners, const Point<Dimension>& at,
  const Point<Dimension>& sides)
{
  constexpr int count = hermiteCorners<Dimension>;
  // `value` has the cubic Hermite polynomials for the values h00, h01 and the slopes h10, h11 at
  // both ends, scaled by the side h; `slope` has their derivatives.
  Value data[count][count]; // corner, derivative
  for (int corner = 0; corner < count; ++corner)
  {
    for (int entry = 0; entry < count; ++entry)
    {
      data[corner][entry] = corners[corner][entry];
    }
  }
  // Axis by axis, the last first: the corners below `half` then hold the interpolation between both
  // ends.
  for (int axis = Dimension; axis-- > 0;)
  {
    const double t = at[axis];
    const double u = 1.0 - t;
    const double h = sides[axis];
    const double value[4] = { u * u * (1.0 + 2.0 * t), t * t * (3.0 - 2.0 * t), h * t * u * u,
      -h * t * t * u };
    const double rise = 6.0 * t * u / h;
    const double slope[4] = { -rise, rise, u * (1.0 - 3.0 * t), t * (3.0 * t - 2.0) };
    const int half = 1 << axis;
    for (int corner = 0; corner < half; ++corner)
    {
      for (int entry = 0; entry < count; ++entry)
      {
        if (entry & half)
        {
          continue;
        }
        const Value ends[4] = { data[corner][entry], data[corner + half][entry],
          data[corner][entry | half], data[corner + half][entry | half] };
        data[corner][entry] =
          value[0] * ends[0] + value[1] * ends[1] + value[2] * ends[2] + value[3] * ends[3];
        data[corner][entry | half] =
          slope[0] * ends[0] + slope[1] * ends[1] + slope[2] * ends[2] + slope[3] * ends[3];
      }
    }
  }
  HermiteData<Dimension, Value> result;
  for (int entry = 0; entry < count; ++entry)
  {
    result[entry] = data[0][entry];
  }
  return result;
}

// All coordinates are those of a RelaxationFrame. The spacing at a place is the side of the
// smallest cube about it that holds a point's share of the mass, or `largest`; it changes by at
// most twice the distance (the largest along an axis). The width of a leaf is at most `finest`
// times the spacing at its centre, and boxes are not halved along an axis along which they are less
// than a quarter as wide. The number of leaves a point is therefore bounded.
template <int Dimension>
class SpacingTree
{
public:
  // The coordinates are in units of the finest possible leaf.
  using Node = std::array<std::int64_t, Dimension>;
  template <class Value>
  using FieldOf = std::vector<HermiteData<Dimension, Value>>; // data at the nodes
  using Field = FieldOf<double>;

  SpacingTree(const RectifiedFlow<Dimension>& flow, const RelaxationFrame<Dimension>& frame,
    std::int64_t points, double finest, double largest, Progress& progress);

  // The corners of the leaves.
  std::int64_t Nodes() const { return static_cast<std::int64_t>(this->NodePlaces.size()); }
  Point<Dimension> NodePoint(std::int64_t node) const;

  std::int64_t Leaves() const { return static_cast<std::int64_t>(this->LeafBoxes.size()); }
  Point<Dimension> LeafLow(std::int64_t leaf) const;
  const Point<Dimension>& LeafSides(std::int64_t leaf) const
  {
    return this->Sides(this->LeafBox(leaf).Depth);
  }

  // A place in a leaf.
  struct Place
  {
    std::int64_t Leaf;
    Point<Dimension> At;           // in [0, 1]
    const Point<Dimension>* Sides; // sides of the leaf
  };
  Place Locate(const Point<Dimension>& x) const;
  // The same, faster if the place is in leaf `guess`.
  Place Locate(const Point<Dimension>& x, std::int64_t guess) const;

  // Returns the place at the relative coordinates `at`, in [0, 1], of a leaf.
  Place InLeaf(std::int64_t leaf, const Point<Dimension>& at) const
  {
    return { leaf, at, &this->LeafSides(leaf) };
  }

  // A function at a place: its value and derivatives, see HermiteData.
  template <class Value>
  HermiteData<Dimension, Value> Evaluate(const FieldOf<Value>& field, const Place& place) const
  {
    std::array<const Value*, hermiteCorners<Dimension>> corners;
    const auto& nodes = this->LeafBox(place.Leaf).Nodes;
    for (std::size_t corner = 0; corner < corners.size(); ++corner)
    {
      corners[corner] = field[static_cast<std::size_t>(nodes[corner])].data();
    }
    return interpolateHermite<Dimension, Value>(corners, place.At, *place.Sides);
  }
  // Loads the data that Evaluate will need: nodes of neighbouring points are seldom in the caches.
  template <class Value>
  void Prefetch(const FieldOf<Value>& field, const Place& place) const
  {
    for (const std::int32_t node : this->LeafBox(place.Leaf).Nodes)
    {
      prefetch(field[static_cast<std::size_t>(node)]);
    }
  }
  void PrefetchLeaf(std::int64_t leaf) const { prefetch(this->LeafBox(leaf)); }

  // Replaces the data of nodes within a face of a larger leaf by its interpolation, so that the
  // function has continuous derivatives.
  void Join(Field& field) const;
  // With `first`, finds first derivatives from differences of values. Otherwise finds mixed second
  // derivatives from differences of first derivatives, then calls Join.
  void FindMixed(Field& field, bool first, Progress& progress) const;

  // The spacing at the nodes, in units of the frame.
  const Field& Spacing() const { return this->SpacingField; }
  // Evaluates the definition of the spacing.
  double ExactSpacing(const Point<Dimension>& x) const;

private:
  struct Box
  {
    Node Low;
    int Depth;
  };
  struct Leaf : Box
  {
    std::array<std::int32_t, hermiteCorners<Dimension>> Nodes;
  };
  // Where a point is in its root.
  struct RootPlace
  {
    Point<Dimension> At; // in [0, 1]
    Node Fixed;          // the same in units of the finest leaf possible, below the upper end
    Node Low;            // lower end of the root, in these units
    std::int64_t Root;
  };

  // Whether the spacing at a place is less than a length.
  bool IsSpacingBelow(double side, const Point<Dimension>& x) const;
  void Divide(double finest, Progress& progress);
  // Sets the children of leaves to -1 - number, and fills LeafBoxes.
  void OrderLeaves(Progress& progress);
  void Number(Progress& progress);
  // Finds nodes that are within a face of a larger leaf, see Join.
  void FindConstrained();
  void FindSpacing(Progress& progress);
  bool IsHalved(int axis, int depth) const { return depth >= this->FirstHalved[axis]; }
  // How often a box of a depth was halved along an axis.
  int Halvings(int axis, int depth) const { return std::max(0, depth - this->FirstHalved[axis]); }
  // The width of a box of a depth, in units of the finest possible leaf.
  std::int64_t Width(int axis, int depth) const
  {
    return std::int64_t{ 1 } << (DeepestLevel - this->Halvings(axis, depth));
  }
  const Point<Dimension>& Sides(int depth) const
  {
    return this->SidesOfDepth[static_cast<std::size_t>(depth)];
  }
  Point<Dimension> PointOf(const Node& node) const;
  const Leaf& LeafBox(std::int64_t leaf) const
  {
    return this->LeafBoxes[static_cast<std::size_t>(leaf)];
  }
  RootPlace LocateRoot(const Point<Dimension>& x) const;
  // The leaf that holds a place of a root, see RootPlace.
  std::int64_t LeafIn(std::int64_t root, const Node& fixed) const;
  Place PlaceIn(const RootPlace& in, std::int64_t leaf) const;
  template <class Data>
  static void prefetch(const Data& data)
  {
    constexpr std::size_t line = 64;
    for (std::size_t at = 0; at < sizeof(Data); at += line)
    {
      __builtin_prefetch(reinterpret_cast<const char*>(&data) + at);
    }
  }
  // The widest leaf that touches a node.
  std::int64_t WidestLeafAt(const Node& node) const;
  // Multilinear interpolation of one entry of the data.
  double Linear(const Field& field, int entry, const Point<Dimension>& x) const;

  // 24 halvings leave a double enough digits for the place in the finest leaf.
  static constexpr int DeepestLevel = 24;

  const RectifiedFlow<Dimension>& Flow;
  const RelaxationFrame<Dimension> Frame;
  const std::int64_t Points;
  const double Largest;
  // The lattice of roots: its size, and the sides of a root in the frame's units.
  Node Roots;
  Point<Dimension> RootSides;
  std::array<int, Dimension> FirstHalved; // the smallest depth of boxes that are halved along an
                                          // axis
  // The cells along each axis that a physical cube has, relative to the widest cell.
  Point<Dimension> Aspect;
  std::array<Point<Dimension>, DeepestLevel + 1> SidesOfDepth;
  std::vector<Box> Boxes;
  // The first of each box's consecutive children, or -1 - number for a leaf.
  std::vector<std::int64_t> Children;
  std::vector<Leaf> LeafBoxes;
  std::vector<Node> NodePlaces;
  std::vector<std::int64_t> NodeLeaf;    // the widest leaf that touches each node
  std::vector<std::int32_t> Constrained; // nodes within faces, those of the widest leaves first
  Field SpacingField;
};

} // namespace RectifiedTransport

#endif
