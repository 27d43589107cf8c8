// SPDX-License-Identifier: BSD-3-Clause
// Boxes far along an axis: where nodes are is counted in 64 bits.
#include "Core/Tables/TableView.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#ifdef __linux__
#include <sys/mman.h>
#endif

#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

#define RT_INLINE inline __attribute__((always_inline))

namespace RectifiedTransport
{
namespace
{

constexpr int BlockSize = 64;

#include "Core/Flow/Kernels/Vectors.txx"

#include "Core/Flow/Kernels/Shared/Language.h"

#include "Core/Flow/Kernels/Shared/BoxMoments.h"

#include "Core/Flow/Kernels/BoxMoments.txx"

#ifdef __linux__
// Tables of a line of 2^29 + 8 cells of mass 1, of which the last ones are there alone.
// Memory that nobody writes takes none.
TEST(BoxMoments, FarAlongALine)
{
  constexpr std::int64_t cells = (std::int64_t{ 1 } << 29) + 8;
  constexpr std::int64_t row = (cells + 1) * TableView<3>::Record;
  constexpr std::int64_t before = std::int64_t{ 1 } << 32; // what a wrong sign would reach
  const std::size_t bytes = (before + 4 * row) * sizeof(double);
  void* memory = mmap(
    nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED)
  {
    GTEST_SKIP() << "there are no " << bytes << " bytes of addresses";
  }
  double* nodes = static_cast<double*>(memory) + before;
  // Below a node of the last row of the last plane; the others have none.
  for (std::int64_t node = cells - 8; node <= cells; ++node)
  {
    const auto mass = static_cast<double>(node);
    const double record[4] = { mass, 3.0 * mass, 0.5 * mass, 0.25 * mass };
    std::memcpy(nodes + 3 * row + node * TableView<3>::Record, record, sizeof(record));
  }
  TableView<3> tables{};
  tables.LevelCount = 1;
  tables.Levels[0] = { nodes, { TableView<3>::Record, row, 2 * row } };

  // From 5/4 to 7/2 cells beyond 2^29, whole along the other axes.
  BoxLanes<3> boxes{};
  const double places[2] = { 1.25, 3.5 };
  boxes.Faces[0] =
    RT_BOTH_FACES << facesShift(1) | static_cast<std::int64_t>(RT_BOTH_FACES) << facesShift(2);
  for (int side = 0; side < 2; ++side)
  {
    const auto whole = static_cast<std::int32_t>(places[side]);
    const double place = places[side] - whole;
    const double node = static_cast<double>(cells - 8) + whole;
    boxes.Node[0][side][0] = static_cast<std::int32_t>(node);
    boxes.Place[0][side][0] = place;
    boxes.MomentWeight[0][side][0] = place * (node + 0.5 * place) / (node + 0.5);
  }
  sumBox(tables, boxes, 0);
  munmap(memory, bytes);
  EXPECT_EQ(boxes.Mass[0], 2.25);
  EXPECT_NEAR(boxes.Moment[0][0], 3.0 * 2.25, 1e-5);
  EXPECT_NEAR(boxes.Moment[1][0], 0.5 * 2.25, 1e-6);
  EXPECT_NEAR(boxes.Moment[2][0], 0.25 * 2.25, 1e-6);
}
#endif

} // namespace
} // namespace RectifiedTransport
