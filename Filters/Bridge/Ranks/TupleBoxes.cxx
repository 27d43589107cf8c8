// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/TupleBoxes.h"

#include "Core/Parallel/RankExchange.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkExtentTranslator.h"
#include "vtkNew.h"

#include <sstream>
#include <utility>

namespace RectifiedTransport::Bridge
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

Extent intersectionOf(const Extent& a, const Extent& b)
{
  Extent both = a;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    both[2 * axis] = std::max(a[2 * axis], b[2 * axis]);
    both[2 * axis + 1] = std::min(a[2 * axis + 1], b[2 * axis + 1]);
  }
  // Of one whose ends are reversed otherwise VTK counts points and cells that there are not.
  return isEmpty(both) ? Extent{ 0, -1, 0, -1, 0, -1 } : both;
}

std::vector<Extent> dividedExtent(const Extent& whole, int ranks)
{
  std::vector<Extent> extents(static_cast<std::size_t>(ranks));
  vtkNew<vtkExtentTranslator> translator;
  for (int rank = 0; rank < ranks; ++rank)
  {
    Extent given = whole;
    translator->PieceToExtentThreadSafe(rank, ranks, 0, given.data(),
      extents[static_cast<std::size_t>(rank)].data(), vtkExtentTranslator::BLOCK_MODE, 0);
  }
  return extents;
}

TupleBox tuplesOf(const Extent& extent, int owner, const Extent& whole)
{
  TupleBox box{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool hasCells = owner == vtkDataObject::CELL && whole[2 * axis] < whole[2 * axis + 1];
    box.Low[axis] = extent[2 * axis];
    box.Cells[axis] = std::max(0, extent[2 * axis + 1] - extent[2 * axis] + (hasCells ? 0 : 1));
  }
  return box;
}

Extent extentOf(const TupleBox& box, int owner, const Extent& whole)
{
  Extent extent{ 0, -1, 0, -1, 0, -1 };
  for (std::size_t axis = 0; axis < 3 && !box.IsEmpty(); ++axis)
  {
    const bool hasCells = owner == vtkDataObject::CELL && whole[2 * axis] < whole[2 * axis + 1];
    extent[2 * axis] = static_cast<int>(box.Low[axis]);
    extent[2 * axis + 1] = static_cast<int>(box.End(static_cast<int>(axis))) - (hasCells ? 0 : 1);
  }
  return extent;
}

void subtract(const TupleBox& box, std::vector<TupleBox>& from)
{
  std::vector<TupleBox> left;
  for (TupleBox rest : from)
  {
    if (rest.And(box).IsEmpty())
    {
      left.push_back(rest);
      continue;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      const TupleBox common = rest.And(box);
      TupleBox below = rest;
      below.Cells[axis] = common.Low[axis] - rest.Low[axis];
      TupleBox above = rest;
      above.Low[axis] = common.End(axis);
      above.Cells[axis] = rest.End(axis) - common.End(axis);
      for (const TupleBox& side : { below, above })
      {
        if (!side.IsEmpty())
        {
          left.push_back(side);
        }
      }
      rest.Low[axis] = common.Low[axis];
      rest.Cells[axis] = common.Cells[axis];
    }
  }
  from = std::move(left);
}

std::string describe(const TupleBox& box)
{
  std::ostringstream os;
  for (int axis = 0; axis < 3; ++axis)
  {
    os << (axis == 0 ? "" : " x ") << "[" << box.Low[axis] << ", " << box.End(axis) - 1 << "]";
  }
  return os.str();
}

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

void BoxExchange::Append(vtkDataArray* from, const TupleBox& all, std::vector<Bytes>& parts) const
{
  for (std::size_t rank = 0; rank < this->Wanted.size(); ++rank)
  {
    if (rank != this->Own)
    {
      appendTuples(from, runsOf(this->PartOf(this->Own, this->Wanted[rank]), all), parts[rank]);
    }
  }
}

void BoxExchange::CopyOwn(vtkDataArray* from, const TupleBox& all, vtkDataArray* to) const
{
  const TupleBox& wanted = this->OwnWanted();
  const TupleBox part = this->PartOf(this->Own, wanted);
  copyTuples(from, runsOf(part, all), runsOf(part, wanted), to);
}

const char* BoxExchange::Take(
  const char* from, std::size_t rank, vtkDataArray* to, const TupleBox& all) const
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
  vtkDataArray* from, vtkDataArray* to)
{
  const BoxExchange boxes(held, wanted, ranks);
  exchangeArrays({ { &boxes, from, held[static_cast<std::size_t>(ranks.Own())], to } }, ranks);
}

void completeBoxes(const std::vector<TupleBox>& held, const TupleBox& wanted, const TupleBox& all,
  const Ranks& ranks, vtkDataArray* array)
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

} // namespace RectifiedTransport::Bridge
