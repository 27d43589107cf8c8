// SPDX-License-Identifier: BSD-3-Clause
// The arrays of points or cells, copied by their ids.
#ifndef RectifiedTransport_TupleCopy_h
#define RectifiedTransport_TupleCopy_h

#include "Bridge/VTKCompatibility.h"

#include "vtkType.h"

#include <cstdint>
#include <functional>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkIdList;
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct TupleSource
{
  vtkDataSetAttributes* From;
  vtkIdType Count;   // the number of its points or cells
  const char* Owner; // "point" or "cell"
  const char* Name;  // the name of the data set, in messages
};

// Throws Failure if the array has too few tuples for `count` points or cells (`owner`) of the data
// set of this name.
void requireTuples(
  vtkAbstractArray* array, vtkIdType count, const std::string& owner, const std::string& name);
// The same for all arrays of points and of cells.
void requireTuples(vtkDataSet* data, const std::string& name);

// Copies the arrays of the source: element i of `count` gets the tuples of element idOf(i). What
// `to` copies is for the caller to set. Throws Failure if an array has too few tuples or there is
// no memory, and Cancelled.
void copyTuples(const TupleSource& source, std::int64_t count,
  const std::function<vtkIdType(vtkIdType)>& idOf, vtkDataSetAttributes* to, Progress& progress);

// Copies the points of these ids with all their arrays, and the field data.
void copyPoints(vtkPointSet* from, vtkIdList* ids, vtkPointSet* to);

} // namespace RectifiedTransport::Bridge

#endif
