// SPDX-License-Identifier: BSD-3-Clause
// The arrays of data sets on several ranks, by their kinds.
#ifndef RectifiedTransport_CommonArrays_h
#define RectifiedTransport_CommonArrays_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Distributed/ArrayKinds.h"
#include "Core/Geometry/Distributed/TupleMemory.h"
#include "Core/Parallel/Ranks.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkDataSet;
class vtkDataSetAttributes;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The kind of an array of points or cells (`owner`), without the names of components.
ArrayKind kindOf(vtkDataSetAttributes* attributes, int array, int owner);
bool isGhosts(const ArrayKind& kind);
// The numeric array of this kind in a data set, which may be nullptr; nullptr if there is none.
// Contiguous: a copy if the array is not.
vtkSmartPointer<vtkDataArray> findArray(const ArrayKind& kind, vtkDataSet* data);
// Adds an array of this number of tuples to a data set; nullptr if it is not numeric.
vtkSmartPointer<vtkDataArray> addArray(const ArrayKind& kind, vtkDataSet* data, vtkIdType tuples);

// The numeric arrays that all ranks with points have, in the order of the first of these ranks, and
// the ghost arrays of any rank. `data` may be nullptr. Collective. Throws Failure for an array with
// too few tuples.
ArrayKinds commonArrays(vtkDataSet* data, const Ranks& ranks);

// The tuples of a contiguous array; zeros of one byte for nullptr.
TupleMemory tuplesIn(vtkDataArray* array);

} // namespace RectifiedTransport::Bridge

#endif
