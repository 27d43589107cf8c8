// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Distributed/BoxExchange.h"

#include "Core/Parallel/RankExchange.h"

#include <utility>

namespace RectifiedTransport
{

namespace
{

// The rows of a box among the tuples of another one, that of an image.
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
  , Own(static_cast<std::size_t>(ranks.Own()))
{
}

// Of a rank's tuples: nothing that a lower rank sends, too, as where each has all.
TupleBox BoxExchange::PartOf(std::size_t rank, const TupleBox& wanted) const
{
  TupleBox part = this->Held[rank].And(wanted);
  for (std::size_t lower = 0; lower < rank && !part.IsEmpty(); ++lower)
  {
    if (this->Held[lower].Contains(part))
    {
      part.Cells = {};
    }
  }
  return part;
}

void BoxExchange::Append(
  const TupleMemory& from, const TupleBox& all, std::vector<Bytes>& parts) const
{
  for (std::size_t rank = 0; rank < this->Wanted.size(); ++rank)
  {
    if (rank != this->Own)
    {
      appendTuples(from, runsOf(this->PartOf(this->Own, this->Wanted[rank]), all), parts[rank]);
    }
  }
}

void BoxExchange::CopyOwn(const TupleMemory& from, const TupleBox& all, const TupleMemory& to) const
{
  const TupleBox& wanted = this->OwnWanted();
  const TupleBox part = this->PartOf(this->Own, wanted);
  copyTuples(from, runsOf(part, all), runsOf(part, wanted), to);
}

const char* BoxExchange::Take(
  const char* from, std::size_t rank, const TupleMemory& to, const TupleBox& all) const
{
  return takeTuples(from, runsOf(this->PartOf(rank, this->OwnWanted()), all), to);
}

void exchangeArrays(const std::vector<BoxArrays>& arrays, const Ranks& ranks)
{
  std::vector<Bytes> parts(static_cast<std::size_t>(ranks.Count()));
  for (const BoxArrays& array : arrays)
  {
    array.Boxes->Append(array.From, array.All, parts);
  }
  std::vector<Bytes> received = ranks.Exchange(std::move(parts));
  for (std::size_t rank = received.size(); rank-- > 0;)
  {
    const char* bytes = received[rank].data();
    for (const BoxArrays& array : arrays)
    {
      if (array.Boxes->IsOwn(rank))
      {
        array.Boxes->CopyOwn(array.From, array.All, array.To);
      }
      else
      {
        bytes = array.Boxes->Take(bytes, rank, array.To, array.Boxes->OwnWanted());
      }
    }
    received[rank] = Bytes();
  }
}

void exchangeBoxes(const std::vector<TupleBox>& held, const TupleBox& wanted, const Ranks& ranks,
  const TupleMemory& from, const TupleMemory& to)
{
  const BoxExchange boxes(held, wanted, ranks);
  exchangeArrays({ { &boxes, from, held[static_cast<std::size_t>(ranks.Own())], to } }, ranks);
}

void completeBoxes(const std::vector<TupleBox>& held, const TupleBox& wanted, const TupleBox& all,
  const Ranks& ranks, const TupleMemory& array)
{
  const BoxExchange boxes(held, wanted, ranks);
  std::vector<Bytes> parts(held.size());
  boxes.Append(array, all, parts);
  const std::vector<Bytes> received = ranks.Exchange(std::move(parts));
  for (std::size_t rank = 0; rank < received.size(); ++rank)
  {
    if (!boxes.IsOwn(rank))
    {
      boxes.Take(received[rank].data(), rank, array, all);
    }
  }
}

} // namespace RectifiedTransport
