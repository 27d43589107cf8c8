// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/BlockArrays.h"

#include "Bridge/Run/Failure.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

namespace
{

struct FoundArray
{
  vtkDataArray* Array = nullptr;
  std::size_t Block = 0;
  int Association = 0;
};

// In the first block of the most dimensions that has one.
FoundArray findArray(const BlockArrays::Find& find, const BlockArrays::MayLack& mayLack,
  const std::vector<DensityBlock>& blocks, const std::vector<int>& dimensions)
{
  const int most = *std::max_element(dimensions.begin(), dimensions.end());
  FoundArray found;
  for (int dimension = most; dimension > 0; --dimension)
  {
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      if (dimensions[b] != dimension)
      {
        continue;
      }
      try
      {
        found = { find(blocks[b], found.Association), b, found.Association };
        return found;
      }
      catch (const Failure&)
      {
        if (!mayLack(blocks[b].Data))
        {
          throw;
        }
      }
    }
  }
  const auto first = std::find(dimensions.begin(), dimensions.end(), most) - dimensions.begin();
  find(blocks[static_cast<std::size_t>(first)], found.Association);
  return found;
}

} // namespace

BlockArrays BlockArrays::Set(
  const Find& find, const MayLack& mayLack, std::vector<DensityBlock>& blocks)
{
  std::vector<int> dimensions;
  for (const DensityBlock& block : blocks)
  {
    dimensions.push_back(largestCellDimension(block.Data));
  }
  if (std::all_of(
        dimensions.begin(), dimensions.end(), [](int dimension) { return dimension == 0; }))
  {
    throw Failure("The input has no cells of a length, area or volume, so that it has no density; "
                  "Splat Mass makes one of points");
  }
  const FoundArray found = findArray(find, mayLack, blocks, dimensions);
  const char* name = found.Array->GetName();
  BlockArrays arrays;
  arrays.OnPoints = found.Association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  arrays.Dimension = dimensions[found.Block];
  std::vector<DensityBlock> kept;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    if (dimensions[b] < arrays.Dimension)
    {
      continue;
    }
    DensityBlock& block = blocks[b];
    vtkDataSetAttributes* attributes =
      block.Data->GetAttributes(arrays.OnPoints ? vtkDataObject::POINT : vtkDataObject::CELL);
    block.Array = b == found.Block ? found.Array : name ? attributes->GetArray(name) : nullptr;
    ++arrays.All;
    arrays.Without += block.Array ? 0 : 1;
    if (dimensions[b] == arrays.Dimension)
    {
      kept.push_back(block);
    }
  }
  blocks = std::move(kept);
  return arrays;
}

} // namespace RectifiedTransport
