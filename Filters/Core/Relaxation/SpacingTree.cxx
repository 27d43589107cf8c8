// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/SpacingTree.h"

#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/Progress.h"
#include "Core/Relaxation/NodeNumbering.h"

#include <cmath>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t treeGrain = 256;
constexpr std::int64_t treeSlice = 16 * treeGrain; // a few milliseconds
// The side of roots, in units of the finest width where the spacing is the mean. It is a power of
// two times slightly less than that width: rounding then does not divide the leaves of a uniform
// density once more.
constexpr double rootSide = 0.97 * 8; // times the finest

} // namespace

template <int Dimension>
SpacingTree<Dimension>::SpacingTree(const RectifiedFlow<Dimension>& flow,
  const RelaxationFrame<Dimension>& frame, std::int64_t points, double finest, double largest,
  Progress& progress)
  : Flow(flow)
  , Frame(frame)
  , Points(points)
  , Largest(largest)
{
  const double widest = *std::max_element(frame.CellSides.begin(), frame.CellSides.end());
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // Aspect has the number of cells along each axis that make a cube in physical space.
    this->Aspect[axis] = widest / frame.CellSides[axis];
    this->Roots[axis] =
      std::max<std::int64_t>(1, std::llround(std::ceil(frame.Sides[axis] / (rootSide * finest))));
    this->RootSides[axis] = frame.Sides[axis] / static_cast<double>(this->Roots[axis]);
  }
  const double widestRoot = *std::max_element(this->RootSides.begin(), this->RootSides.end());
  // An axis is not halved until its side is at least a quarter of the widest one: boxes that are
  // thin along an axis stay whole there, which bounds the number of leaves.
  for (int axis = 0; axis < Dimension; ++axis)
  {
    int& first = this->FirstHalved[axis];
    first = 0;
    while (first < DeepestLevel && 4.0 * this->RootSides[axis] < std::ldexp(widestRoot, -first))
    {
      ++first;
    }
  }
  for (int depth = 0; depth <= DeepestLevel; ++depth)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      // The sides of a box depend only on its depth.
      this->SidesOfDepth[static_cast<std::size_t>(depth)][axis] =
        std::ldexp(this->RootSides[axis], -this->Halvings(axis, depth));
    }
  }
  this->Divide(finest, progress);
  this->OrderLeaves(progress);
  this->Number(progress);
  this->FindSpacing(progress);
}

// The spacing h(x) is the side of the cube about x with the share 1 / N of the mass.
template <int Dimension>
double SpacingTree<Dimension>::ExactSpacing(const Point<Dimension>& x) const
{
  Point<Dimension> index;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // From the frame to the density's index space.
    index[axis] = std::clamp(
      x[axis] / this->Frame.CellSides[axis], 0.0, static_cast<double>(this->Flow.Size()[axis]));
  }
  // Far from all mass the cube would be huge, and is bounded by Largest.
  const double side = this->Frame.SideOfCells(
    this->Flow.MeasureOfShare(index, this->Aspect, 1.0 / static_cast<double>(this->Points)));
  return std::min(side, this->Largest);
}

// Decides h(x) < side mostly by the mass of the cube of this side, without the search for h: the
// cube holds more than a share exactly if h is smaller.
template <int Dimension>
bool SpacingTree<Dimension>::IsSpacingBelow(double side, const Point<Dimension>& x) const
{
  if (side > this->Largest)
  {
    return true;
  }
  Point<Dimension> low;
  Point<Dimension> high;
  bool isInside = true;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    isInside = isInside && x[axis] >= 0.5 * side && x[axis] + 0.5 * side <= this->Frame.Sides[axis];
    low[axis] = (x[axis] - 0.5 * side) / this->Frame.CellSides[axis];
    high[axis] = (x[axis] + 0.5 * side) / this->Frame.CellSides[axis];
  }
  // Within this part of the share 1 the search decides, so that both ways give the same tree.
  constexpr double doubt = 1e-6; // more than the error of the search
  // A cube that is cut by the domain's border has no simple relation to the definition, so the
  // exact spacing decides.
  const double shares =
    isInside ? this->Flow.Share(low, high) * static_cast<double>(this->Points) : 1.0;
  return std::abs(shares - 1.0) > doubt ? shares > 1.0 : side > this->ExactSpacing(x);
}

// Divides breadth first: all boxes of a depth are tested in parallel, then their children are
// appended in a fixed order. A box is divided where its widest side exceeds `finest` spacings at
// its centre.
template <int Dimension>
void SpacingTree<Dimension>::Divide(double finest, Progress& progress)
{
  const auto roots = static_cast<std::int64_t>(numberOfCells<Dimension>(this->Roots));
  for (std::int64_t root = 0; root < roots; ++root)
  {
    // The root's lower corner, in units of the finest leaf.
    Box box{ LatticePart<Dimension>::WholeOf(this->Roots).CellOf(root), 0 };
    for (int axis = 0; axis < Dimension; ++axis)
    {
      box.Low[axis] *= this->Width(axis, 0);
    }
    this->Boxes.push_back(box);
  }
  std::size_t first = 0;
  for (int depth = 0; first < this->Boxes.size(); ++depth)
  {
    const std::size_t last = this->Boxes.size();
    // Bytes, as threads write to neighbouring entries.
    std::vector<char> divided(last - first, 0);
    const Point<Dimension>& sides = this->Sides(depth);
    const double widest = *std::max_element(sides.begin(), sides.end());
    if (depth < DeepestLevel)
    {
      progress.ForEach(
        static_cast<std::int64_t>(divided.size()), treeGrain,
        [&](std::int64_t i) {
          Point<Dimension> centre =
            this->PointOf(this->Boxes[first + static_cast<std::size_t>(i)].Low);
          for (int axis = 0; axis < Dimension; ++axis)
          {
            centre[axis] += 0.5 * sides[axis];
          }
          divided[static_cast<std::size_t>(i)] = this->IsSpacingBelow(widest / finest, centre);
        },
        4 * treeGrain);
    }
    for (std::size_t i = first; i < last; ++i)
    {
      if (!divided[i - first])
      {
        this->Children.push_back(-1);
        continue;
      }
      this->Children.push_back(static_cast<std::int64_t>(this->Boxes.size()));
      // The first child has the parent's lower corner.
      this->Boxes.push_back(this->Boxes[i]);
      ++this->Boxes.back().Depth;
      // Child k has bit j of k set if it is the upper half along the j-th axis that is halved.
      for (int axis = 0; axis < Dimension; ++axis)
      {
        // Append the upper halves of the boxes made so far for this parent.
        const std::size_t halves = this->Boxes.size();
        for (auto k = static_cast<std::size_t>(this->Children[i]);
             k < halves && this->IsHalved(axis, depth); ++k)
        {
          this->Boxes.push_back(this->Boxes[k]);
          this->Boxes.back().Low[axis] += this->Width(axis, depth + 1);
        }
      }
    }
    first = last;
  }
}

// Numbers the leaves in the order of a depth-first traversal, which bisects the lattice of roots
// along its longest axis. Leaves that are near each other are then near in memory, and so are their
// nodes.
template <int Dimension>
void SpacingTree<Dimension>::OrderLeaves(Progress& progress)
{
  struct Range // half-open box of roots
  {
    Node Low;
    Node High;
  };
  std::vector<Range> ranges{ { Node{}, this->Roots } };
  std::vector<std::int64_t> boxes;
  while (!ranges.empty())
  {
    const Range range = ranges.back();
    ranges.pop_back();
    std::int64_t root = 0;
    int longest = 0;
    for (int axis = Dimension; axis-- > 0;)
    {
      root = root * this->Roots[axis] + range.Low[axis];
      longest = range.High[axis] - range.Low[axis] > range.High[longest] - range.Low[longest]
        ? axis
        : longest;
    }
    if (range.High[longest] - range.Low[longest] > 1)
    {
      const std::int64_t middle = (range.Low[longest] + range.High[longest]) / 2;
      ranges.push_back(range);
      // The lower half is pushed last, so that it is visited first.
      ranges.back().Low[longest] = middle;
      ranges.push_back(range);
      ranges.back().High[longest] = middle;
      continue;
    }
    boxes.push_back(root);
    while (!boxes.empty())
    {
      const std::int64_t box = boxes.back();
      boxes.pop_back();
      std::int64_t& first = this->Children[static_cast<std::size_t>(box)];
      if (first < 0)
      {
        // A leaf stores -1 - number in place of its first child.
        first = -1 - this->Leaves();
        this->LeafBoxes.push_back({ this->Boxes[static_cast<std::size_t>(box)], {} });
        progress.Add(1);
        continue;
      }
      const int depth = this->Boxes[static_cast<std::size_t>(box)].Depth;
      // A box has 2^halved children.
      int halved = 0;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        halved += this->IsHalved(axis, depth) ? 1 : 0;
      }
      for (std::int64_t child = std::int64_t{ 1 } << halved; child-- > 0;)
      {
        boxes.push_back(first + child);
      }
    }
  }
}

// Numbers the corners of leaves, each of which belongs to up to 2^D leaves, in the leaves' order.
template <int Dimension>
void SpacingTree<Dimension>::Number(Progress& progress)
{
  // There are about as many nodes as leaves.
  NodeNumbering<Dimension> numbers(this->LeafBoxes.size());
  for (Leaf& box : this->LeafBoxes)
  {
    for (int corner = 0; corner < hermiteCorners<Dimension>; ++corner)
    {
      Node node = box.Low;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        // Corner c is at the upper end of the axes of the bits of c.
        node[axis] += (corner >> axis & 1) * this->Width(axis, box.Depth);
      }
      box.Nodes[static_cast<std::size_t>(corner)] = numbers[node];
    }
    progress.Add(1);
  }
  this->NodePlaces = numbers.Release();
  progress.Check();
  this->NodeLeaf.resize(this->NodePlaces.size());
  progress.ForEach(
    this->Nodes(), treeGrain,
    [&](std::int64_t node) {
      this->NodeLeaf[static_cast<std::size_t>(node)] =
        this->WidestLeafAt(this->NodePlaces[static_cast<std::size_t>(node)]);
    },
    treeSlice);
  this->Boxes = {}; // no longer needed: the leaves have their own
  this->FindConstrained();
}

// A node is constrained if it is not a corner of the widest leaf that touches it, that is, if a
// coordinate is no multiple of that leaf's width. The list has the widest leaves first (see Join).
template <int Dimension>
void SpacingTree<Dimension>::FindConstrained()
{
  std::array<std::vector<std::int32_t>, DeepestLevel + 1> ofDepth;
  for (std::int64_t i = 0; i < this->Nodes(); ++i)
  {
    const auto node = static_cast<std::size_t>(i);
    const int depth = this->LeafBox(this->NodeLeaf[node]).Depth;
    const Node& place = this->NodePlaces[node];
    bool isConstrained = false;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      isConstrained = isConstrained || place[axis] % this->Width(axis, depth) != 0;
    }
    if (isConstrained)
    {
      ofDepth[static_cast<std::size_t>(depth)].push_back(static_cast<std::int32_t>(i));
    }
  }
  for (const auto& nodes : ofDepth)
  {
    this->Constrained.insert(this->Constrained.end(), nodes.begin(), nodes.end());
  }
}

template <int Dimension>
std::int64_t SpacingTree<Dimension>::WidestLeafAt(const Node& node) const
{
  std::int64_t widest = -1;
  for (int side = 0; side < hermiteCorners<Dimension>; ++side)
  {
    // Each of the 2^D finest possible boxes around the node; `side` has a bit for the upper one.
    Node fixed;
    std::int64_t root = 0;
    bool isInside = true;
    for (int axis = Dimension; axis-- > 0;)
    {
      // The width of a root in these units.
      const std::int64_t width = this->Width(axis, 0);
      const std::int64_t at = node[axis] - ((side >> axis & 1) ? 0 : 1);
      isInside = isInside && at >= 0 && at < this->Roots[axis] * width;
      fixed[axis] = at % width;
      root = root * this->Roots[axis] + at / width;
    }
    // Among equally wide leaves the first one in the order of the sides is taken.
    if (isInside)
    {
      const std::int64_t leaf = this->LeafIn(root, fixed);
      widest =
        widest < 0 || this->LeafBox(leaf).Depth < this->LeafBox(widest).Depth ? leaf : widest;
    }
  }
  return widest;
}

// Converts units of the finest leaf to lengths. Rounding must not put a node beyond the domain.
template <int Dimension>
Point<Dimension> SpacingTree<Dimension>::PointOf(const Node& node) const
{
  Point<Dimension> point;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double roots =
      static_cast<double>(node[axis]) / static_cast<double>(this->Width(axis, 0));
    point[axis] = std::min(roots * this->RootSides[axis], this->Frame.Sides[axis]);
  }
  return point;
}

template <int Dimension>
Point<Dimension> SpacingTree<Dimension>::NodePoint(std::int64_t node) const
{
  return this->PointOf(this->NodePlaces[static_cast<std::size_t>(node)]);
}

template <int Dimension>
Point<Dimension> SpacingTree<Dimension>::LeafLow(std::int64_t leaf) const
{
  return this->PointOf(this->LeafBox(leaf).Low);
}

// Finds the root in the lattice of roots, then descends by bits.
template <int Dimension>
typename SpacingTree<Dimension>::Place SpacingTree<Dimension>::Locate(
  const Point<Dimension>& x) const
{
  const RootPlace in = this->LocateRoot(x);
  return this->PlaceIn(in, this->LeafIn(in.Root, in.Fixed));
}

// Points move little between two evaluations, so that the leaf of the one before is mostly right.
template <int Dimension>
typename SpacingTree<Dimension>::Place SpacingTree<Dimension>::Locate(
  const Point<Dimension>& x, std::int64_t guess) const
{
  const RootPlace in = this->LocateRoot(x);
  const Box& leaf = this->LeafBox(guess);
  bool isInside = true;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // The place in units of the finest leaf, relative to the guessed leaf.
    const std::int64_t above = in.Low[axis] + in.Fixed[axis] - leaf.Low[axis];
    isInside = isInside && above >= 0 && above < this->Width(axis, leaf.Depth);
  }
  return this->PlaceIn(in, isInside ? guess : this->LeafIn(in.Root, in.Fixed));
}

// `Fixed` is the place in the root in fixed point, with 24 bits along each axis. Each further bit
// selects a half on the way down.
template <int Dimension>
typename SpacingTree<Dimension>::RootPlace SpacingTree<Dimension>::LocateRoot(
  const Point<Dimension>& x) const
{
  constexpr auto width = std::int64_t{ 1 } << DeepestLevel;
  RootPlace in;
  in.Root = 0;
  for (int axis = Dimension; axis-- > 0;)
  {
    const double roots = std::max(x[axis] / this->RootSides[axis], 0.0);
    const std::int64_t at = std::min(static_cast<std::int64_t>(roots), this->Roots[axis] - 1);
    in.At[axis] = std::min(roots - static_cast<double>(at), 1.0);
    in.Fixed[axis] = std::min(static_cast<std::int64_t>(in.At[axis] * width), width - 1);
    in.Low[axis] = at * width;
    in.Root = in.Root * this->Roots[axis] + at;
  }
  return in;
}

// Descends by the bits of the fixed-point coordinates: one bit for each axis that is halved at a
// depth.
template <int Dimension>
std::int64_t SpacingTree<Dimension>::LeafIn(std::int64_t root, const Node& fixed) const
{
  // The first child of the box, or the leaf's code, which is negative.
  std::int64_t first;
  int depth = 0;
  for (std::int64_t box = root; (first = this->Children[static_cast<std::size_t>(box)]) >= 0;
       ++depth)
  {
    int half = 0;
    box = first;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      if (this->IsHalved(axis, depth))
      {
        const int shift = DeepestLevel - 1 - this->Halvings(axis, depth);
        box += (fixed[axis] >> shift & 1) << half++;
      }
    }
  }
  return -1 - first;
}

// The place relative to the leaf: (at * 2^halvings) less its integer part.
template <int Dimension>
typename SpacingTree<Dimension>::Place SpacingTree<Dimension>::PlaceIn(
  const RootPlace& in, std::int64_t leaf) const
{
  const int depth = this->LeafBox(leaf).Depth;
  Place place{ leaf, {}, &this->Sides(depth) };
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // The fixed-point digits above the leaf's level are its index within the root.
    const int halvings = this->Halvings(axis, depth);
    place.At[axis] = in.At[axis] * static_cast<double>(std::int64_t{ 1 } << halvings) -
      static_cast<double>(in.Fixed[axis] >> (DeepestLevel - halvings));
  }
  return place;
}

template class SpacingTree<2>;
template class SpacingTree<3>;

} // namespace RectifiedTransport
