// SPDX-License-Identifier: BSD-3-Clause
// The input array of a filter's target, which is array 1.
#ifndef RectifiedTransport_TargetArray_h
#define RectifiedTransport_TargetArray_h

#include <utility>

namespace RectifiedTransport::Bridge
{

// The index and the port to keep, for those given to SetInputArrayToProcess. The array is looked up
// in the target's data object, so that its port is 0 here: ParaView copies the arrays of port 1
// from index 0 on, and stops at the first one of another port.
inline std::pair<int, int> targetArray(int index, int port)
{
  const bool isTarget = port == 1 || index == 1;
  return { isTarget ? 1 : index, isTarget ? 0 : port };
}

} // namespace RectifiedTransport::Bridge

#endif
