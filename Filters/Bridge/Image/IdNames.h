// SPDX-License-Identifier: BSD-3-Clause
// Arrays that number or mark points and cells, by their names: no densities, unless a user says so.
#ifndef RectifiedTransport_IdNames_h
#define RectifiedTransport_IdNames_h

#include <string>

namespace RectifiedTransport
{

// Whether it is the name of ids ("ids", "GlobalNodeId", "cell_id", "ElementIDs"), or of flags and
// ids that VTK and VisIt add themselves ("vtkGhostType", "avtGhostZones").
inline bool isIdName(const std::string& name)
{
  const auto isUpper = [](char c) { return c >= 'A' && c <= 'Z'; };
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
    // A word of its own: not the end of "Solid", nor of "FLUID".
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
