// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/SiteColorArray.h"

#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/SiteCells/SiteLabels.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/SiteCells/SiteColors.h"

#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkUnsignedCharArray.h"

namespace RectifiedTransport
{

namespace
{

template <int D>
void writeColors(const ImageGrid& grid, const std::int64_t* labels, vtkIdType sites,
  unsigned char* colors, Progress& progress)
{
  const std::vector<std::uint8_t> ofSites =
    colourSiteCells<D>(grid.Size<D>(), labels, sites, progress.Stage());
  constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
  progress.For(grid.NumberOfCells(), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t pixel = first; pixel < last; ++pixel)
    {
      colors[pixel] = ofSites[static_cast<std::size_t>(labels[pixel])];
    }
  });
}

} // namespace

void addSiteColors(vtkImageData* labels, vtkIdType sites, Progress& progress)
{
  const ImageGrid grid = gridOf(labels, false);
  auto* ids = SiteIdArray::SafeDownCast(labels->GetCellData()->GetScalars());
  auto colors =
    newArray<vtkUnsignedCharArray>("SiteColor", 1, static_cast<vtkIdType>(grid.NumberOfCells()));
  constexpr double eachSite = 120.0; // a dozen neighbours
  withMemory("the neighbours of the " + std::to_string(sites) + " sites",
    static_cast<double>(sites) * eachSite, [&]() {
      progress.BeginStage(1.0);
      dispatchDimension(grid.Dimension(), writeColors<1>, writeColors<2>, writeColors<3>)(
        grid, ids->GetPointer(0), sites, colors->GetPointer(0), progress);
    });
  labels->GetCellData()->AddArray(colors);
}

} // namespace RectifiedTransport
