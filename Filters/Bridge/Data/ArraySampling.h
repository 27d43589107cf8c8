// SPDX-License-Identifier: BSD-3-Clause
// The arrays of data sets at points in their cells.
#ifndef RectifiedTransport_ArraySampling_h
#define RectifiedTransport_ArraySampling_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/Points.h"
#include "Core/Resampling/ProbeLocations.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
class vtkImageData;
class vtkPointData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct ArraySource
{
  std::vector<vtkDataSet*> Sets;
  const char* Name; // in messages
  bool KeepActive;  // whether active attributes of points stay active, if there are no others
};

// For several data sets, samples the arrays that all have with one type and number of components.
//
// Adds the point arrays, interpolated, and the values of the cell arrays at the given places to the
// data of points, except names that exist already, ghost arrays, ids of points and global ids.
// Throws Failure and Cancelled.
void sampleArrays(const ArraySource& source, const ProbeLocations& places, Progress& progress,
  vtkPointData* output);

// The same for particles in a part of an image on a grid.
void sampleImage(vtkImageData* part, const ImageGrid& grid, const Extent& extent,
  ConstPointSpan<3> particles, Progress& progress, vtkPointData* output);

} // namespace RectifiedTransport::Bridge

#endif
