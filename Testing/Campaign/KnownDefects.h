// SPDX-License-Identifier: BSD-3-Clause
// Findings that are known and wait to be mended: counted, not failed on. The list gets shorter.
#ifndef Campaign_KnownDefects_h
#define Campaign_KnownDefects_h

#include <string>
#include <vector>

namespace Campaign
{

struct KnownDefect
{
  const char* Filter; // "" for all
  const char* Begin;  // of the finding
  const char* Part;   // that it has as well
};

inline bool isKnown(const std::string& filter, const std::string& finding)
{
  static const std::vector<KnownDefect> defects = {
  };
  for (const KnownDefect& defect : defects)
  {
    if ((*defect.Filter == 0 || filter == defect.Filter) && finding.rfind(defect.Begin, 0) == 0 &&
      finding.find(defect.Part) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

} // namespace Campaign

#endif
