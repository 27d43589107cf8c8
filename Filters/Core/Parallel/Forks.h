// SPDX-License-Identifier: BSD-3-Clause
// Whether fork() made this process: its threads are not its parent's.
#ifndef RectifiedTransport_Forks_h
#define RectifiedTransport_Forks_h

namespace RectifiedTransport
{

// How many calls of fork() lie between the process that loaded this library and this one. A child
// has none of its parent's threads, and pools of threads wait there for them for ever; so if this
// is above 0, loops run on the calling thread. A program that a child starts by exec() counts from
// 0 again.
int forksSinceLoad() noexcept;

} // namespace RectifiedTransport

#endif
