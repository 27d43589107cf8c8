// SPDX-License-Identifier: BSD-3-Clause
// Tests on a device of this machine. Without one they are skipped, unless RT_OPENCL says that there
// is one.
#ifndef RectifiedTransport_OfADevice_h
#define RectifiedTransport_OfADevice_h

#include "Devices/Device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <memory>
#include <string>

namespace RectifiedTransport
{

inline std::string errorOf(const std::function<void()>& function)
{
  try
  {
    function();
  }
  catch (const DeviceError& error)
  {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

class OfADevice : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const std::string reason =
      errorOf([this]() { this->Opened = std::static_pointer_cast<Device>(openDevice("")); });
    if (!this->Opened)
    {
      ASSERT_EQ(std::getenv("RT_OPENCL"), nullptr) << reason;
      GTEST_SKIP() << reason;
    }
  }

  std::shared_ptr<Device> Opened;
};

} // namespace RectifiedTransport

#endif
