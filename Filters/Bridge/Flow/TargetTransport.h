// SPDX-License-Identifier: BSD-3-Clause
// What moves points from one density to another, kept by a filter until a density or a setting
// changes: the flow of the target's density, and the optimal map between both.
#ifndef RectifiedTransport_TargetTransport_h
#define RectifiedTransport_TargetTransport_h

#include "Bridge/Density/ContentHash.h"
#include "Bridge/Density/FlowCache.h"
#include "Bridge/Settings/OptimalSettings.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/OptimalMap/OptimalMap.h"

#include <memory>
#include <string>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// The two densities of a map, and the box that holds both.
struct DensityPair
{
  // Throws Failure for grids of different axes, planes or directions.
  DensityPair(InputDensity& source, const std::string& sourceName, InputDensity& target,
    const std::string& targetName);

  InputDensity& Source;
  InputDensity& Target;
  std::string SourceName; // in messages
  std::string TargetName;
  ImageGrid Box;
};

class TargetTransport
{
public:
  // Of the target.
  FlowCache Tables;

  // The optimal map between two densities, solved, in LengthScale's units of their box; nullptr if
  // the setting needs none. Collective. Throws Failure and Cancelled.
  template <int D>
  std::shared_ptr<const OptimalMap<D>> Map(
    const DensityPair& pair, const OptimalSetting& setting, Progress& progress);
  // Whether Map probably solves.
  bool MustSolve(const DensityPair& pair, const OptimalSetting& setting) const
  {
    return setting.NeedsMap() && !(this->IsFor(pair, setting) && this->HasTimesOf(pair));
  }

private:
  bool IsFor(const DensityPair& pair, const OptimalSetting& setting) const;
  bool HasTimesOf(const DensityPair& pair) const
  {
    return this->Source.IsOf(pair.Source) && this->Target.IsOf(pair.Target);
  }

  std::shared_ptr<const void> Kept;
  ContentHash Source;
  ContentHash Target;
  ImageGrid SourceGrid;
  ImageGrid TargetGrid;
  OptimalSetting Setting;
};

} // namespace RectifiedTransport::Bridge

#endif
