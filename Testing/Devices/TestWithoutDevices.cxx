// SPDX-License-Identifier: BSD-3-Clause
// Filters of a build without OpenCL have no devices, and say why.
#include "Devices/SharedDevices.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

TEST(WithoutDevices, NoneServes)
{
  EXPECT_TRUE(deviceNames().empty());
  CachedDevice kept;
  DeviceUse use = kept.Begin("", 0);
  EXPECT_EQ(kept.Get(), nullptr);
  EXPECT_FALSE(use.Serves());
  EXPECT_NE(use.Fault().find("built without OpenCL"), std::string::npos) << use.Fault();
  bool isRun = false;
  EXPECT_FALSE(use.Run([&]() { isRun = true; }));
  EXPECT_FALSE(isRun);
}

} // namespace
} // namespace RectifiedTransport
