// SPDX-License-Identifier: BSD-3-Clause
// Names of arrays of ids and flags. Such arrays are no densities unless the user chooses them.
#ifndef RectifiedTransport_IdNames_h
#define RectifiedTransport_IdNames_h

#include <algorithm>
#include <iterator>
#include <string>

namespace RectifiedTransport
{

// Whether files of maps number their features so: "FID", "OBJECTID", "objectid_1", "gid", "GEOID",
// "ogc_fid" of GDAL.
inline bool isFeatureIdName(const std::string& name)
{
  std::string plain = name.substr(0, name.find_last_not_of("_0123456789") + 1);
  std::transform(plain.begin(), plain.end(), plain.begin(),
    [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const std::string names[] = { "fid", "ogc_fid", "gid", "oid", "uid", "geoid", "objectid",
    "featureid" };
  return std::find(std::begin(names), std::end(names), plain) != std::end(names);
}

// Whether this is a name of ids ("ids", "GlobalNodeId", "cell_id", "ElementIDs"), or of flags and
// ids that VTK and VisIt add ("vtkGhostType", "avtGhostZones").
inline bool isIdName(const std::string& name)
{
  if (isFeatureIdName(name))
  {
    return true;
  }
  const auto isUpper = [](char c) { return c >= 'A' && c <= 'Z'; };
  // Only ASCII letters count, whatever the locale.
  const auto isLetter = [&](char c) { return isUpper(c) || (c >= 'a' && c <= 'z'); };
  if (name.compare(0, 3, "vtk") == 0 || name.compare(0, 3, "avt") == 0)
  {
    return name.size() > 3 && isUpper(name[3]);
  }
  for (const std::string ending : { "id", "ids", "Id", "Ids", "ID", "IDs", "IDS" })
  {
    if (name.size() < ending.size() ||
      name.compare(name.size() - ending.size(), ending.size(), ending) != 0)
    {
      continue;
    }
    if (name.size() == ending.size())
    {
      return true;
    }
    // A separate word: not the end of "Solid" or "FLUID".
    const char before = name[name.size() - ending.size() - 1];
    const bool isWord = !isLetter(before) || (isUpper(ending[0]) && !isUpper(before));
    if (isWord)
    {
      return true;
    }
  }
  return false;
}

} // namespace RectifiedTransport

#endif
