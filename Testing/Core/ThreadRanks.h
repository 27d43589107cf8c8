// SPDX-License-Identifier: BSD-3-Clause
// Ranks that are threads of one process, for tests of what several processes compute together.
#ifndef ThreadRanks_h
#define ThreadRanks_h

#include "Core/Parallel/Ranks.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// What the ranks share: all come to each exchange, or one has left.
class RankBoard
{
public:
  explicit RankBoard(int count)
    : Sent(static_cast<std::size_t>(count))
    , Waiting(0)
  {
  }

  int Count() const { return static_cast<int>(this->Sent.size()); }

  std::vector<Bytes> Exchange(int own, std::vector<Bytes> parts)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Sent[static_cast<std::size_t>(own)] = std::move(parts);
    this->Meet(lock);
    std::vector<Bytes> received;
    for (std::vector<Bytes>& from : this->Sent)
    {
      received.push_back(std::move(from[static_cast<std::size_t>(own)]));
    }
    this->Meet(lock);
    return received;
  }

  void Leave()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->HasLeft = true;
    this->Condition.notify_all();
  }

private:
  void Meet(std::unique_lock<std::mutex>& lock)
  {
    const std::int64_t meeting = this->Meetings;
    if (++this->Waiting == this->Count())
    {
      this->Waiting = 0;
      ++this->Meetings;
      this->Condition.notify_all();
    }
    this->Condition.wait(lock, [&]() { return this->Meetings > meeting || this->HasLeft; });
    if (this->Meetings == meeting)
    {
      throw FailedElsewhere();
    }
  }

  std::mutex Mutex;
  std::condition_variable Condition;
  std::vector<std::vector<Bytes>> Sent; // by rank, for each
  int Waiting;
  std::int64_t Meetings = 0;
  bool HasLeft = false;
};

class ThreadRanks final : public Ranks
{
public:
  ThreadRanks(RankBoard& board, int own)
    : Board(board)
    , Number(own)
  {
  }
  int Count() const override { return this->Board.Count(); }
  int Own() const override { return this->Number; }
  std::vector<Bytes> Gather(const Bytes& own) const override
  {
    return this->Exchange(std::vector<Bytes>(static_cast<std::size_t>(this->Count()), own));
  }
  std::vector<Bytes> Exchange(std::vector<Bytes> parts) const override
  {
    return this->Board.Exchange(this->Number, std::move(parts));
  }

private:
  RankBoard& Board;
  const int Number;
};

// Calls function(ranks) on each of so many. Rethrows the exception of the one that failed first in
// their order.
template <class Function>
void runOnRanks(int count, const Function& function)
{
  RankBoard board(count);
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(count));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < count; ++rank)
  {
    threads.emplace_back([&, rank]() {
      try
      {
        function(ThreadRanks(board, rank));
      }
      catch (const FailedElsewhere&)
      {
      }
      catch (...)
      {
        failures[static_cast<std::size_t>(rank)] = std::current_exception();
        board.Leave();
      }
    });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const std::exception_ptr& failure : failures)
  {
    if (failure)
    {
      std::rethrow_exception(failure);
    }
  }
}

} // namespace RectifiedTransport

#endif
