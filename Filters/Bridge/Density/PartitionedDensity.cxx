// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/PartitionedDensity.h"

#include "Bridge/Data/ArraySampling.h"
#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Density/ArrayReader.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Run/Fingerprint.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Tables/Reading/PaddedValues.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
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

} // namespace

PartitionedDensity::PartitionedDensity(std::unique_ptr<const ImagePieces> pieces,
  const std::string& name, bool onPoints, const DensityRules& rules)
  : InputDensity("density array '" + name + "'", rules)
  , Distribution(std::move(pieces))
  , ArrayName(name)
{
  this->Geometry = gridOf(this->Distribution->MakeFrame(), onPoints);
  requireCells(this->Geometry);
  ArrayForm form{};
  bool isFound = false;
  for (const ArrayKind& kind : this->Distribution->Kinds())
  {
    if (kind.Owner == this->Owner() && kind.Name == name)
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
  this->SetForm(form, { ++count });
  this->FillValues = fillValuesOf(this->Distribution->OwnImage()->GetFieldData());
}

PartitionedDensity::~PartitionedDensity() = default;

std::uint64_t PartitionedDensity::Fingerprint(Progress& progress) const
{
  vtkImageData* own = this->Distribution->OwnImage();
  const std::uint64_t bits = fingerprint(
    { this->ArrayIn(own), own->GetPointGhostArray(), own->GetCellGhostArray() }, progress);
  return joinFingerprints(
    this->Distribution->Group(), this->Extents(), own->GetNumberOfPoints() == 0 ? 1 : bits);
}

void PartitionedDensity::Prepare(FlowTables tables, Progress& progress)
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
  this->Known = this->Gathered->Suspect();
  this->Empty = this->Gathered->EmptyDensity();
}

const DensityValues* PartitionedDensity::Values() const
{
  return this->Gathered ? this->Gathered->Values() : nullptr;
}

const std::vector<Extent>& PartitionedDensity::Extents() const
{
  return this->Geometry.IsOnPoints() ? this->Distribution->Points() : this->Distribution->Cells();
}

const Extent& PartitionedDensity::OwnExtent() const
{
  return this->Extents()[static_cast<std::size_t>(this->Distribution->Group().Own())];
}

vtkDataArray* PartitionedDensity::ArrayIn(vtkImageData* image) const
{
  return image->GetAttributes(this->Owner())->GetArray(this->ArrayName.c_str());
}

void PartitionedDensity::PreparePieces(Progress& progress)
{
  this->Known = {};
  if (!this->NeedsWhite() && !this->Clamps() && !this->FillsEmpty())
  {
    return;
  }
  const Ranks& ranks = this->Distribution->Group();
  const auto piece = this->Gather(this->OwnExtent());
  // What all ranks found is joined by the numbers that tuples have in the whole image.
  const Extent& whole = this->Geometry.Extent();
  const auto join = [&](auto own, auto& all) {
    if (own.First >= 0)
    {
      const TupleBox part = tuplesOf(piece->Grid().Extent(), this->Owner(), whole);
      own.First = tuplesOf(whole, this->Owner(), whole).NumberOf(part.CellOf(own.First));
    }
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
    const auto own = piece ? piece->Occupied(this->OwnTuples(), progress) : OccupiedCells();
    this->Empty = densityOfEmptyCells(this->Rules.Empty, sumOverRanks(ranks, own));
  }
}

// Those that no rank below has, as points at common faces are in several pieces.
std::vector<TupleBox> PartitionedDensity::OwnTuples() const
{
  const Extent& whole = this->Distribution->Whole();
  std::vector<TupleBox> own = { tuplesOf(this->OwnExtent(), this->Owner(), whole) };
  for (int rank = 0; rank < this->Distribution->Group().Own(); ++rank)
  {
    const Extent& below = this->Extents()[static_cast<std::size_t>(rank)];
    if (!isEmpty(below))
    {
      subtract(tuplesOf(below, this->Owner(), whole), own);
    }
  }
  return own;
}

// The part in an extent; nullptr for an empty one. Each rank may want another one.
std::unique_ptr<DensityImage> PartitionedDensity::Gather(const Extent& extent) const
{
  const vtkSmartPointer<vtkImageData> image =
    this->Distribution->Gather(extent, { this->ArrayName });
  return image->GetNumberOfPoints() == 0
    ? nullptr
    : std::make_unique<DensityImage>(
        image, this->ArrayIn(image), this->Geometry.IsOnPoints(), this->Rules);
}

std::shared_ptr<const DensityValues> PartitionedDensity::Part(
  const GridSize<3>& low, const GridSize<3>& high) const
{
  if (this->Gathered)
  {
    return this->Gathered->Part(low, high);
  }
  const ImageGrid& grid = this->Geometry;
  LatticePart<3> part{ low, {} };
  std::transform(high.begin(), high.end(), low.begin(), part.Cells.begin(), std::minus<>());
  Extent extent = grid.Extent();
  std::size_t axis = 0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (grid.IsAxis(a))
    {
      const int start = extent[2 * a];
      extent[2 * a] = start + static_cast<int>(low[axis]);
      extent[2 * a + 1] = start + static_cast<int>(high[axis]) - (grid.IsOnPoints() ? 1 : 0);
      ++axis;
    }
  }
  if (part.IsEmpty())
  {
    extent = { 0, -1, 0, -1, 0, -1 };
  }
  const std::shared_ptr<DensityImage> box = this->Gather(extent);
  if (!box)
  {
    return std::make_shared<DensityArray<3, double>>(nullptr, GridSize<3>{});
  }
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  box->SetWhite(this->White(), progress);
  box->SetEmpty(this->Empty);
  return std::make_shared<PaddedValues>(
    std::shared_ptr<const DensityValues>(box, box->Values()), part, this->CellsInSpace(), 0.0);
}

vtkSmartPointer<vtkImageData> PartitionedDensity::ImageIn(const Extent& extent) const
{
  return this->Distribution->Gather(extent);
}

void PartitionedDensity::SampleArrays(
  const Extent& extent, ConstPointSpan<3> particles, Progress& progress, vtkPointData* output) const
{
  sampleImage(this->ImageIn(extent), this->Geometry, extent, particles, progress, output);
}

} // namespace RectifiedTransport::Bridge
