// SPDX-License-Identifier: BSD-3-Clause
// A density in a larger box: with empty cells around its own.
#ifndef RectifiedTransport_PaddedDensity_h
#define RectifiedTransport_PaddedDensity_h

#include "Bridge/Run/Settings/MissingData.h"
#include "Core/Tables/Reading/DensityRules.h"

#include <memory>

namespace RectifiedTransport::Bridge
{

class InputDensity;

// The upper end of the range of the property Margin.
constexpr double LargestMargin = 10.0;

// The density with its box grown by `margin` times its longest axis, rounded up to whole cells, on
// every side of every axis. `rule` says what its empty cells count as. The density itself, which
// may be nullptr, if the margin is 0. Throws Failure if there are too many cells.
std::unique_ptr<InputDensity> withMargin(
  std::unique_ptr<InputDensity> density, double margin, const EmptyRule& rule);

} // namespace RectifiedTransport::Bridge

#endif
