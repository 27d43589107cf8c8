// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/RankBarrier.h"

#include "Bridge/Run/MpiController.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/Ranks.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPIController.h"
#include "vtkOutputWindow.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <thread>

namespace RectifiedTransport::Bridge
{

namespace
{

using Clock = std::chrono::steady_clock;

constexpr int barrierTag = 52718; // a tag that no message of ParaView or VTK has

using Seconds = std::chrono::duration<double>;

// How ranks learn that all of them execute a filter. The first rank collects: a rank that fails
// before its data are complete never comes, and the others must not wait for it in an exchange.
// Ranks other than 0 send a message that they have come, and wait for the answer. Rank 0 polls the
// messages of all, and answers each. MPI's own barrier has no limit of time, and its waiting ranks
// could not tell why one is missing.
class Barrier
{
public:
  explicit Barrier(vtkMPIController* controller)
    : Controller(controller)
  {
  }

  // `withData` where the data are to be made; else before, as REQUEST_INFORMATION is.
  // Requests that MPI has finished are removed first: their memory may be freed only then.
  void Wait(const std::string& filter, bool withData, Seconds longest)
  {
    this->Longest = longest;
    const std::uint64_t subject = subjectOf(filter, withData);
    this->Sends.remove_if([](Send& send) { return send.Request.Test() != 0; });
    if (this->Controller->GetLocalProcessId() == 0)
    {
      this->Collect(subject);
    }
    else
    {
      this->Come(subject);
    }
  }

private:
  // A rank sends the first two kinds, rank 0 answers with the others.
  enum Kind : std::uint64_t
  {
    Comes,
    Leaves,
    AllCame,
    SomeMissing
  };
  // The subject; the number of the call on the rank that comes; the kind; a rank that is missing.
  using Message = std::array<unsigned long, 4>;
  using Calls = std::map<unsigned long, unsigned long>; // the subjects of those that wait
  struct Send
  {
    Message Content;
    vtkMPICommunicator::Request Request;
  };

  // Does not block: two ranks that send to each other before they receive would otherwise wait
  // forever. The list keeps the content in its place until MPI has sent it.
  void SendTo(int rank, const Message& message)
  {
    this->Sends.push_back({ message, {} });
    Send& send = this->Sends.back();
    this->Controller->NoBlockSend(
      send.Content.data(), static_cast<int>(message.size()), rank, barrierTag, send.Request);
  }

  // Returns whether there was a message of a rank.
  bool Receive(int rank, Message& message)
  {
    int has = 0;
    int source = 0;
    if (!this->Controller->Iprobe(rank, barrierTag, &has, &source) || !has)
    {
      return false;
    }
    this->Controller->Receive(
      message.data(), static_cast<vtkIdType>(message.size()), rank, barrierTag);
    return true;
  }

  // Numbers of meetings with data are even.
  // Ranks run the same program, so that equal names have equal hashes on all of them.
  static std::uint64_t subjectOf(const std::string& filter, bool withData)
  {
    return std::hash<std::string>()(filter) << 1U | (withData ? 0U : 1U);
  }
  static bool isWithData(std::uint64_t subject) { return (subject & 1U) == 0; }

  // Returns whether ready() in time. After the time `patience` it says which rank() is missing.
  // Polls, because a blocking receive would know no limit of time. 200 microseconds are short
  // beside a run of a filter, and leave the processor to ranks that still compute on the same
  // machine.
  template <class Ready, class Rank>
  static bool waitFor(Seconds longest, Seconds patience, const Ready& ready, const Rank& rank)
  {
    const auto start = Clock::now();
    for (bool hasSaid = false; !ready();)
    {
      const auto waited = Clock::now() - start;
      if (waited > longest)
      {
        return false;
      }
      if (waited > patience && !hasSaid)
      {
        hasSaid = true;
        vtkOutputWindow::GetInstance()->DisplayText(
          ("RectifiedTransport: waiting for rank " + std::to_string(rank()) +
            " to run the same filter. All ranks must run it; if only one of them runs it, it "
            "waits until RECTIFIEDTRANSPORT_RANK_TIMEOUT seconds (120) are over\n")
            .c_str());
      }
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return true;
  }

  [[noreturn]] void ThrowMissing(int rank) const
  {
    throw Failure("Rank " + std::to_string(rank) + " has not run this filter within " +
      std::to_string(std::chrono::duration_cast<std::chrono::seconds>(this->Longest).count()) +
      " seconds of this one, perhaps as a filter before it failed there; all ranks must run it "
      "(RECTIFIEDTRANSPORT_RANK_TIMEOUT sets how long they wait for one another)");
  }

  [[noreturn]] static void throwElsewhere(int rank)
  {
    throw Failure("Rank " + std::to_string(rank) +
      " runs another filter in place of this one, perhaps as a filter before it failed there; all "
      "ranks must run the same filters in the same order");
  }

  // Messages of one rank arrive in the order in which it sent them: a call that was given up in the
  // meantime is removed again.
  void ReceiveAll(int rank)
  {
    for (Message message; this->Receive(rank, message);)
    {
      Calls& waiting = this->Waiting[rank];
      if (message[2] == Comes)
      {
        waiting[message[1]] = message[0];
      }
      else
      {
        waiting.erase(message[1]);
      }
    }
  }

  // A rank that has come for another subject waits for this rank, and this one for it. Where that
  // is before the data, it goes on alone, and comes. Returns whether it waits nevertheless.
  bool WaitsElsewhere(int rank, std::uint64_t subject)
  {
    Calls& waiting = this->Waiting[rank];
    // Where this rank is at the data, calls from earlier requests are answered: their ranks need
    // not meet.
    for (auto call = waiting.begin(); isWithData(subject) && call != waiting.end();)
    {
      if (isWithData(call->second))
      {
        ++call;
        continue;
      }
      this->SendTo(rank, { call->second, call->first, SomeMissing, 0 });
      call = waiting.erase(call);
    }
    return !waiting.empty();
  }

  void Collect(std::uint64_t subject)
  {
    // Each poll reads the messages of all ranks, and stops when one is known to wait for something
    // else.
    const int ranks = this->Controller->GetNumberOfProcesses();
    int missing = 0;
    bool isElsewhere = false;
    const auto allHaveCome = [&]() {
      missing = 0;
      for (int rank = 1; rank < ranks && !isElsewhere; ++rank)
      {
        this->ReceiveAll(rank);
        const Calls& waiting = this->Waiting[rank];
        if (callFor(subject, waiting) == waiting.end())
        {
          isElsewhere = this->WaitsElsewhere(rank, subject);
          missing = missing == 0 || isElsewhere ? rank : missing;
        }
      }
      return missing == 0;
    };
    const bool haveAll =
      // After five seconds the user learns which rank is waited for, as it may be a mistake in a
      // script.
      waitFor(
        this->Longest, std::chrono::seconds(5), [&]() { return allHaveCome() || isElsewhere; },
        [&]() { return missing; }) &&
      !isElsewhere;
    // All ranks that have come get an answer, also if one is missing: they must not wait any
    // longer.
    for (int rank = 1; rank < ranks; ++rank)
    {
      Calls& waiting = this->Waiting[rank];
      const auto call = callFor(subject, waiting);
      if (call != waiting.end())
      {
        this->SendTo(rank,
          { subject, call->first, haveAll ? AllCame : SomeMissing,
            static_cast<unsigned long>(missing) });
        waiting.erase(call);
      }
    }
    if (isElsewhere)
    {
      throwElsewhere(missing);
    }
    if (!haveAll)
    {
      this->ThrowMissing(missing);
    }
  }

  // A rank's call for this subject, where it waits for it; else the end.
  static Calls::const_iterator callFor(std::uint64_t subject, const Calls& waiting)
  {
    return std::find_if(
      waiting.begin(), waiting.end(), [&](const auto& entry) { return entry.second == subject; });
  }

  void Come(std::uint64_t subject)
  {
    // The number tells this call's answer from a late one to a call that was given up.
    const unsigned long call = ++this->OwnCalls;
    this->SendTo(0, { subject, call, Comes, 0 });
    Message answer{};
    // Twice as long, as the first rank may come late and then waits itself.
    if (!waitFor(
          2 * this->Longest, std::chrono::seconds(10),
          [&]() { return this->Receive(0, answer) && answer[1] == call; }, []() { return 0; }))
    {
      // Without it, rank 0 would find this rank waiting when it arrives, and go on with it.
      this->SendTo(0, { subject, call, Leaves, 0 });
      this->ThrowMissing(0);
    }
    if (answer[2] == SomeMissing)
    {
      throw FailedElsewhere(); // the first rank reports it
    }
  }

  vtkMPIController* Controller;
  Seconds Longest{};
  std::list<Send> Sends;
  unsigned long OwnCalls = 0;
  std::map<int, Calls> Waiting; // on the first rank, of each other one
};

} // namespace

void waitForRanks(const std::string& filter, bool withData, Seconds longest)
{
  // One for the process: messages that arrive for a later call must be kept between calls.
  static Barrier meeting(mpiController());
  meeting.Wait(filter, withData, longest);
}

} // namespace RectifiedTransport::Bridge

#endif
