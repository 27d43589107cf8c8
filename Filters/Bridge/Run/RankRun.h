// SPDX-License-Identifier: BSD-3-Clause
// One execution of a filter on all ranks of MPI together.
#ifndef RectifiedTransport_RankRun_h
#define RectifiedTransport_RankRun_h

#include "Core/Parallel/Ranks.h"

#include <chrono>
#include <memory>
#include <string>

namespace RectifiedTransport
{

class RankRun : public Ranks
{
public:
  // Waits until all ranks have come here for the same filter. nullptr where there is one rank only,
  // or where the requested piece is not this rank's, of as many pieces as there are ranks. Throws
  // Failure, or FailedElsewhere on the ranks that need not report it, where a rank does not come
  // within a time (RECTIFIEDTRANSPORT_RANK_TIMEOUT in seconds), and at once where it waits here for
  // another filter.
  static std::unique_ptr<RankRun> Begin(const std::string& filter, int piece, int pieces);
  // The same before data are made. nullptr for ranks that do not meet in time, and at once for
  // those that wait here while others are in Begin(). The time is that of Begin, or `longest`.
  static std::unique_ptr<RankRun> TryBegin(const std::string& filter);
  static std::unique_ptr<RankRun> TryBegin(
    const std::string& filter, std::chrono::duration<double> longest);

  // To be called in place of any further exchange. Ends the runs of the others, if they have not
  // ended: by an exception of each. Returns what is to be reported here: the message of the first
  // rank that failed, on the first rank; else nothing.
  virtual std::string Fail(const std::string& message) = 0;
  virtual void Cancel() = 0;
  // Called last by all ranks that do not fail. Throws FailedElsewhere and Cancelled.
  virtual void End() = 0;
};

} // namespace RectifiedTransport

#endif
