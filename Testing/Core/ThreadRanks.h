// SPDX-License-Identifier: BSD-3-Clause
// Ranks that are threads of the test.
#ifndef ThreadRanks_h
#define ThreadRanks_h

#include "Core/Parallel/Ranks.h"

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// What each rank sends to each, in turns.
class RankTable
{
public:
  explicit RankTable(std::size_t ranks)
    : Sent(ranks)
  {
  }
  std::vector<Bytes> Exchange(std::size_t own, std::vector<Bytes> parts)
  {
    this->Sent[own] = std::move(parts);
    this->Wait();
    std::vector<Bytes> received;
    for (const std::vector<Bytes>& sent : this->Sent)
    {
      received.push_back(sent[own]);
    }
    this->Wait();
    return received;
  }

private:
  void Wait()
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    const std::size_t turn = this->Turn;
    if (++this->Waiting == this->Sent.size())
    {
      this->Waiting = 0;
      ++this->Turn;
      this->Changed.notify_all();
      return;
    }
    this->Changed.wait(lock, [&]() { return this->Turn != turn; });
  }

  std::vector<std::vector<Bytes>> Sent;
  std::mutex Mutex;
  std::condition_variable Changed;
  std::size_t Waiting = 0;
  std::size_t Turn = 0;
};

class ThreadRank final : public Ranks
{
public:
  ThreadRank(RankTable& table, int count, int own)
    : Table(table)
    , Number(count)
    , Rank(own)
  {
  }
  int Count() const override { return this->Number; }
  int Own() const override { return this->Rank; }
  std::vector<Bytes> Gather(const Bytes& own) const override
  {
    return this->Exchange(std::vector<Bytes>(static_cast<std::size_t>(this->Number), own));
  }
  std::vector<Bytes> Exchange(std::vector<Bytes> parts) const override
  {
    return this->Table.Exchange(static_cast<std::size_t>(this->Rank), std::move(parts));
  }

private:
  RankTable& Table;
  int Number;
  int Rank;
};

// Calls run(rank) on each of `count` ranks, which must not throw.
template <class Run>
void onRanks(int count, const Run& run)
{
  RankTable table(static_cast<std::size_t>(count));
  std::vector<std::thread> threads;
  for (int own = 0; own < count; ++own)
  {
    threads.emplace_back([&table, &run, count, own]() { run(ThreadRank(table, count, own)); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

} // namespace RectifiedTransport

#endif
