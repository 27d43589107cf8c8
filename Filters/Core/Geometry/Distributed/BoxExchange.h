// SPDX-License-Identifier: BSD-3-Clause
// The exchange of boxes of an image's tuples between ranks.
#ifndef RectifiedTransport_BoxExchange_h
#define RectifiedTransport_BoxExchange_h

#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Geometry/Distributed/TupleMemory.h"
#include "Core/Parallel/Ranks.h"

#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

// The tuples that each rank holds, and those that each wants. Tuples of several ranks come from the
// lowest one; tuples of none are left as they are.
class BoxExchange
{
public:
  // `held`: the boxes that all ranks hold; `wanted`: the box that this rank wants. Collective.
  BoxExchange(std::vector<TupleBox> held, const TupleBox& wanted, const Ranks& ranks);

  // Appends to the parts for the other ranks what they want of tuples of the box `all`.
  void Append(const TupleMemory& from, const TupleBox& all, std::vector<Bytes>& parts) const;
  // Reads what another rank sent, for an array with the tuples of the box `all`; returns where the
  // next array begins. Call it for the ranks in descending order, with CopyOwn for this rank, to an
  // array of the wanted tuples.
  const char* Take(
    const char* from, std::size_t rank, const TupleMemory& to, const TupleBox& all) const;
  void CopyOwn(const TupleMemory& from, const TupleBox& all, const TupleMemory& to) const;
  const TupleBox& OwnWanted() const { return this->Wanted[this->Own]; }
  bool IsOwn(std::size_t rank) const { return rank == this->Own; }

private:
  TupleBox PartOf(std::size_t rank, const TupleBox& wanted) const;

  const std::vector<TupleBox> Held;
  const std::vector<TupleBox> Wanted;
  const std::size_t Own;
};

// An array with the tuples of the box `All`, and one for the wanted tuples of an exchange.
struct BoxArrays
{
  const BoxExchange* Boxes;
  TupleMemory From;
  TupleBox All;
  TupleMemory To;
};
// Exchanges several arrays together. Collective; every rank gives the same arrays.
void exchangeArrays(const std::vector<BoxArrays>& arrays, const Ranks& ranks);
// Exchanges one array with the tuples that this rank holds.
void exchangeBoxes(const std::vector<TupleBox>& held, const TupleBox& wanted, const Ranks& ranks,
  const TupleMemory& from, const TupleMemory& to);
// Within one array with the tuples of the box `all`: this rank has those that it holds and gets the
// wanted ones.
void completeBoxes(const std::vector<TupleBox>& held, const TupleBox& wanted, const TupleBox& all,
  const Ranks& ranks, const TupleMemory& array);

} // namespace RectifiedTransport

#endif
