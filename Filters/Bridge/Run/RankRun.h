// SPDX-License-Identifier: BSD-3-Clause
// One execution of a filter on all ranks of MPI together.
#ifndef RectifiedTransport_RankRun_h
#define RectifiedTransport_RankRun_h

#include "Core/Parallel/Ranks.h"

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
  // The same before pieces are requested. Ranks that do not meet in time run alone: nullptr. Those
  // that wait here while others are in Begin() run alone at once.
  static std::unique_ptr<RankRun> BeginWithoutPieces(const std::string& filter);

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
