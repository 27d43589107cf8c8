// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/DistributedImage.h"

#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Ranks/DataSetBytes.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Ranks/SameOnRanks.h"

#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace RectifiedTransport
{

namespace
{

// As those of a data set.
vtkSmartPointer<vtkDataSet> fieldsOfFirst(vtkFieldData* own, const Ranks& ranks)
{
  Bytes bytes;
  if (ranks.Own() == 0)
  {
    vtkNew<vtkPoints> point; // without any VTK sends text, which rounds
    point->InsertNextPoint(0.0, 0.0, 0.0);
    vtkNew<vtkPolyData> fields;
    fields->SetPoints(point);
    fields->GetFieldData()->ShallowCopy(own);
    bytes = bytesOfDataSet(fields);
  }
  const Bytes first = ranks.Gather(bytes).front();
  return dataSetOfBytes(first.data(), first.size());
}

} // namespace

void distributeImage(vtkImageData* image, vtkInformation* output, const Ranks& ranks)
{
  const ImagePieces pieces(image, ranks);
  const vtkSmartPointer<vtkDataSet> fields = fieldsOfFirst(image->GetFieldData(), ranks);
  if (isEmpty(pieces.Whole()))
  {
    return;
  }
  const ImageGrid grid = gridOf(pieces.MakeFrame(), false);
  const Extent wanted = extentToGive(grid.Extent(), output, ranks);
  const vtkSmartPointer<vtkImageData> part = pieces.Gather(wanted);
  image->ShallowCopy(part);
  image->GetFieldData()->ShallowCopy(fields->GetFieldData());
  announceGrid(grid, output);
}

} // namespace RectifiedTransport
