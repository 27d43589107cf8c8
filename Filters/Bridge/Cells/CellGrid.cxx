// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cells/CellGrid.h"

#include "Bridge/Cells/MeshCells.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Resampling/CellFrame.h"

#include "vtkDataSet.h"

#include <memory>
#include <sstream>

namespace RectifiedTransport::Bridge
{

namespace
{

std::string describe(const Eigen::Vector3d& x)
{
  std::ostringstream text;
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
  return text.str();
}

[[noreturn]] void failNotFinite(const DensityBlock& block, vtkIdType point)
{
  Eigen::Vector3d x;
  vtkDataSet* data = block.Data;
  data->GetPoint(point, x.data());
  fail("Point ", point, " of the ", block.Name, " is at ", describe(x),
    "; the coordinates of all points of cells must be finite");
}

[[noreturn]] void failFlat(const MassCells& mass, const Eigen::Vector3d& sides)
{
  const int dimension = mass.Dimension;
  fail("The input's cells are ",
    dimension == 1          ? "lines that are not on one straight line"
      : mass.AreClosedLines ? "closed lines that lie in no plane"
                            : "faces that lie in no plane",
    ": points are ", sides[2 - dimension], " off, with a longest side of ", sides[2], "; ",
    mass.AreClosedLines ? "they must lie in one plane"
      : dimension == 2
      ? "they must lie in one plane, as a slice does (Sample Surface takes curved "
        "surfaces that are disks)"
      : "they must lie on one, or closed ones in a plane, around regions (Triangle "
        "Strips joins the segments of a slice)");
}

void requireFrame(
  const CellFrame& frame, const std::vector<DensityBlock>& blocks, const MassCells& mass)
{
  switch (frame.Wrong)
  {
    case CellFrame::Flaw::NotFinite:
      failNotFinite(blocks[frame.Set], frame.Point);
    case CellFrame::Flaw::OnePlace:
      fail("The cells of the input are all at one place; they must have a length, area or volume");
    case CellFrame::Flaw::TooLong:
      fail("The cells of the input reach from ", describe(frame.Box.min()), " to ",
        describe(frame.Box.max()), "; a side must not be past the largest double");
    case CellFrame::Flaw::NotFlat:
      failFlat(mass, frame.Sides);
    case CellFrame::Flaw::None:
      break;
  }
}

std::string percent(double part, double whole)
{
  std::ostringstream text;
  text.precision(2);
  text << (whole > 0.0 ? 100.0 * part / whole : 0.0) << " %";
  return text.str();
}

// "(the first is cell 3)", or "cell 3 of block 1 of the input".
std::string firstText(const BlockValues& blocks, std::size_t block, vtkIdType cell)
{
  return " (the first is cell " + std::to_string(cell) +
    (blocks.Sources.size() > 1 ? " of " + blocks.Sources[block].Block : "") + ")";
}

} // namespace

CellSets cellSetsOf(const std::vector<DensityBlock>& blocks)
{
  CellSets sets;
  for (const DensityBlock& block : blocks)
  {
    sets.push_back(std::make_shared<MeshCells>(block.Data, block.Name));
  }
  return sets;
}

std::optional<CellLattice> latticeOf(
  const std::vector<DensityBlock>& blocks, const CellSets& sets, int dimension, Progress& progress)
{
  std::optional<CellLattice> lattice = CellLattice::Find(sets, dimension, progress);
  for (std::size_t b = 0; lattice && b < sets.size(); ++b)
  {
    const bool isPlaced =
      withMemory({ "the places of cells in their lattice",
                   static_cast<double>(sets[b]->NumberOfCells) * sizeof(std::int64_t) },
        [&]() { return lattice->Place(*sets[b], blocks[b].Array != nullptr, progress); });
    if (!isPlaced)
    {
      lattice.reset();
    }
  }
  return lattice;
}

ImageGrid gridOfCells(const std::vector<DensityBlock>& blocks, const CellSets& sets,
  const MassCells& mass, int resolution, Progress& progress)
{
  const CellFrame frame = CellFrame::Of(sets, mass, progress);
  requireFrame(frame, blocks, mass);
  double box[6];
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    box[2 * a] = frame.Box.min()[a];
    box[2 * a + 1] = frame.Box.max()[a];
  }
  const ImageGrid straight = gridWithResolution(gridOfBox(box), resolution, "DensityResolution");
  return { straight.Extent(), frame.Axes * straight.Origin(), straight.Spacing(), frame.Axes,
    straight.IsOnPoints() };
}

std::vector<std::string> describeLost(
  const BlockValues& blocks, const CellSize& size, int dimension)
{
  std::vector<std::string> warnings;
  if (size.LeftOut > 0)
  {
    warnings.push_back(std::to_string(size.LeftOut) + (size.LeftOut == 1 ? " cell" : " cells") +
      " of the input" + firstText(blocks, size.Set, size.FirstLeftOut) +
      " could not be divided into simplices and carry no mass: at most " +
      percent(size.LeftOutIntegral, size.LeftOutIntegral + size.Integral) + " of the mass, and " +
      percent(size.LeftOutMeasure, size.LeftOutMeasure + size.Measure) + " of the " +
      (dimension == 3      ? "volume"
          : dimension == 2 ? "area"
                           : "length") +
      ", are in the boxes around them");
  }
  vtkIdType open = 0;
  std::string first;
  for (std::size_t b = 0; b < blocks.Cells.size(); ++b)
  {
    first = open == 0 ? firstText(blocks, b, blocks.Cells[b].FirstOpenLine()) : first;
    open += blocks.Cells[b].OpenLines();
  }
  if (open > 0)
  {
    warnings.push_back(std::to_string(open) +
      (open == 1 ? " line of the input is not closed" + first + " and carries no mass"
                 : " lines of the input are not closed" + first + " and carry no mass") +
      "; lines around regions must end where they begin");
  }
  return warnings;
}

} // namespace RectifiedTransport::Bridge
