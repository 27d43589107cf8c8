// SPDX-License-Identifier: BSD-3-Clause
// How MPI ranks learn that all of them run a filter.
#ifndef RectifiedTransport_RankBarrier_h
#define RectifiedTransport_RankBarrier_h

#include <chrono>
#include <string>

namespace RectifiedTransport::Bridge
{

// Waits until all ranks have arrived here for the same filter. `withData`: to make its data; else
// earlier, for example in REQUEST_INFORMATION. Throws Failure, or FailedElsewhere on the ranks that
// need not report it, if a rank does not arrive within `longest`, and at once if it waits here for
// another filter. Only if VTK has MPI.
void waitForRanks(const std::string& filter, bool withData, std::chrono::duration<double> longest);

} // namespace RectifiedTransport::Bridge

#endif
