// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/SiteColorArray.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/SiteCells/CellOutputs.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"
#include "Core/SiteCells/SiteColors.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

using Colors = std::vector<std::uint8_t>;

template <int D>
Colors colorsOf(
  const ImageGrid& grid, const std::int64_t* labels, vtkIdType sites, Progress& progress)
{
  return colourSiteCells<D>(grid.Size<D>(), labels, sites, progress);
}

// Adds an array of byteOf(id) of each element.
template <class ByteOf>
void addBytes(const char* name, vtkCellData* data, Progress& progress, const ByteOf& byteOf)
{
  auto* ids = SiteIdArray::SafeDownCast(data->GetScalars());
  const vtkIdType count = ids->GetNumberOfTuples();
  auto bytes = newArray<vtkUnsignedCharArray>(name, 1, count);
  const std::int64_t* labels = ids->GetPointer(0);
  constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
  progress.For(count, grain, [&](std::int64_t first, std::int64_t last) {
    std::transform(labels + first, labels + last, bytes->GetPointer(first), byteOf);
  });
  data->AddArray(bytes);
}

} // namespace

void addSiteColors(vtkImageData* labels, vtkPolyData* polygons, vtkIdType sites, Progress& progress)
{
  const ImageGrid grid = gridOf(labels, false);
  vtkCellData* data = labels->GetCellData();
  auto* ids = SiteIdArray::SafeDownCast(data->GetScalars());
  constexpr double eachSite = 120.0; // a dozen neighbours
  const Colors ofSites = withMemory({ "the neighbours of the " + std::to_string(sites) + " sites",
                                      static_cast<double>(sites) * eachSite },
    [&]() {
      return dispatchDimension(grid.Dimension(), colorsOf<1>, colorsOf<2>, colorsOf<3>)(
        grid, ids->GetPointer(0), sites, progress);
    });
  const auto colorOf = [&](std::int64_t id) { // 0 for elements of no site
    return id < 0 ? std::uint8_t{ 0 } : ofSites[static_cast<std::size_t>(id)];
  };
  addBytes("SiteColor", data, progress, colorOf);
  if (polygons->GetNumberOfCells() > 0)
  {
    addBytes("SiteColor", polygons->GetCellData(), progress, colorOf);
  }
  const std::int64_t* const pixels = ids->GetPointer(0);
  if (std::any_of(
        pixels, pixels + ids->GetNumberOfTuples(), [](std::int64_t id) { return id < 0; }))
  {
    addBytes(vtkDataSetAttributes::GhostArrayName(), data, progress, [](std::int64_t id) {
      return static_cast<unsigned char>(id < 0 ? vtkDataSetAttributes::HIDDENCELL : 0);
    });
  }
}

} // namespace RectifiedTransport::Bridge
