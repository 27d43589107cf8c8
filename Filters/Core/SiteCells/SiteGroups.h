// SPDX-License-Identifier: BSD-3-Clause
// Groups of sites that the labelling of pixels does not tell apart. They divide what their group
// gets.
#ifndef RectifiedTransport_SiteGroups_h
#define RectifiedTransport_SiteGroups_h

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

struct SiteGroups
{
  std::int64_t NumberOfSites() const { return static_cast<std::int64_t>(this->Sites.size()); }
  std::int64_t NumberOfGroups() const { return static_cast<std::int64_t>(this->First.size()) - 1; }
  std::int64_t SitesIn(std::int64_t group) const
  {
    return this->First[group + 1] - this->First[group];
  }
  // Site i of a group.
  std::int64_t Site(std::int64_t group, std::int64_t i) const
  {
    return this->Sites[this->First[group] + i];
  }

  // The first entry of each group in Sites, and the number of all sites.
  std::vector<std::int64_t> First;
  std::vector<std::int64_t> Sites;
};

} // namespace RectifiedTransport

#endif
