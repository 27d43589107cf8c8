// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/GatheredBlocks.h"

#include "Bridge/Ranks/GatheredParts.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkAbstractArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"

#include <utility>

namespace RectifiedTransport
{

namespace
{

DataContent contentOf(const std::vector<DensityBlock>& blocks)
{
  DataContent content;
  for (const DensityBlock& block : blocks)
  {
    content.AddNumber(static_cast<std::uint64_t>(block.Number));
    addGeometry(block, content);
    for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      vtkDataSetAttributes* attributes = block.Data->GetAttributes(owner);
      for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
      {
        content.AddArray(attributes->GetAbstractArray(i));
        content.AddNumber(static_cast<std::uint64_t>(attributes->IsArrayAnAttribute(i)));
      }
    }
  }
  return content;
}

} // namespace

const std::vector<DensityBlock>& GatheredBlocks::Gather(
  const std::vector<DensityBlock>& own, const Ranks& ranks, Progress& progress)
{
  DataContent content = contentOf(own);
  if (onAllRanks(ranks, this->HasBlocks && content.IsSameAs(this->Content, progress)))
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
    const auto time = static_cast<std::uint64_t>(part.Data->GetMTime());
    this->Blocks.push_back({ part.Data, part.Name, part.Number, time });
  }
  content.Keep(progress);
  this->Content = std::move(content);
  this->HasBlocks = true;
  return this->Blocks;
}

} // namespace RectifiedTransport
