// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Resampling/ResampledDensity.h"

#include "Bridge/Resampling/MeshDensity.h"
#include "Bridge/Resampling/MeshGrid.h"
#include "Bridge/Resampling/RegionShapes.h"
#include "Bridge/Resampling/TiledImages.h"
#include "Bridge/Resampling/UnusualBlocks.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

namespace RectifiedTransport
{

vtkImageData* ResampledDensity::Image() const
{
  return this->Made;
}

void ResampledDensity::Update(const std::vector<DensityBlock>& blocks, bool onPoints, int dimension,
  int resolution, const DensityRules& rules, Progress& progress)
{
  const auto number = [](auto value) { return static_cast<std::uint64_t>(value); };
  std::vector<std::uint64_t> content{ number(onPoints), number(dimension), number(resolution),
    number(rules.Component + 2), number(rules.Invert), number(rules.ClampNegative) };
  for (const DensityBlock& block : blocks)
  {
    content.insert(content.end(),
      { number(reinterpret_cast<std::uintptr_t>(block.Array)), number(block.Array->GetMTime()) });
    content.insert(content.end(), block.Geometry.begin(), block.Geometry.end());
  }
  if (this->Made && content == this->Content)
  {
    return;
  }
  *this = ResampledDensity();
  const char* name = blocks.front().Array->GetName();
  if ((this->Made = joinTiles(blocks, onPoints)))
  {
    this->OnPoints = onPoints;
    vtkDataSetAttributes* attributes =
      this->Made->GetAttributes(onPoints ? vtkDataObject::POINT : vtkDataObject::CELL);
    this->Density = blocks.size() == 1 ? blocks.front().Array : attributes->GetArray(name);
  }
  else
  {
    const MassCells cells = massCells(blocks, dimension, progress);
    const ImageGrid grid = meshGrid(blocks, cells, resolution, progress);
    this->Blocks = readBlocks(blocks, onPoints, cells, rules, progress);
    if (cells.Dimension == 2)
    {
      markRegions(this->Blocks, grid, progress);
    }
    const char* called = name ? name : "Density";
    const MeshDensity made = MeshDensity::Make(this->Blocks, grid, called, progress);
    this->Made = made.Image;
    this->Lost = made.Warnings;
    this->Resampled = true;
    this->Density = made.Image->GetCellData()->GetScalars();
    this->Unusual = describeUnusual(this->Blocks, grid, rules.Invert, progress);
  }
  this->Content = content;
}

} // namespace RectifiedTransport
