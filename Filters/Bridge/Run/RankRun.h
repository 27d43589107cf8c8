// SPDX-License-Identifier: BSD-3-Clause
// One execution of a filter on all MPI ranks together.
#ifndef RectifiedTransport_RankRun_h
#define RectifiedTransport_RankRun_h

#include "Core/Parallel/Ranks.h"

#include <chrono>
#include <memory>
#include <string>

namespace RectifiedTransport::Bridge
{

class RankRun : public Ranks
{
public:
  // Waits until all ranks have arrived here for the same filter. nullptr if there is only one rank,
  // or unless there are as many pieces as ranks and the requested piece is this rank's. Throws
  // Failure, or FailedElsewhere on the ranks that need not report it, if a rank does not arrive
  // within a time (RECTIFIEDTRANSPORT_RANK_TIMEOUT in seconds), and at once if it waits here for
  // another filter.
  static std::unique_ptr<RankRun> Begin(const std::string& filter, int piece, int pieces);
  // The same before data are made. nullptr if the ranks do not meet in time, and at once if this
  // rank waits here while others are in Begin().
  static std::unique_ptr<RankRun> TryBegin(
    const std::string& filter, std::chrono::duration<double> longest = Timeout());
  // RECTIFIEDTRANSPORT_RANK_TIMEOUT in seconds, else 120 s.
  static std::chrono::duration<double> Timeout();

  // Call it instead of any further exchange. The runs of the other ranks that have not ended end by
  // an exception. Returns what to report here: on the first rank, the message of the first rank
  // that failed; else nothing.
  virtual std::string Fail(const std::string& message) = 0;
  virtual void Cancel() = 0;
  // Called last by all ranks that do not fail. Throws FailedElsewhere and Cancelled.
  virtual void End() = 0;
};

} // namespace RectifiedTransport::Bridge

#endif
