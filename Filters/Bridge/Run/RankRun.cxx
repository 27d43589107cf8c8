// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/RankRun.h"

#include "Bridge/Run/MpiController.h"
#include "Bridge/Run/RankBarrier.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/Context.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPIController.h"

#include <algorithm>
#include <list>
#include <new>
#include <numeric>
#include <utility>
#include <vector>
#endif

#include <cstdlib>

namespace RectifiedTransport::Bridge
{

namespace
{

#if VTK_MODULE_ENABLE_VTK_ParallelMPI

constexpr int exchangeTag = 52719;  // a tag that no message of ParaView or VTK has
constexpr long long much = 1 << 24; // bytes; more is sent in pieces, after all have the memory

// An exchange among ranks of which any may fail. A rank that fails or is cancelled says so in its
// next announcement, which all ranks take part in, and none waits for a message that never comes.
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

  std::vector<Bytes> GatherAtOnce(const Bytes& own, const std::vector<long long>& sizes) const;
  std::vector<Bytes> Transfer(
    const std::vector<const Bytes*>& parts, const Arrivals& arrivals) const;
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
  // Message to all: this rank's state, then the bytes that it will send to each rank.
  std::vector<long long> own(ranks + 1);
  own[0] = static_cast<long long>(state);
  for (std::size_t rank = 0; rank < parts.size(); ++rank)
  {
    own[rank + 1] = static_cast<long long>(parts[rank]->size());
  }
  std::vector<long long> all(ranks * own.size());
  // Shape of `all`: ranks x (ranks + 1), by senders. All ranks compute the same decision from it.
  this->Controller->AllGather(own.data(), all.data(), static_cast<vtkIdType>(own.size()));
  // By the order of State, a failure on any rank outweighs a cancellation, which would hide it.
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
  // The largest sum of any rank, so that all choose the same way of transfer.
  arriving.Most = *std::max_element(sums.begin(), sums.end());
  if (worst == State::Runs)
  {
    return arriving;
  }
  // After the reports no exchange takes place: what ranks do next, such as empty outputs, is local.
  this->HasEnded = true;
  if (worst == State::Failed)
  {
    this->CollectReports(state == State::Failed ? message : "");
  }
  // The rank that failed, or was cancelled, already has an exception of its own.
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

// All ranks get the messages of all, of which the first one is reported, by rank 0.
void MpiRun::CollectReports(const std::string& message) const
{
  const auto length = static_cast<long long>(message.size());
  std::vector<long long> lengths(static_cast<std::size_t>(this->Count()));
  this->Controller->AllGather(&length, lengths.data(), 1);
  const std::vector<Bytes> reports =
    this->GatherAtOnce(Bytes(message.begin(), message.end()), lengths);
  const auto first = std::find_if(
    reports.begin(), reports.end(), [](const Bytes& report) { return !report.empty(); });
  if (first != reports.end())
  {
    const auto rank = first - reports.begin();
    this->Report = (rank > 0 ? "Rank " + std::to_string(rank) + ": " : "") +
      std::string(first->begin(), first->end());
  }
}

// AllGatherV takes one round, but the sum of the parts must be less than 2^31 bytes, as MPI counts
// with int; it also makes a copy of all.
std::vector<Bytes> MpiRun::Gather(const Bytes& own) const
{
  // Gather is an exchange in which each rank gives the same bytes to all.
  const std::vector<const Bytes*> parts(static_cast<std::size_t>(this->Count()), &own);
  const Arrivals arrivals = this->Announce(State::Runs, "", parts);
  if (arrivals.Most <= much)
  {
    return this->GatherAtOnce(own, arrivals.Here);
  }
  // Large parts are received where they stay, without a copy of all in one block.
  std::vector<Bytes> received = this->Transfer(parts, arrivals);
  received[static_cast<std::size_t>(this->Own())] = own;
  return received;
}

std::vector<Bytes> MpiRun::GatherAtOnce(const Bytes& own, const std::vector<long long>& sizes) const
{
  // Rank r's bytes are [offsets[r], offsets[r + 1]) of the block that MPI fills.
  const std::vector<vtkIdType> lengths(sizes.begin(), sizes.end());
  std::vector<vtkIdType> offsets(sizes.size() + 1);
  std::partial_sum(lengths.begin(), lengths.end(), offsets.begin() + 1);
  Bytes all(static_cast<std::size_t>(offsets.back()));
  if (!all.empty())
  {
    this->Controller->AllGatherV(own.data(), all.data(),
      lengths[static_cast<std::size_t>(this->Own())], const_cast<vtkIdType*>(lengths.data()),
      offsets.data());
  }
  std::vector<Bytes> received;
  for (std::size_t rank = 0; rank < lengths.size(); ++rank)
  {
    received.emplace_back(all.begin() + offsets[rank], all.begin() + offsets[rank + 1]);
  }
  return received;
}

std::vector<Bytes> MpiRun::Exchange(std::vector<Bytes> parts) const
{
  // Parts are not copied; each must stay until Transfer has sent it.
  std::vector<const Bytes*> given;
  for (const Bytes& part : parts)
  {
    given.push_back(&part);
  }
  std::vector<Bytes> received = this->Transfer(given, this->Announce(State::Runs, "", given));
  const auto own = static_cast<std::size_t>(this->Own());
  // What a rank sends to itself takes no message.
  received[own] = std::move(parts[own]);
  return received;
}

// Ranks agree that all have the memory, where it is much: they would wait for the messages of one
// that has not.
std::vector<Bytes> MpiRun::AllocateFor(const Arrivals& arrivals) const
{
  std::vector<Bytes> received(arrivals.Here.size());
  bool fits = true;
  try
  {
    for (std::size_t rank = 0; rank < received.size(); ++rank)
    {
      // Without a buffer for the own part, which the caller puts there.
      const bool isOwn = rank == static_cast<std::size_t>(this->Own());
      received[rank].resize(isOwn ? 0 : static_cast<std::size_t>(arrivals.Here[rank]));
    }
  }
  catch (const std::bad_alloc&)
  {
    fits = false;
    received.clear();
  }
  // One more announcement costs little beside so many bytes. With less, memory is taken to be
  // there.
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

// Sends and receives all parts except this rank's own. MPI counts with int, so a message has at
// most 2^30 bytes. All receives are posted before the first send, so that data arrive in their
// place.
std::vector<Bytes> MpiRun::Transfer(
  const std::vector<const Bytes*>& parts, const Arrivals& arrivals) const
{
  std::vector<Bytes> received = this->AllocateFor(arrivals);
  const auto own = static_cast<std::size_t>(this->Own());
  // Sender and receiver cut a part at the same bytes, and MPI keeps the order of messages between
  // two ranks with one tag, so that pieces need no numbers.
  constexpr std::size_t most = std::size_t{ 1 } << 30; // bytes of a message
  const auto forMessages = [=](std::size_t rank, std::size_t bytes, const auto& start) {
    for (std::size_t first = 0; first < bytes && rank != own; first += most)
    {
      start(first, static_cast<int>(std::min(most, bytes - first)), static_cast<int>(rank));
    }
  };
  // A list: MPI needs the requests where they are until they are finished.
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
  // Buffers may be used or freed only when all messages have been sent and received.
  for (vtkMPICommunicator::Request& request : requests)
  {
    request.Wait();
  }
  return received;
}

// Every run begins with a meeting of all ranks, because its first announcement would otherwise wait
// without limit for a rank that never comes.
std::unique_ptr<RankRun> meet(
  const std::string& filter, bool withData, std::chrono::duration<double> longest)
{
  waitForRanks(filter, withData, longest);
  return std::make_unique<MpiRun>(mpiController());
}

#else

std::unique_ptr<RankRun> meet(const std::string&, bool, std::chrono::duration<double>)
{
  return nullptr; // without MPI there is one rank
}

#endif

} // namespace

std::unique_ptr<RankRun> RankRun::Begin(const std::string& filter, int piece, int pieces)
{
  // A request of another number of pieces comes from one rank alone, as from a writer that gathers.
  return isPieceOfRanks(piece, pieces) ? meet(filter, true, Timeout()) : nullptr;
}

std::chrono::duration<double> RankRun::Timeout()
{
  // Seconds until the ranks that wait report one that does not arrive, for example because an
  // upstream filter failed there.
  constexpr double usual = 120.0;
  const char* given = std::getenv("RECTIFIEDTRANSPORT_RANK_TIMEOUT");
  const double seconds = given ? std::strtod(given, nullptr) : 0.0;
  return std::chrono::duration<double>(seconds > 0.0 ? seconds : usual);
}

std::unique_ptr<RankRun> RankRun::TryBegin(
  const std::string& filter, std::chrono::duration<double> longest)
{
  // Before data are made, a missing rank is no error: the filter goes on alone, and RequestData
  // reports what is wrong.
  try
  {
    return haveSeveralRanks() ? meet(filter, false, longest) : nullptr;
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

} // namespace RectifiedTransport::Bridge
