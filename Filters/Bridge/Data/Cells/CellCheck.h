// SPDX-License-Identifier: BSD-3-Clause
// Whether the cells of a data set can be read. Files may be damaged, and VTK does not check.
#ifndef RectifiedTransport_CellCheck_h
#define RectifiedTransport_CellCheck_h

#include "Bridge/VTKCompatibility.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Throws Failure for a cell with points that the data set, called `name`, does not have, of a type
// unknown to VTK, or with too few points for its type, and names the first one. Also for cell
// arrays whose offsets are not in order, for lattices with more places than points or coordinates,
// and for ghost arrays of a wrong length. Reads only the ids.
void requireReadableCells(vtkDataSet* data, const std::string& name);

} // namespace RectifiedTransport::Bridge

#endif
