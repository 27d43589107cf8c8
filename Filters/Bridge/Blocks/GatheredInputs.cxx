// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/GatheredInputs.h"

#include "Bridge/Ranks/GatheredData.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Ranks/RankConsistency.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointSet.h"

#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// What decides whether the blocks of this rank are those of the last run: their numbers, cells and
// all arrays, as all of these are sent to the other ranks.
DataIdentity contentOf(const std::vector<DensityBlock>& blocks)
{
  DataIdentity content;
  for (const DensityBlock& block : blocks)
  {
    content.AddNumber(static_cast<std::uint64_t>(block.Number));
    addGeometry(block, content);
    addArrays(block, content);
  }
  return content;
}

// The blocks in the order of their numbers, or of those of their wholes, as gatherDataParts expects
// them. The data are shared, not copied.
std::vector<DataPart> partsOf(
  const std::vector<DensityBlock>& blocks, std::int64_t DensityBlock::*number)
{
  std::vector<DataPart> parts;
  for (const DensityBlock& block : blocks)
  {
    parts.push_back({ block.*number, block.Name, block.Data });
  }
  return parts;
}

// The first rank gets the whole image and the others an empty extent, as it alone runs the filter.
vtkSmartPointer<vtkDataObject> gatherImage(vtkImageData* own, const Ranks& ranks)
{
  const ImagePieces pieces(own, ranks);
  const Extent none{ 0, -1, 0, -1, 0, -1 };
  return pieces.Gather(ranks.Own() == 0 ? pieces.Whole() : none);
}

// Gathers data sets as blocks of one; the parts that ranks have of one data set stay its pieces. If
// every rank has all parts already, its own data are returned.
vtkSmartPointer<vtkDataObject> gatherBlocks(vtkDataObject* own, const Ranks& ranks)
{
  const GatheredParts gathered =
    gatherDataParts(partsOf(densityBlocks(own, nullptr, nullptr, ranks), &DensityBlock::Whole),
      ranks, Receivers::First);
  if (gathered.AreWhole)
  {
    return own;
  }
  if (gathered.Parts.size() == 1)
  {
    return gathered.Parts.front().Data;
  }
  const auto all = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
  std::int64_t last = -1;
  for (const DataPart& part : gathered.Parts)
  {
    const unsigned int sets = all->GetNumberOfPartitionedDataSets();
    const unsigned int set = part.Number == last ? sets - 1 : sets;
    all->SetPartition(set, set < sets ? all->GetNumberOfPartitions(set) : 0, part.Data);
    last = part.Number;
  }
  return all;
}

// The data of all ranks as one object on the first rank. Ranks without data take part with nullptr.
vtkSmartPointer<vtkDataObject> gatherAny(vtkDataObject* own, GatheredKind kind, const Ranks& ranks)
{
  if (kind != GatheredKind::Density)
  {
    if (!onAllRanks(ranks, !vtkCompositeDataSet::SafeDownCast(own)))
    {
      throw Failure("A point set that is read as a whole has blocks, which several ranks cannot "
                    "gather; make one of them, with Merge Blocks");
    }
    return gatherPoints(vtkPointSet::SafeDownCast(own), ranks, Receivers::First,
      kind == GatheredKind::Surface ? PointSetKind::Surface : PointSetKind::Points);
  }
  auto* image = vtkImageData::SafeDownCast(own);
  const bool hasPoints = own && own->GetNumberOfElements(vtkDataObject::POINT) > 0;
  // Pieces of one image are joined exactly, cell by cell. Other data become blocks of one data set.
  // All ranks must take the same way, as each way is collective.
  const char* type = !hasPoints ? "" : image ? "an image" : "no image";
  return requireSameOnRanks(ranks, type, "The density is ") == "an image"
    ? gatherImage(image, ranks)
    : gatherBlocks(own, ranks);
}

} // namespace

const std::vector<DensityBlock>& GatheredBlocks::Gather(
  const std::vector<DensityBlock>& own, const Ranks& ranks, Progress& progress)
{
  DataIdentity content = contentOf(own);
  // Blocks are gathered again if they changed on any rank; a rank that kept its own would not take
  // part in the exchange.
  if (onAllRanks(ranks, content.IsSameAs(this->Content, progress)))
  {
    return this->Blocks;
  }
  *this = GatheredBlocks();
  // Gathered data sets stay until a block of some rank changes, so that their own times identify
  // them.
  for (const DataPart& part :
    gatherDataParts(partsOf(own, &DensityBlock::Number), ranks, Receivers::All).Parts)
  {
    const auto time = static_cast<std::uint64_t>(part.Data->GetMTime());
    this->Blocks.push_back({ part.Data, part.Name, part.Number, time });
  }
  content.Hash(progress);
  this->Content = std::move(content);
  return this->Blocks;
}

GatheredInputs::GatheredInputs(
  vtkInformationVector** inputs, const std::map<int, GatheredKind>& kinds, const Ranks& ranks)
{
  for (const auto& [port, kind] : kinds)
  {
    const auto vector = vtkSmartPointer<vtkInformationVector>::New();
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      // The information is copied, because that of the pipeline must keep this rank's own data. All
      // other keys, such as times and whole extents, stay as they are.
      vtkInformation* input = inputs[port]->GetInformationObject(i);
      vtkNew<vtkInformation> copy;
      copy->Copy(input);
      const auto all = gatherAny(vtkDataObject::GetData(input), kind, ranks);
      copy->Set(vtkDataObject::DATA_OBJECT(), ranks.Own() == 0 ? all.Get() : nullptr);
      vector->Append(copy);
    }
    this->Made.push_back(vector);
    this->Pointers.push_back(vector);
  }
}

} // namespace RectifiedTransport::Bridge
