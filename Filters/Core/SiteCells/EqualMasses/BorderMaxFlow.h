// SPDX-License-Identifier: BSD-3-Clause
// The adjacency of site cells, and the numbers of pixels, or the masses, to move over their borders
// so that each cell gets its share: a maximum flow.
#ifndef RectifiedTransport_BorderMaxFlow_h
#define RectifiedTransport_BorderMaxFlow_h

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace RectifiedTransport
{

class Progress;

struct SiteCellBorder
{
  std::int64_t Low; // numbers of site cells, Low < High
  std::int64_t High;
  // Twice the most that may move over it: the number of faces between pixels of both, or the masses
  // at these faces.
  std::int64_t Extent = 0;
  std::int64_t Flow = 0; // pixels, or mass, to move from Low to High
};

class BorderMaxFlow
{
public:
  explicit BorderMaxFlow(std::int64_t cells)
    : Cells(cells)
  {
  }

  void Clear();
  // Returns the number of the border between two site cells; Add inserts it if it is new.
  std::int64_t Add(std::int64_t low, std::int64_t high);
  std::int64_t Find(std::int64_t low, std::int64_t high) const;

  std::size_t Size() const { return this->Borders.size(); }
  SiteCellBorder& operator[](std::size_t number) { return this->Borders[number]; }

  // Computes the flow from site cells with too many pixels to those with too few (negative
  // `excess`) by Dinic's algorithm for a maximum flow: all shortest paths of neighbours first, then
  // the longer ones. The capacity of a border is half its extent, so that the border does not move
  // far. The outflow of a cell is at most `count`, its number of pixels. For masses, all numbers
  // are in units of mass. Excess without a path remains. Throws Cancelled.
  void Plan(const std::vector<std::int64_t>& excess, const std::vector<std::int64_t>& count,
    Progress& progress);

private:
  struct Neighbour
  {
    std::int64_t Cell;
    std::int64_t Border;
    int Sign; // 1 if a flow to that cell is positive, else -1
  };

  std::int64_t Key(std::int64_t low, std::int64_t high) const { return low * this->Cells + high; }
  std::int64_t Capacity(std::int64_t border, int sign) const;
  void FindNeighbours();
  bool FindDistances();
  bool FindPath(std::int64_t start);
  bool IsAdmissible(std::int64_t cell, const Neighbour& to) const;
  void Augment(std::int64_t start);

  const std::int64_t Cells;
  std::vector<SiteCellBorder> Borders;
  std::unordered_map<std::int64_t, std::int64_t> Numbers;
  std::vector<std::int64_t> FirstNeighbour;
  std::vector<Neighbour> Neighbours;
  std::vector<std::int64_t> Excess;   // excess that is not yet sent
  std::vector<std::int64_t> Movable;  // pixels of a site cell that no flow takes yet
  std::vector<std::int64_t> Distance; // to the nearest site cell with too few pixels, in borders
  std::vector<std::int64_t> Queue;
  std::vector<std::int64_t> Next; // the next neighbour of each cell to try
  std::vector<std::int64_t> Path; // numbers of neighbours
};

} // namespace RectifiedTransport

#endif
