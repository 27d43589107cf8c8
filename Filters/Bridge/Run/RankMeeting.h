// SPDX-License-Identifier: BSD-3-Clause
// How ranks of MPI learn that all of them run a filter.
#ifndef RectifiedTransport_RankMeeting_h
#define RectifiedTransport_RankMeeting_h

#include <chrono>
#include <string>

namespace RectifiedTransport
{

// RECTIFIEDTRANSPORT_RANK_TIMEOUT in seconds, else 120 s.
std::chrono::duration<double> rankTimeout();

// Waits until all ranks have come here for the same filter. `withData` where its data are to be
// made; else before, as in REQUEST_INFORMATION. Throws Failure, or FailedElsewhere on the ranks
// that need not report it, if a rank does not come within `longest`, and at once if it waits here
// for another filter. Only where VTK has MPI.
void meetRanks(const std::string& filter, bool withData, std::chrono::duration<double> longest);

} // namespace RectifiedTransport

#endif
