// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/FixedCells.h"

#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Cells a chunk of parallel loops.
constexpr std::int64_t stillGrain = std::int64_t{ 1 } << 14;

// These tolerances bound the errors that a potential on nodes has in a part that truly stands
// still.
constexpr double leastSame = 1.0 - 2e-3; // ratio of two masses that count as the same
constexpr double mostSlack = 0.02;       // ratio to the squared distance of nodes
constexpr std::size_t fewestStill = 16;  // cells of a part, unless only voids surround it
constexpr double mostMove = 0.2;         // in the mean of a part, in cells between nodes
// What may cross a part's border, of its mass, and of that of the cells beyond: where more does,
// these move far, and the part may move with them.
constexpr double mostCrossing = 2e-4;
constexpr double mostBeyond = 1.5;

// What a cell between nodes is found to be.
enum Cell : unsigned char
{
  Empty,
  Moving,
  MayBeFixed,
  Fixed
};

// The Euclidean norm.
template <int Dimension>
double lengthOf(const Point<Dimension>& vector)
{
  double square = 0.0;
  for (const double v : vector)
  {
    square += v * v;
  }
  return std::sqrt(square);
}

// Sorts the cells between nodes: classifies each on its own, then decides about connected parts.
template <int Dimension>
class FixedParts
{
public:
  FixedParts(const PotentialSolver<Dimension>& solver, int from, Progress& progress)
    : Grid(solver.Grid())
    , Nodes(LatticePart<Dimension>::WholeOf(solver.Grid().Cells))
    , Potential(solver.Side(from).Potential.data())
    , Other(solver.Side(1 - from).Potential.data())
    , SourceCells(solver.Side(from).CellsOrNull())
    , TargetCells(solver.Side(1 - from).CellsOrNull())
    , Work(progress)
    , Map(NodeMap<Dimension>::On(solver.Grid()))
    , Kinds(this->Nodes.Count())
  {
    // With phi + psi = 0 the slack |x - x|^2 / 2 - phi - psi of a node and itself vanishes. Half a
    // node's move m leaves a slack of about m^2 / 2, hence the square of the shortest spacing; the
    // squared diagonal bounds what rounding leaves of potentials.
    const Point<Dimension>& spacing = this->Grid.Spacing;
    const double shortest = *std::min_element(spacing.begin(), spacing.end());
    constexpr double rounding = 1e-15;
    this->Most = mostSlack * shortest * shortest + rounding * this->Grid.SquaredDiagonal();
  }

  // Most maps move everything: without a candidate no map of the nodes is written.
  void Find()
  {
    this->Classify();
    const std::int64_t count = this->Nodes.Count();
    unsigned char* kinds = this->Kinds.data();
    if (std::find(kinds, kinds + count, MayBeFixed) == kinds + count)
    {
      return;
    }
    writeGradientMap<Dimension>(this->Potential, this->Map, this->Work);
    smoothMap<Dimension>(this->Map, this->Work); // removes the stairs that a potential on nodes has
    for (std::int64_t cell = 0; cell < count; ++cell)
    {
      if (kinds[cell] == MayBeFixed)
      {
        this->Decide(cell);
      }
    }
  }

  // Whether the cells that a box, in cells between nodes, overlaps stand still.
  bool AreFixed(const Point<Dimension>& low, const Point<Dimension>& high) const
  {
    // A box that ends within 1e-6 of a face does not overlap the next cell.
    constexpr double rounding = 1e-6;
    LatticePart<Dimension> box;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const std::int64_t last = this->Grid.Cells[axis] - 1;
      // The cells that the box overlaps, at least one along each axis.
      const auto begin = static_cast<std::int64_t>(std::floor(low[axis] + rounding));
      const auto end = static_cast<std::int64_t>(std::ceil(high[axis] - rounding));
      box.Low[axis] = std::clamp<std::int64_t>(begin, 0, last);
      box.Cells[axis] = std::clamp(end, box.Low[axis] + 1, last + 1) - box.Low[axis];
    }
    for (std::int64_t i = 0; i < box.Count(); ++i)
    {
      if (this->Kinds.data()[this->Nodes.NumberOf(box.CellOf(i))] != Fixed)
      {
        return false;
      }
    }
    return true;
  }

private:
  static constexpr int Corners = 1 << Dimension;

  // Cells of a uniform density are not stored; each has the mean mass, 1.
  static double MassOf(const double* cells, std::int64_t cell) { return cells ? cells[cell] : 1.0; }

  // The node at the lowest corner.
  std::int64_t NodeOf(const GridSize<Dimension>& place) const
  {
    std::int64_t node = 0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      node += place[axis] * this->Grid.Stride(axis);
    }
    return node;
  }
  // A corner of the cell of a lowest node: bit a of `corner` goes up along axis a.
  std::int64_t CornerOf(std::int64_t node, int corner) const
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      node += ((corner >> axis) & 1) * this->Grid.Stride(axis);
    }
    return node;
  }

  // A cell may stand still if both masses agree and one of its corners is next to its own image.
  void Classify()
  {
    this->Work.ForEach(this->Nodes.Count(), stillGrain, [&](std::int64_t cell) {
      const double source = MassOf(this->SourceCells, cell);
      const double target = MassOf(this->TargetCells, cell);
      const auto [less, more] = std::minmax(source, target);
      const bool mayBeFixed = more > 0.0 && less >= leastSame * more &&
        this->SlackAbout(this->NodeOf(this->Nodes.CellOf(cell))) <= this->Most;
      this->Kinds.data()[cell] = !(more > 0.0) ? Empty : mayBeFixed ? MayBeFixed : Moving;
    });
  }

  // The least slack -(phi + psi) of a corner and itself. The potentials' sum is at most c(x, x) =
  // 0, and equals it where x is its own image.
  double SlackAbout(std::int64_t node) const
  {
    double least = -(this->Potential[node] + this->Other[node]);
    for (int corner = 1; corner < Corners; ++corner)
    {
      const std::int64_t at = this->CornerOf(node, corner);
      least = std::min(least, -(this->Potential[at] + this->Other[at]));
    }
    return least;
  }

  // The displacement of a cell's centre by the map, the mean of the corners' images less the
  // centre, in cells.
  Point<Dimension> MoveOf(const GridSize<Dimension>& place) const
  {
    const std::int64_t node = this->NodeOf(place);
    Point<Dimension> move;
    for (std::size_t axis = 0; axis < Dimension; ++axis)
    {
      double sum = 0.0;
      for (int corner = 0; corner < Corners; ++corner)
      {
        sum += this->Map.Images[axis].data()[this->CornerOf(node, corner)];
      }
      move[axis] = sum / Corners - (static_cast<double>(place[axis]) + 0.5);
    }
    return move;
  }

  // Takes the connected part of a cell by breadth-first search over faces, and decides whether it
  // stands still: it is large enough, moves little in the mean, and is closed.
  void Decide(std::int64_t cell)
  {
    constexpr std::size_t interval = 1 << 14; // cells between two polls
    unsigned char* kinds = this->Kinds.data();
    // All of the part is marked Fixed at once, which keeps cells from entering the list twice, and
    // is marked Moving again if it fails.
    this->Part.assign(1, cell);
    kinds[cell] = Fixed;
    double mass = 0.0;
    double moved = 0.0;
    double crossing = 0.0;
    double beyond = 0.0;
    for (std::size_t next = 0; next < this->Part.size(); ++next)
    {
      if (next % interval == interval - 1)
      {
        this->Work.Check();
      }
      const std::int64_t own = this->Part[next];
      const GridSize<Dimension> place = this->Nodes.CellOf(own);
      const double ownMass = MassOf(this->TargetCells, own);
      const Point<Dimension> move = this->MoveOf(place);
      mass += ownMass;
      moved += ownMass * lengthOf<Dimension>(move);
      std::int64_t step = 1;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        for (const std::int64_t to : { -step, step })
        {
          // The box's border is closed: no mass crosses it.
          const bool isBorder = place[axis] == (to < 0 ? 0 : this->Grid.Cells[axis] - 1);
          const std::int64_t neighbour = isBorder ? own : own + to;
          if (kinds[neighbour] == Moving)
          {
            // The mass that the displacement carries through this face, at most half of the cell's.
            crossing += ownMass * std::min(0.5, std::abs(move[axis]));
            beyond += MassOf(this->TargetCells, neighbour);
          }
          if (kinds[neighbour] == MayBeFixed)
          {
            kinds[neighbour] = Fixed;
            this->Part.push_back(neighbour);
          }
        }
        step *= this->Grid.Cells[axis];
      }
    }
    // A part is closed if little crosses its border, beside its own mass or beside what lies
    // beyond. A small part next to other mass is no evidence.
    const bool isClosed = crossing <= std::max(mostCrossing * mass, mostBeyond * beyond);
    const bool isFew = this->Part.size() < fewestStill && beyond > 0.0;
    if (isFew || moved > mostMove * mass || !isClosed)
    {
      for (const std::int64_t own : this->Part)
      {
        kinds[own] = Moving;
      }
    }
  }

  const NodeGrid<Dimension>& Grid;
  const LatticePart<Dimension> Nodes;
  const double* Potential;
  const double* Other;
  const double* SourceCells;
  const double* TargetCells;
  Progress& Work;
  NodeMap<Dimension> Map;
  LargeBuffer<unsigned char> Kinds;
  std::vector<std::int64_t> Part;
  double Most = 0.0; // slack
};

} // namespace

// A target cell stands still if all cells between nodes that it overlaps do.
template <int Dimension>
FixedCells<Dimension>::FixedCells(const PotentialSolver<Dimension>& solver, int from,
  const CellDensity<Dimension>& target, Progress& progress)
  : SourceSize(solver.Density(from).Size())
  , Size(target.Size())
  , SourcePlacement(solver.Side(from).Placement)
  , TargetPlacement(solver.Side(1 - from).Placement)
{
  FixedParts<Dimension> parts(solver, from, progress);
  parts.Find();
  const auto cells = LatticePart<Dimension>::WholeOf(this->Size);
  LargeBuffer<unsigned char> areFixed(target.NumberOfCells());
  constexpr int none = 1;
  constexpr int all = 2;
  // Whether none and all of the cells with mass stand still.
  const int found = reduceChunks(
    progress, target.NumberOfCells(), stillGrain, none | all,
    [&](std::int64_t first, std::int64_t last) {
      // Bits of what may hold of a chunk's cells; chunks are combined by "and". Cells without mass
      // decide nothing.
      int ofChunk = none | all;
      for (std::int64_t cell = first; cell < last; ++cell)
      {
        Point<Dimension> low;
        Point<Dimension> high;
        const GridSize<Dimension> place = cells.CellOf(cell);
        for (int axis = 0; axis < Dimension; ++axis)
        {
          low[axis] = static_cast<double>(place[axis]);
          high[axis] = low[axis] + 1.0;
        }
        const bool hasMass = target.Share(cell) > 0.0;
        const bool isFixed = hasMass &&
          parts.AreFixed(
            this->TargetPlacement.ToNodes(low.data()), this->TargetPlacement.ToNodes(high.data()));
        areFixed.data()[cell] = isFixed ? 1 : 0;
        ofChunk &= isFixed ? all : hasMass ? none : none | all;
      }
      return ofChunk;
    },
    [](int whole, int part) { return whole & part; });
  this->All = found == all;
  // From the uniform measure to a density, cells of the mean density are no things that stand.
  const bool areThings = solver.Side(0).CellsOrNull() && solver.Side(1).CellsOrNull();
  if (found == 0 && areThings)
  {
    this->AreFixed = std::move(areFixed);
  }
}

// Whether the target cell at a point of its index space stands still.
template <int Dimension>
bool FixedCells<Dimension>::IsFixedAt(const double* image) const
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // Points beyond the grid do not stand still, nor do those that are NaN.
    if (!(image[axis] >= 0.0 && image[axis] <= static_cast<double>(this->Size[axis])))
    {
      return false;
    }
  }
  return this->AreFixed.data()[numberOfCellAt<Dimension>(image, this->Size)] != 0;
}

// Converts a point from one index space to the other and keeps it there if it stands still. It is
// the identity in physical space.
template <int Dimension>
bool FixedCells<Dimension>::MapIfFixed(const CellPlacement<Dimension>& from,
  const CellPlacement<Dimension>& to, const GridSize<Dimension>& size, double* point) const
{
  if (this->AreNone())
  {
    return false;
  }
  auto moved = pointAt<Dimension>(point);
  if (from.Low != to.Low || from.Sides != to.Sides) // conversions would round
  {
    moved = to.FromNodes(from.ToNodes(point).data());
    for (int axis = 0; axis < Dimension; ++axis)
    {
      moved[axis] = std::clamp(moved[axis], 0.0, static_cast<double>(size[axis]));
    }
  }
  const bool isFixed =
    this->All || this->IsFixedAt(&to == &this->TargetPlacement ? moved.data() : point);
  if (isFixed)
  {
    std::copy(moved.begin(), moved.end(), point);
  }
  return isFixed;
}

template <int Dimension>
bool FixedCells<Dimension>::Fix(double* point) const
{
  return this->MapIfFixed(this->SourcePlacement, this->TargetPlacement, this->Size, point);
}

template <int Dimension>
bool FixedCells<Dimension>::FixBackward(double* image) const
{
  return this->MapIfFixed(this->TargetPlacement, this->SourcePlacement, this->SourceSize, image);
}

// Sets images of points that stand still back after samples were finished.
template <int Dimension>
void FixedCells<Dimension>::RestoreFixed(const double* points, PointSpan<Dimension> images) const
{
  for (std::int64_t i = 0; i < images.size(); ++i)
  {
    auto point = pointAt<Dimension>(points + i * Dimension);
    if (this->Fix(point.data()))
    {
      std::copy(point.begin(), point.end(), images[i]);
    }
  }
}

template <int Dimension>
double FixedCells<Dimension>::MemoryKept(const GridSize<Dimension>& target)
{
  return numberOfCells<Dimension>(target);
}

template <int Dimension>
double FixedCells<Dimension>::MemoryFor(const GridSize<Dimension>& nodes)
{
  // A kind and an entry of the part's list for each cell; and the images of the nodes.
  constexpr double each = 1.0 + sizeof(std::int64_t);
  return each * numberOfCells<Dimension>(nodes) +
    sizeof(double) * Dimension * numberOfCorners<Dimension>(nodes);
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(FixedCells);

} // namespace RectifiedTransport
