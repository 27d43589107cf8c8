// SPDX-License-Identifier: BSD-3-Clause
// What all kinds of data say of an array that is no density.
#ifndef RectifiedTransport_DensityFailure_h
#define RectifiedTransport_DensityFailure_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Tables/Density.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

struct DensityRules;

// "density array 'Mass'".
std::string describeArray(vtkDataArray* array);

// Throws Failure where an array has not one tuple for each point or cell of `what`, its data set.
void requireTuples(vtkDataArray* array, vtkDataSet* data, bool onPoints, const std::string& what);

// Throws Failure for a Component that an array of `count` components has not.
void requireComponent(const std::string& name, int component, int count);

// Whether the largest displayed value is needed.
bool needsWhite(const DensityRules& rules, int components);

// Throws the Failure for values that are no density; `hasBlanks` as part of the reason.
[[noreturn]] void throwInvalidDensity(
  const std::string& name, const DensitySummary& summary, bool hasBlanks = false);

} // namespace RectifiedTransport

#endif
