// SPDX-License-Identifier: BSD-3-Clause
// Texts that must be the same on all ranks.
#ifndef RectifiedTransport_PropertyDifference_h
#define RectifiedTransport_PropertyDifference_h

#include <string>
#include <vector>

namespace RectifiedTransport
{

// Compares the texts of all ranks that are not empty, and sets `common` to the first one. Returns
// which two differ, as "a on rank 0, but b on rank 1"; empty if none do.
std::string differenceOfTexts(const std::vector<std::string>& all, std::string& common);

// Compares what PrintSelf printed for a filter on each rank. Returns a message that names the first
// property after Threading that differs; empty if none does.
std::string differenceOfProperties(const std::vector<std::string>& all);

} // namespace RectifiedTransport

#endif
