// SPDX-License-Identifier: BSD-3-Clause
#ifndef Campaign_Watch_h
#define Campaign_Watch_h

namespace Campaign
{

// What does not end by itself is ended by a signal, after as many seconds of its own threads: what
// else the machine does is no matter. On Linux; elsewhere run.py ends it.
void startWatch(int seconds);

} // namespace Campaign

#endif
