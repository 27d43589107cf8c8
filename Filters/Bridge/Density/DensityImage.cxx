// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityImage.h"

#include "Bridge/Data/ArraySampling.h"
#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Density/ArrayReader.h"
#include "Bridge/Run/Fingerprint.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Parallel/Progress.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

namespace
{

// Cells in a range of work: enough to outweigh the start of a range, few enough for all threads.
constexpr std::int64_t grain = std::int64_t{ 1 } << 14;

} // namespace

DensityImage::DensityImage(
  vtkImageData* image, vtkDataArray* array, bool onPoints, const DensityRules& rules)
  : InputDensity(describeArray(array), rules)
  , Input(image)
  , Array(array)
{
  requireTuples(array, image, onPoints, "input image");
  // Cells of the image, or dual cells around its points: each value is the mean density of one.
  this->Geometry = gridOf(image, onPoints);
  requireCells(this->Geometry);
  this->FillValues = fillValuesOf(image->GetFieldData());

  const auto time = [](vtkObject* object) {
    return object ? static_cast<std::uint64_t>(object->GetMTime()) : std::uint64_t{ 0 };
  };
  // What the density is read from, whose values its hash covers. They stay in memory with this
  // object.
  this->Sources = { this->Array, image->GetPointGhostArray(), image->GetCellGhostArray() };
  // The modification time of the vtkImageData itself: its GetMTime() includes all its arrays.
  this->SetForm({ array->GetDataType(), array->GetNumberOfComponents(), this->Sources[1] != nullptr,
                  this->Sources[2] != nullptr },
    { time(this->Sources[0]), time(this->Sources[1]), time(this->Sources[2]),
      static_cast<std::uint64_t>(image->vtkObject::GetMTime()) });
  this->Reader = makeDensityReader(array, this->Rules);
  constexpr const char* what = "input image";
  // Ghost points have no value. For cell data, hidden points blank their cells, as in VTK; Prepare
  // combines the flags of both.
  const unsigned char* points = ghostFlags(image, vtkDataObject::POINT, what);
  if (onPoints)
  {
    this->Reader->SetBlanks(points, ghostPoint);
    return;
  }
  this->CellFlags = ghostFlags(image, vtkDataObject::CELL, what);
  this->Reader->SetBlanks(this->CellFlags, ghostCell);
  this->HiddenPoints = points;
}

std::string DensityImage::NameOfArray() const
{
  return this->Array->GetName() ? this->Array->GetName() : "";
}

std::uint64_t DensityImage::Fingerprint(Progress& progress) const
{
  return fingerprint({ this->Sources.begin(), this->Sources.end() }, progress);
}

void DensityImage::Prepare(FlowTables /*tables*/, Progress& progress)
{
  // The order matters: white is found without blanked cells, densities depend on white, and what
  // empty cells count as may be the mean or the least of all other densities.
  this->Known = {};
  this->Known.White = this->FindWhite(progress);
  this->SetWhite(this->White(), progress);
  this->Known.Clamped = this->FindClamped(progress);
  if (this->FillsEmpty())
  {
    this->SetEmpty(
      densityOfEmptyCells(this->Rules.Empty, this->Occupied({ this->AllTuples() }, progress)));
  }
}

void DensityImage::SetEmpty(double density)
{
  this->Empty = density;
  this->Reader->SetEmpty(density);
}

// An inverted density is white - value, where white is one number for the whole image: a part of a
// distributed image gets that of all ranks.
void DensityImage::SetWhite(double white, Progress& progress)
{
  this->BlankCellsOfHiddenPoints(progress);
  this->Reader->SetWhite(white);
}

void DensityImage::BlankCellsOfHiddenPoints(Progress& progress)
{
  if (!this->HiddenPoints || !this->CombinedFlags.empty())
  {
    return;
  }
  const std::int64_t cells = this->Geometry.NumberOfCells();
  // One byte a cell; only images with hidden points need it.
  withMemory({ "the flags of the cells of the input image", static_cast<double>(cells) },
    [&]() { this->CombinedFlags.resize(static_cast<std::size_t>(cells)); });
  const std::array<int, 3> points = this->Geometry.NumberOfPoints();
  // Whole rows of cells along the first axis, as the cells of a row share its points.
  const std::int64_t columns = std::max(1, points[0] - 1);
  const std::int64_t rowsAtOnce = std::max<std::int64_t>(1, grain / columns);
  progress.For(cells / columns, rowsAtOnce, [&](std::int64_t first, std::int64_t last) {
    blankCellsOfHiddenPoints(points, this->HiddenPoints, this->CellFlags, first, last,
      this->CombinedFlags.data(), blankingFlags);
  });
  this->Reader->SetBlanks(this->CombinedFlags.data(), ghostCell);
}

// Values of empty cells are none that white is found among.
LargestValue DensityImage::FindWhite(Progress& progress)
{
  this->BlankCellsOfHiddenPoints(progress);
  return !this->NeedsWhite()
    ? LargestValue()
    : findWhite(*this->Reader, this->Array->GetDataType() == VTK_UNSIGNED_CHAR,
        this->Geometry.NumberOfCells(), progress);
}

// Inverted, no value is negative but for those above white.
LowestValue DensityImage::FindClamped(Progress& progress) const
{
  return this->Clamps() ? findLowest(*this->Reader, this->Geometry.NumberOfCells(), progress)
                        : LowestValue();
}

// The box of all values, in the indices of the image's extent, which need not begin at 0.
TupleBox DensityImage::AllTuples() const
{
  const Extent& extent = this->Geometry.Extent();
  return tuplesOf(extent, this->Owner(), extent);
}

OccupiedCells DensityImage::Occupied(const std::vector<TupleBox>& boxes, Progress& progress) const
{
  // The sums are exact, so that they are the same for every division into boxes, ranges and ranks.
  const TupleBox all = this->AllTuples();
  OccupiedCells filled;
  for (const TupleBox& box : boxes)
  {
    filled.Add(sumExactly<OccupiedCells>(progress, box.Count(), grain,
      [&](std::int64_t first, std::int64_t last, OccupiedCells& part) {
        std::vector<double> values(static_cast<std::size_t>(last - first));
        std::vector<unsigned char> empty(values.size());
        // Runs of cells that follow each other in both.
        const std::int64_t row = box.Count() == all.Count() ? all.Count() : box.Cells[0];
        for (std::int64_t i = first; i < last;)
        {
          const std::int64_t count = std::min(last, (i / row + 1) * row) - i;
          const std::int64_t cell = all.NumberOf(box.CellOf(i));
          this->Reader->Read(cell, count, values.data());
          this->Reader->FindEmpty(cell, count, empty.data());
          part.Add(values.data(), empty.data(), count);
          i += count;
        }
      }));
  }
  return filled;
}

// The input is shared and cropped in the copy; an empty extent gives an image without points.
vtkSmartPointer<vtkImageData> DensityImage::ImageIn(const Extent& extent) const
{
  const auto part = vtkSmartPointer<vtkImageData>::New();
  if (!isEmpty(extent))
  {
    part->ShallowCopy(this->Input);
    part->Crop(extent.data());
  }
  return part;
}

// The input has all arrays everywhere, so that the extent is not needed.
void DensityImage::SampleArrays(const Extent& /*extent*/, ConstPointSpan<3> particles,
  Progress& progress, vtkPointData* output) const
{
  sampleImage(this->Input, this->Geometry, this->Geometry.Extent(), particles, progress, output);
}

} // namespace RectifiedTransport::Bridge
