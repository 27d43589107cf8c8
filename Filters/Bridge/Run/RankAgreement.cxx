// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/RankAgreement.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPIController.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <thread>
#endif

namespace RectifiedTransport
{

#if VTK_MODULE_ENABLE_VTK_ParallelMPI

namespace
{

using Clock = std::chrono::steady_clock;

constexpr int tag = 52717; // of no other messages in ParaView or VTK
constexpr std::chrono::seconds longestWait{ 10 };
constexpr std::chrono::seconds mismatchDelay{ 1 }; // messages of earlier, failed runs may precede

// A hash of the subject of the comparison, and the fingerprint.
using Message = std::array<unsigned long, 2>;

// Sends without blocking, and stores received messages until they are taken: ranks execute the same
// filters, but not simultaneously, and not all of them after a failure.
class MessageQueue
{
public:
  explicit MessageQueue(vtkMPIController* controller)
    : Controller(controller)
  {
  }

  void SendToAll(const Message& message)
  {
    this->Pending.remove_if([](Send& send) { return send.Request.Test() != 0; });
    for (int rank = 0; rank < this->Controller->GetNumberOfProcesses(); ++rank)
    {
      if (rank != this->Controller->GetLocalProcessId())
      {
        this->Pending.push_back({ message, {} });
        Send& send = this->Pending.back();
        this->Controller->NoBlockSend(send.Content.data(), 2, rank, tag, send.Request);
      }
    }
  }

  // Removes the first received message of a rank that satisfies a condition; returns whether there
  // is one.
  template <class Condition>
  bool Take(int rank, const Condition& condition)
  {
    std::deque<Message>& received = this->Received[rank];
    for (int has = 0, source = 0; this->Controller->Iprobe(rank, tag, &has, &source) && has;)
    {
      Message message{};
      this->Controller->Receive(message.data(), 2, rank, tag);
      received.push_back(message);
    }
    const auto found = std::find_if(received.begin(), received.end(), condition);
    if (found == received.end())
    {
      return false;
    }
    received.erase(found);
    return true;
  }

private:
  struct Send
  {
    Message Content;
    vtkMPICommunicator::Request Request;
  };

  vtkMPIController* Controller;
  std::list<Send> Pending;
  std::map<int, std::deque<Message>> Received;
};

} // namespace

vtkMPIController* mpiController()
{
  return vtkMPIController::SafeDownCast(vtkMultiProcessController::GetGlobalController());
}

bool haveSeveralRanks()
{
  vtkMPIController* controller = mpiController();
  return controller && controller->GetNumberOfProcesses() > 1;
}

bool sharesWithRanks(int piece, int pieces)
{
  vtkMPIController* controller = mpiController();
  return controller && pieces > 1 && pieces == controller->GetNumberOfProcesses() &&
    piece == controller->GetLocalProcessId();
}

RankAgreement compareRanks(const std::string& subject, std::uint64_t fingerprint, int& rank)
{
  vtkMPIController* controller = mpiController();
  const int ranks = controller->GetNumberOfProcesses();
  const int own = controller->GetLocalProcessId();
  static MessageQueue queue(controller);
  const unsigned long kind = std::hash<std::string>()(subject);
  queue.SendToAll({ kind, fingerprint });
  RankAgreement agreement = RankAgreement::Same;
  const auto start = Clock::now();
  for (rank = 0; rank < ranks; ++rank)
  {
    const auto isSame = [&](const Message& message) {
      const unsigned long higher = rank > own ? message[1] : fingerprint;
      const bool isFirstOnly = message[0] == kind && higher == 0;
      agreement = isFirstOnly ? RankAgreement::FirstOnly : agreement;
      return isFirstOnly || (message[0] == kind && message[1] == fingerprint);
    };
    while (rank != own && !queue.Take(rank, isSame))
    {
      const auto waited = Clock::now() - start;
      if (waited > mismatchDelay &&
        queue.Take(rank, [kind](const Message& message) { return message[0] == kind; }))
      {
        return RankAgreement::Differs;
      }
      if (waited > longestWait)
      {
        return RankAgreement::NoAnswer;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  return agreement;
}

#else

bool haveSeveralRanks()
{
  return false;
}

bool sharesWithRanks(int, int)
{
  return false;
}

RankAgreement compareRanks(const std::string&, std::uint64_t, int&)
{
  return RankAgreement::Same;
}

#endif

} // namespace RectifiedTransport
