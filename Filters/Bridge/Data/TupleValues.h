// SPDX-License-Identifier: BSD-3-Clause
// Tuples of arrays of any type, compared and as text.
#ifndef RectifiedTransport_TupleValues_h
#define RectifiedTransport_TupleValues_h

#include "Bridge/VTKCompatibility.h"

#include "vtkType.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Appends bytes that are the same for two tuples of an array exactly if their values are equal: as
// numbers of the array's type, or as texts. All NaNs are equal, and so are 0 and -0.
void appendTupleKey(vtkAbstractArray* array, vtkIdType tuple, std::string& key);

// All components, numbers with the digits that they need.
std::string tupleText(vtkAbstractArray* array, vtkIdType tuple);

} // namespace RectifiedTransport::Bridge

#endif
