// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/RankRun.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/RankAgreement.h"
#include "Core/Parallel/Context.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPIController.h"
#include "vtkOutputWindow.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <list>
#include <map>
#include <new>
#include <thread>
#include <utility>
#include <vector>
#endif

namespace RectifiedTransport
{

#if VTK_MODULE_ENABLE_VTK_ParallelMPI

namespace
{

using Clock = std::chrono::steady_clock;

// Of no other messages in ParaView or VTK.
constexpr int meetingTag = 52718;
constexpr int exchangeTag = 52719;

Clock::duration longestWait()
{
  constexpr double usual = 120.0;
  const char* given = std::getenv("RECTIFIEDTRANSPORT_RANK_TIMEOUT");
  const double seconds = given ? std::strtod(given, nullptr) : 0.0;
  return std::chrono::duration_cast<Clock::duration>(
    std::chrono::duration<double>(seconds > 0.0 ? seconds : usual));
}

// How ranks learn that all of them execute a filter. The first rank collects: a rank that fails
// before its data are complete never comes, and the others must not wait for it in an exchange.
class Meeting
{
public:
  explicit Meeting(vtkMPIController* controller)
    : Controller(controller)
  {
  }

  // `withData` where the data are to be made; else before, as REQUEST_INFORMATION is.
  void Wait(const std::string& filter, bool withData)
  {
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

  void SendTo(int rank, const Message& message)
  {
    this->Sends.push_back({ message, {} });
    Send& send = this->Sends.back();
    this->Controller->NoBlockSend(
      send.Content.data(), static_cast<int>(message.size()), rank, meetingTag, send.Request);
  }

  // Returns whether there was a message of a rank.
  bool Receive(int rank, Message& message)
  {
    int has = 0;
    int source = 0;
    if (!this->Controller->Iprobe(rank, meetingTag, &has, &source) || !has)
    {
      return false;
    }
    this->Controller->Receive(
      message.data(), static_cast<vtkIdType>(message.size()), rank, meetingTag);
    return true;
  }

  // Numbers of meetings with data are even.
  static std::uint64_t subjectOf(const std::string& filter, bool withData)
  {
    return std::hash<std::string>()(filter) << 1U | (withData ? 0U : 1U);
  }
  static bool isWithData(std::uint64_t subject) { return (subject & 1U) == 0; }

  // Returns whether ready() in time. After the time `patience` it says which rank() is missing.
  template <class Ready, class Rank>
  static bool waitFor(
    Clock::duration longest, Clock::duration patience, const Ready& ready, const Rank& rank)
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
            " to run the same filter. All ranks must run it; where one of them alone runs it, it "
            "waits until RECTIFIEDTRANSPORT_RANK_TIMEOUT seconds (120) are over\n")
            .c_str());
      }
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return true;
  }

  [[noreturn]] static void throwMissing(int rank)
  {
    throw Failure("Rank " + std::to_string(rank) + " has not run this filter within " +
      std::to_string(std::chrono::duration_cast<std::chrono::seconds>(longestWait()).count()) +
      " seconds of this one, perhaps as a filter before it failed there; all ranks must run it "
      "(RECTIFIEDTRANSPORT_RANK_TIMEOUT sets how long they wait for one another)");
  }

  [[noreturn]] static void throwElsewhere(int rank)
  {
    throw Failure("Rank " + std::to_string(rank) +
      " runs another filter in place of this one, perhaps as a filter before it failed there; all "
      "ranks must run the same filters in the same order");
  }

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
      waitFor(
        longestWait(), std::chrono::seconds(5), [&]() { return allHaveCome() || isElsewhere; },
        [&]() { return missing; }) &&
      !isElsewhere;
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
      throwMissing(missing);
    }
  }

  static Calls::const_iterator callFor(std::uint64_t subject, const Calls& waiting)
  {
    return std::find_if(
      waiting.begin(), waiting.end(), [&](const auto& entry) { return entry.second == subject; });
  }

  void Come(std::uint64_t subject)
  {
    const unsigned long call = ++this->OwnCalls;
    this->SendTo(0, { subject, call, Comes, 0 });
    Message answer{};
    // Twice as long, as the first rank may come late and then waits itself.
    if (!waitFor(
          2 * longestWait(), std::chrono::seconds(10),
          [&]() { return this->Receive(0, answer) && answer[1] == call; }, []() { return 0; }))
    {
      this->SendTo(0, { subject, call, Leaves, 0 });
      throwMissing(0);
    }
    if (answer[2] == SomeMissing)
    {
      throw FailedElsewhere(); // the first rank reports it
    }
  }

  vtkMPIController* Controller;
  std::list<Send> Sends;
  unsigned long OwnCalls = 0;
  std::map<int, Calls> Waiting; // on the first rank, of each other one
};

class MpiRun final : public RankRun
{
public:
  explicit MpiRun(vtkMPIController* controller)
    : Controller(controller)
  {
  }
  int Count() const override { return this->Controller->GetNumberOfProcesses(); }
  int Own() const override { return this->Controller->GetLocalProcessId(); }
  std::vector<Bytes> Gather(const Bytes& own) const override;
  std::vector<Bytes> Exchange(std::vector<Bytes> parts) const override;
  std::string Fail(const std::string& message) override
  {
    this->Leave(State::Failed, message);
    return this->Own() == 0 ? this->Report : "";
  }
  void Cancel() override { this->Leave(State::Cancelled, ""); }
  void End() override { this->Announce(State::Runs, "", {}); }

private:
  enum class State : long long
  {
    Runs,
    Cancelled,
    Failed
  };

  void Leave(State state, const std::string& message)
  {
    if (!this->HasEnded)
    {
      this->Announce(state, message, {});
    }
  }
  // What arrives from each rank, and the most that arrives on any.
  struct Arrivals
  {
    std::vector<long long> Here;
    long long Most = 0;
  };

  std::vector<Bytes> Transfer(const std::vector<const Bytes*>& parts) const;
  std::vector<Bytes> AllocateFor(const Arrivals& arrivals) const;
  Arrivals Announce(
    State state, const std::string& message, const std::vector<const Bytes*>& parts) const;
  void CollectReports(const std::string& message) const;

  vtkMPIController* Controller;
  mutable bool HasEnded = false;
  mutable std::string Report;
};

// Precedes every exchange: how each rank fares, and what it will send. Returns the sizes of what
// arrives here, and throws where others have failed, unless this rank has, too.
MpiRun::Arrivals MpiRun::Announce(
  State state, const std::string& message, const std::vector<const Bytes*>& parts) const
{
  const auto ranks = static_cast<std::size_t>(this->Count());
  std::vector<long long> own(ranks + 1);
  own[0] = static_cast<long long>(state);
  for (std::size_t rank = 0; rank < parts.size(); ++rank)
  {
    own[rank + 1] = static_cast<long long>(parts[rank]->size());
  }
  std::vector<long long> all(ranks * own.size());
  this->Controller->AllGather(own.data(), all.data(), static_cast<vtkIdType>(own.size()));
  State worst = State::Runs;
  Arrivals arriving{ std::vector<long long>(ranks) };
  std::vector<long long> sums(ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    const long long* const there = all.data() + rank * own.size();
    worst = std::max(worst, static_cast<State>(there[0]));
    arriving.Here[rank] = there[1 + static_cast<std::size_t>(this->Own())];
    for (std::size_t to = 0; to < ranks; ++to)
    {
      sums[to] += there[1 + to];
    }
  }
  arriving.Most = *std::max_element(sums.begin(), sums.end());
  if (worst == State::Runs)
  {
    return arriving;
  }
  this->HasEnded = true;
  if (worst == State::Failed)
  {
    this->CollectReports(state == State::Failed ? message : "");
  }
  if (state == State::Runs)
  {
    if (worst == State::Cancelled)
    {
      throw Cancelled();
    }
    throw FailedElsewhere();
  }
  return arriving;
}

void MpiRun::CollectReports(const std::string& message) const
{
  const int ranks = this->Count();
  const auto length = static_cast<vtkIdType>(message.size());
  std::vector<vtkIdType> lengths(static_cast<std::size_t>(ranks));
  std::vector<vtkIdType> offsets(lengths.size());
  this->Controller->AllGather(&length, lengths.data(), 1);
  vtkIdType all = 0;
  for (std::size_t rank = 0; rank < lengths.size(); ++rank)
  {
    offsets[rank] = all;
    all += lengths[rank];
  }
  std::string text(static_cast<std::size_t>(std::max<vtkIdType>(1, all)), '\0');
  this->Controller->AllGatherV(message.data(), &text[0], length, lengths.data(), offsets.data());
  for (std::size_t rank = 0; rank < lengths.size() && this->Report.empty(); ++rank)
  {
    if (lengths[rank] > 0)
    {
      this->Report = (rank > 0 ? "Rank " + std::to_string(rank) + ": " : "") +
        text.substr(
          static_cast<std::size_t>(offsets[rank]), static_cast<std::size_t>(lengths[rank]));
    }
  }
}

std::vector<Bytes> MpiRun::Gather(const Bytes& own) const
{
  std::vector<Bytes> received =
    this->Transfer(std::vector<const Bytes*>(static_cast<std::size_t>(this->Count()), &own));
  received[static_cast<std::size_t>(this->Own())] = own;
  return received;
}

std::vector<Bytes> MpiRun::Exchange(std::vector<Bytes> parts) const
{
  std::vector<const Bytes*> given;
  for (const Bytes& part : parts)
  {
    given.push_back(&part);
  }
  std::vector<Bytes> received = this->Transfer(given);
  const auto own = static_cast<std::size_t>(this->Own());
  received[own] = std::move(parts[own]);
  return received;
}

// Ranks agree that all have the memory, where it is much: they would wait for the messages of one
// that has not.
std::vector<Bytes> MpiRun::AllocateFor(const Arrivals& arrivals) const
{
  constexpr long long much = 1 << 24;
  std::vector<Bytes> received(arrivals.Here.size());
  bool fits = true;
  try
  {
    for (std::size_t rank = 0; rank < received.size(); ++rank)
    {
      const bool isOwn = rank == static_cast<std::size_t>(this->Own());
      received[rank].resize(isOwn ? 0 : static_cast<std::size_t>(arrivals.Here[rank]));
    }
  }
  catch (const std::bad_alloc&)
  {
    fits = false;
    received.clear();
  }
  if (arrivals.Most > much)
  {
    this->Announce(
      fits ? State::Runs : State::Failed, "Not enough memory for what other ranks send", {});
  }
  if (!fits)
  {
    throw std::bad_alloc();
  }
  return received;
}

// Without this rank's own part.
std::vector<Bytes> MpiRun::Transfer(const std::vector<const Bytes*>& parts) const
{
  std::vector<Bytes> received = this->AllocateFor(this->Announce(State::Runs, "", parts));
  const auto own = static_cast<std::size_t>(this->Own());
  constexpr std::size_t most = std::size_t{ 1 } << 30; // bytes of a message
  const auto forMessages = [=](std::size_t rank, std::size_t bytes, const auto& start) {
    for (std::size_t first = 0; first < bytes && rank != own; first += most)
    {
      start(first, static_cast<int>(std::min(most, bytes - first)), static_cast<int>(rank));
    }
  };
  std::list<vtkMPICommunicator::Request> requests;
  for (std::size_t rank = 0; rank < parts.size(); ++rank)
  {
    forMessages(rank, received[rank].size(), [&](std::size_t first, int length, int remote) {
      requests.emplace_back();
      this->Controller->NoBlockReceive(
        received[rank].data() + first, length, remote, exchangeTag, requests.back());
    });
  }
  for (std::size_t rank = 0; rank < parts.size(); ++rank)
  {
    forMessages(rank, parts[rank]->size(), [&](std::size_t first, int length, int remote) {
      requests.emplace_back();
      this->Controller->NoBlockSend(
        parts[rank]->data() + first, length, remote, exchangeTag, requests.back());
    });
  }
  for (vtkMPICommunicator::Request& request : requests)
  {
    request.Wait();
  }
  return received;
}

} // namespace

namespace
{

std::unique_ptr<RankRun> meet(const std::string& filter, bool withData)
{
  static Meeting meeting(mpiController());
  meeting.Wait(filter, withData);
  return std::make_unique<MpiRun>(mpiController());
}

} // namespace

std::unique_ptr<RankRun> RankRun::Begin(const std::string& filter, int piece, int pieces)
{
  return sharesWithRanks(piece, pieces) ? meet(filter, true) : nullptr;
}

std::unique_ptr<RankRun> RankRun::BeginWithoutPieces(const std::string& filter)
{
  if (!haveSeveralRanks())
  {
    return nullptr;
  }
  try
  {
    return meet(filter, false);
  }
  catch (const Failure&)
  {
    return nullptr;
  }
  catch (const FailedElsewhere&)
  {
    return nullptr;
  }
}

#else

std::unique_ptr<RankRun> RankRun::Begin(const std::string&, int, int)
{
  return nullptr;
}

std::unique_ptr<RankRun> RankRun::BeginWithoutPieces(const std::string&)
{
  return nullptr;
}

#endif

} // namespace RectifiedTransport
