// SPDX-License-Identifier: BSD-3-Clause
// One case of the campaign: a filter, its inputs and several runs, all from one number.
#ifndef Campaign_Case_h
#define Campaign_Case_h

#include <cstdint>
#include <string>
#include <vector>

namespace Campaign
{

struct CaseResult
{
  std::string Filter;
  std::string Log;          // what was done, a line a step
  std::uint64_t Digest = 0; // of all that does not depend on threads or instruction sets
  std::uint64_t Input = 0;  // of what a crafted file gave: readers leave memory as it was
  std::vector<std::string> Findings;
  int Runs = 0;
  int Errors = 0;
  int Aborts = 0;
  int Limits = 0; // of memory that ended a run
};

// The filter of a random case.
std::string filterOfCase(std::uint64_t seed, std::uint64_t number);
CaseResult runCase(std::uint64_t seed, std::uint64_t number);

} // namespace Campaign

#endif
