// SPDX-License-Identifier: BSD-3-Clause
// Who runs the range kernels: the host decides, the mathematics does not know.
#ifndef RectifiedTransport_Executor_h
#define RectifiedTransport_Executor_h

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <type_traits>
#include <utility>

namespace RectifiedTransport
{

// A non-owning reference to a callable void(std::int64_t first, std::int64_t last).
class RangeKernel
{
public:
  template <class F, class = std::enable_if_t<!std::is_same_v<std::decay_t<F>, RangeKernel>>>
  RangeKernel(F&& function)
    : Object(const_cast<void*>(static_cast<const void*>(std::addressof(function))))
    , Call([](void* object, std::int64_t first, std::int64_t last) {
      (*static_cast<std::remove_reference_t<F>*>(object))(first, last);
    })
  {
  }
  void operator()(std::int64_t first, std::int64_t last) const
  {
    this->Call(this->Object, first, last);
  }

private:
  void* Object;
  void (*Call)(void*, std::int64_t, std::int64_t);
};

// For executors: no exception may leave a thread that the executor runs, or the program ends. The
// first one is kept; ranges after it need not run.
class KernelFailure
{
public:
  bool HasHappened() const { return this->Happened.load(std::memory_order_relaxed); }
  // Keeps the exception that is being handled.
  void Keep() noexcept
  {
    if (!this->Happened.exchange(true))
    {
      this->First = std::current_exception();
    }
  }
  // Once all threads are done: throws what was kept.
  void Rethrow() const
  {
    if (this->First)
    {
      std::rethrow_exception(this->First);
    }
  }

private:
  std::atomic<bool> Happened{ false };
  std::exception_ptr First;
};

// Runs a kernel over [0, count) in ranges that are cut at multiples of `grain` only, so that what
// a range computes cannot depend on the number of threads. What a kernel throws comes out of For,
// when no thread runs it any more; some ranges have not run then.
class Executor
{
public:
  virtual ~Executor() = default;
  virtual void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const = 0;
  // The number of ranges that may run at one time; a hint for the size of a slice of work.
  virtual int Concurrency() const = 0;
};

class SerialExecutor final : public Executor
{
public:
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override;
  int Concurrency() const override { return 1; }
};

// Serial where the library was built without OpenMP.
class OpenMPExecutor final : public Executor
{
public:
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override;
  int Concurrency() const override;
};

} // namespace RectifiedTransport

#endif
