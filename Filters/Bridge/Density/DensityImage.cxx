// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityImage.h"

#include "Bridge/Density/DensityFailure.h"
#include "Bridge/Density/DensityReader.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Fingerprint.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
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

} // namespace

DensityImage::DensityImage(vtkImageData* image, vtkDataArray* array, bool onPoints,
  const DensityRules& rules, std::unique_ptr<const ImagePieces> pieces)
  : Input(image)
  , Array(array)
  , Distribution(std::move(pieces))
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
  const std::uint64_t bits = fingerprint({ this->Sources.begin(), this->Sources.end() }, progress);
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
  if (this->HiddenPoints)
  {
    this->BlankCellsOfHiddenPoints(progress);
  }
  if (needsWhite(this->Rules, this->Array->GetNumberOfComponents()))
  {
    this->Reader->SetWhite(this->Array->GetDataType() == VTK_UNSIGNED_CHAR
        ? std::numeric_limits<unsigned char>::max()
        : this->FindWhite(progress));
  }
}

void DensityImage::BlankCellsOfHiddenPoints(Progress& progress)
{
  const GridSize<3> size = this->Geometry.Size<3>();
  const int dimension = this->Geometry.Dimension();
  const std::int64_t cells[3] = { size[0], dimension > 1 ? size[1] : 1,
    dimension > 2 ? size[2] : 1 };
  const std::int64_t rowStep = cells[0] + 1;
  const std::int64_t planeStep = dimension > 1 ? rowStep * (cells[1] + 1) : 0;
  const int corners = 1 << dimension;
  this->CombinedFlags.resize(static_cast<std::size_t>(this->Geometry.NumberOfCells()));
  unsigned char* combined = this->CombinedFlags.data();
  const std::int64_t rowsAtOnce = std::max<std::int64_t>(1, grain / cells[0]);
  progress.For(cells[1] * cells[2], rowsAtOnce, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t row = first; row < last; ++row)
    {
      const unsigned char* points =
        this->HiddenPoints + row % cells[1] * rowStep + row / cells[1] * planeStep;
      for (std::int64_t i = 0; i < cells[0]; ++i)
      {
        unsigned char hidden = 0;
        for (int corner = 0; corner < corners; ++corner)
        {
          hidden |=
            points[i + (corner & 1) + (corner >> 1 & 1) * rowStep + (corner >> 2) * planeStep];
        }
        const std::int64_t cell = row * cells[0] + i;
        const unsigned char own = this->CellFlags ? this->CellFlags[cell] : 0;
        combined[cell] = (hidden & vtkDataSetAttributes::HIDDENPOINT) ? ghostCell : own;
      }
    }
  });
  this->Reader->SetBlanks(combined, ghostCell);
}

double DensityImage::FindWhite(Progress& progress) const
{
  const std::int64_t cells = this->Geometry.NumberOfCells();
  const double largest = reduceChunks(
    progress, cells, grain, -std::numeric_limits<double>::infinity(),
    [this](
      std::int64_t first, std::int64_t last) { return this->Reader->Maximum(first, last - first); },
    [](double a, double b) { return std::max(a, b); });
  // Without a finite value the construction of the tables reports the error.
  return std::isfinite(largest) ? largest : 0.0;
}

void DensityImage::ThrowInvalid(const DensitySummary& summary) const
{
  throwInvalidDensity(this->Name, summary, this->Reader->HasBlanks());
}

} // namespace RectifiedTransport
