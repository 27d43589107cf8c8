// SPDX-License-Identifier: BSD-3-Clause
// Times of whole flows on the processor and on a device.
#ifndef RectifiedTransport_Times_h
#define RectifiedTransport_Times_h

#include "BitsTable.h"

#include <memory>

namespace RectifiedTransport
{

class Device;

enum class TimesForm
{
  Text,
  CommaSeparated // times in ms
};

struct TimesChoice
{
  bool IsQuick = false; // small cases, once
  bool HasLarge = false;
  TimesForm Form = TimesForm::Text;
};

// Prints medians of 5, and the least. Positions are compared, too.
void measureTimes(
  const std::shared_ptr<Device>& device, const TimesChoice& choice, BitsTable& table);

} // namespace RectifiedTransport

#endif
