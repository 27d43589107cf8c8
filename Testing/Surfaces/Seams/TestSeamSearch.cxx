// SPDX-License-Identifier: BSD-3-Clause
// Shortest paths to seams: their lengths, and those that are too short to be worth while.
#include "Core/Parallel/Progress.h"
#include "DiskSurfaces.h"
#include "Surfaces/Seams/SeamSearch.h"

#include <gtest/gtest.h>

#include <numeric>

namespace RectifiedTransport
{
namespace
{

constexpr std::int64_t cells = 8;

SeamMesh makeSheet()
{
  const Mesh mesh = makeRectangle(cells, cells);
  std::vector<std::int64_t> triangles;
  for (const auto& triangle : mesh.Triangles)
  {
    triangles.insert(triangles.end(), triangle.begin(), triangle.end());
  }
  std::vector<std::int64_t> origins(mesh.Triangles.size());
  std::iota(origins.begin(), origins.end(), std::int64_t{ 0 });
  return { mesh.Points, triangles, origins };
}

TEST(SeamSearch, JoinsPointsToTheBoundary)
{
  // Three cells from the left side.
  constexpr std::int64_t point = 4 * (cells + 1) + 3;
  constexpr double length = 3.0 / cells;
  for (const double least : { 0.0, 0.99 * length, 1.01 * length })
  {
    SeamMesh sheet = makeSheet();
    Progress progress{ Context() };
    SeamSearch search(sheet, progress);
    const bool isLong = least < length;
    EXPECT_EQ(joinToSeams(sheet, search, point, least), isLong) << least;
    EXPECT_EQ(sheet.SeamsAt(point), isLong ? 1 : 0);
    EXPECT_EQ(sheet.SeamsAt(point - 1), isLong ? 2 : 0);
    EXPECT_EQ(sheet.SeamsAt(point - 3), isLong ? 3 : 2);
    EXPECT_EQ(joinToSeams(sheet, search, point - 3, 0.0), false) << "on a seam already";
  }
}

} // namespace
} // namespace RectifiedTransport
