// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Image/ImageFrame.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/PropertyCheck.h"

#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

[[noreturn]] void failValues(const char* property, const int values[3], const std::string& rule)
{
  std::ostringstream message;
  message << property << " is " << values[0] << " " << values[1] << " " << values[2]
          << "; it must be " << rule;
  throw Failure(message.str());
}

} // namespace

ImageFrame::ImageFrame() = default;

ImageFrame::ImageFrame(vtkImageData* image)
{
  image->GetExtent(this->Extent.data());
  image->GetOrigin(this->Origin.data());
  image->GetSpacing(this->Spacing.data());
  std::copy_n(image->GetDirectionMatrix()->GetData(), 9, this->Direction.begin());
}

ImageFrame::ImageFrame(vtkInformation* information)
{
  const auto get = [information](auto* key, auto& values) {
    if (information->Has(key))
    {
      information->Get(key, values.data());
    }
  };
  get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), this->Extent);
  get(vtkDataObject::ORIGIN(), this->Origin);
  get(vtkDataObject::SPACING(), this->Spacing);
  get(vtkDataObject::DIRECTION(), this->Direction);
}

ImageFrame::ImageFrame(const std::array<int, 3>& points, const std::array<double, 3>& origin,
  const std::array<double, 3>& spacing)
  : Extent{ 0, points[0] - 1, 0, points[1] - 1, 0, points[2] - 1 }
  , Origin(origin)
  , Spacing(spacing)
{
}

ImageFrame::ImageFrame(const double (&bounds)[6])
{
  constexpr double flat = 1e-9;
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    longest = std::max(longest, bounds[2 * i + 1] - bounds[2 * i]);
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double length = bounds[2 * i + 1] - bounds[2 * i];
    const bool isAxis = length > 0.0 && length >= flat * longest; // infinite ones too
    this->Extent[2 * i + 1] = isAxis ? 1 : 0;
    this->Origin[i] = bounds[2 * i];
    this->Spacing[i] = isAxis ? length : 1.0;
  }
}

ImageFrame::Side ImageFrame::GetSide(std::size_t axis, bool onPoints) const
{
  double inverse[9] = {}; // so it stays where there is none
  vtkMatrix3x3::Invert(this->Direction.data(), inverse);
  const double* row = inverse + 3 * axis;
  const int first = this->Extent[2 * axis];
  const bool isAxis = first != this->Extent[2 * axis + 1];
  const double index = isAxis && onPoints ? first - 0.5 : first;
  Side side;
  side.Low = row[0] * this->Origin[0] + row[1] * this->Origin[1] + row[2] * this->Origin[2] +
    this->Spacing[axis] * index;
  side.Spacing = this->Spacing[axis];
  side.Cells = this->Values(onPoints)[axis];
  side.IsAxis = isAxis;
  return side;
}

ImageFrame ImageFrame::WithSides(const std::array<Side, 3>& sides, bool onPoints) const
{
  ImageFrame frame = *this;
  double place[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Side& side = sides[i];
    frame.Spacing[i] = side.Spacing;
    frame.Extent[2 * i] = 0;
    frame.Extent[2 * i + 1] = !side.IsAxis ? 0 : onPoints ? side.Cells - 1 : side.Cells;
    place[i] = side.IsAxis && onPoints ? side.Low + 0.5 * side.Spacing : side.Low;
  }
  vtkMatrix3x3::MultiplyPoint(this->Direction.data(), place, frame.Origin.data());
  return frame;
}

bool ImageFrame::HasDirectionOf(const ImageFrame& other) const
{
  constexpr double rounding = 1e-9;
  return std::equal(this->Direction.begin(), this->Direction.end(), other.Direction.begin(),
    [](double a, double b) { return std::abs(a - b) <= rounding; });
}

bool ImageFrame::HasInverse() const
{
  constexpr double flat = 1e-12;
  return std::abs(vtkMatrix3x3::Determinant(this->Direction.data())) > flat;
}

bool ImageFrame::operator==(const ImageFrame& other) const
{
  return this->Extent == other.Extent && this->Origin == other.Origin &&
    this->Spacing == other.Spacing && this->Direction == other.Direction;
}

void ImageFrame::CopyTo(vtkImageData* image) const
{
  double planes = 0.0;
  for (const int points : this->Values(true))
  {
    planes += points;
  }
  requireMemory("an image of " + this->DescribeValues(true) + " points", planes * sizeof(double));
  const auto& e = this->Extent;
  image->SetExtent(e[0], e[1], e[2], e[3], e[4], e[5]);
  image->SetOrigin(this->Origin.data());
  image->SetSpacing(this->Spacing.data());
  image->SetDirectionMatrix(this->Direction.data());
}

void ImageFrame::Publish(vtkInformation* information) const
{
  information->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), this->Extent.data(), 6);
  information->Set(vtkDataObject::ORIGIN(), this->Origin.data(), 3);
  information->Set(vtkDataObject::SPACING(), this->Spacing.data(), 3);
  information->Set(vtkDataObject::DIRECTION(), this->Direction.data(), 9);
}

void ImageFrame::PublishDensity(vtkInformation* information, bool onPoints) const
{
  this->Publish(information);
  vtkDataObject::SetActiveAttributeInfo(information,
    onPoints ? vtkDataObject::FIELD_ASSOCIATION_POINTS : vtkDataObject::FIELD_ASSOCIATION_CELLS,
    vtkDataSetAttributes::SCALARS, "Density", VTK_DOUBLE, 1, -1);
}

bool ImageFrame::IsEmpty() const
{
  const auto& e = this->Extent;
  return e[0] > e[1] || e[2] > e[3] || e[4] > e[5];
}

std::array<int, 3> ImageFrame::Values(bool onPoints) const
{
  std::array<int, 3> values;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const int cells = this->Extent[2 * i + 1] - this->Extent[2 * i];
    values[i] = onPoints || cells == 0 ? cells + 1 : cells;
  }
  return values;
}

int ImageFrame::NumberOfAxes() const
{
  int axes = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    axes += this->Extent[2 * i] != this->Extent[2 * i + 1] ? 1 : 0;
  }
  return axes;
}

double ImageFrame::NumberOfValues(bool onPoints) const
{
  double number = 1.0;
  for (const int values : this->Values(onPoints))
  {
    number *= values;
  }
  return number;
}

std::string ImageFrame::DescribeValues(bool onPoints) const
{
  std::string text;
  const std::array<int, 3> values = this->Values(onPoints);
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (this->Extent[2 * i] != this->Extent[2 * i + 1])
    {
      text += (text.empty() ? "" : " x ") + std::to_string(values[i]);
    }
  }
  return text;
}

ImageFrame ImageFrame::WithValues(const int wanted[3], bool onPoints, const char* property) const
{
  if (*std::min_element(wanted, wanted + 3) < 0)
  {
    failValues(property, wanted, "0 (as many as the input) or greater along every axis");
  }
  ImageFrame frame = *this;
  const std::array<int, 3> values = this->Values(onPoints);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const int count = wanted[i];
    if (count == 0 || count == values[i])
    {
      continue;
    }
    const std::string axis = std::string(" along ") + "xyz"[i];
    if (this->Extent[2 * i] == this->Extent[2 * i + 1])
    {
      failValues(property, wanted, "0 or 1" + axis + ", where the input has one point");
    }
    if (onPoints && count == 1)
    {
      failValues(property, wanted,
        "0 or at least 2" + axis + ": points have no axis where there is one of them");
    }
    if (count > MaximumResolution)
    {
      failValues(
        property, wanted, "at most " + std::to_string(MaximumResolution) + " along every axis");
    }
    // Where the new index is 0, in the old one.
    const double ratio = static_cast<double>(values[i]) / count;
    const double start = this->Extent[2 * i] + (onPoints ? 0.5 * (ratio - 1.0) : 0.0);
    frame.SetAxis(i, start, onPoints ? count : count + 1);
    frame.Spacing[i] *= ratio;
  }
  return frame;
}

void ImageFrame::SetAxis(std::size_t axis, double first, int points)
{
  for (std::size_t r = 0; r < 3; ++r)
  {
    this->Origin[r] += this->Direction[3 * r + axis] * this->Spacing[axis] * first;
  }
  this->Extent[2 * axis] = 0;
  this->Extent[2 * axis + 1] = points - 1;
}

ImageFrame ImageFrame::AtCellCentres() const
{
  ImageFrame frame = *this;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const int cells = this->Extent[2 * i + 1] - this->Extent[2 * i];
    if (cells > 0)
    {
      frame.SetAxis(i, this->Extent[2 * i] + 0.5, cells);
    }
  }
  return frame;
}

ImageFrame ImageFrame::WithDualCells() const
{
  ImageFrame frame = *this;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const int cells = this->Extent[2 * i + 1] - this->Extent[2 * i];
    if (cells > 0)
    {
      frame.SetAxis(i, this->Extent[2 * i] - 0.5, cells + 2);
    }
  }
  return frame;
}

ImageFrame ImageFrame::WithResolution(int resolution, const char* property) const
{
  requireResolution(property, resolution);
  const std::array<int, 3> cells = this->Values(false);
  double lengths[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    const bool isAxis = this->Extent[2 * i] != this->Extent[2 * i + 1];
    lengths[i] = isAxis ? std::abs(this->Spacing[i]) * cells[i] : 0.0;
  }
  const double longest = std::max({ lengths[0], lengths[1], lengths[2] });
  int wanted[3] = { 0, 0, 0 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (lengths[i] > 0.0)
    {
      wanted[i] = std::max(1, static_cast<int>(std::lround(resolution * (lengths[i] / longest))));
    }
  }
  return this->WithValues(wanted, false, property);
}

} // namespace RectifiedTransport
