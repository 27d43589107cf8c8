// SPDX-License-Identifier: BSD-3-Clause
// Errors for arrays that are no density, for all kinds of data.
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
struct MissingValues;

// "density array 'Mass'".
std::string describeArray(vtkDataArray* array);

// Throws Failure unless an array has one tuple for each point or cell of its data set, `what`.
void requireTuples(vtkDataArray* array, vtkDataSet* data, bool onPoints, const std::string& what);

// Throws Failure if an array of `count` components does not have this Component.
void requireComponent(const std::string& name, int component, int count);

// Whether the density is the luminance of several components.
bool isColour(const DensityRules& rules, int components);

// Whether the largest displayed value is needed.
bool needsWhite(const DensityRules& rules, int components);

// Throws the Failure for values that are no density; `hasEmpty` is part of the reason.
[[noreturn]] void throwInvalidDensity(const std::string& name, const DensitySummary& summary,
  const MissingValues& missing, bool hasEmpty = false);

} // namespace RectifiedTransport

#endif
