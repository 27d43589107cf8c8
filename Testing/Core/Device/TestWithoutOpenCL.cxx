// SPDX-License-Identifier: BSD-3-Clause
// A library that was built without OpenCL has no devices, and says why.
#include "Core/Device/DeviceError.h"
#include "Core/Device/DeviceList.h"

#include <gtest/gtest.h>

#include <string>

namespace RectifiedTransport
{

TEST(DeviceList, IsEmptyWithoutOpenCL)
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
  EXPECT_NE(text.find("built without OpenCL"), std::string::npos) << text;
}

} // namespace RectifiedTransport
