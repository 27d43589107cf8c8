// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/WholeInput.h"

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
constexpr std::chrono::seconds grace{ 1 }; // a message of a run that failed here may come first

// A filter's class and its fingerprint.
using Message = std::array<unsigned long, 2>;

// Messages wait for whom they concern: ranks run the same filters, but not at the same moment, and
// not all of them where one has failed. Nobody waits for a message to be taken.
class Post
{
public:
  explicit Post(vtkMPIController* controller)
    : Controller(controller)
  {
  }

  void Send(const Message& message)
  {
    this->Sent.remove_if([](Letter& letter) { return letter.Request.Test() != 0; });
    for (int rank = 0; rank < this->Controller->GetNumberOfProcesses(); ++rank)
    {
      if (rank != this->Controller->GetLocalProcessId())
      {
        this->Sent.push_back({ message, {} });
        Letter& letter = this->Sent.back();
        this->Controller->NoBlockSend(letter.Content.data(), 2, rank, tag, letter.Request);
      }
    }
  }

  // Takes the first message of a rank that satisfies a condition out of what has come.
  template <class Condition>
  bool Take(int rank, const Condition& condition)
  {
    std::deque<Message>& box = this->Boxes[rank];
    for (int has = 0, source = 0; this->Controller->Iprobe(rank, tag, &has, &source) && has;)
    {
      Message message{};
      this->Controller->Receive(message.data(), 2, rank, tag);
      box.push_back(message);
    }
    const auto found = std::find_if(box.begin(), box.end(), condition);
    if (found == box.end())
    {
      return false;
    }
    box.erase(found);
    return true;
  }

private:
  struct Letter
  {
    Message Content;
    vtkMPICommunicator::Request Request;
  };

  vtkMPIController* Controller;
  std::list<Letter> Sent;
  std::map<int, std::deque<Message>> Boxes;
};

} // namespace

RankAgreement compareRanks(int piece, int pieces, const std::string& filter,
  const std::vector<vtkDataObject*>& data, int& rank)
{
  auto* controller =
    vtkMPIController::SafeDownCast(vtkMultiProcessController::GetGlobalController());
  const int ranks = controller ? controller->GetNumberOfProcesses() : 1;
  const int own = controller ? controller->GetLocalProcessId() : 0;
  if (ranks < 2 || pieces != ranks || piece != own)
  {
    return RankAgreement::Same;
  }
  static Post post(controller);
  const unsigned long kind = std::hash<std::string>()(filter);
  const unsigned long fingerprint = fingerprintOf(data);
  post.Send({ kind, fingerprint });
  const auto start = Clock::now();
  for (rank = 0; rank < ranks; ++rank)
  {
    const auto isSame = [&](const Message& message) {
      const unsigned long higher = rank > own ? message[1] : fingerprint;
      return message[0] == kind && (message[1] == fingerprint || higher == 0);
    };
    while (rank != own && !post.Take(rank, isSame))
    {
      const auto waited = Clock::now() - start;
      if (waited > grace &&
        post.Take(rank, [kind](const Message& message) { return message[0] == kind; }))
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
  return RankAgreement::Same;
}

#else

RankAgreement compareRanks(int, int, const std::string&, const std::vector<vtkDataObject*>&, int&)
{
  return RankAgreement::Same;
}

#endif

} // namespace RectifiedTransport
