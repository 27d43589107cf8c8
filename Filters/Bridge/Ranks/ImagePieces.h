// SPDX-License-Identifier: BSD-3-Clause
// An image that is distributed over ranks.
#ifndef RectifiedTransport_ImagePieces_h
#define RectifiedTransport_ImagePieces_h

#include "Bridge/Ranks/CommonArrays.h"
#include "Bridge/Ranks/TruncatedArrays.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Distributed/ImagePiece.h"
#include "Core/Geometry/Distributed/PlaceOwners.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Which part of one whole image each rank has. Points and cells that ghost arrays mark as
// duplicates belong to another rank. If several ranks have the same points or cells, they belong to
// the lowest rank.
class ImagePieces
{
public:
  // `own` may be nullptr or without points. Collective. Throws Failure for images that are not
  // parts of one image, or do not fill it.
  ImagePieces(vtkImageData* own, const Ranks& ranks);

  // Empty if no rank has points.
  const Extent& Whole() const { return this->Joined.Whole; }
  // The extents of the points of each rank, without duplicates.
  const std::vector<Extent>& Points() const { return this->Joined.Points; }
  // The extents of the corners of each rank's cells, without duplicates.
  const std::vector<Extent>& Cells() const { return this->Joined.Cells; }
  const Ranks& Group() const { return this->Processes; }
  vtkImageData* OwnImage() const;
  // The arrays that can be gathered.
  const ArrayKinds& Kinds() const { return this->Arrays; }
  // An image of the whole extent, without arrays.
  vtkSmartPointer<vtkImageData> MakeFrame() const;

  // The part of the whole image in an extent. It may be empty and may differ between ranks. With
  // the ghost arrays and, among the arrays that all ranks with data have, those of these names, or
  // all, of which those that are too short on a rank have no tuples. Collective. Throws
  // std::bad_alloc.
  vtkSmartPointer<vtkImageData> Gather(
    const Extent& wanted, const std::vector<std::string>& names = {}) const;

private:
  vtkSmartPointer<vtkImageData> MakeImage(Extent extent) const;

  const Ranks& Processes;
  const vtkSmartPointer<vtkImageData> Own;
  TruncatedArrays TooShort; // on any rank
  ArrayKinds Arrays;
  JoinedPieces Joined;
};

// The rank that owns a position is one that holds its cell. Without pieces (nullptr) the grid is
// divided among the ranks.
PlaceOwners ownersOf(const ImageGrid& grid, const ImagePieces* pieces, const Ranks& ranks);

// If the first rank has an image and the others have none: gives each rank the extent that is
// requested of its output, with all arrays; announces the whole extent. Field data stay.
// Collective.
void distributeImage(vtkImageData* image, vtkInformation* output, const Ranks& ranks);

} // namespace RectifiedTransport::Bridge

#endif
