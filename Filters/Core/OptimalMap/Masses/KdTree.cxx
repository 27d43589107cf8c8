// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/Masses/KdTree.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// Boxes of at most so many cells are leaves, whose parts are not kept but summed anew.
constexpr std::int64_t leafCells = 64; // cells

// Calls visit(first, last, cell) for each row of a box along axis 0: the numbers [first, last) of
// its cells, axis 0 fastest, and the place of its first cell.
template <int Dimension, class Visit>
void forRows(const KdBox<Dimension>& box, const GridSize<Dimension>& size, const Visit& visit)
{
  GridSize<Dimension> row = box.Low;
  for (int axis = 0; axis < Dimension;)
  {
    std::int64_t first = 0;
    for (int a = Dimension; a-- > 0;)
    {
      first = first * size[a] + row[a];
    }
    visit(first, first + box.High[0] - box.Low[0], row);
    for (axis = 1; axis < Dimension && ++row[axis] == box.High[axis]; ++axis)
    {
      row[axis] = box.Low[axis];
    }
  }
}

} // namespace

// The state of a search for the nearest cell with mass: the best one so far, and its squared
// distance.
template <int Dimension>
struct KdTree<Dimension>::Nearest
{
  GridSize<Dimension> From; // the cell of the box that holds the point, or is nearest to it
  GridSize<Dimension> Cell{};
  double Square = std::numeric_limits<double>::infinity();
};

// Nodes lie in preorder: a node's low half follows it, so that only the high half needs an index. A
// uniform density needs no tree, as a box's mass is its number of cells.
template <int Dimension>
KdTree<Dimension>::KdTree(
  const CellDensity<Dimension>& density, const Point<Dimension>& sides, Progress& progress)
  : Cells(density)
  , Sides(sides)
{
  if (density.IsUniform())
  {
    return;
  }
  this->Keep({ {}, density.Size() }, progress);
  const auto nodes = static_cast<std::int64_t>(this->Nodes.size());
  // The leaves' masses are sums over their cells, on all threads.
  progress.Threads().For(nodes, 64, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last && !progress.IsCancelled(); ++i)
    {
      Node& node = this->Nodes[static_cast<std::size_t>(i)];
      if (node.High == 0)
      {
        node.Mass = this->Sum(node.Box);
      }
    }
    progress.ShouldStop();
  });
  progress.Check();
  // Inner masses are the sums of the two halves'. In preorder both halves come after their parent,
  // hence backwards.
  for (std::size_t i = this->Nodes.size(); i-- > 0;)
  {
    Node& node = this->Nodes[i];
    if (node.High != 0)
    {
      node.Mass = this->Nodes[i + 1].Mass + this->Nodes[static_cast<std::size_t>(node.High)].Mass;
    }
  }
}

// Appends a box and, recursively, its halves.
template <int Dimension>
void KdTree<Dimension>::Keep(KdBox<Dimension> box, Progress& progress)
{
  const std::size_t own = this->Nodes.size();
  box.Node = static_cast<std::int64_t>(own);
  this->Nodes.push_back({ box });
  if (box.NumberOfCells() > leafCells)
  {
    const KdSplit halves = this->Halves(box);
    this->Keep(halves.Low, progress);
    this->Nodes[own].High = static_cast<std::int64_t>(this->Nodes.size());
    this->Keep(halves.High, progress);
  }
  // Polls for cancellation every 4096 nodes.
  if (own % 4096 == 0)
  {
    progress.Check();
  }
}

// The box of all cells, at the root if there is a tree.
template <int Dimension>
KdBox<Dimension> KdTree<Dimension>::Whole() const
{
  return { {}, this->Cells.Size(), this->Nodes.empty() ? -1 : 0 };
}

// Halves a box at a whole cell across its longest side, in lengths; the low half has the odd cell.
template <int Dimension>
typename KdTree<Dimension>::KdSplit KdTree<Dimension>::Halves(const KdBox<Dimension>& box) const
{
  int axis = 0;
  double longest = 0.0;
  for (int a = 0; a < Dimension; ++a)
  {
    const std::int64_t cells = box.High[a] - box.Low[a];
    const double length = static_cast<double>(cells) * this->Sides[a];
    if (cells > 1 && length > longest)
    {
      longest = length;
      axis = a;
    }
  }
  KdSplit halves{ box, box, axis };
  const std::int64_t plane = box.Low[axis] + (box.High[axis] - box.Low[axis] + 1) / 2;
  halves.Low.High[axis] = plane;
  halves.High.Low[axis] = plane;
  const std::int64_t high = box.Node < 0 ? 0 : this->Nodes[static_cast<std::size_t>(box.Node)].High;
  halves.Low.Node = high > 0 ? box.Node + 1 : -1;
  halves.High.Node = high > 0 ? high : -1;
  return halves;
}

// A kept box has its mass at hand; a part of a leaf is summed. A uniform density's masses are
// numbers of cells, in units of a cell's share.
template <int Dimension>
double KdTree<Dimension>::Mass(const KdBox<Dimension>& box) const
{
  if (this->Cells.IsUniform())
  {
    return static_cast<double>(box.NumberOfCells());
  }
  return box.Node < 0 ? this->Sum(box) : this->Nodes[static_cast<std::size_t>(box.Node)].Mass;
}

// The sum of the shares of a box's cells, in the fixed order of the rows.
template <int Dimension>
double KdTree<Dimension>::Sum(const KdBox<Dimension>& box) const
{
  double sum = 0.0;
  forRows<Dimension>(
    box, this->Cells.Size(), [&](std::int64_t first, std::int64_t last, const auto&) {
      for (std::int64_t cell = first; cell < last; ++cell)
      {
        sum += this->Cells.Share(cell);
      }
    });
  return sum;
}

// The point keeps its place within the cell as far as it can (PlaceInCell).
template <int Dimension>
void KdTree<Dimension>::MoveToMass(Point<Dimension>& point, const KdBox<Dimension>& box) const
{
  const PlaceInCell<Dimension> place(point.data(), box.Low, box.High);
  Nearest nearest{ place.Cell };
  this->Search(box, nearest);
  place.MoveTo(nearest.Cell, point.data());
}

// Branch and bound: the half on the point's side comes first, and a half is left out if it is empty
// or no nearer than the best cell so far.
template <int Dimension>
void KdTree<Dimension>::Search(const KdBox<Dimension>& box, Nearest& nearest) const
{
  if (box.Node < 0 || this->Nodes[static_cast<std::size_t>(box.Node)].High == 0)
  {
    this->SearchCells(box, nearest);
    return;
  }
  const KdSplit halves = this->Halves(box);
  const bool isLow = nearest.From[halves.Axis] < halves.High.Low[halves.Axis];
  // The mass of a kept box is read, not summed: empty halves cost nothing.
  for (const KdBox<Dimension>& half :
    { isLow ? halves.Low : halves.High, isLow ? halves.High : halves.Low })
  {
    if (this->Mass(half) > 0.0 && this->SquaredDistance(nearest.From, half) < nearest.Square)
    {
      this->Search(half, nearest);
    }
  }
}

// Compares all cells with mass of a leaf or of a part of one.
template <int Dimension>
void KdTree<Dimension>::SearchCells(const KdBox<Dimension>& box, Nearest& nearest) const
{
  forRows<Dimension>(
    box, this->Cells.Size(), [&](std::int64_t first, std::int64_t last, GridSize<Dimension> cell) {
      for (std::int64_t number = first; number < last; ++number, ++cell[0])
      {
        if (this->Cells.Share(number) > 0.0)
        {
          GridSize<Dimension> end = cell;
          for (std::int64_t& coordinate : end)
          {
            ++coordinate;
          }
          const double square = this->SquaredDistance(nearest.From, { cell, end });
          if (square < nearest.Square)
          {
            nearest.Square = square;
            nearest.Cell = cell;
          }
        }
      }
    });
}

// The squared distance between the centre of `cell` and that of the nearest cell of the box, in
// squared lengths: 0 along an axis where the box overlaps the cell.
template <int Dimension>
double KdTree<Dimension>::SquaredDistance(
  const GridSize<Dimension>& cell, const KdBox<Dimension>& box) const
{
  double square = 0.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const std::int64_t cells =
      std::max<std::int64_t>({ box.Low[axis] - cell[axis], cell[axis] - (box.High[axis] - 1), 0 });
    const double way = static_cast<double>(cells) * this->Sides[axis];
    square += way * way;
  }
  return square;
}

// A binary tree over leaves of at least leafCells / 2 cells has fewer than 4 nodes for each
// leafCells cells.
template <int Dimension>
double KdTree<Dimension>::MemoryFor(const GridSize<Dimension>& size)
{
  return numberOfCells<Dimension>(size) / leafCells * 4.0 * sizeof(Node);
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(KdTree);

} // namespace RectifiedTransport
