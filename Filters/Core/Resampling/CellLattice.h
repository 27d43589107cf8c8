// SPDX-License-Identifier: BSD-3-Clause
// Cells of an image that a filter such as Threshold turned into voxels, hexahedra, pixels,
// quadrilaterals or lines: the image that they came from.
#ifndef RectifiedTransport_CellLattice_h
#define RectifiedTransport_CellLattice_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"
#include "Core/Resampling/CellValues.h"
#include "Core/Resampling/LatticeFrame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace RectifiedTransport
{

class CellLattice
{
public:
  // The lattice of the cells of the dimension. None if their edges differ, or if there are far
  // fewer cells than the lattice's box has. Throws Cancelled.
  static std::optional<CellLattice> Find(const CellSets& sets, int dimension, Progress& progress);
  // Call it for all of these sets, in their order; `hasMass`: whether values of it follow. Returns
  // false if a cell is not a box of the lattice, for any order of corners and direction of axes.
  // Corners may be off by the rounding of coordinates and by 1e-4 of a cell. Throws Cancelled.
  bool Place(const CellSet& cells, bool hasMass, Progress& progress);

  // The grid on the box of the cells of all blocks, with values on cells. Its axes are those of
  // space, or nearest to them.
  const ImageGrid& Grid() const { return this->Box; }

  // The grid with its cells divided along each axis so that the longest axis has about `resolution`
  // cells, or the grid as it is.
  ImageGrid DividedGrid(int resolution) const;

  // Whether no two counted cells are at the same place. The values are those of the sets with mass.
  bool HasEachOnce(const std::vector<CellValues>& sets, Progress& progress) const;
  // For the grid: the cell values in their places, 0 if there is none.
  void CopyValues(const std::vector<CellValues>& sets, double* cells, Progress& progress) const;
  // For the divided grid: sets to 0 what rounding put outside the cells.
  void ClearAround(const std::vector<CellValues>& sets, const ImageGrid& divided, double* cells,
    Progress& progress) const;

  // Calls visit(place, set, cell) for the counted cells; a place is a number in the grid.
  template <class Visit>
  void VisitCounted(
    const std::vector<CellValues>& sets, Progress& progress, const Visit& visit) const;

  const LatticeFrame& Frame() const { return this->Axes; }

private:
  // Which places have a counted cell. Returns whether none has two.
  bool FindTaken(
    const std::vector<CellValues>& sets, Progress& progress, std::vector<bool>& taken) const;

  LatticeFrame Axes;
  ImageGrid Box;
  int Dimension = 0;
  std::vector<std::vector<std::int64_t>>
    Places; // one for each cell of each set with mass; -1: none
};

// Multilinear places need the image's order of places: axis 0 fastest.
template <class Visit>
void CellLattice::VisitCounted(
  const std::vector<CellValues>& sets, Progress& progress, const Visit& visit) const
{
  constexpr std::int64_t cellsBetweenPolls = std::int64_t{ 1 } << 16;
  for (std::size_t s = 0; s < sets.size(); ++s)
  {
    const std::vector<std::int64_t>& places = this->Places[s];
    for (std::size_t cell = 0; cell < places.size(); ++cell)
    {
      progress.CheckEvery(cellsBetweenPolls, static_cast<std::int64_t>(cell));
      if (places[cell] >= 0 && sets[s].IsCounted(static_cast<std::int64_t>(cell)))
      {
        visit(places[cell], s, cell);
      }
    }
  }
}

// Where places lie among the points and cells of sets that form a lattice: linear between the
// corners of a cell along each axis. Places in holes are in no cell, except those that rounding put
// there.
class LatticeLookup
{
public:
  // A place between points with weights. For a place in no cell, Cell is -1.
  struct Place
  {
    std::array<std::int64_t, 8> Points;
    std::array<double, 8> Weights;
    int Count = 0; // the number of points
    std::int64_t Cell = -1;
    std::size_t Set = 0;
  };

  // Throws Cancelled.
  LatticeLookup(
    const CellLattice& lattice, const std::vector<CellValues>& sets, Progress& progress);

  // `place` is physical, in the lattice's grid. On any thread.
  Place Find(const double* place) const;

private:
  // The number of a cell among the cells of all sets; -1 for none.
  std::int64_t CellNear(const std::array<double, 3>& along) const;

  const CellLattice& Lattice;
  const std::vector<CellValues>& Sets;
  std::vector<std::int64_t> First{ 0 }; // number of the first cell of each set, and the end
  std::vector<std::int64_t> CellAt;     // numbers of cells, by places of the lattice; -1: none
};

} // namespace RectifiedTransport

#endif
