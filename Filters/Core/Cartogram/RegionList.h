// SPDX-License-Identifier: BSD-3-Clause
// The regions of a map by keys, with their names and masses.
#ifndef RectifiedTransport_RegionList_h
#define RectifiedTransport_RegionList_h

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace RectifiedTransport
{

class RegionList
{
public:
  // `title` says in messages what the masses come from.
  explicit RegionList(std::string title);

  // The region of this key, numbered in the order in which keys come. Throws Failure if the mass is
  // negative or not finite, or not that of the region's cells before.
  template <class NameOf>
  std::int32_t Add(const std::string& key, double mass, const NameOf& nameOf)
  {
    const auto next = static_cast<std::int32_t>(this->Names.size());
    const auto [found, isNew] = this->Numbers.insert({ key, next });
    if (isNew)
    {
      this->Names.push_back(nameOf());
      this->Masses.push_back(mass);
    }
    this->Require(found->second, mass, isNew);
    return found->second;
  }
  // Throws Failure unless the masses sum to a finite number above 0.
  void RequireMass() const;

  std::vector<std::string> Names;
  std::vector<double> Masses;

private:
  void Require(std::int32_t region, double mass, bool isNew) const;

  std::string Title;
  std::unordered_map<std::string, std::int32_t> Numbers;
};

} // namespace RectifiedTransport

#endif
