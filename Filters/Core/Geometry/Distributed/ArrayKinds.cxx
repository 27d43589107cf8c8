// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Distributed/ArrayKinds.h"

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

// Whether a list has an array of the same owner, type, components and name.
bool has(const ArrayKinds& kinds, const ArrayKind& wanted)
{
  return std::any_of(
    kinds.begin(), kinds.end(), [&](const ArrayKind& kind) { return kind.IsLike(wanted); });
}

} // namespace

// Names are quoted: they may contain blanks and line ends.
std::string textOfKinds(const ArrayKinds& kinds)
{
  std::ostringstream os;
  for (const ArrayKind& kind : kinds)
  {
    os << kind.Owner << ' ' << kind.Type << ' ' << kind.Components << ' ' << kind.Attribute << ' '
       << kind.ComponentNames.size() << ' ' << std::quoted(kind.Name);
    for (const std::string& name : kind.ComponentNames)
    {
      os << ' ' << std::quoted(name);
    }
    os << '\n';
  }
  return os.str();
}

ArrayKinds kindsOfText(const std::string& text)
{
  std::istringstream is(text);
  ArrayKinds kinds;
  std::size_t names = 0;
  for (ArrayKind kind; is >> kind.Owner >> kind.Type >> kind.Components >> kind.Attribute >>
       names >> std::quoted(kind.Name);)
  {
    kind.ComponentNames.resize(names);
    for (std::string& name : kind.ComponentNames)
    {
      is >> std::quoted(name);
    }
    kinds.push_back(kind);
  }
  return kinds;
}

// An array of this name counts even if only some lists have it.
ArrayKinds commonKinds(const std::vector<ArrayKinds>& all, const std::string& name)
{
  ArrayKinds common;
  for (const ArrayKinds& kinds : all)
  {
    for (const ArrayKind& kind : kinds)
    {
      const bool isInAll = std::all_of(
        all.begin(), all.end(), [&](const ArrayKinds& there) { return has(there, kind); });
      if ((isInAll || kind.Name == name) && !has(common, kind))
      {
        common.push_back(kind);
      }
    }
  }
  return common;
}

} // namespace RectifiedTransport
