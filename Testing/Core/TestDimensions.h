// SPDX-License-Identifier: BSD-3-Clause
// What the tests for one to three dimensions share.
#ifndef RectifiedTransport_TestDimensions_h
#define RectifiedTransport_TestDimensions_h

#include "Core/Geometry/GridSize.h"

#include <gtest/gtest.h>

#include <tuple>
#include <type_traits>

namespace RectifiedTransport
{

template <int Dimension>
using Dim = std::integral_constant<int, Dimension>;
using Dimensions = testing::Types<Dim<1>, Dim<2>, Dim<3>>;
using PlaneAndSpace = testing::Types<Dim<2>, Dim<3>>;

// A typed test of its own name is an alias of it.
template <class T>
class DimensionTest : public testing::Test
{
};

// The size that is given for the dimension.
template <int Dimension>
GridSize<Dimension> sizeFor(
  const GridSize<1>& line, const GridSize<2>& plane, const GridSize<3>& volume)
{
  return std::get<GridSize<Dimension>>(std::make_tuple(line, plane, volume));
}

} // namespace RectifiedTransport

#endif
