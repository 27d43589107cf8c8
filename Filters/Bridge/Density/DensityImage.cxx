// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityImage.h"

#include "Bridge/Density/DensityFailure.h"
#include "Bridge/Density/DensityReader.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Fingerprint.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Reduction.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 14;

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
  const std::array<int, 3> of = part.NumberOfValues();
  const std::array<int, 3> all = whole.NumberOfValues();
  std::int64_t number = 0;
  std::int64_t step = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int low = part.Extent()[2 * axis] - whole.Extent()[2 * axis];
    number += (index % of[axis] + low) * step;
    index /= of[axis];
    step *= all[axis];
  }
  return number;
}

} // namespace

DensityImage::DensityImage(
  vtkImageData* image, vtkDataArray* array, bool onPoints, const DensityRules& rules)
  : Input(image)
  , Array(array)
  , Rules(rules)
  , Name(describeArray(array))
{
  requireTuples(array, image, onPoints, "input image");
  requireComponent(this->Name, rules.Component, array->GetNumberOfComponents());
  this->Geometry = gridOf(image, onPoints);
  requireCells(this->Geometry);
  this->Reader = makeDensityReader(array, rules);
  this->FindBlanks(image);

  const auto time = [](vtkObject* object) {
    return object ? static_cast<std::uint64_t>(object->GetMTime()) : std::uint64_t{ 0 };
  };
  this->Sources = { this->Array, image->GetPointGhostArray(), image->GetCellGhostArray() };
  // The modification time of the vtkImageData itself: its GetMTime() includes all its arrays.
  this->Changed = { time(this->Sources[0]), time(this->Sources[1]), time(this->Sources[2]),
    static_cast<std::uint64_t>(image->vtkObject::GetMTime()) };
  this->FindReading();
}

// `Array` is an empty one of the kind until the image is gathered.
DensityImage::DensityImage(std::unique_ptr<const ImagePieces> pieces, const std::string& name,
  bool onPoints, const DensityRules& rules)
  : Distribution(std::move(pieces))
  , ArrayName(name)
  , Rules(rules)
  , Name("density array '" + name + "'")
{
  const vtkSmartPointer<vtkImageData> frame = this->Distribution->MakeFrame();
  this->Geometry = gridOf(frame, onPoints);
  requireCells(this->Geometry);
  const int owner = onPoints ? vtkDataObject::POINT : vtkDataObject::CELL;
  for (const ArrayKind& kind : this->Distribution->Kinds())
  {
    if (kind.Owner == owner && kind.Name == name)
    {
      this->Array = kind.Make(frame, 0);
    }
    else if (kind.IsGhosts())
    {
      this->Sources[kind.Owner == vtkDataObject::POINT ? 1 : 2] = kind.Make(frame, 0);
    }
  }
  if (!this->Array)
  {
    throw Failure("The " + this->Name +
      " has not the same type and number of components on all ranks; it must have");
  }
  requireComponent(this->Name, rules.Component, this->Array->GetNumberOfComponents());
  this->Sources[0] = this->Array;
  // Times differ among the ranks: only contents are compared.
  static std::atomic<std::uint64_t> count{ 0 };
  this->Changed = { ++count, 0, 0, 0 };
  this->FindReading();
}

void DensityImage::FindReading()
{
  const double measure = this->Geometry.CellMeasure();
  std::uint64_t measureBits = 0;
  std::memcpy(&measureBits, &measure, sizeof(measure));
  const GridSize<3> size = this->Geometry.Size<3>();
  const auto number = [](auto value) { return static_cast<std::uint64_t>(value); };
  const auto has = [this](std::size_t source) { return this->Sources[source] ? 1 : 0; };
  this->Reading = { 0, number(this->Array->GetDataType()),
    number(this->Array->GetNumberOfComponents()), number(this->Geometry.Dimension()),
    number(size[0]), number(size[1]), number(size[2]), number(this->Rules.Component + 2),
    number(this->Rules.Invert) + 2 * number(this->Rules.ClampNegative),
    number(this->Geometry.IsOnPoints()), number(has(1) + 2 * has(2)), measureBits };
}

DensityImage::~DensityImage() = default;

vtkImageData* DensityImage::Image() const
{
  return this->Input;
}

const DensityImage::Content& DensityImage::GetContent(Progress& progress)
{
  if (this->Hashed != Content{})
  {
    return this->Hashed;
  }
  std::vector<vtkDataArray*> arrays(this->Sources.begin(), this->Sources.end());
  if (this->Distribution)
  {
    vtkImageData* own = this->Distribution->OwnImage();
    const int owner = this->Geometry.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
    arrays = { own->GetAttributes(owner)->GetArray(this->ArrayName.c_str()),
      own->GetPointGhostArray(), own->GetCellGhostArray() };
  }
  std::uint64_t bits = fingerprint(arrays, progress);
  if (this->Distribution)
  {
    const bool hasNone = this->Distribution->OwnImage()->GetNumberOfPoints() == 0;
    bits = joinFingerprints(this->Distribution->Group(),
      this->Geometry.IsOnPoints() ? this->Distribution->Points() : this->Distribution->Cells(),
      hasNone ? 1 : bits);
  }
  this->Hashed = this->Reading;
  this->Hashed[0] = bits;
  return this->Hashed;
}

void DensityImage::FindBlanks(vtkImageData* image)
{
  constexpr const char* what = "input image";
  const unsigned char* points = ghostFlags(image, vtkDataObject::POINT, what);
  if (this->Geometry.IsOnPoints())
  {
    this->Reader->SetBlanks(points, ghostPoint);
    return;
  }
  this->CellFlags = ghostFlags(image, vtkDataObject::CELL, what);
  this->Reader->SetBlanks(this->CellFlags, ghostCell);
  this->HiddenPoints = points;
}

void DensityImage::Prepare(Progress& progress)
{
  if (this->Distribution)
  {
    this->Gathered = this->GatherPart(this->Distribution->Whole());
    this->Gathered->Prepare(progress);
    return;
  }
  // Values of blanked cells are none that white is found among.
  this->BlankCellsOfHiddenPoints(progress);
  this->Known = {};
  if (this->NeedsWhite())
  {
    this->Known.White = this->FindWhite(progress);
  }
  this->Reader->SetWhite(this->White());
  this->Known.Clamped = this->FindClamped(progress);
}

void DensityImage::ReleaseGathered()
{
  this->Gathered.reset();
}

void DensityImage::PrepareShared(Progress& progress)
{
  this->Known = {};
  const bool clamps = this->Rules.ClampNegative && !this->Rules.Invert;
  if (!this->NeedsWhite() && !clamps)
  {
    return;
  }
  const Ranks& ranks = this->Distribution->Group();
  const auto own = static_cast<std::size_t>(ranks.Own());
  const auto piece =
    this->GatherPart(this->Geometry.IsOnPoints() ? this->Distribution->Points()[own]
                                                 : this->Distribution->Cells()[own]);
  // By the numbers of the whole image.
  const auto number = [&](std::int64_t index) {
    return index < 0 ? index : indexIn(this->Geometry, piece->Geometry, index);
  };
  if (piece)
  {
    piece->BlankCellsOfHiddenPoints(progress);
  }
  if (this->NeedsWhite())
  {
    LargestValue largest = piece ? piece->FindWhite(progress) : LargestValue();
    largest.First = piece ? number(largest.First) : -1;
    for (const LargestValue& part : gatherValues(ranks, largest))
    {
      merge(part, this->Known.White);
    }
  }
  if (clamps)
  {
    if (piece)
    {
      piece->Reader->SetWhite(this->White());
    }
    LowestValue lowest = piece ? piece->FindClamped(progress) : LowestValue();
    lowest.First = piece ? number(lowest.First) : -1;
    for (const LowestValue& part : gatherValues(ranks, lowest))
    {
      merge(part, this->Known.Clamped);
    }
  }
}

double DensityImage::White() const
{
  return std::isfinite(this->Known.White.Value) ? this->Known.White.Value : 0.0;
}

// Inverted, no value is negative but for those above white.
LowestValue DensityImage::FindClamped(Progress& progress) const
{
  return this->Rules.ClampNegative && !this->Rules.Invert
    ? findLowest(this->Array, *this->Reader, this->Geometry.NumberOfCells(), progress)
    : LowestValue();
}

bool DensityImage::NeedsWhite() const
{
  return needsWhite(this->Rules, this->Array->GetNumberOfComponents());
}

std::unique_ptr<DensityImage> DensityImage::GatherBox(const std::array<int, 6>& extent) const
{
  std::unique_ptr<DensityImage> box = this->GatherPart(extent);
  if (box)
  {
    const SerialExecutor serial;
    Progress progress{ Context(serial) };
    box->BlankCellsOfHiddenPoints(progress);
    box->Reader->SetWhite(this->White());
  }
  return box;
}

// nullptr for an empty extent.
std::unique_ptr<DensityImage> DensityImage::GatherPart(const std::array<int, 6>& extent) const
{
  const vtkSmartPointer<vtkImageData> image =
    this->Distribution->Gather(extent, { this->ArrayName });
  if (image->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  const bool onPoints = this->Geometry.IsOnPoints();
  vtkDataSetAttributes* attributes =
    image->GetAttributes(onPoints ? vtkDataObject::POINT : vtkDataObject::CELL);
  return std::make_unique<DensityImage>(
    image, attributes->GetArray(this->ArrayName.c_str()), onPoints, this->Rules);
}

void DensityImage::BlankCellsOfHiddenPoints(Progress& progress)
{
  if (!this->HiddenPoints || !this->CombinedFlags.empty())
  {
    return;
  }
  const std::int64_t cells = this->Geometry.NumberOfCells();
  withMemory("the flags of the cells of the input image", static_cast<double>(cells),
    [&]() { this->CombinedFlags.resize(static_cast<std::size_t>(cells)); });
  const std::array<int, 3> points = this->Geometry.NumberOfPoints();
  const std::int64_t columns = std::max(1, points[0] - 1);
  const std::int64_t rowsAtOnce = std::max<std::int64_t>(1, grain / columns);
  progress.For(cells / columns, rowsAtOnce, [&](std::int64_t first, std::int64_t last) {
    blankCellsOfHiddenPoints(
      points, this->HiddenPoints, this->CellFlags, first, last, this->CombinedFlags.data());
  });
  this->Reader->SetBlanks(this->CombinedFlags.data(), ghostCell);
}

LargestValue DensityImage::FindWhite(Progress& progress) const
{
  if (this->Array->GetDataType() == VTK_UNSIGNED_CHAR)
  {
    LargestValue displayed;
    displayed.Value = std::numeric_limits<unsigned char>::max();
    return displayed;
  }
  // Without a finite value the construction of the tables reports the error.
  return reduceChunks(
    progress, this->Geometry.NumberOfCells(), grain, LargestValue(),
    [this](
      std::int64_t first, std::int64_t last) { return this->Reader->Largest(first, last - first); },
    [](LargestValue all, const LargestValue& part) {
      merge(part, all);
      return all;
    });
}

const UnusualValues& DensityImage::Unusual() const
{
  return this->Gathered ? this->Gathered->Known : this->Known;
}

void DensityImage::SetFindings(const std::vector<std::string>& lines)
{
  this->Findings = lines;
  this->HasFindings = true;
}

std::vector<std::string> DensityImage::Describe(const UnusualValues& values) const
{
  if (this->HasFindings)
  {
    return this->Findings;
  }
  std::vector<std::string> lines;
  const ValuePlaces places{ this->Name, this->Geometry.IsOnPoints() ? "points" : "cells",
    this->Geometry.NumberOfCells() };
  // Of several components it is the luminance.
  const bool isInverted =
    this->Rules.Invert && (this->Rules.Component >= 0 || this->Array->GetNumberOfComponents() == 1);
  const double raw = isInverted ? values.White.Value - values.Found.Maximum : values.Found.Maximum;
  if (isUnusualLargest(values.Found, raw, places.All))
  {
    const double share = static_cast<double>(values.Found.Maxima) *
      (values.Found.Maximum / std::max(values.Found.Total, values.Found.Maximum));
    lines.push_back(describeLargest(places, values.Found, raw, share));
  }
  else if (this->Rules.Invert && isUnusualWhite(values.White))
  {
    lines.push_back(describeWhite(places, values.White));
  }
  if (isUnusualLowest(values.Clamped))
  {
    lines.push_back(describeLowest(places, values.Clamped));
  }
  return lines;
}

void DensityImage::TellUnusual(const UnusualValues& values, Progress& progress)
{
  if (!this->Tell)
  {
    return;
  }
  std::vector<std::string> lines = this->Describe(values);
  for (std::string& line : lines)
  {
    line = this->InputName.empty() ? line : this->InputName + ": " + line;
  }
  // All ranks describe the same values.
  this->Tell(lines, lines.empty() ? Content{} : this->GetContent(progress));
}

void DensityImage::ThrowInvalid(const DensitySummary& summary) const
{
  const bool hasCellFlags = !this->Geometry.IsOnPoints() && this->Sources[2];
  throwInvalidDensity(this->Name, summary, this->Sources[1] || hasCellFlags);
}

} // namespace RectifiedTransport
