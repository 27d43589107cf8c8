// SPDX-License-Identifier: BSD-3-Clause
// From a dimension that is known at run time to one that templates take.
#ifndef RectifiedTransport_Dispatch_h
#define RectifiedTransport_Dispatch_h

namespace RectifiedTransport
{

// Of a function for each number of axes, the one for `dimension`:
//
//   dispatchDimension(dimension, sample<1>, sample<2>, sample<3>)(arguments)
template <class Function>
Function dispatchDimension(int dimension, Function one, Function two, Function three)
{
  return dimension == 1 ? one : dimension == 2 ? two : three;
}

} // namespace RectifiedTransport

#endif
