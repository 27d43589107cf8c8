// SPDX-License-Identifier: BSD-3-Clause
// The interface through which a host application runs range kernels on its threads, and two
// executors.
#ifndef RectifiedTransport_Executor_h
#define RectifiedTransport_Executor_h

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <type_traits>

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

// For executors: keeps the first exception, because an exception that leaves a thread of the
// executor terminates the program. Ranges after it need not run.
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
  // Call it when all threads are done: throws the kept exception.
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

// Runs a kernel over [0, count) in ranges that end at multiples of `grain`, or at count, so that
// the results of a range cannot depend on the number of threads. An exception of a kernel leaves
// For when no thread runs the kernel any more; some ranges may then not have run.
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

// Serial if the library was built without OpenMP.
class OpenMPExecutor final : public Executor
{
public:
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override;
  int Concurrency() const override;
};

} // namespace RectifiedTransport

#endif
