// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/RefinedCells.h"

#include "Core/Geometry/CoveredParts.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkAMRBox.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkOverlappingAMR.h"
#include "vtkStructuredData.h"
#include "vtkUnsignedCharArray.h"
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_AMR_OF_CARTESIAN_GRIDS
#include "vtkCartesianGrid.h"
#include "vtkOverlappingAMRMetaData.h"
#else
#include "vtkAMRInformation.h"
#include "vtkUniformGrid.h"
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// vtkOverlappingAMR itself reports an error of its own where it is asked for a box that is not set.
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_AMR_OF_CARTESIAN_GRIDS
using BlockGrid = vtkCartesianGrid;

auto* metaDataOf(vtkOverlappingAMR* grids)
{
  return grids->GetOverlappingAMRMetaData();
}

unsigned int blocksIn(vtkOverlappingAMR* grids, unsigned int level)
{
  return grids->GetNumberOfBlocks(level);
}

BlockGrid* gridAt(vtkOverlappingAMR* grids, unsigned int level, unsigned int block)
{
  return grids->GetDataSetAsCartesianGrid(level, block);
}
#else
using BlockGrid = vtkUniformGrid;

auto* metaDataOf(vtkOverlappingAMR* grids)
{
  return grids->GetAMRInfo();
}

unsigned int blocksIn(vtkOverlappingAMR* grids, unsigned int level)
{
  return grids->GetNumberOfDataSets(level);
}

BlockGrid* gridAt(vtkOverlappingAMR* grids, unsigned int level, unsigned int block)
{
  return grids->GetDataSet(level, block);
}
#endif

// A block in messages, by its place in the hierarchy.
std::string nameOf(unsigned int level, unsigned int block)
{
  return "block " + std::to_string(block) + " of level " + std::to_string(level);
}

// Calls visit(level, block) for all blocks of all levels. The metadata are the same on all ranks,
// so that the order and the number of the calls are, too, although grids of other ranks are
// nullptr.
template <class Visit>
void visitBlocks(vtkOverlappingAMR* grids, const Visit& visit)
{
  for (unsigned int level = 0; level < grids->GetNumberOfLevels(); ++level)
  {
    for (unsigned int i = 0; i < blocksIn(grids, level); ++i)
    {
      visit(level, i);
    }
  }
}

// Without boxes VTK neither knows where grids are nor which cells finer ones cover.
void requireBoxes(vtkOverlappingAMR* grids)
{
  visitBlocks(grids, [grids](unsigned int level, unsigned int i) {
    const auto* data = metaDataOf(grids);
    const bool hasBox = data && !data->GetAMRBox(level, i).IsInvalid();
    if (!hasBox || !metaDataOf(grids)->HasSpacing(level))
    {
      throw Failure("The overlapping AMR has no " +
        (hasBox ? "spacing of level " + std::to_string(level) : "box for " + nameOf(level, i)) +
        "; its origin, the spacing of every level and the box of every block must be set "
        "(SetOrigin, SetSpacing, SetAMRBox), as readers do");
    }
  });
}

// Whether a grid of this rank has ghost flags, with which a reader may have marked refined cells.
bool hasGhosts(vtkOverlappingAMR* grids)
{
  bool has = false;
  visitBlocks(grids, [&](unsigned int level, unsigned int i) {
    BlockGrid* grid = gridAt(grids, level, i);
    has = has || (grid && grid->GetCellGhostArray());
  });
  return has;
}

// The axes along which a grid description such as VTK_XY_PLANE has one layer of points: the one
// among the eight choices of axes to which VTK gives this description.
std::array<bool, 3> flatAxes(int description)
{
  for (int axes = 0; axes < 8; ++axes)
  {
    const std::array<bool, 3> isFlat{ (axes & 1) != 0, (axes & 2) != 0, (axes & 4) != 0 };
    std::array<int, 3> points{ isFlat[0] ? 1 : 2, isFlat[1] ? 1 : 2, isFlat[2] ? 1 : 2 };
    if (vtkStructuredData::GetDataDescription(points.data()) == description)
    {
      return isFlat;
    }
  }
  return { false, false, false };
}

// Numbers along the axes in messages, "4 x 4 x 1".
template <class Counts>
std::string textOf(const Counts& counts)
{
  return std::to_string(counts[0]) + " x " + std::to_string(counts[1]) + " x " +
    std::to_string(counts[2]);
}

// How many cells of a finer level are along one of a level, by the spacings.
int refinementOf(vtkOverlappingAMR* grids, unsigned int level, unsigned int finer)
{
  // Files may have spacings in single precision or with few digits. A thousandth is far above such
  // rounding and far below the step to the next whole ratio. `most` keeps the conversion to int
  // valid.
  constexpr double most = 1e6;
  constexpr double tolerance = 1e-3;
  std::array<double, 3> coarse;
  std::array<double, 3> fine;
  grids->GetSpacing(level, coarse.data());
  grids->GetSpacing(finer, fine.data());
  const std::array<bool, 3> isFlat = flatAxes(grids->GetGridDescription());
  double common = 0.0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (isFlat[a])
    {
      continue;
    }
    const double ratio = coarse[a] / fine[a];
    // The first axis with cells gives the ratio, a whole number of at least 1; all others must have
    // it.
    common = common == 0.0 ? std::round(ratio) : common;
    if (!(coarse[a] > 0.0 && ratio < most && common >= 1.0 &&
          std::abs(ratio - common) < tolerance * common))
    {
      fail("The overlapping AMR has the spacing ", coarse[a], " of level ", level, ", but ",
        fine[a], " of level ", finer, " along axis ", a,
        "; spacings must be positive, and a level's a whole multiple of the finer one's, the same "
        "along all axes");
    }
  }
  return std::max(static_cast<int>(common), 1);
}

// Files and programs give flat boxes a cell across the plane, or none.
// Flat axes get the cells [0, 1), so that boxes of both kinds match. The others are in the index
// space of their level, whose cell 0 begins at the origin of the hierarchy.
LatticePart<3> cellsOf(vtkOverlappingAMR* grids, unsigned int level, unsigned int block)
{
  std::array<int, 3> low;
  std::array<int, 3> high;
  grids->GetAMRBox(level, block).GetDimensions(low.data(), high.data());
  const std::array<bool, 3> isFlat = flatAxes(grids->GetGridDescription());
  LatticePart<3> cells{ {}, {} };
  for (std::size_t a = 0; a < 3; ++a)
  {
    cells.Low[a] = isFlat[a] ? 0 : low[a];
    cells.Cells[a] = isFlat[a] ? 1 : std::int64_t{ high[a] } - low[a] + 1;
  }
  return cells;
}

// The grid's cells are marked by their places in the box.
void requireCellsOfBox(BlockGrid* grid, const LatticePart<3>& box, int description,
  unsigned int level, unsigned int block)
{
  std::array<int, 3> points;
  grid->GetDimensions(points.data());
  bool isFilled = vtkStructuredData::GetDataDescription(points.data()) == description;
  for (std::size_t a = 0; a < 3; ++a)
  {
    isFilled = isFilled && box.Cells[a] == std::max(points[a] - 1, 1);
  }
  if (!isFilled)
  {
    throw Failure("The overlapping AMR has " + textOf(box.Cells) + " cells in the box of " +
      nameOf(level, block) + ", but a grid of " + textOf(points) +
      " points there; all grids must have the cells of their boxes, and "
      "lie along the axes of the grid description");
  }
}

// The blocks of a level that have a grid on some rank; both vectors have one entry for each.
struct Level
{
  std::vector<LatticePart<3>> Parts; // the cells of each block
  std::vector<BlockGrid*> Grids;     // nullptr where it lies on another rank
};

// Which blocks have a grid on any rank, all levels one after the other.
std::vector<unsigned char> presentBlocks(vtkOverlappingAMR* grids, const Ranks& ranks)
{
  std::vector<unsigned char> present;
  if (grids)
  {
    visitBlocks(grids, [&](unsigned int level, unsigned int i) {
      present.push_back(gridAt(grids, level, i) ? 1 : 0);
    });
  }
  // Boxes without a grid on any rank cover nothing: readers leave out grids of levels that they do
  // not load. Ranks without the hierarchy give no flags.
  for (const Bytes& bytes : ranks.Gather(toBytes(present)))
  {
    const auto there = fromBytes<unsigned char>(bytes);
    for (std::size_t i = 0; i < std::min(there.size(), present.size()); ++i)
    {
      present[i] |= there[i];
    }
  }
  return present;
}

// The blocks of a level that have a grid; `present` says which do.
Level levelOf(vtkOverlappingAMR* grids, unsigned int number, const unsigned char* present)
{
  Level level;
  for (unsigned int i = 0; i < blocksIn(grids, number); ++i)
  {
    if (present[i])
    {
      level.Parts.push_back(cellsOf(grids, number, i));
      level.Grids.push_back(gridAt(grids, number, i));
    }
  }
  return level;
}

using Flags = std::map<BlockGrid*, vtkSmartPointer<vtkUnsignedCharArray>>;

// Flags that may be written into; those that a grid has are of the input.
vtkSmartPointer<vtkUnsignedCharArray> ownFlags(BlockGrid* grid)
{
  const auto flags = vtkSmartPointer<vtkUnsignedCharArray>::New();
  if (vtkUnsignedCharArray* given = grid->GetCellGhostArray())
  {
    flags->DeepCopy(given);
    return flags;
  }
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetNumberOfValues(grid->GetNumberOfCells());
  flags->FillValue(0);
  return flags;
}

// Marks the cells `covered` among the `own` ones of a grid.
void mark(BlockGrid* grid, const LatticePart<3>& own, const LatticePart<3>& covered, Flags& flags)
{
  vtkSmartPointer<vtkUnsignedCharArray>& marks = flags[grid];
  marks = marks ? marks : ownFlags(grid);
  if (marks->GetNumberOfValues() != grid->GetNumberOfCells())
  {
    return; // an error of whoever reads them
  }
  for (std::int64_t z = covered.Low[2]; z < covered.End(2); ++z)
  {
    for (std::int64_t y = covered.Low[1]; y < covered.End(1); ++y)
    {
      // Cells of a grid are numbered with axis 0 fastest, as those of the box.
      unsigned char* row = marks->GetPointer(own.NumberOf({ covered.Low[0], y, z }));
      for (std::int64_t x = 0; x < covered.Cells[0]; ++x)
      {
        row[x] |= vtkDataSetAttributes::REFINEDCELL;
      }
    }
  }
}

// The flags of this rank's grids that finer grids cover in part. Each level is compared with the
// next finer one that has grids: the levels beyond cover no more, as grids lie within those of
// coarser levels.
Flags findRefined(vtkOverlappingAMR* grids, const std::vector<unsigned char>& present)
{
  visitBlocks(grids, [&](unsigned int level, unsigned int i) {
    if (BlockGrid* grid = gridAt(grids, level, i))
    {
      requireCellsOfBox(grid, cellsOf(grids, level, i), grids->GetGridDescription(), level, i);
    }
  });
  Flags flags;
  // The flags of presence of one level after the other, in step with the loop.
  const unsigned char* ofLevel = present.data();
  unsigned int number = 0;
  Level coarse;
  for (unsigned int finer = 0; finer < grids->GetNumberOfLevels(); ++finer)
  {
    Level fine = levelOf(grids, finer, ofLevel);
    ofLevel += blocksIn(grids, finer);
    if (fine.Parts.empty())
    {
      continue;
    }
    if (!coarse.Parts.empty())
    {
      // vtkAMRUtilities::BlankCells would do, but reads past its arrays for boxes outside of the
      // coarser level's, for empty levels and for flat boxes with a cell across the plane.
      visitCovered(coarse.Parts, fine.Parts, refinementOf(grids, number, finer),
        [&](std::size_t block, const LatticePart<3>& covered) {
          if (coarse.Grids[block])
          {
            mark(coarse.Grids[block], coarse.Parts[block], covered, flags);
          }
        });
    }
    coarse = std::move(fine);
    number = finer;
  }
  return flags;
}

} // namespace

vtkSmartPointer<vtkOverlappingAMR> markRefinedCells(vtkOverlappingAMR* grids, const Ranks& ranks)
{
  // First the collective part, before anything that may fail on this rank alone.
  const std::vector<unsigned char> present = presentBlocks(grids, ranks);
  if (!grids)
  {
    return nullptr;
  }
  requireBoxes(grids);
  Flags flags;
  try
  {
    flags = findRefined(grids, present);
  }
  catch (const Failure&)
  {
    if (!hasGhosts(grids))
    {
      throw;
    }
    return grids; // the flags say it
  }
  // Grids of its own: those of the input stay as they are.
  const auto marked = vtkSmartPointer<vtkOverlappingAMR>::New();
  marked->CopyStructure(grids);
  visitBlocks(grids, [&](unsigned int level, unsigned int i) {
    BlockGrid* grid = gridAt(grids, level, i);
    // Grids that nothing covers are shared as they are; the others get a shallow copy with new
    // flags.
    const auto found = flags.find(grid);
    if (found == flags.end())
    {
      marked->SetDataSet(level, i, grid);
      return;
    }
    const auto copy = vtkSmartPointer<BlockGrid>::Take(grid->NewInstance());
    copy->ShallowCopy(grid);
    copy->GetCellData()->AddArray(found->second);
    marked->SetDataSet(level, i, copy);
  });
  return marked;
}

} // namespace RectifiedTransport::Bridge
