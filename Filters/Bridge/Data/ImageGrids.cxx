// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/ImageGrids.h"

#include "Bridge/Run/Inputs/InputExtents.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/MpiController.h"
#include "Core/Geometry/Boxes/GridResolution.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace RectifiedTransport::Bridge
{

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

void announceDensity(const ImageGrid& grid, vtkInformation* information, const char* name)
{
  announceGrid(grid, information);
  vtkDataObject::SetActiveAttributeInfo(information,
    grid.IsOnPoints() ? vtkDataObject::FIELD_ASSOCIATION_POINTS
                      : vtkDataObject::FIELD_ASSOCIATION_CELLS,
    vtkDataSetAttributes::SCALARS, name, VTK_DOUBLE, 1, -1);
}

} // namespace RectifiedTransport::Bridge
