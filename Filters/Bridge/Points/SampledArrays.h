// SPDX-License-Identifier: BSD-3-Clause
// The arrays of data sets at points in their cells.
#ifndef RectifiedTransport_SampledArrays_h
#define RectifiedTransport_SampledArrays_h

#include "Bridge/VTKCompatibility.h"

#include "vtkType.h"

#include <cstdint>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
class vtkPointData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// A place in a data set: between points that have weights, and in a cell.
struct SampledPlace
{
  vtkIdType Points[8];
  double Weights[8];
  int Count;      // of points
  vtkIdType Cell; // -1 for a place in none: values are NaN, or 0 for types without NaN
  int Set = 0;    // which of the data sets
};

class SampledPlaces
{
public:
  virtual ~SampledPlaces() = default;

  virtual std::int64_t Count() const = 0;
  // On any thread.
  virtual SampledPlace Find(std::int64_t place) const = 0;
  // The same for `count` places from `first` on; for a place it writes only as many points as it
  // has.
  virtual void FindBlock(std::int64_t first, std::int64_t count, SampledPlace* found) const
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      found[i] = this->Find(first + i);
    }
  }
};

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
void sampleArrays(
  const ArraySource& source, const SampledPlaces& places, Progress& progress, vtkPointData* output);

} // namespace RectifiedTransport::Bridge

#endif
