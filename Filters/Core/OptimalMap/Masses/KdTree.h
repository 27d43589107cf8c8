// SPDX-License-Identifier: BSD-3-Clause
// The masses of the boxes that halve a density's grid.
#ifndef RectifiedTransport_KdTree_h
#define RectifiedTransport_KdTree_h

#include "Core/OptimalMap/Masses/CellDensity.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// The cells [Low, High) of a grid.
template <int Dimension>
struct KdBox
{
  GridSize<Dimension> Low;
  GridSize<Dimension> High;
  std::int64_t Node = -1; // its number in the tree, or -1 if the tree does not keep the box

  std::int64_t NumberOfCells() const
  {
    std::int64_t count = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      count *= this->High[axis] - this->Low[axis];
    }
    return count;
  }
  bool IsDivisible() const { return this->NumberOfCells() > 1; }
};

// A k-d tree of boxes that are halved at whole cells across their longest side. It keeps all
// masses but those of small boxes and their parts, which are summed anew. Masses are sums of
// shares, never differences, so that those of empty boxes are exactly 0. For a uniform density
// nothing is kept.
template <int Dimension>
class KdTree
{
public:
  // The density must live as long. Throws std::bad_alloc and Cancelled.
  KdTree(const CellDensity<Dimension>& density, const Point<Dimension>& sides, Progress& progress);

  struct KdSplit
  {
    KdBox<Dimension> Low;
    KdBox<Dimension> High;
    int Axis; // across the plane between them
  };
  KdBox<Dimension> Whole() const;
  // Halves a box of more than one cell.
  KdSplit Halves(const KdBox<Dimension>& box) const;
  // The box's share of the whole mass, times a constant that is the same for all boxes.
  double Mass(const KdBox<Dimension>& box) const;
  // Moves a point into the nearest cell with mass of a box that has some, as PlaceInCell does. The
  // tree leaves out what is empty; of equally near cells, this may take another one than
  // CellDensity does.
  void MoveToMass(Point<Dimension>& point, const KdBox<Dimension>& box) const;
  const CellDensity<Dimension>& Density() const { return this->Cells; }

  // An estimate in bytes.
  static double MemoryFor(const GridSize<Dimension>& size);

private:
  // Its low half is the next node in the order.
  struct Node
  {
    KdBox<Dimension> Box;
    std::int64_t High = 0; // the other half; 0 if neither is kept
    double Mass = 0.0;
  };
  struct Nearest;

  void Keep(KdBox<Dimension> box, Progress& progress);
  double Sum(const KdBox<Dimension>& box) const;
  double SquaredDistance(const GridSize<Dimension>& cell, const KdBox<Dimension>& box) const;
  void Search(const KdBox<Dimension>& box, Nearest& nearest) const;
  void SearchCells(const KdBox<Dimension>& box, Nearest& nearest) const;

  const CellDensity<Dimension>& Cells;
  Point<Dimension> Sides;
  std::vector<Node> Nodes;
};

} // namespace RectifiedTransport

#endif
