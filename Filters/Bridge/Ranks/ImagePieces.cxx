// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/ImagePieces.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Ranks/RankConsistency.h"
#include "Core/Geometry/Distributed/BoxExchange.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// The extent of the tuples that are no duplicates.
Extent ownExtent(vtkImageData* image, int owner, const Extent& all)
{
  const TupleBox box = tuplesOf(all, owner, all);
  vtkUnsignedCharArray* ghosts = image->GetAttributes(owner)->GetGhostArray();
  // A ghost array with too few tuples says nothing about the rest, and is not read past its end.
  const bool hasFlags = ghosts && ghosts->GetNumberOfTuples() >= box.Count();
  const unsigned char duplicate = owner == vtkDataObject::POINT
    ? +vtkDataSetAttributes::DUPLICATEPOINT
    : +vtkDataSetAttributes::DUPLICATECELL;
  return extentOf(hasFlags ? boxWithout(box, ghosts->GetPointer(0), duplicate) : box, owner, all);
}

} // namespace

ImagePieces::ImagePieces(vtkImageData* own, const Ranks& ranks)
  : Processes(ranks)
  , Own(own ? vtkSmartPointer<vtkImageData>(own) : vtkSmartPointer<vtkImageData>::New())
  , TooShort(own)
{
  // A rank without points gives the empty piece, whose geometry does not count.
  ImagePiece piece;
  if (own && own->GetNumberOfPoints() > 0)
  {
    Extent extent;
    own->GetExtent(extent.data());
    piece.Points = ownExtent(own, vtkDataObject::POINT, extent);
    piece.Cells = ownExtent(own, vtkDataObject::CELL, extent);
    // Some readers mark only cells: points outside the own cells then belong to other ranks.
    if (!own->GetPointGhostArray() && !isEmpty(piece.Cells))
    {
      piece.Points = piece.Cells; // where only cells are marked
    }
    // Origin (3), spacing (3) and direction (9 numbers, row-major) have to agree on all ranks.
    std::copy_n(own->GetOrigin(), 3, piece.Geometry.begin());
    std::copy_n(own->GetSpacing(), 3, piece.Geometry.begin() + 3);
    std::copy_n(own->GetDirectionMatrix()->GetData(), 9, piece.Geometry.begin() + 6);
  }
  // Every rank learns the extents of all, so that senders and receivers agree on each message
  // without asking.
  this->Joined = joinPieces(gatherValues(ranks, piece));
  if (!this->Joined.Fault.empty())
  {
    throw Failure(this->Joined.Fault);
  }
  // The names of arrays are compared after those that are too short on some rank have been left
  // out.
  this->TooShort.AddFromRanks(ranks);
  this->Arrays = commonArrays(this->TooShort.RemovedFrom(own), ranks);
}

vtkImageData* ImagePieces::OwnImage() const
{
  return this->Own;
}

vtkSmartPointer<vtkImageData> ImagePieces::MakeFrame() const
{
  return this->MakeImage(this->Joined.Whole);
}

vtkSmartPointer<vtkImageData> ImagePieces::MakeImage(Extent extent) const
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetOrigin(this->Joined.Geometry[0], this->Joined.Geometry[1], this->Joined.Geometry[2]);
  image->SetSpacing(this->Joined.Geometry[3], this->Joined.Geometry[4], this->Joined.Geometry[5]);
  image->SetDirectionMatrix(this->Joined.Geometry.data() + 6);
  image->SetExtent(extent.data());
  return image;
}

vtkSmartPointer<vtkImageData> ImagePieces::Gather(
  const Extent& wanted, const std::vector<std::string>& names) const
{
  ArrayKinds kinds;
  // Ghost arrays always come along: they say which points and cells have values at all.
  std::copy_if(this->Arrays.begin(), this->Arrays.end(), std::back_inserter(kinds),
    [&](const ArrayKind& kind) {
      return names.empty() || isGhosts(kind) ||
        std::find(names.begin(), names.end(), kind.Name) != names.end();
    });
  // Points and cells have boxes of their own: where cells meet at a face, both pieces have its
  // points.
  const auto exchangeOf = [&](int owner) {
    std::vector<TupleBox> held;
    for (const Extent& extent : owner == vtkDataObject::POINT ? this->Points() : this->Cells())
    {
      held.push_back(tuplesOf(extent, owner, this->Joined.Whole));
    }
    return BoxExchange(
      std::move(held), tuplesOf(wanted, owner, this->Joined.Whole), this->Processes);
  };
  const BoxExchange points = exchangeOf(vtkDataObject::POINT);
  const BoxExchange cells = exchangeOf(vtkDataObject::CELL);
  // The tuples of the own image lie in its own extent, duplicates of other ranks among them.
  Extent own = emptyExtent;
  if (this->Own && this->Own->GetNumberOfPoints() > 0)
  {
    this->Own->GetExtent(own.data());
  }
  const vtkSmartPointer<vtkImageData> image = this->MakeImage(wanted);
  std::vector<BoxArrays> arrays;
  std::vector<vtkSmartPointer<vtkDataArray>> kept; // also where one replaces another of its name
  // `kept` holds the arrays that BoxArrays only points to: those given, which may be contiguous
  // copies, and those made. A rank without the array gives nothing of it.
  for (const ArrayKind& kind : kinds)
  {
    const TupleBox made = tuplesOf(wanted, kind.Owner, this->Joined.Whole);
    kept.push_back(findArray(kind, this->Own));
    const TupleMemory given = tuplesIn(kept.back());
    kept.push_back(addArray(kind, image, static_cast<vtkIdType>(made.Count())));
    arrays.push_back({ kind.Owner == vtkDataObject::POINT ? &points : &cells, given,
      tuplesOf(own, kind.Owner, this->Joined.Whole), tuplesIn(kept.back()), made });
  }
  // A few named arrays are sent in one round of messages.
  if (!names.empty())
  {
    exchangeArrays(arrays, this->Processes);
    return image;
  }
  // One by one, as each is in memory twice meanwhile.
  for (const BoxArrays& array : arrays)
  {
    exchangeArrays({ array }, this->Processes);
  }
  this->TooShort.AddEmptyTo(image);
  return image;
}

PlaceOwners ownersOf(const ImageGrid& grid, const ImagePieces* pieces, const Ranks& ranks)
{
  // Points own the dual cells around them, cells themselves.
  const auto held = [&]() { return grid.IsOnPoints() ? pieces->Points() : pieces->Cells(); };
  return { grid, pieces ? held() : std::vector<Extent>(),
    dividedExtent(grid.Extent(), ranks.Count()), ranks };
}

void distributeImage(vtkImageData* image, vtkInformation* output, const Ranks& ranks)
{
  const ImagePieces pieces(image, ranks);
  // ShallowCopy below replaces field data by those of the gathered part, which has none.
  vtkNew<vtkFieldData> fields;
  fields->ShallowCopy(image->GetFieldData());
  if (isEmpty(pieces.Whole()))
  {
    return;
  }
  // The grid of the whole image tells consumers what to request next.
  const ImageGrid grid = gridOf(pieces.MakeFrame(), false);
  const Extent wanted = extentToGive(grid.Extent(), output, ranks);
  const vtkSmartPointer<vtkImageData> part = pieces.Gather(wanted);
  image->ShallowCopy(part);
  image->GetFieldData()->ShallowCopy(fields);
  announceGrid(grid, output);
}

} // namespace RectifiedTransport::Bridge
