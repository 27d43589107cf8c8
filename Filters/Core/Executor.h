// SPDX-License-Identifier: BSD-3-Clause
// Who runs the range kernels: the host decides, the mathematics does not know.
#ifndef RectifiedTransport_Executor_h
#define RectifiedTransport_Executor_h

#include <cstdint>
#include <functional>
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

// Runs a kernel over [0, count) in ranges that are cut at multiples of `grain` only, so that what
// a range computes cannot depend on the number of threads. Kernels must not throw.
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

// What the host wants to hear and may say during long work. Progress is in [0,1] and called on
// the thread that called the library only; Cancelled may be called on any thread, one at a time.
// Neither may throw.
struct Monitor
{
  std::function<void(double)> Progress;
  std::function<bool()> Cancelled;
};

} // namespace RectifiedTransport

#endif
