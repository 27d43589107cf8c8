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

  // What a rank sends of its tuples to another one, or keeps.
  TupleBox PartFor(std::size_t rank, std::size_t receiver) const;

private:
  const std::vector<TupleBox> Held;
  const std::vector<TupleBox> Wanted;
};

// An array with the tuples of the box `Given`, and one, or the same, with those of the box `Made`,
// which gets the wanted tuples of an exchange.
struct BoxArrays
{
  const BoxExchange* Boxes;
  TupleMemory From;
  TupleBox Given;
  TupleMemory To;
  TupleBox Made;
};
// Exchanges several arrays together. Collective; every rank gives the same arrays.
void exchangeArrays(const std::vector<BoxArrays>& arrays, const Ranks& ranks);
// Exchanges one array with the tuples that this rank holds.
void exchangeBoxes(const std::vector<TupleBox>& held, const TupleBox& wanted, const Ranks& ranks,
  const TupleMemory& from, const TupleMemory& to);
// Within one array with the tuples of the box `all`: this rank has those that it holds and gets the
// wanted ones. Ranks that hold a tuple have the same value of it.
void completeBoxes(const std::vector<TupleBox>& held, const TupleBox& wanted, const TupleBox& all,
  const Ranks& ranks, const TupleMemory& array);

} // namespace RectifiedTransport

#endif
