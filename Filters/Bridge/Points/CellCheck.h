// SPDX-License-Identifier: BSD-3-Clause
// Whether the cells of a data set can be read: files may be damaged, and VTK does not check.
#ifndef RectifiedTransport_CellCheck_h
#define RectifiedTransport_CellCheck_h

#include "Bridge/VTKCompatibility.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Throws Failure that names the first cell that has points which the data set, called `name`, does
// not have, of a type that VTK does not know, or with too few points for its type; for cell arrays
// whose offsets are not in order, for lattices with more places than points or coordinates, and for
// ghost arrays of another length than points or cells have.
// Reads all ids, nothing else.
void requireReadableCells(vtkDataSet* data, const std::string& name);

} // namespace RectifiedTransport

#endif
