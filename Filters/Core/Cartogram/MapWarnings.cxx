// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/MapWarnings.h"

#include "Core/Geometry/PointBounds.h"
#include "Core/Messages/PartText.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

std::size_t indexOf(std::int32_t region)
{
  return static_cast<std::size_t>(region);
}

// The regions that miss the tolerance, and why.
class MissedRegions
{
public:
  MissedRegions(const CartogramResult& result, const std::vector<double>& masses,
    const std::vector<std::string>& names, double tolerance)
    : Result(result)
    , Names(names)
  {
    double missed = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < result.Errors.size(); ++i)
    {
      // Counts the missed regions, notes whether any of them overlaps others, and finds the worst
      // one.
      const bool isMissed = std::abs(result.Errors[i]) > tolerance;
      this->Count += isMissed ? 1 : 0;
      missed += isMissed ? masses[i] : 0.0;
      all += masses[i];
      this->AreOnOthers = this->AreOnOthers || (isMissed && result.Overlaps[i] > tolerance);
      this->Worst =
        std::abs(result.Errors[i]) > std::abs(result.Errors[this->Worst]) ? i : this->Worst;
    }
    // Specks of a map would interrupt its user each time.
    constexpr double least = 0.01;
    this->AreWorthAWarning = missed >= least * all && this->Count > 0;
  }

  std::int64_t Number() const { return this->Count; }

  void Add(std::vector<std::string>& warnings) const
  {
    if (!this->AreWorthAWarning)
    {
      return;
    }
    const auto regions = static_cast<std::int64_t>(this->Names.size());
    // The number comes first, then the reason that helps most.
    const std::string part = describePart(this->Count, regions, "regions") + " miss Tolerance";
    warnings.push_back(part + (this->Result.OutOfReach.empty() ? this->Farthest() : this->Small()));
  }

private:
  // Names the worst region; the remedy depends on whether regions overlap.
  std::string Farthest() const
  {
    return " (the region " + this->Names[this->Worst] + " by " +
      percentText(std::abs(this->Result.Errors[this->Worst])) + "); " +
      (this->AreOnOthers
          ? "regions on each other cannot all have their areas: leave one of them in "
            "each place, with Threshold"
          : "raise MaximumIterations or Resolution");
  }

  // Names the regions that are too small for cells of the raster, up to five of them.
  std::string Small() const
  {
    constexpr std::size_t most = 5;
    const std::vector<std::int32_t>& small = this->Result.OutOfReach;
    std::ostringstream text;
    text << "; the raster cannot hold the region" << (small.size() > 1 ? "s" : "");
    for (std::size_t i = 0; i < std::min(most, small.size()); ++i)
    {
      text << (i == 0 ? " " : ", ") << this->Names[indexOf(small[i])] << " (off by "
           << percentText(std::abs(this->Result.Errors[indexOf(small[i])])) << ")";
    }
    text << (small.size() > most ? ", ..." : "")
         << ": raise Resolution, or enlarge small regions with MinimumShare";
    return text.str();
  }

  const CartogramResult& Result;
  const std::vector<std::string>& Names;
  std::int64_t Count = 0;
  std::size_t Worst = 0;
  bool AreOnOthers = false;
  bool AreWorthAWarning = false;
};

} // namespace

bool looksLikeDegrees(const std::vector<Point<3>>& places)
{
  // Degrees of a country's latitude, or of a large map's extent.
  constexpr double wide = 20.0;
  const auto bounds = Bounds<2>::Of(places);
  const Point<2>& low = bounds.Low;
  const Point<2>& high = bounds.High;
  // The borders of the earth, with some rounding of files.
  const bool isOnEarth =
    low[0] >= -180.001 && high[0] <= 180.001 && low[1] >= -90.001 && high[1] <= 90.001;
  const bool isWide = bounds.LongestSide() > wide;
  const bool areLatitudes = low[1] > wide || high[1] < -wide;
  return isOnEarth && (isWide || areLatitudes);
}

std::int64_t addWarnings(const CartogramResult& result, const std::vector<double>& masses,
  const std::vector<std::string>& names, std::int64_t rings, double tolerance,
  std::vector<std::string>& warnings)
{
  // Overlaps are a fault of the map, and come before errors that follow from them.
  if (result.Overlap > leastOverlap)
  {
    warnings.push_back("Regions overlap by " + percentText(result.Overlap) +
      " of their area (most at the region " + names[indexOf(result.Overlapping)] +
      "), which counts for each of them; their areas there are not what their masses ask");
  }
  if (result.Folded > 0)
  {
    warnings.push_back("A pass would turn over " + describePart(result.Folded, rings, "outlines") +
      " (the first of the region " + names[indexOf(result.FirstFolded)] +
      ") even with 4096 steps and is left out; raise Resolution or MinimumShare");
  }
  const MissedRegions missed(result, masses, names, tolerance);
  missed.Add(warnings);
  return missed.Number();
}

} // namespace RectifiedTransport
