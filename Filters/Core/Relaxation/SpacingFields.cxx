// SPDX-License-Identifier: BSD-3-Clause
// Functions on the nodes of a SpacingTree: the spacing, and what joins values and derivatives.
#include "Core/Parallel/Progress.h"
#include "Core/Relaxation/SpacingTree.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t fieldGrain = 256;
constexpr std::int64_t fieldSlice = 16 * fieldGrain; // a few milliseconds

} // namespace

// Differences read the field by multilinear interpolation, as derivatives are not known yet.
template <int Dimension>
double SpacingTree<Dimension>::Linear(
  const Field& field, int entry, const Point<Dimension>& x) const
{
  const Place place = this->Locate(x);
  const auto& nodes = this->LeafBox(place.Leaf).Nodes;
  double sum = 0.0;
  for (int corner = 0; corner < hermiteCorners<Dimension>; ++corner)
  {
    double weight = 1.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      // Multilinear weights of the leaf's corners.
      weight *= (corner >> axis & 1) ? place.At[axis] : 1.0 - place.At[axis];
    }
    const auto node = static_cast<std::size_t>(nodes[static_cast<std::size_t>(corner)]);
    sum += weight * field[node][static_cast<std::size_t>(entry)];
  }
  return sum;
}

template <int Dimension>
// A node in the interior of a larger leaf's face is not free: it takes the Hermite interpolation of
// that leaf, which both sides then share. Nodes of wider leaves come first, because their values
// determine those of narrower ones.
void SpacingTree<Dimension>::Join(Field& field) const
{
  for (const std::int32_t i : this->Constrained)
  {
    const auto node = static_cast<std::size_t>(i);
    const Box& box = this->LeafBox(this->NodeLeaf[node]);
    Point<Dimension> at;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      at[axis] = static_cast<double>(this->NodePlaces[node][axis] - box.Low[axis]) /
        static_cast<double>(this->Width(axis, box.Depth));
    }
    field[node] = this->Evaluate(field, this->InLeaf(this->NodeLeaf[node], at));
  }
}

template <int Dimension>
void SpacingTree<Dimension>::FindMixed(Field& field, bool first, Progress& progress) const
{
  // Nodes read their neighbours' entries while others are written: all read the field as it was.
  const Field given = field;
  progress.ForEach(
    this->Nodes(), fieldGrain,
    [&](std::int64_t i) {
      const auto node = static_cast<std::size_t>(i);
      const Point<Dimension> x = this->NodePoint(i);
      const Point<Dimension>& sides = this->LeafSides(this->NodeLeaf[node]);
      // The central difference of an entry along an axis, over the sides of the leaf; one-sided at
      // the border.
      const auto difference = [&](int entry, int axis) {
        Point<Dimension> low = x;
        Point<Dimension> high = x;
        low[axis] = std::max(x[axis] - sides[axis], 0.0);
        high[axis] = std::min(x[axis] + sides[axis], this->Frame.Sides[axis]);
        return (this->Linear(given, entry, high) - this->Linear(given, entry, low)) /
          (high[axis] - low[axis]);
      };
      for (int axis = 0; axis < Dimension && first; ++axis)
      {
        field[node][std::size_t{ 1 } << axis] = difference(0, axis);
      }
      if (!first)
      {
        // Both orders of differentiation approximate the mixed derivative; their mean is symmetric
        // in the axes.
        for (int a = 0; a < Dimension; ++a)
        {
          for (int b = 0; b < a; ++b)
          {
            field[node][static_cast<std::size_t>(1 << a | 1 << b)] =
              0.5 * (difference(1 << a, b) + difference(1 << b, a));
          }
        }
      }
    },
    fieldSlice);
  if (!first)
  {
    this->Join(field);
  }
}

// Finds the values, then the first derivatives, then the mixed ones, which are differences of the
// first ones.
template <int Dimension>
void SpacingTree<Dimension>::FindSpacing(Progress& progress)
{
  Field& field = this->SpacingField;
  field.assign(this->NodePlaces.size(), {});
  progress.ForEach(
    this->Nodes(), fieldGrain,
    [&](std::int64_t node) {
      field[static_cast<std::size_t>(node)][0] = this->ExactSpacing(this->NodePoint(node));
    },
    4 * fieldGrain);
  progress.Check();
  this->FindMixed(field, true, progress);
  progress.Check();
  this->FindMixed(field, false, progress);
  // The spacing must stay positive between the nodes. Along an axis, a cubic Hermite polynomial has
  // the Bezier control values f and f +- h f' / 3, and |f'| <= 0.6 f / h keeps them at 0.8 f or
  // more. With the products of these bounds for mixed derivatives, all control values of the tensor
  // product in 3D are at least (1 - 3 * 0.2 - 3 * 0.04 - 0.008) f > 0.
  for (std::int64_t i = 0; i < this->Nodes(); ++i)
  {
    const auto node = static_cast<std::size_t>(i);
    const Point<Dimension>& sides = this->LeafSides(this->NodeLeaf[node]);
    for (int entry = 1; entry < hermiteCorners<Dimension>; ++entry)
    {
      double bound = field[node][0];
      for (int axis = 0; axis < Dimension; ++axis)
      {
        bound *= (entry >> axis & 1) ? 0.6 / sides[axis] : 1.0;
      }
      double& value = field[node][static_cast<std::size_t>(entry)];
      value = std::clamp(value, -bound, bound);
    }
  }
  this->Join(field);
}

template void SpacingTree<2>::FindMixed(Field&, bool, Progress&) const;
template void SpacingTree<3>::FindMixed(Field&, bool, Progress&) const;
template void SpacingTree<2>::FindSpacing(Progress&);
template void SpacingTree<3>::FindSpacing(Progress&);

} // namespace RectifiedTransport
