// SPDX-License-Identifier: BSD-3-Clause
// The power diagram (Laguerre diagram) of weighted sites in a rectangle: the cell of a site is the
// set of points x for which its |x - site|^2 - weight is smallest.
#ifndef RectifiedTransport_PowerDiagram_h
#define RectifiedTransport_PowerDiagram_h

#include "Core/Geometry/Points.h"
#include "Core/PowerCells/SiteTree.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Bisectors of its site and others cut each cell out of the rectangle, independently of other
// cells. Cells are therefore computed in parallel, and no arrangement of sites is special. The
// neighbours of the last update come first. Cells that then fit together are final; for the others
// more neighbours are searched.
class PowerDiagram
{
public:
  // A corner of a cell, and the side to the next corner, counter-clockwise.
  struct Corner
  {
    Point<2> X;
    std::int64_t Neighbour; // the site across the side; -1 at the border of the rectangle
  };
  struct Cell
  {
    const Corner* First = nullptr;
    std::int64_t Count = 0; // 0 or at least 3

    const Corner& operator[](std::int64_t corner) const { return this->First[corner]; }
    const Corner& After(std::int64_t corner) const
    {
      return this->First[corner + 1 < this->Count ? corner + 1 : 0];
    }
    const Corner& Before(std::int64_t corner) const
    {
      return this->First[(corner > 0 ? corner : this->Count) - 1];
    }
  };

  // The rectangle [0, lengths].
  explicit PowerDiagram(const Point<2>& lengths)
    : Lengths(lengths)
  {
  }

  // Sets the sites, at least one. They may lie outside the rectangle, and may coincide. Throws
  // std::bad_alloc and Cancelled.
  void SetSites(ConstPointSpan<2> sites, Progress& progress);
  const std::vector<Point<2>>& Sites() const { return this->AllSites; }
  // Computes the cells. After an exception, some of them are kept for the next update.
  void Update(const double* weights, Progress& progress);

  std::int64_t NumberOfCells() const { return this->Tree.Size(); }
  Cell operator[](std::int64_t site) const { return this->Now.At(site); }

  // Writes the corners of the cell that a site would have with another weight than in the last
  // update, with the other weights unchanged.
  void CutCell(std::int64_t site, double weight, std::vector<Corner>& corners) const;

  // Cells are computed in an order in which neighbours are near each other, and in chunks.
  static constexpr std::int64_t cellsOfChunk = 64;
  std::int64_t NumberOfChunks() const
  {
    return (this->NumberOfCells() + cellsOfChunk - 1) / cellsOfChunk;
  }
  // The site at a place in that order.
  std::int64_t SiteAt(std::int64_t place) const { return this->Tree.Site(place); }

private:
  class Cutter;
  struct Place
  {
    std::int64_t Chunk = 0;
    std::int64_t First = 0;
    std::int64_t Count = 0;
  };
  // The cells of all sites, empty at first.
  struct Cells
  {
    Cell At(std::int64_t site) const
    {
      const Place& place = this->Places[static_cast<std::size_t>(site)];
      return { this->Chunks[static_cast<std::size_t>(place.Chunk)].data() + place.First,
        place.Count };
    }
    void Clear(std::int64_t sites, std::int64_t chunks);
    void Store(const Point<2>& at, std::int64_t site, std::int64_t chunk, const Cutter& cutter);

    std::vector<Place> Places;
    std::vector<std::vector<Corner>> Chunks;
  };
  // The sites that cut a cell.
  enum class CutBy : char
  {
    Known,        // the neighbours of the last update
    Inconsistent, // the same, and the cell may be too large
    All
  };

  const Point<2>& SiteOf(std::int64_t site) const
  {
    return this->AllSites[static_cast<std::size_t>(site)];
  }
  std::atomic<CutBy>& StateOf(std::int64_t site)
  {
    return this->States[static_cast<std::size_t>(site)];
  }
  void CutByKnown(const double* weights, Progress& progress);
  std::vector<std::int64_t> FindInconsistent(Progress& progress);
  std::vector<std::int64_t> SitesCutBy(CutBy state);
  std::int64_t Compare(std::int64_t site);
  void MarkInconsistent(std::int64_t site);
  void CutByAll(const std::vector<std::int64_t>& sites, const double* weights, Progress& progress);
  void CutByNeighbours(
    const Cell& known, std::int64_t site, const double* weights, Cutter& cutter) const;
  void CutByRivals(std::int64_t site, double weight, Cutter& cutter) const;

  const Point<2> Lengths;
  SiteTree Tree;
  std::vector<Point<2>> AllSites;
  std::vector<std::atomic<CutBy>> States;
  Cells Now;
  Cells Last; // cells of the previous update, for their neighbours
};

} // namespace RectifiedTransport

#endif
