// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/RegionList.h"

#include "Core/Messages/PropertyCheck.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace RectifiedTransport
{

RegionList::RegionList(std::string title)
  : Title(std::move(title))
{
}

void RegionList::Require(std::int32_t region, double mass, bool isNew) const
{
  const std::string& name = this->Names[static_cast<std::size_t>(region)];
  const double before = this->Masses[static_cast<std::size_t>(region)];
  if (isNew && (!(mass >= 0.0) || !std::isfinite(mass)))
  {
    fail("The mass of the region ", name, " in ", this->Title, " is ", mass,
      "; masses must be at least 0 and finite");
  }
  if (!(mass == before))
  {
    fail("The region ", name, " has cells of mass ", textOf(before), " and ", textOf(mass), " in ",
      this->Title, "; all cells of a region must have its mass, which counts once");
  }
}

void RegionList::RequireMass() const
{
  const double total = std::accumulate(this->Masses.begin(), this->Masses.end(), 0.0);
  if (!(total > 0.0) || !std::isfinite(total))
  {
    fail("The masses in ", this->Title, " sum to ", total, "; they must sum to a number above 0");
  }
}

} // namespace RectifiedTransport
