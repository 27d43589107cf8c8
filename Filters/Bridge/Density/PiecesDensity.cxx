// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/PiecesDensity.h"

#include "Bridge/Density/DensityFailure.h"
#include "Bridge/Image/DefaultArray.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Fingerprint.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkUnsignedCharArray.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// One hash of those of all ranks, and of which part each has; 0 where one has no hash.
std::uint64_t joinFingerprints(
  const Ranks& ranks, const std::vector<Extent>& parts, std::uint64_t own)
{
  std::uint64_t joined = 0xcbf29ce484222325; // as FNV-1a, by words
  const auto add = [&joined](std::uint64_t bits) { joined = (joined ^ bits) * 0x100000001b3; };
  for (const std::uint64_t bits : gatherValues(ranks, own))
  {
    if (bits == 0)
    {
      return 0;
    }
    add(bits);
  }
  for (const Extent& part : parts)
  {
    for (const int bound : part)
    {
      add(static_cast<std::uint64_t>(bound));
    }
  }
  return joined;
}

// The number in a whole image of a value of a part of it.
std::int64_t indexIn(const ImageGrid& whole, const ImageGrid& part, std::int64_t index)
{
  const int owner = part.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
  return tuplesOf(whole.Extent(), owner, whole.Extent())
    .NumberOf(tuplesOf(part.Extent(), owner, whole.Extent()).CellOf(index));
}

// The values of a box, by the numbers of the whole grid.
template <int D>
class BoxOfDensity final : public DensityValues
{
public:
  BoxOfDensity(
    std::unique_ptr<DensityImage> box, const GridSize<D>& whole, const LatticePart<D>& part)
    : Box(std::move(box))
    , Whole{ {}, whole }
    , Part(part)
  {
  }

  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    this->Box->Values()->Read(this->Part.NumberOf(this->Whole.CellOf(first)), count, values);
  }

private:
  const std::unique_ptr<DensityImage> Box;
  const LatticePart<D> Whole;
  const LatticePart<D> Part;
};

} // namespace

PiecesDensity::PiecesDensity(std::unique_ptr<const ImagePieces> pieces, const std::string& name,
  bool onPoints, const DensityRules& rules)
  : InputDensity("density array '" + name + "'", rules)
  , Distribution(std::move(pieces))
  , ArrayName(name)
{
  this->Geometry = gridOf(this->Distribution->MakeFrame(), onPoints);
  requireCells(this->Geometry);
  const int owner = onPoints ? vtkDataObject::POINT : vtkDataObject::CELL;
  ArrayForm form{};
  bool isFound = false;
  for (const ArrayKind& kind : this->Distribution->Kinds())
  {
    if (kind.Owner == owner && kind.Name == name)
    {
      form.Type = kind.Type;
      form.Components = kind.Components;
      isFound = true;
    }
    else if (isGhosts(kind))
    {
      (kind.Owner == vtkDataObject::POINT ? form.HasPointGhosts : form.HasCellGhosts) = true;
    }
  }
  if (!isFound)
  {
    throw Failure("The " + this->GetName() +
      " has not the same type and number of components on all ranks; it must have");
  }
  // Times differ among the ranks: only contents are compared.
  static std::atomic<std::uint64_t> count{ 0 };
  this->Changed = { ++count, 0, 0, 0 };
  this->SetForm(form);
  this->FillValues = fillValuesOf(this->Distribution->OwnImage()->GetFieldData());
}

PiecesDensity::~PiecesDensity() = default;

std::uint64_t PiecesDensity::Fingerprint(Progress& progress) const
{
  vtkImageData* own = this->Distribution->OwnImage();
  const bool onPoints = this->Geometry.IsOnPoints();
  vtkDataArray* array = attributesOf(own, onPoints)->GetArray(this->ArrayName.c_str());
  const std::uint64_t bits =
    fingerprint({ array, own->GetPointGhostArray(), own->GetCellGhostArray() }, progress);
  return joinFingerprints(this->Distribution->Group(),
    onPoints ? this->Distribution->Points() : this->Distribution->Cells(),
    own->GetNumberOfPoints() == 0 ? 1 : bits);
}

void PiecesDensity::Prepare(FlowTables tables, Progress& progress)
{
  if (tables == FlowTables::Tiled)
  {
    this->PreparePieces(progress);
    return;
  }
  this->Gathered = this->Gather(this->Distribution->Whole());
  if (this->FillsEmpty())
  {
    this->Gathered->FindEmptyDensity();
  }
  this->Gathered->Prepare(tables, progress);
  this->Known = this->Gathered->Unusual();
  this->Empty = this->Gathered->EmptyDensity();
}

const DensityValues* PiecesDensity::Values() const
{
  return this->Gathered ? this->Gathered->Values() : nullptr;
}

const Extent& PiecesDensity::OwnExtent() const
{
  const auto own = static_cast<std::size_t>(this->Distribution->Group().Own());
  return this->Geometry.IsOnPoints() ? this->Distribution->Points()[own]
                                     : this->Distribution->Cells()[own];
}

void PiecesDensity::PreparePieces(Progress& progress)
{
  this->Known = {};
  if (!this->NeedsWhite() && !this->Clamps() && !this->FillsEmpty())
  {
    return;
  }
  const Ranks& ranks = this->Distribution->Group();
  const auto piece = this->Gather(this->OwnExtent());
  // Of all ranks, by the numbers of the whole image.
  const auto join = [&](auto own, auto& all) {
    own.First = own.First < 0 ? -1 : indexIn(this->Geometry, piece->Grid(), own.First);
    for (const auto& part : gatherValues(ranks, own))
    {
      merge(part, all);
    }
  };
  join(piece ? piece->FindWhite(progress) : LargestValue(), this->Known.White);
  if (piece)
  {
    piece->SetWhite(this->White(), progress);
  }
  join(piece ? piece->FindClamped(progress) : LowestValue(), this->Known.Clamped);
  if (this->FillsEmpty())
  {
    const FilledCells own = piece ? piece->FindFilled(this->OwnTuples(), progress) : FilledCells();
    this->Empty = densityOfEmptyCells(this->Rules.Empty, sumOverRanks(ranks, own));
  }
}

// Those that no rank below has, as points at common faces are in several pieces.
std::vector<TupleBox> PiecesDensity::OwnTuples() const
{
  const bool onPoints = this->Geometry.IsOnPoints();
  const int owner = onPoints ? vtkDataObject::POINT : vtkDataObject::CELL;
  const Extent& whole = this->Distribution->Whole();
  const auto& extents = onPoints ? this->Distribution->Points() : this->Distribution->Cells();
  std::vector<TupleBox> own = { tuplesOf(this->OwnExtent(), owner, whole) };
  for (int rank = 0; rank < this->Distribution->Group().Own(); ++rank)
  {
    const Extent& below = extents[static_cast<std::size_t>(rank)];
    if (!isEmpty(below))
    {
      subtract(tuplesOf(below, owner, whole), own);
    }
  }
  return own;
}

// The part in an extent; nullptr for an empty one. Each rank may want another one.
std::unique_ptr<DensityImage> PiecesDensity::Gather(const Extent& extent) const
{
  const vtkSmartPointer<vtkImageData> image =
    this->Distribution->Gather(extent, { this->ArrayName });
  if (image->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  const bool onPoints = this->Geometry.IsOnPoints();
  vtkDataArray* array = attributesOf(image, onPoints)->GetArray(this->ArrayName.c_str());
  return std::make_unique<DensityImage>(image, array, onPoints, this->Rules);
}

template <int D>
std::shared_ptr<const DensityValues> PiecesDensity::Boxes<D>::Gather(
  const GridSize<D>& low, const GridSize<D>& high) const
{
  const ImageGrid& grid = this->Density.Grid();
  LatticePart<D> part{ low, {} };
  Extent extent = grid.Extent();
  int axis = 0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (!grid.IsAxis(a))
    {
      continue;
    }
    const int start = extent[2 * a];
    extent[2 * a] = start + static_cast<int>(low[axis]);
    extent[2 * a + 1] = start + static_cast<int>(high[axis]) - (grid.IsOnPoints() ? 1 : 0);
    part.Cells[axis] = high[axis] - low[axis];
    ++axis;
  }
  if (part.IsEmpty())
  {
    extent = { 0, -1, 0, -1, 0, -1 };
  }
  std::unique_ptr<DensityImage> box = this->Density.Gather(extent);
  if (!box)
  {
    return std::make_shared<DensityArray<D, double>>(nullptr, GridSize<D>{});
  }
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  box->SetWhite(this->Density.White(), progress);
  box->SetEmpty(this->Density.Empty);
  return std::make_shared<BoxOfDensity<D>>(std::move(box), grid.Size<D>(), part);
}

vtkSmartPointer<vtkImageData> PiecesDensity::ImageIn(const Extent& extent) const
{
  return this->Distribution->Gather(extent);
}

void PiecesDensity::SampleArrays(
  const Extent& extent, ConstPointSpan<3> particles, Progress& progress, vtkPointData* output) const
{
  sampleImage(this->ImageIn(extent), this->Geometry, extent, particles, progress, output);
}

} // namespace RectifiedTransport::Bridge
