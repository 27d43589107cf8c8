// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Image/ImageGeometry.h"

#include "Bridge/Run/Failure.h"

#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"

#include <cmath>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

// The measure that `count` vectors span.
double measure(const double vectors[3][3], int count)
{
  const double* a = vectors[0];
  if (count == 1)
  {
    return std::hypot(a[0], a[1], a[2]);
  }
  double cross[3];
  vtkMath::Cross(a, vectors[1], cross);
  return count == 2 ? std::hypot(cross[0], cross[1], cross[2])
                    : std::abs(vtkMath::Dot(cross, vectors[2]));
}

[[noreturn]] void failDegenerate(vtkImageData* image)
{
  double spacing[3];
  image->GetSpacing(spacing);
  std::ostringstream message;
  message
    << "The image's spacing is (" << spacing[0] << ", " << spacing[1] << ", " << spacing[2]
    << "); origin, spacing and direction must be finite, and every axis of more than one "
       "point needs a spacing that is not 0 and a direction of its own, none so large or small "
       "that a corner of the image or a cell's measure is no number";
  throw Failure(message.str());
}

} // namespace

ImageGeometry::ImageGeometry(vtkImageData* image, bool onPoints)
{
  int extent[6];
  image->GetExtent(extent);
  double axes[3][3] = {};
  const double* elements = image->GetIndexToPhysicalMatrix()->GetData();
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 4; ++c)
    {
      this->Matrix[r][c] = elements[4 * r + c];
    }
  }
  for (int i = 0; i < 3; ++i)
  {
    const std::int64_t points = std::int64_t{ extent[2 * i + 1] } - extent[2 * i] + 1;
    this->Fixed[i] = extent[2 * i];
    if (points <= 1)
    {
      continue;
    }
    if (onPoints)
    {
      this->Fixed[i] -= 0.5;
    }
    const int a = this->AxisCount++;
    this->Axis[a] = i;
    this->Cells[a] = onPoints ? points : points - 1;
    for (int r = 0; r < 3; ++r)
    {
      axes[a][r] = this->Matrix[r][i];
    }
  }
  if (this->AxisCount == 0)
  {
    throw Failure("The input image has one point along every axis; a density needs at least one "
                  "axis of two points or more");
  }

  for (int a = 0; a < this->AxisCount; ++a)
  {
    this->Spacing[a] = std::hypot(axes[a][0], axes[a][1], axes[a][2]);
  }
  this->Measure = measure(axes, this->AxisCount);
  const double zero[3] = { 0.0, 0.0, 0.0 };
  this->ToPhysical<3>(zero, this->Corner);
  double sums[3]; // no coordinate of the domain is larger
  for (int r = 0; r < 3; ++r)
  {
    sums[r] = std::abs(this->Corner[r]) + std::abs(this->Matrix[r][3]);
    for (int a = 0; a < this->AxisCount; ++a)
    {
      sums[r] += std::abs(axes[a][r]) * static_cast<double>(this->Cells[a]);
    }
  }
  const bool finite =
    std::isfinite(this->Measure) && std::isfinite(std::hypot(sums[0], sums[1], sums[2]));
  for (int a = 0; a < this->AxisCount; ++a)
  {
    vtkMath::MultiplyScalar(axes[a], 1.0 / this->Spacing[a]);
  }
  constexpr double parallel = 1e-12;
  if (!finite || !(this->Measure > 0.0) || !(measure(axes, this->AxisCount) > parallel))
  {
    failDegenerate(image);
  }

  // Least squares on axes of unit length: (U^T U)^-1 U^T.
  double gram[3][3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  double inverse[3][3];
  for (int a = 0; a < this->AxisCount; ++a)
  {
    for (int b = 0; b < this->AxisCount; ++b)
    {
      gram[a][b] = a == b ? 1.0 : vtkMath::Dot(axes[a], axes[b]);
    }
  }
  vtkMath::Invert3x3(gram, inverse);
  for (int a = 0; a < this->AxisCount; ++a)
  {
    for (int r = 0; r < 3; ++r)
    {
      for (int b = 0; b < this->AxisCount; ++b)
      {
        this->Inverse[a][r] += inverse[a][b] * axes[b][r];
      }
    }
  }

  if (this->AxisCount == 1)
  {
    vtkMath::Perpendiculars(axes[0], this->Normal[1], this->Normal[2], 0.0);
  }
  else if (this->AxisCount == 2)
  {
    vtkMath::Cross(axes[0], axes[1], this->Normal[2]);
    vtkMath::Normalize(this->Normal[2]);
  }
}

bool ImageGeometry::operator==(const ImageGeometry& other) const
{
  if (this->AxisCount != other.AxisCount)
  {
    return false;
  }
  for (int i = 0; i < 3; ++i)
  {
    if (this->Axis[i] != other.Axis[i] || this->Cells[i] != other.Cells[i] ||
      this->Fixed[i] != other.Fixed[i] ||
      !std::equal(this->Matrix[i], this->Matrix[i] + 4, other.Matrix[i]))
    {
      return false;
    }
  }
  return true;
}

std::int64_t ImageGeometry::NumberOfCells() const
{
  std::int64_t cells = 1;
  for (int a = 0; a < this->AxisCount; ++a)
  {
    cells *= this->Cells[a];
  }
  return cells;
}

bool ImageGeometry::IsMirrored() const
{
  double axes[3][3];
  for (int r = 0; r < 3; ++r)
  {
    std::copy_n(this->Matrix[r], 3, axes[r]);
  }
  return this->AxisCount == 3 && vtkMath::Determinant3x3(axes) < 0.0;
}

double ImageGeometry::Diagonal() const
{
  const Point<3> lengths = this->Lengths<3>();
  return std::hypot(lengths[0], lengths[1], lengths[2]);
}

} // namespace RectifiedTransport
