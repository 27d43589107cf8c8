// SPDX-License-Identifier: BSD-3-Clause
// Composite inputs, of which the executive gives a filter one block at a time.
#ifndef BlocksTest_h
#define BlocksTest_h

#include "vtkAlgorithm.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSmartPointer.h"

#include <vector>

// Where one is null there is no block.
inline vtkSmartPointer<vtkMultiBlockDataSet> makeBlocks(const std::vector<vtkDataObject*>& all)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    blocks->SetBlock(static_cast<unsigned int>(i), all[i]);
  }
  return blocks;
}

// A block of an algorithm's first output; null if it is not there, or of another type.
template <class Data>
Data* outputBlock(vtkAlgorithm* algorithm, unsigned int block)
{
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(algorithm->GetOutputDataObject(0));
  return blocks ? Data::SafeDownCast(blocks->GetBlock(block)) : nullptr;
}

#endif
