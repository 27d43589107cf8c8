// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Image/ImageGrids.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Inputs/InputExtents.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/MpiController.h"
#include "Bridge/Run/PropertyCheck.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport::Bridge
{

namespace
{

[[noreturn]] void failValues(const char* property, const int values[3], const std::string& rule)
{
  fail(property, " is ", values[0], " ", values[1], " ", values[2], "; it must be ", rule);
}

} // namespace

ImageGrid gridOf(vtkImageData* image, bool onPoints)
{
  std::array<int, 6> extent;
  image->GetExtent(extent.data());
  return { extent, Eigen::Map<const Eigen::Vector3d>(image->GetOrigin()),
    Eigen::Map<const Eigen::Vector3d>(image->GetSpacing()),
    Eigen::Map<const ImageGrid::Matrix>(image->GetDirectionMatrix()->GetData()), onPoints };
}

ImageGrid announcedGrid(vtkInformation* information, bool onPoints)
{
  std::array<int, 6> extent{ 0, -1, 0, -1, 0, -1 };
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();
  ImageGrid::Matrix direction = ImageGrid::Matrix::Identity();
  const auto get = [information](auto* key, auto* values) {
    if (information->Has(key))
    {
      information->Get(key, values);
    }
  };
  get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent.data());
  if (!isReadable(extent.data()))
  {
    extent = { 0, -1, 0, -1, 0, -1 }; // an error of the data, when they come
  }
  get(vtkDataObject::ORIGIN(), origin.data());
  get(vtkDataObject::SPACING(), spacing.data());
  get(vtkDataObject::DIRECTION(), direction.data());
  return { extent, origin, spacing, direction, onPoints };
}

ImageGrid gridOfBox(const double (&bounds)[6])
{
  constexpr double flat = 1e-9;
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    longest = std::max(longest, bounds[2 * i + 1] - bounds[2 * i]);
  }
  std::array<int, 6> extent{};
  Eigen::Vector3d origin;
  Eigen::Vector3d spacing;
  for (int i = 0; i < 3; ++i)
  {
    const double length = bounds[2 * i + 1] - bounds[2 * i];
    const bool isAxis = length > 0.0 && length >= flat * longest; // infinite ones too
    extent[static_cast<std::size_t>(2 * i + 1)] = isAxis ? 1 : 0;
    origin[i] = bounds[2 * i];
    spacing[i] = isAxis ? length : 1.0;
  }
  return { extent, origin, spacing, ImageGrid::Matrix::Identity(), false };
}

void requireCells(const ImageGrid& grid)
{
  if (grid.Dimension() == 0)
  {
    throw Failure("The input image has one point along every axis; a density needs at least one "
                  "axis of two points or more");
  }
  if (!grid.HasCells())
  {
    fail("The image's spacing is (", grid.Spacing()[0], ", ", grid.Spacing()[1], ", ",
      grid.Spacing()[2],
      "); origin, spacing and direction must be finite, and every axis of more than one point "
      "needs a spacing that is not 0 and a direction of its own, none so large or small that a "
      "corner of the image or a cell's measure is no number");
  }
}

void applyGrid(const ImageGrid& grid, vtkImageData* image)
{
  double planes = 0.0;
  for (const int points : grid.NumberOfPoints())
  {
    planes += points;
  }
  requireMemory({ "an image of " + describeValues(grid.WithValuesOn(true)) + " points",
    planes * sizeof(double) });
  std::array<int, 6> extent = grid.Extent();
  image->SetExtent(extent.data());
  image->SetOrigin(grid.Origin().data());
  image->SetSpacing(grid.Spacing().data());
  image->SetDirectionMatrix(grid.Direction().data());
}

void announceGrid(const ImageGrid& grid, vtkInformation* information)
{
  information->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), grid.Extent().data(), 6);
  information->Set(vtkDataObject::ORIGIN(), grid.Origin().data(), 3);
  information->Set(vtkDataObject::SPACING(), grid.Spacing().data(), 3);
  information->Set(vtkDataObject::DIRECTION(), grid.Direction().data(), 9);
}

void announceSubExtents(vtkInformation* information)
{
  if (haveSeveralRanks())
  {
    information->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  }
}

std::array<int, 6> requestedExtent(vtkInformation* information)
{
  std::array<int, 6> extent{ 0, -1, 0, -1, 0, -1 };
  if (information->Has(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()))
  {
    information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent.data());
  }
  return extent;
}

void announceDensity(const ImageGrid& grid, vtkInformation* information)
{
  announceGrid(grid, information);
  vtkDataObject::SetActiveAttributeInfo(information,
    grid.IsOnPoints() ? vtkDataObject::FIELD_ASSOCIATION_POINTS
                      : vtkDataObject::FIELD_ASSOCIATION_CELLS,
    vtkDataSetAttributes::SCALARS, "Density", VTK_DOUBLE, 1, -1);
}

ImageGrid gridWithValues(const ImageGrid& grid, const int wanted[3], const char* property)
{
  if (*std::min_element(wanted, wanted + 3) < 0)
  {
    failValues(property, wanted, "0 (as many as the input) or greater along every axis");
  }
  const std::array<int, 3> values = grid.NumberOfValues();
  for (std::size_t i = 0; i < 3; ++i)
  {
    const int count = wanted[i];
    if (count == 0 || count == values[i])
    {
      continue;
    }
    const std::string axis = std::string(" along ") + "xyz"[i];
    if (!grid.IsAxis(i))
    {
      failValues(property, wanted, "0 or 1" + axis + ", where the input has one point");
    }
    if (grid.IsOnPoints() && count == 1)
    {
      failValues(property, wanted,
        "0 or at least 2" + axis + ": points have no axis where there is one of them");
    }
    if (count > MaximumResolution)
    {
      failValues(
        property, wanted, "at most " + std::to_string(MaximumResolution) + " along every axis");
    }
  }
  return grid.WithValues({ wanted[0], wanted[1], wanted[2] });
}

ImageGrid gridWithResolution(const ImageGrid& grid, int resolution, const char* property)
{
  requireResolution(property, resolution);
  const std::array<int, 3> cells = grid.WithValuesOn(false).NumberOfValues();
  double lengths[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double spacing = grid.Spacing()[static_cast<Eigen::Index>(i)];
    lengths[i] = grid.IsAxis(i) ? std::abs(spacing) * cells[i] : 0.0;
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
  return gridWithValues(grid.WithValuesOn(false), wanted, property);
}

double numberOfValues(const ImageGrid& grid)
{
  double number = 1.0;
  for (const int values : grid.NumberOfValues())
  {
    number *= values;
  }
  return number;
}

std::string describeValues(const ImageGrid& grid)
{
  std::string text;
  const std::array<int, 3> values = grid.NumberOfValues();
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (grid.IsAxis(i))
    {
      text += (text.empty() ? "" : " x ") + std::to_string(values[i]);
    }
  }
  return text;
}

} // namespace RectifiedTransport::Bridge
