// SPDX-License-Identifier: BSD-3-Clause
// Values that are NaN or infinite, counted for a message.
#ifndef RectifiedTransport_NotFiniteValues_h
#define RectifiedTransport_NotFiniteValues_h

#include <cstdint>
#include <string>

namespace RectifiedTransport
{

struct NotFiniteValues
{
  std::int64_t Count = 0;
  std::int64_t First = -1; // the index of the first one

  void Add(std::int64_t index) { this->First = this->Count++ == 0 ? index : this->First; }
  // Adds the count of values that come after these ones in the array.
  void Add(const NotFiniteValues& later)
  {
    this->First = this->Count == 0 ? later.First : this->First;
    this->Count += later.Count;
  }
  // "has 3 points that are NaN or infinite, the first at index 7".
  std::string Text(const std::string& value) const
  {
    return "has " + std::to_string(this->Count) + " " + value +
      (this->Count == 1 ? " that is" : "s that are") + " NaN or infinite, the first at index " +
      std::to_string(this->First);
  }
};

} // namespace RectifiedTransport

#endif
