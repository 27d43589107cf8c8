// SPDX-License-Identifier: BSD-3-Clause
// Small work on one thread. Threads that wait for each other after every short loop lose more than
// they gain, above all where other programs keep the processor busy.
#ifndef RectifiedTransport_SmallWork_h
#define RectifiedTransport_SmallWork_h

#include "Core/Parallel/Context.h"
#include "Core/Parallel/Executor.h"

namespace RectifiedTransport
{

// The context for work on so many values, many loops of some nanoseconds a value.
inline Context contextForSize(Context context, double values)
{
  static const SerialExecutor serial;
  constexpr double fewestForThreads = 0x1p16;
  if (values < fewestForThreads)
  {
    context.Threads = &serial;
  }
  return context;
}

} // namespace RectifiedTransport

#endif
