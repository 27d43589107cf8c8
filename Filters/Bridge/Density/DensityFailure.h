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

namespace RectifiedTransport::Bridge
{

struct DensityRules;
struct MissingValues;

// "density array 'Mass'".
std::string describeArray(vtkDataArray* array);

// Throws Failure unless an array has one tuple for each point or cell of its data set, `what`.
void requireTuples(vtkDataArray* array, vtkDataSet* data, bool onPoints, const std::string& what);

// What the property Component takes of an array of a VTK type with `count` components: an index,
// Luminance or Magnitude. Throws Failure if the array does not have it.
int takenComponent(const std::string& name, int component, int type, int count);

// With rules whose component is the one that is taken: whether the density comes from several
// components; whether it needs the largest displayed value; whether this is the type's, 255.
bool isOfSeveral(const DensityRules& rules);
bool needsWhite(const DensityRules& rules, int components);
bool hasDisplayedWhite(const DensityRules& rules, int type);

// Throws the Failure for values that are no density; `hasEmpty` is part of the reason.
[[noreturn]] void throwInvalidDensity(const std::string& name, const DensitySummary& summary,
  const MissingValues& missing, bool hasEmpty = false);

} // namespace RectifiedTransport::Bridge

#endif
