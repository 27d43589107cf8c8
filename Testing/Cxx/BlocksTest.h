// SPDX-License-Identifier: BSD-3-Clause
// Composite inputs and outputs.
#ifndef BlocksTest_h
#define BlocksTest_h

#include "vtkAlgorithm.h"
#include "vtkExtractVOI.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
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

// The image in two tiles, the second from plane `cut` on along the first axis. The tiles of points
// share one plane of them; each has an origin and an extent of its own.
inline vtkSmartPointer<vtkMultiBlockDataSet> makeTiles(vtkImageData* image, int cut)
{
  auto tiles = makeBlocks({});
  int whole[6];
  image->GetExtent(whole);
  for (unsigned int tile = 0; tile < 2; ++tile)
  {
    vtkNew<vtkExtractVOI> part;
    part->SetInputData(image);
    part->SetVOI(tile == 0 ? whole[0] : whole[0] + cut, tile == 0 ? whole[0] + cut : whole[1],
      whole[2], whole[3], whole[4], whole[5]);
    part->Update();
    vtkNew<vtkImageData> moved;
    moved->ShallowCopy(part->GetOutput());
    double origin[3];
    int extent[6];
    moved->GetExtent(extent);
    moved->TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], origin);
    moved->SetOrigin(origin);
    moved->SetExtent(0, extent[1] - extent[0], 0, extent[3] - extent[2], 0, extent[5] - extent[4]);
    tiles->SetBlock(tile, moved);
  }
  return tiles;
}

// A block of an algorithm's first output; null if it is not there, or of another type.
template <class Data>
Data* outputBlock(vtkAlgorithm* algorithm, unsigned int block)
{
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(algorithm->GetOutputDataObject(0));
  return blocks ? Data::SafeDownCast(blocks->GetBlock(block)) : nullptr;
}

#endif
