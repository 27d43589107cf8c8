// SPDX-License-Identifier: BSD-3-Clause
// Arrays of VTK that the core reads as densities: names in messages, checks, readers.
#ifndef RectifiedTransport_ArrayReader_h
#define RectifiedTransport_ArrayReader_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Messages/Failure.h"
#include "Core/Tables/Reading/DensityReader.h"

#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkDataSet;
class vtkFieldData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// "density array 'Mass'".
std::string describeArray(vtkDataArray* array);

// Throws Failure unless an array has one tuple for each point or cell of its data set, `what`.
void requireTuples(vtkDataArray* array, vtkDataSet* data, bool onPoints, const std::string& what);

// The rules with the component that is taken of an array, which messages call `name`. Throws
// Failure if the array does not have it.
DensityRules resolveRules(vtkDataArray* array, const std::string& name, const DensityRules& rules);

// What netCDF and GDAL write: _FillValue, missing_value, NO_DATA_VALUE. `fields` may be nullptr.
std::vector<FillValue> fillValuesOf(vtkFieldData* fields);

// Reads any value type and memory layout. `rules` have the component that is taken, not Auto.
std::unique_ptr<DensityReader> makeDensityReader(vtkDataArray* array, const DensityRules& rules);

} // namespace RectifiedTransport::Bridge

#endif
