// SPDX-License-Identifier: BSD-3-Clause
// How much memory buffers take.
#include "Core/Parallel/LargeBuffer.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::size_t megabyte = std::size_t{ 1 } << 20;

// Of this process, in bytes; 0 where the system does not tell.
double residentMemory()
{
  long pages = 0;
  if (std::FILE* sizes = std::fopen("/proc/self/statm", "r"))
  {
    if (std::fscanf(sizes, "%*d %ld", &pages) != 1)
    {
      pages = 0;
    }
    std::fclose(sizes);
  }
  return 4096.0 * static_cast<double>(pages);
}

} // namespace

TEST(LargeBuffer, HasHugePagesThatItFills)
{
  EXPECT_EQ(bytesOnHugePages(0), 0u);
  EXPECT_EQ(bytesOnHugePages(megabyte), 0u);
  EXPECT_EQ(bytesOnHugePages(3 * megabyte / 2), 0u);
  EXPECT_EQ(bytesOnHugePages(15 * megabyte / 8), 2 * megabyte);
  EXPECT_EQ(bytesOnHugePages(2 * megabyte), 2 * megabyte);
  EXPECT_EQ(bytesOnHugePages(3 * megabyte), 2 * megabyte);
  EXPECT_EQ(bytesOnHugePages(64 * megabyte + 1), 64 * megabyte);
  EXPECT_EQ(bytesOnHugePages(65 * megabyte), 66 * megabyte);
  for (std::size_t bytes = 1; bytes < 40 * megabyte; bytes += 77777)
  {
    EXPECT_LE(bytesOnHugePages(bytes), bytes + bytes / 8) << bytes;
  }
}

TEST(LargeBuffer, TakesTheMemoryOfItsBytes)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "A sanitizer takes memory of its own for each byte";
#endif
  for (const std::size_t bytes : { megabyte, 3 * megabyte / 2, 5 * megabyte / 2, 4 * megabyte })
  {
    constexpr int many = 24;
    std::vector<LargeBuffer<char>> buffers;
    buffers.reserve(many);
    const double before = residentMemory();
    for (int i = 0; i < many; ++i)
    {
      buffers.emplace_back(static_cast<std::int64_t>(bytes));
      std::memset(buffers.back().data(), i, bytes);
    }
    EXPECT_LE(residentMemory() - before, 1.13 * many * static_cast<double>(bytes)) << bytes;
  }
}

} // namespace RectifiedTransport
