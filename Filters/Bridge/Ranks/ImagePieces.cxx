// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/ImagePieces.h"

#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Ranks/SameOnRanks.h"
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
#include <cstddef>
#include <iterator>
#include <sstream>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// The tuples that are no duplicates, in a box.
TupleBox ownTuples(vtkImageData* image, int owner, const TupleBox& all, unsigned char mask)
{
  vtkUnsignedCharArray* ghosts = image->GetAttributes(owner)->GetGhostArray();
  if (!ghosts || ghosts->GetNumberOfTuples() < all.Count())
  {
    return all;
  }
  TupleBox own{};
  const auto isOwn = [mask](unsigned char flags) { return (flags & mask) == 0; };
  for (std::int64_t first = 0; first < all.Count(); first += all.Cells[0])
  {
    const unsigned char* row = ghosts->GetPointer(static_cast<vtkIdType>(first));
    const unsigned char* end = row + all.Cells[0];
    const unsigned char* low = std::find_if(row, end, isOwn);
    const unsigned char* high = end;
    while (high != low && !isOwn(high[-1]))
    {
      --high;
    }
    if (low != end)
    {
      own = own.With({ all.CellOf(first + (low - row)), { high - low, 1, 1 } });
    }
  }
  return own;
}

std::string describe(const double* numbers, std::size_t count)
{
  std::ostringstream os;
  os.precision(17);
  for (std::size_t i = 0; i < count; ++i)
  {
    os << (i == 0 ? "" : " ") << numbers[i];
  }
  return os.str();
}

} // namespace

struct ImagePieces::Piece
{
  Extent Points{ 0, -1, 0, -1, 0, -1 };
  Extent Cells{ 0, -1, 0, -1, 0, -1 };
  std::array<double, 15> Geometry{};
};

ImagePieces::ImagePieces(vtkImageData* own, const Ranks& ranks)
  : Processes(ranks)
  , Own(own ? vtkSmartPointer<vtkImageData>(own) : vtkSmartPointer<vtkImageData>::New())
  , TooShort(own)
{
  Piece piece;
  if (own && own->GetNumberOfPoints() > 0)
  {
    Extent extent;
    std::copy_n(own->GetExtent(), 6, extent.begin());
    const TupleBox points = ownTuples(own, vtkDataObject::POINT,
      tuplesOf(extent, vtkDataObject::POINT, extent), vtkDataSetAttributes::DUPLICATEPOINT);
    const TupleBox cells = ownTuples(own, vtkDataObject::CELL,
      tuplesOf(extent, vtkDataObject::CELL, extent), vtkDataSetAttributes::DUPLICATECELL);
    piece.Points = extentOf(points, vtkDataObject::POINT, extent);
    piece.Cells = extentOf(cells, vtkDataObject::CELL, extent);
    if (!own->GetPointGhostArray() && !isEmpty(piece.Cells))
    {
      piece.Points = piece.Cells; // where only cells are marked
    }
    std::copy_n(own->GetOrigin(), 3, piece.Geometry.begin());
    std::copy_n(own->GetSpacing(), 3, piece.Geometry.begin() + 3);
    std::copy_n(own->GetDirectionMatrix()->GetData(), 9, piece.Geometry.begin() + 6);
  }
  this->TakePieces(gatherValues(ranks, piece));
  this->TooShort.AddFromRanks(ranks);
  this->Arrays = commonArrays(this->TooShort.RemovedFrom(own), ranks);
}

void ImagePieces::TakePieces(const std::vector<Piece>& pieces)
{
  int first = -1; // rank with points
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    const Piece& piece = pieces[rank];
    this->PointExtents.push_back(piece.Points);
    this->CellExtents.push_back(piece.Cells);
    if (isEmpty(piece.Points))
    {
      continue;
    }
    if (first < 0)
    {
      first = static_cast<int>(rank);
      this->WholeExtent = piece.Points;
      this->Geometry = piece.Geometry;
    }
    constexpr std::array<const char*, 3> names = { "origin", "spacing", "direction matrix" };
    constexpr std::array<std::size_t, 4> starts = { 0, 3, 6, 15 };
    for (std::size_t part = 0; part < names.size(); ++part)
    {
      const std::size_t start = starts[part];
      const std::size_t count = starts[part + 1] - start;
      const double* here = piece.Geometry.data() + start;
      const double* there = this->Geometry.data() + start;
      if (!std::equal(here, here + count, there))
      {
        throw Failure("The images of the ranks are not parts of one: the " +
          std::string(names[part]) + " is " + describe(there, count) + " on rank " +
          std::to_string(first) + ", but " + describe(here, count) + " on rank " +
          std::to_string(rank));
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->WholeExtent[2 * axis] = std::min(this->WholeExtent[2 * axis], piece.Points[2 * axis]);
      this->WholeExtent[2 * axis + 1] =
        std::max(this->WholeExtent[2 * axis + 1], piece.Points[2 * axis + 1]);
    }
  }
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    const auto& extents = owner == vtkDataObject::POINT ? this->PointExtents : this->CellExtents;
    std::vector<TupleBox> missing = { tuplesOf(this->WholeExtent, owner, this->WholeExtent) };
    for (const Extent& extent : extents)
    {
      if (!isEmpty(extent))
      {
        subtract(tuplesOf(extent, owner, this->WholeExtent), missing);
      }
    }
    if (first >= 0 && !missing.empty() && !missing.front().IsEmpty())
    {
      throw Failure("The images of the ranks do not fill their common extent: none has the " +
        std::string(owner == vtkDataObject::POINT ? "points " : "cells ") +
        describe(missing.front()));
    }
  }
}

vtkImageData* ImagePieces::OwnImage() const
{
  return this->Own;
}

vtkSmartPointer<vtkImageData> ImagePieces::MakeFrame() const
{
  return this->MakeImage(this->WholeExtent);
}

vtkSmartPointer<vtkImageData> ImagePieces::MakeImage(Extent extent) const
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetOrigin(this->Geometry[0], this->Geometry[1], this->Geometry[2]);
  image->SetSpacing(this->Geometry[3], this->Geometry[4], this->Geometry[5]);
  image->SetDirectionMatrix(this->Geometry.data() + 6);
  image->SetExtent(extent.data());
  return image;
}

vtkSmartPointer<vtkImageData> ImagePieces::Gather(
  const Extent& wanted, const std::vector<std::string>& names) const
{
  std::vector<ArrayKind> kinds;
  std::copy_if(this->Arrays.begin(), this->Arrays.end(), std::back_inserter(kinds),
    [&](const ArrayKind& kind) {
      return names.empty() || kind.IsGhosts() ||
        std::find(names.begin(), names.end(), kind.Name) != names.end();
    });
  const auto exchangeOf = [&](int owner) {
    std::vector<TupleBox> held;
    for (const Extent& extent :
      owner == vtkDataObject::POINT ? this->PointExtents : this->CellExtents)
    {
      held.push_back(tuplesOf(extent, owner, this->WholeExtent));
    }
    return BoxExchange(
      std::move(held), tuplesOf(wanted, owner, this->WholeExtent), this->Processes);
  };
  const BoxExchange points = exchangeOf(vtkDataObject::POINT);
  const BoxExchange cells = exchangeOf(vtkDataObject::CELL);
  Extent own{ 0, -1, 0, -1, 0, -1 };
  if (this->Own && this->Own->GetNumberOfPoints() > 0)
  {
    std::copy_n(this->Own->GetExtent(), 6, own.begin());
  }
  const vtkSmartPointer<vtkImageData> image = this->MakeImage(wanted);
  std::vector<BoxArrays> arrays;
  for (const ArrayKind& kind : kinds)
  {
    const vtkIdType tuples = tuplesOf(wanted, kind.Owner, this->WholeExtent).Count();
    arrays.push_back({ kind.Owner == vtkDataObject::POINT ? &points : &cells, kind.Find(this->Own),
      tuplesOf(own, kind.Owner, this->WholeExtent), kind.Make(image, tuples) });
  }
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

void distributeImage(vtkImageData* image, vtkInformation* output, const Ranks& ranks)
{
  const ImagePieces pieces(image, ranks);
  vtkNew<vtkFieldData> fields;
  fields->ShallowCopy(image->GetFieldData());
  if (isEmpty(pieces.Whole()))
  {
    return;
  }
  const ImageGrid grid = gridOf(pieces.MakeFrame(), false);
  const Extent wanted = extentToGive(grid.Extent(), output, ranks);
  const vtkSmartPointer<vtkImageData> part = pieces.Gather(wanted);
  image->ShallowCopy(part);
  image->GetFieldData()->ShallowCopy(fields);
  announceGrid(grid, output);
}

} // namespace RectifiedTransport::Bridge
