// SPDX-License-Identifier: BSD-3-Clause
// Errors for arrays that are no density.
#ifndef RectifiedTransport_DensityFailure_h
#define RectifiedTransport_DensityFailure_h

#include "Core/Tables/Density.h"
#include "Core/Tables/Reading/DensityRules.h"

#include <string>

namespace RectifiedTransport
{

// Returns what the property Component selects from an array with `count` components, of which Auto
// takes `automatic`: an index, Luminance or Magnitude. Throws Failure if the array does not have
// it.
int resolveComponent(const std::string& name, int component, int automatic, int count);

// Throws the Failure for values that are no density; `hasEmpty` is part of the reason.
[[noreturn]] void throwInvalidDensity(const std::string& name, const DensitySummary& summary,
  const MissingValues& missing, bool hasEmpty = false);

} // namespace RectifiedTransport

#endif
