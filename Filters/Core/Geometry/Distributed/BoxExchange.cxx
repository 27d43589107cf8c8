// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Distributed/BoxExchange.h"

#include "Core/Parallel/RankExchange.h"

#include <utility>

namespace RectifiedTransport
{

namespace
{

// The rows of a box, as runs of tuples in the order of an image's box.
std::vector<TupleRun> runsOf(const TupleBox& box, const TupleBox& image)
{
  std::vector<TupleRun> runs;
  if (box.IsEmpty())
  {
    return runs;
  }
  for (std::int64_t k = box.Low[2]; k < box.End(2); ++k)
  {
    for (std::int64_t j = box.Low[1]; j < box.End(1); ++j)
    {
      runs.push_back({ image.NumberOf({ box.Low[0], j, k }), box.Cells[0] });
    }
  }
  return runs;
}

} // namespace

BoxExchange::BoxExchange(std::vector<TupleBox> held, const TupleBox& wanted, const Ranks& ranks)
  : Held(std::move(held))
  , Wanted(gatherValues(ranks, wanted))
{
}

// What a rank sends. Nothing is sent that a lower rank sends as well, for example where each rank
// has all tuples. A part that several lower ranks cover only together is sent twice.
TupleBox BoxExchange::PartFor(std::size_t rank, std::size_t receiver) const
{
  TupleBox part = this->Held[rank].And(this->Wanted[receiver]);
  // The lowest rank that holds the whole part sends it.
  for (std::size_t lower = 0; lower < rank && !part.IsEmpty(); ++lower)
  {
    if (this->Held[lower].Contains(part))
    {
      part.Cells = {};
    }
  }
  return part;
}

void exchangeArrays(const std::vector<BoxArrays>& arrays, const Ranks& ranks)
{
  const auto own = static_cast<std::size_t>(ranks.Own());
  std::vector<Bytes> parts(static_cast<std::size_t>(ranks.Count()));
  for (const BoxArrays& array : arrays)
  {
    for (std::size_t rank = 0; rank < parts.size(); ++rank)
    {
      if (rank != own)
      {
        appendTuples(array.From, runsOf(array.Boxes->PartFor(own, rank), array.Given), parts[rank]);
      }
    }
  }
  std::vector<Bytes> received = ranks.Exchange(std::move(parts));
  // The lowest rank comes last, so that its tuples are those that stay.
  for (std::size_t rank = received.size(); rank-- > 0;)
  {
    // Arrays follow each other in the bytes, in the order in which they were appended.
    const char* bytes = received[rank].data();
    for (const BoxArrays& array : arrays)
    {
      // The receiver computes the same parts as the sender: no sizes need to be sent.
      const TupleBox part = array.Boxes->PartFor(rank, own);
      if (rank != own)
      {
        bytes = takeTuples(bytes, runsOf(part, array.Made), array.To);
      }
      else if (array.To.First != array.From.First)
      {
        copyTuples(array.From, runsOf(part, array.Given), runsOf(part, array.Made), array.To);
      }
    }
    received[rank] = Bytes();
  }
}

void exchangeBoxes(const std::vector<TupleBox>& held, const TupleBox& wanted, const Ranks& ranks,
  const TupleMemory& from, const TupleMemory& to)
{
  const BoxExchange boxes(held, wanted, ranks);
  exchangeArrays(
    { { &boxes, from, held[static_cast<std::size_t>(ranks.Own())], to, wanted } }, ranks);
}

void completeBoxes(const std::vector<TupleBox>& held, const TupleBox& wanted, const TupleBox& all,
  const Ranks& ranks, const TupleMemory& array)
{
  const BoxExchange boxes(held, wanted, ranks);
  exchangeArrays({ { &boxes, array, all, array, all } }, ranks);
}

} // namespace RectifiedTransport
