// SPDX-License-Identifier: BSD-3-Clause
// A library that was built without OpenCL has no devices, and says why; flows are the processor's.
#include "Core/Device/DeviceError.h"
#include "Core/Device/DeviceList.h"
#include "Core/Device/DeviceUse.h"
#include "Core/Flow/Devices/DeviceAdvection.h"

#include <gtest/gtest.h>

#include <string>

namespace RectifiedTransport
{
namespace
{

constexpr const char* reason = "built without OpenCL";

TEST(WithoutOpenCL, ThereAreNoDevices)
{
  EXPECT_TRUE(listDevices().empty());
  std::string text;
  try
  {
    openDevice("");
  }
  catch (const DeviceError& error)
  {
    text = error.what();
  }
  EXPECT_NE(text.find(reason), std::string::npos) << text;
}

TEST(WithoutOpenCL, NoneServes)
{
  DeviceUse use = DeviceUse::Open("");
  EXPECT_FALSE(use.Serves());
  EXPECT_NE(use.Fault().find(reason), std::string::npos) << use.Fault();
  bool isRun = false;
  EXPECT_FALSE(use.Run([&](Device&) { isRun = true; }));
  EXPECT_FALSE(isRun);
}

TEST(WithoutOpenCL, FlowsAreTheProcessors)
{
  EXPECT_FALSE(DeviceFlow<2>::Serves(AdvectionKind::Forward, {}));
  EXPECT_FALSE(DeviceFlow<3>::Serves(AdvectionKind::Backward, {}));
}

} // namespace
} // namespace RectifiedTransport
