// SPDX-License-Identifier: BSD-3-Clause
// From a dimension known at run time to a template argument.
#ifndef RectifiedTransport_Dispatch_h
#define RectifiedTransport_Dispatch_h

namespace RectifiedTransport
{

// Selects the instantiation for `dimension`, 1, 2 or 3:
//
//   dispatchDimension(dimension, sample<1>, sample<2>, sample<3>)(arguments)
template <class Function>
Function dispatchDimension(int dimension, Function one, Function two, Function three)
{
  return dimension == 1 ? one : dimension == 2 ? two : three;
}

} // namespace RectifiedTransport

#endif
