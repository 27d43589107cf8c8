// SPDX-License-Identifier: BSD-3-Clause
#ifndef Campaign_Written_h
#define Campaign_Written_h

#include "Case.h"

#include <string>

namespace Campaign
{

// Any data by one of the writers to a target of any kind: a plain file, a link, a pipe, a device, a
// disk that is full. What is written is whole, and nothing else has changed. The target is in a
// folder of the case's own, below the given one.
CaseResult runWrittenCase(std::uint64_t seed, std::uint64_t number, const std::string& folder);

} // namespace Campaign

#endif
