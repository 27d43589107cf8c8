// SPDX-License-Identifier: BSD-3-Clause
// Functions on the nodes of a SpacingTree: the spacing, and what joins values and derivatives.
#include "Core/Parallel/Progress.h"
#include "Core/Relaxation/SpacingTree.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = 256;
constexpr std::int64_t firstSlice = 16 * grain; // a few milliseconds

} // namespace

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
      weight *= (corner >> axis & 1) ? place.At[axis] : 1.0 - place.At[axis];
    }
    const auto node = static_cast<std::size_t>(nodes[static_cast<std::size_t>(corner)]);
    sum += weight * field[node][static_cast<std::size_t>(entry)];
  }
  return sum;
}

template <int Dimension>
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
  const Field given = field;
  progress.ForEach(
    this->Nodes(), grain,
    [&](std::int64_t i) {
      const auto node = static_cast<std::size_t>(i);
      const Point<Dimension> x = this->NodePoint(i);
      const Point<Dimension>& sides = this->LeafSides(this->NodeLeaf[node]);
      // The difference of an entry along an axis, one-sided at the border.
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
    firstSlice);
  if (!first)
  {
    this->Join(field);
  }
}

template <int Dimension>
void SpacingTree<Dimension>::FindSpacing(Progress& progress)
{
  Field& field = this->SpacingField;
  field.assign(this->NodePlaces.size(), {});
  progress.ForEach(
    this->Nodes(), grain,
    [&](std::int64_t node) {
      field[static_cast<std::size_t>(node)][0] = this->ExactSpacing(this->NodePoint(node));
    },
    4 * grain);
  progress.Check();
  this->FindMixed(field, true, progress);
  progress.Check();
  this->FindMixed(field, false, progress);
  // Bounds of the control values of the interpolation (value and derivatives times a third of the
  // side for each order) that keep it positive.
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
