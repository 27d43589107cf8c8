// SPDX-License-Identifier: BSD-3-Clause
// Which cells touch, and how many pixels go from one to the other so that each gets its share.
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
  std::int64_t Low; // Low < High
  std::int64_t High;
  std::int64_t Faces = 0;
  std::int64_t Flow = 0; // pixels to go from Low to High
};

class BorderMaxFlow
{
public:
  explicit BorderMaxFlow(std::int64_t cells)
    : Cells(cells)
  {
  }

  void Clear();
  // The number of the contact of two cells; Add makes it if it is new.
  std::int64_t Add(std::int64_t low, std::int64_t high);
  std::int64_t Find(std::int64_t low, std::int64_t high) const;

  std::size_t Size() const { return this->Contacts.size(); }
  SiteCellBorder& operator[](std::size_t number) { return this->Contacts[number]; }

  // Sends what cells have too many of (`excess`, negative where there are too few) from neighbour
  // to neighbour to those that have too few, on the shortest ways first: all ways of one length,
  // then what is left on longer ones (as in Dinic's algorithm for a maximum flow). No more goes
  // over a border than half of its faces, that it stays where it is, and none leaves that had not
  // been there (`count`). What finds no way stays. Throws Cancelled.
  void Plan(const std::vector<std::int64_t>& excess, const std::vector<std::int64_t>& count,
    Progress& progress);

private:
  struct Neighbour
  {
    std::int64_t Cell;
    std::int64_t Contact;
    int Sign; // of a flow to that cell
  };

  std::int64_t Key(std::int64_t low, std::int64_t high) const { return low * this->Cells + high; }
  std::int64_t Capacity(std::int64_t contact, int sign) const;
  void FindNeighbours();
  bool CountSteps();
  bool FindWay(std::int64_t start);
  bool LeadsOn(std::int64_t cell, const Neighbour& to) const;
  void Send(std::int64_t start);

  const std::int64_t Cells;
  std::vector<SiteCellBorder> Contacts;
  std::unordered_map<std::int64_t, std::int64_t> Numbers;
  std::vector<std::int64_t> FirstNeighbour;
  std::vector<Neighbour> Neighbours;
  std::vector<std::int64_t> Open;  // what is left of the excess
  std::vector<std::int64_t> Left;  // pixels of a cell that are not to go yet
  std::vector<std::int64_t> Steps; // to the nearest cell that has too few
  std::vector<std::int64_t> Queue;
  std::vector<std::int64_t> Next; // the neighbour of each cell to try
  std::vector<std::int64_t> Way;  // numbers of neighbours
};

} // namespace RectifiedTransport

#endif
