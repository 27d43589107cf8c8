// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/HyperTreeCells.h"

#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridNonOrientedGeometryCursor.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

using Bounds = std::array<double, 6>;

constexpr const char* purpose = "the cells of a hyper tree grid";

// This many leaves take a few milliseconds: an abort is noticed soon, and polls cost next to
// nothing.
constexpr std::size_t leavesBetweenPolls = std::size_t{ 1 } << 14;

// Polls for an abort, once in a while.
void poll(std::size_t leaf, Progress* progress)
{
  if (progress && leaf % leavesBetweenPolls == 0)
  {
    progress->Check();
  }
}

struct Leaves
{
  std::vector<Bounds> Boxes;
  std::vector<vtkIdType> Numbers; // the tuples of the leaves in the cell arrays of the grid
};

// Depth first, as the values of coarse cells are not needed: leaves alone tile the domain, and
// masked ones are no part of it.
void addLeaves(
  vtkHyperTreeGridNonOrientedGeometryCursor* cursor, Progress* progress, Leaves& leaves)
{
  if (cursor->IsMasked())
  {
    return;
  }
  if (cursor->IsLeaf())
  {
    poll(leaves.Boxes.size(), progress);
    leaves.Boxes.emplace_back();
    cursor->GetBounds(leaves.Boxes.back().data());
    leaves.Numbers.push_back(cursor->GetGlobalNodeIndex());
    return;
  }
  const int children = cursor->GetNumberOfChildren();
  for (int child = 0; child < children; ++child)
  {
    cursor->ToChild(static_cast<unsigned char>(child));
    addLeaves(cursor, progress, leaves);
    cursor->ToParent();
  }
}

// The leaves of all trees, in the order of the trees. The non-oriented geometry cursor knows the
// bounds of a node in physical coordinates, and can return to the parent.
Leaves leavesOf(vtkHyperTreeGrid* grid, Progress* progress)
{
  Leaves leaves;
  vtkHyperTreeGrid::vtkHyperTreeGridIterator trees;
  grid->InitializeTreeIterator(trees);
  vtkNew<vtkHyperTreeGridNonOrientedGeometryCursor> cursor;
  vtkIdType tree = 0;
  while (trees.GetNextTree(tree))
  {
    grid->InitializeNonOrientedGeometryCursor(cursor, tree);
    addLeaves(cursor, progress, leaves);
  }
  return leaves;
}

// The corners of the boxes, the first axis fastest, eight a voxel.
vtkSmartPointer<vtkDoubleArray> cornersOf(const Leaves& leaves, const std::vector<int>& axes)
{
  const std::size_t corners = std::size_t{ 1 } << axes.size();
  auto places =
    newArray<vtkDoubleArray>(purpose, 3, static_cast<vtkIdType>(corners * leaves.Boxes.size()));
  double* x = places->GetPointer(0);
  for (const Bounds& box : leaves.Boxes)
  {
    for (std::size_t corner = 0; corner < corners; ++corner, x += 3)
    {
      // Along axes without cells all corners have the lower bound; along the others bit a of the
      // number of a corner chooses the bound. This is the order of points of VTK_LINE, VTK_PIXEL
      // and VTK_VOXEL.
      for (std::size_t a = 0; a < 3; ++a)
      {
        x[a] = box[2 * a];
      }
      for (std::size_t a = 0; a < axes.size(); ++a)
      {
        const auto axis = static_cast<std::size_t>(axes[a]);
        x[axis] = box[2 * axis + (corner >> a & 1)];
      }
    }
  }
  return places;
}

// The axes along which the grid has cells.
std::vector<int> axesOf(vtkHyperTreeGrid* grid)
{
  // GetDimensions counts the points of the coarse grid of trees, 1 along an axis without cells.
  int points[3];
  grid->GetDimensions(points);
  std::vector<int> axes;
  for (int a = 0; a < 3; ++a)
  {
    if (points[a] > 1)
    {
      axes.push_back(a);
    }
  }
  return axes;
}

// Arrays of a hyper tree grid have a tuple for each node of its trees, coarse ones, too. An array
// that lacks tuples of leaves is left out.
void copyValues(vtkHyperTreeGrid* grid, const Leaves& leaves, vtkCellData* to)
{
  auto* from =
    vtkDataSetAttributes::SafeDownCast(grid->GetAttributesAsFieldData(vtkDataObject::CELL));
  if (!from)
  {
    return;
  }
  const auto count = static_cast<vtkIdType>(leaves.Numbers.size());
  vtkNew<vtkIdList> numbers;
  numbers->SetNumberOfIds(count);
  std::copy(leaves.Numbers.begin(), leaves.Numbers.end(), numbers->GetPointer(0));
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = from->GetAbstractArray(i);
    // Node numbers need not ascend, so that the tuple of every leaf is looked for. Files may be
    // damaged.
    bool isWhole = true;
    for (const vtkIdType number : leaves.Numbers)
    {
      isWhole = isWhole && number < array->GetNumberOfTuples();
    }
    if (!isWhole)
    {
      continue;
    }
    const auto values = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
    values->SetName(array->GetName());
    values->SetNumberOfComponents(array->GetNumberOfComponents());
    values->SetNumberOfTuples(count);
    array->GetTuples(numbers, values);
    const int index = to->AddArray(values);
    // The active scalars are the density if no array is chosen, so that attributes stay active. The
    // ghost array is copied as any other: duplicates of other pieces stay marked.
    const int attribute = from->IsArrayAnAttribute(i);
    if (attribute >= 0)
    {
      to->SetActiveAttribute(index, attribute);
    }
  }
}

} // namespace

vtkSmartPointer<vtkUnstructuredGrid> cellsOfTrees(vtkHyperTreeGrid* grid, Progress* progress)
{
  auto cells = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const std::vector<int> axes = axesOf(grid);
  // A grid without axes has no cells. The result has no points, so that the caller skips it.
  if (axes.empty())
  {
    return cells;
  }
  const int corners = 1 << axes.size();
  // A cell has its box, its corners and their numbers.
  const vtkIdType bytes = sizeof(Bounds) + corners * (3 * sizeof(double) + sizeof(vtkIdType));
  // GetNumberOfCells counts coarse nodes, too, so that this is an upper bound for the message.
  withMemory({ purpose, static_cast<double>(grid->GetNumberOfCells() * bytes) }, [&]() {
    const Leaves leaves = leavesOf(grid, progress);
    vtkNew<vtkPoints> points;
    points->SetData(cornersOf(leaves, axes));
    cells->SetPoints(points);
    cells->Allocate(static_cast<vtkIdType>(leaves.Boxes.size()));
    // Each leaf has corners of its own: a density needs the boxes of cells, not which of them share
    // points.
    const int type = axes.size() == 1 ? VTK_LINE : axes.size() == 2 ? VTK_PIXEL : VTK_VOXEL;
    std::array<vtkIdType, 8> ids{};
    for (std::size_t leaf = 0; leaf < leaves.Boxes.size(); ++leaf)
    {
      poll(leaf, progress);
      for (int corner = 0; corner < corners; ++corner)
      {
        ids[static_cast<std::size_t>(corner)] = static_cast<vtkIdType>(leaf) * corners + corner;
      }
      cells->InsertNextCell(type, corners, ids.data());
    }
    copyValues(grid, leaves, cells->GetCellData());
    cells->GetFieldData()->ShallowCopy(grid->GetFieldData());
  });
  return cells;
}

} // namespace RectifiedTransport::Bridge
