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
  // All ranks hash the same list, so that they agree on whether the density has changed.
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
  // The grid is that of the whole image, on every rank, although none may ever have all of its
  // values.
  this->Geometry = gridOf(this->Distribution->MakeFrame(), onPoints);
  requireCells(this->Geometry);
  // Kinds are what all ranks agree on. Ranks without points have no arrays but need the same form,
  // since the collective calls below depend on it.
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
  // A number that no other density has makes times differ always, so that hashes decide on all
  // ranks.
  static std::atomic<std::uint64_t> count{ 0 };
  this->SetForm(form, { ++count });
  this->FillValues = fillValuesOf(this->Distribution->OwnImage()->GetFieldData());
}

PartitionedDensity::~PartitionedDensity() = default;

std::uint64_t PartitionedDensity::Fingerprint(Progress& progress) const
{
  // Each rank hashes the values that it has; 1 stands for no values, since 0 means that there is no
  // hash.
  vtkImageData* own = this->Distribution->OwnImage();
  const std::uint64_t bits = fingerprint(
    { this->ArrayIn(own), own->GetPointGhostArray(), own->GetCellGhostArray() }, progress);
  return joinFingerprints(
    this->Distribution->Group(), this->Extents(), own->GetNumberOfPoints() == 0 ? 1 : bits);
}

void PartitionedDensity::Prepare(FlowTables tables, Progress& progress)
{
  // With tiles each rank only ever needs the boxes of the tiles at hand (see Part). Others need all
  // values, which every rank gathers.
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

// The part of each rank, by points: those of values on points, or the corners of values on cells.
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
  // White, the clamped values and the density of empty cells depend on all values. Each rank finds
  // them in its piece; ranks without a piece take part in the exchange with neutral ones. All ranks
  // return here together, as the rules and the form are the same on all.
  this->Known = {};
  if (!this->NeedsWhite() && !this->Clamps() && !this->FillsEmpty())
  {
    return;
  }
  const Ranks& ranks = this->Distribution->Group();
  // The piece without the layers of duplicates around it.
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
  // White comes first, since with an inverted density it decides which values are negative.
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
  // Values of the cells [low, high) of the grid: `low` and `high` count the grid's own axes, while
  // an extent has all three and counts points. Between n + 1 points there are n cells, and around n
  // points n dual cells.
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
  // A rank that needs nothing still takes part in the exchange, with an empty extent.
  if (part.IsEmpty())
  {
    extent = { 0, -1, 0, -1, 0, -1 };
  }
  const std::shared_ptr<DensityImage> box = this->Gather(extent);
  if (!box)
  {
    return std::make_shared<DensityArray<3, double>>(nullptr, GridSize<3>{});
  }
  // Part has no progress of its own; the flags of a box take little time on one thread.
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  box->SetWhite(this->White(), progress);
  box->SetEmpty(this->Empty);
  // Cells keep their numbers in the whole grid. Those outside of the box are not read.
  return std::make_shared<PaddedValues>(
    std::shared_ptr<const DensityValues>(box, box->Values()), part, this->CellsInSpace(), 0.0);
}

// With all arrays that the ranks have in common, for outputs that pass them on.
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
