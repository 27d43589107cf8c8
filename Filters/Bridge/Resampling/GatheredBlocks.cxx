// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Resampling/GatheredBlocks.h"

#include "Bridge/Ranks/GatheredParts.h"

#include "vtkAbstractArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"

namespace RectifiedTransport
{

namespace
{

std::vector<std::uint64_t> contentOf(const std::vector<DensityBlock>& blocks)
{
  std::vector<std::uint64_t> content;
  for (const DensityBlock& block : blocks)
  {
    content.push_back(static_cast<std::uint64_t>(block.Number));
    content.insert(content.end(), block.Geometry.begin(), block.Geometry.end());
    for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      vtkDataSetAttributes* attributes = block.Data->GetAttributes(owner);
      for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
      {
        vtkAbstractArray* array = attributes->GetAbstractArray(i);
        content.push_back(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(array)));
        content.push_back(static_cast<std::uint64_t>(array->GetMTime()));
        content.push_back(static_cast<std::uint64_t>(attributes->IsArrayAnAttribute(i)));
      }
    }
  }
  return content;
}

} // namespace

const std::vector<DensityBlock>& GatheredBlocks::Gather(
  const std::vector<DensityBlock>& own, const Ranks& ranks)
{
  std::vector<std::uint64_t> content = contentOf(own);
  if (onAllRanks(&ranks, this->HasBlocks && content == this->Content))
  {
    return this->Blocks;
  }
  *this = GatheredBlocks();
  std::vector<DataPart> parts;
  for (const DensityBlock& block : own)
  {
    parts.push_back({ block.Number, block.Name, block.Data });
  }
  const GatheredParts gathered = gatherDataParts(parts, ranks, Receivers::All);
  for (const DataPart& part : gathered.Parts)
  {
    for (DensityBlock block : densityBlocks(part.Data))
    {
      block.Name = part.Name;
      block.Number = part.Number;
      this->Blocks.push_back(block);
    }
  }
  this->Content = std::move(content);
  this->HasBlocks = true;
  return this->Blocks;
}

} // namespace RectifiedTransport
