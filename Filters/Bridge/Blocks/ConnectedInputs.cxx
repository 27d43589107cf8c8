// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/ConnectedInputs.h"

#include "Core/Messages/Failure.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkHyperTreeGrid.h"
#include "vtkInformationVector.h"

namespace RectifiedTransport::Bridge
{

namespace
{

void addBlocks(
  vtkDataObject* data, bool blocksAreInputs, int port, int connection, ConnectedInputs& all)
{
  auto* composite = blocksAreInputs ? vtkCompositeDataSet::SafeDownCast(data) : nullptr;
  if (!composite)
  {
    all.All.push_back({ data, port, connection, "" });
    return;
  }
  for (const Leaf& leaf : leavesOf(composite))
  {
    if (vtkDataSet::SafeDownCast(leaf.Data) || vtkHyperTreeGrid::SafeDownCast(leaf.Data))
    {
      all.All.push_back({ leaf.Data, port, connection, leaf.Name });
      continue;
    }
    all.Skipped.Add(leaf.Data, leaf.Text());
  }
}

} // namespace

ConnectedInputs gatherBlocks(vtkDataObject* data, bool blocksAreInputs)
{
  ConnectedInputs all;
  addBlocks(data, blocksAreInputs, 0, 0, all);
  return all;
}

ConnectedInputs gatherInputs(
  vtkInformationVector** inputVector, int numberOfPorts, bool blocksAreInputs)
{
  ConnectedInputs all;
  for (int port = 0; port < numberOfPorts; ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      addBlocks(vtkDataObject::GetData(inputVector[port], i), blocksAreInputs, port, i, all);
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

std::string describeSkipped(const ConnectedInputs& connected)
{
  const SkippedLeaves& skipped = connected.Skipped;
  if (skipped.Count > 0 && connected.All.empty())
  {
    failSkipped("The inputs have", skipped.Count, skipped);
  }
  return skipped.Count == 0 ? ""
                            : blocksText(skipped.Count) + " of the inputs" + skipped.FirstText() +
      (skipped.Count == 1 ? " is" : " are") + " no data set of cells and passed over";
}

} // namespace RectifiedTransport::Bridge
