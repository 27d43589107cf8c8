// SPDX-License-Identifier: BSD-3-Clause
// Texts that must be the same on all ranks.
#ifndef RectifiedTransport_PropertyLines_h
#define RectifiedTransport_PropertyLines_h

#include <string>
#include <vector>

namespace RectifiedTransport
{

// Of the texts of all ranks, those that are not empty must be the same: sets `common` to the first
// one. Returns which two differ, as "a on rank 0, but b on rank 1"; empty if none do.
std::string differenceOfTexts(const std::vector<std::string>& all, std::string& common);

// Of what PrintSelf printed of a filter on each rank: which property after Threading differs, as a
// message; empty if none does.
std::string differenceOfProperties(const std::vector<std::string>& all);

} // namespace RectifiedTransport

#endif
