// SPDX-License-Identifier: BSD-3-Clause
#include "Input.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkRectilinearGrid.h"
#include "vtkTable.h"

namespace Campaign
{

namespace
{

vtkSmartPointer<vtkDataObject> drawComposite(RandomSource& random, vtkDataObject* block)
{
  if (random.Chance(0.3))
  {
    const auto parts = vtkSmartPointer<vtkPartitionedDataSet>::New();
    parts->SetPartition(0, block);
    return parts;
  }
  const auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const auto count = static_cast<unsigned int>(random.Whole(0, 3));
  for (unsigned int i = 0; i < count; ++i)
  {
    const bool same = random.Chance(0.6);
    blocks->SetBlock(i, same ? block : nullptr);
    if (!same && random.Chance(0.5))
    {
      blocks->SetBlock(i, drawImage(random).Data);
    }
  }
  return blocks;
}

} // namespace

void drawUnusual(RandomSource& random, Input& input)
{
  if (!random.Chance(0.03))
  {
    return;
  }
  input.IsPlain = false;
  input.Values = nullptr;
  input.Series = nullptr;
  input.Condition = State::Open;
  switch (random.Whole(0, 5))
  {
    case 0:
      input.Data = nullptr;
      break;
    case 1:
      input.Data = vtkSmartPointer<vtkTable>::New();
      break;
    case 2:
      input.Data = vtkSmartPointer<vtkRectilinearGrid>::New();
      break;
    default:
      input.Data = drawComposite(random, input.Data);
      break;
  }
  input.Describe(input.Data ? input.Data->GetClassName() : "nothing");
}

} // namespace Campaign
