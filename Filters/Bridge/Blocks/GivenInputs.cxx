// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/GivenInputs.h"

#include "Bridge/Blocks/BlockName.h"
#include "Bridge/Run/Failure.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkHyperTreeGrid.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkSmartPointer.h"

namespace RectifiedTransport::Bridge
{

GivenInputs gatherBlocks(vtkDataObject* data, bool blocksAreInputs)
{
  GivenInputs given;
  auto* composite = blocksAreInputs ? vtkCompositeDataSet::SafeDownCast(data) : nullptr;
  if (!composite)
  {
    given.All.push_back({ data, 0, 0, false, "" });
    return given;
  }
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    vtkDataObject* leaf = leaves->GetCurrentDataObject();
    if (vtkDataSet::SafeDownCast(leaf) || vtkHyperTreeGrid::SafeDownCast(leaf))
    {
      vtkInformation* about = leaves->HasCurrentMetaData() ? leaves->GetCurrentMetaData() : nullptr;
      const char* name = about ? about->Get(vtkCompositeDataSet::NAME()) : nullptr;
      given.All.push_back({ leaf, 0, 0, true, name ? name : "" });
    }
    else
    {
      given.FirstOther = given.Others++ == 0
        ? std::string(leaf->GetClassName()) + ", " + nameOfBlock(leaves)
        : given.FirstOther;
    }
  }
  return given;
}

GivenInputs gatherInputs(
  vtkInformationVector** inputVector, int numberOfPorts, bool blocksAreInputs)
{
  GivenInputs all;
  for (int port = 0; port < numberOfPorts; ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      GivenInputs given =
        gatherBlocks(vtkDataObject::GetData(inputVector[port], i), blocksAreInputs);
      all.FirstOther = all.Others == 0 ? given.FirstOther : all.FirstOther;
      all.Others += given.Others;
      for (GivenInput& input : given.All)
      {
        input.Port = port;
        input.Connection = i;
        all.All.push_back(input);
      }
    }
  }
  return all;
}

void requireSameNumber(std::size_t inputs, const Ranks& ranks)
{
  const std::vector<std::size_t> all = gatherValues(ranks, inputs);
  for (std::size_t rank = 1; rank < all.size(); ++rank)
  {
    if (all[rank] != all.front())
    {
      throw Failure("The number of inputs is " + std::to_string(all.front()) + " on rank 0, but " +
        std::to_string(all[rank]) + " on rank " + std::to_string(rank) +
        "; all ranks must have the same inputs and blocks");
    }
  }
}

std::string describeOthers(const GivenInputs& given)
{
  const std::string first = " (the first a " + given.FirstOther + ")";
  if (given.Others > 0 && given.All.empty())
  {
    throw Failure("The inputs have no image, mesh or grid, but " + std::to_string(given.Others) +
      (given.Others == 1 ? " block" : " blocks") + " of another type" + first);
  }
  return given.Others == 0 ? ""
                           : std::to_string(given.Others) +
      (given.Others == 1 ? " block of the inputs" : " blocks of the inputs") + first +
      (given.Others == 1 ? " is" : " are") + " no data set of cells and passed over";
}

} // namespace RectifiedTransport::Bridge
