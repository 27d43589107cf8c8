// SPDX-License-Identifier: BSD-3-Clause
// From a dimension that is known at run time to one that templates take.
#ifndef RectifiedTransport_Dispatch_h
#define RectifiedTransport_Dispatch_h

#include <type_traits>

namespace RectifiedTransport
{

// Calls function(dimension) with a std::integral_constant of 1, 2 or 3, and returns what it
// returns.
template <class Function>
auto dispatchDimension(int dimension, Function&& function)
{
  return dimension == 1 ? function(std::integral_constant<int, 1>())
    : dimension == 2    ? function(std::integral_constant<int, 2>())
                        : function(std::integral_constant<int, 3>());
}

} // namespace RectifiedTransport

#endif
