// SPDX-License-Identifier: BSD-3-Clause
#include "FailingAllocations.h"
#include "SolidSurfaces.h"
#include "Surfaces/Solid/SolidCoverage.h"

#include <gtest/gtest.h>

#include <vector>

namespace RectifiedTransport
{
namespace
{

TEST(SolidMemory, RunsOut)
{
  if (!canRunOut)
  {
    GTEST_SKIP() << "Memory does not run out under a sanitizer";
  }
  const GridSize<3> cells{ 9, 8, 7 };
  const Mesh solid = makeTetrahedron({ 1, 1, 1 }, { 8, 2, 2 }, { 3, 7, 2 }, { 4, 4, 6 });
  std::vector<double> values(504);
  expectBadAlloc("a solid", [&]() { coverSolid(solid.Surface(), cells, 3, values.data()); });
}

} // namespace
} // namespace RectifiedTransport
