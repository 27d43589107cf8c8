// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/LabelGrid.h"

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Data/Cells/CellCheck.h"
#include "Bridge/Data/DefaultArray.h"
#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Run/Inputs/InputExtents.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/SiteCells/LabelPixels.h"

#include "vtkBoundingBox.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"

#include <algorithm>
#include <array>

namespace RectifiedTransport::Bridge
{

namespace
{

using Bounds = std::array<double, 6>;

constexpr Bounds noBounds{ 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };

ImageGrid boxOf(vtkImageData* image, const Ranks& ranks)
{
  const bool isOnPoints =
    !onAllRanks(ranks, image->GetNumberOfPoints() == 0 || !hasPointValues(image));
  vtkSmartPointer<vtkImageData> whole = image;
  if (ranks.AreSeveral())
  {
    whole = ImagePieces(image, ranks).MakeFrame();
  }
  const ImageGrid grid = gridOf(whole, false);
  return !grid.IsEmpty() && isOnPoints ? grid.WithDualCells() : grid;
}

ImageGrid boxOf(const Bounds& own, const Ranks& ranks)
{
  const Bounds bounds = boundsOfAll(ranks, own);
  double box[6];
  std::copy(bounds.begin(), bounds.end(), box);
  return bounds[0] > bounds[1] ? ImageGrid() : gridOfBox(box);
}

} // namespace

ImageGrid LabelGrid::On(vtkDataObject* domain, const Ranks& ranks) const
{
  requireExtents(domain, "domain");
  ImageGrid box;
  if (auto* image = vtkImageData::SafeDownCast(domain))
  {
    box = boxOf(image, ranks);
  }
  else
  {
    vtkBoundingBox all;
    for (const DensityBlock& block : densityBlocks(domain))
    {
      requireReadableCells(block.Data, block.Name);
      double bounds[6];
      block.Data->GetBounds(bounds);
      all.AddBounds(bounds);
    }
    Bounds bounds = noBounds;
    if (all.IsValid())
    {
      all.GetBounds(bounds.data());
    }
    box = boxOf(bounds, ranks);
  }
  return box.IsEmpty() ? box : this->On(box);
}

// A density on points has its mass in the dual cells around them.
ImageGrid LabelGrid::On(const ImageGrid& density) const
{
  const ImageGrid box = density.IsOnPoints() ? density.WithDualCells() : density;
  if (box.Dimension() == 0)
  {
    throw Failure("The Domain has one point along every axis; it needs at least one axis of two "
                  "points or more");
  }
  return labelPixels(box, this->Resolution);
}

ImageGrid LabelGrid::Around(vtkPointSet* sites, const Ranks& ranks) const
{
  constexpr double margin = 0.05; // on each side
  double bounds[6];
  findBounds(sites, ranks, bounds);
  for (int a = 0; a < 3; ++a)
  {
    const double length = bounds[2 * a + 1] - bounds[2 * a];
    bounds[2 * a] -= margin * length;
    bounds[2 * a + 1] += margin * length;
  }
  const ImageGrid box = gridOfBox(bounds);
  if (box.Dimension() == 0)
  {
    throw Failure("The input's sites are all at one point, about which there is no domain; connect "
                  "an image as the Domain");
  }
  return labelPixels(box, this->Resolution);
}

} // namespace RectifiedTransport::Bridge
