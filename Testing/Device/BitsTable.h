// SPDX-License-Identifier: BSD-3-Clause
// The table of what was compared to the bit: how many differ, and the first place that does.
#ifndef RectifiedTransport_BitsTable_h
#define RectifiedTransport_BitsTable_h

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

namespace RectifiedTransport
{

// "1,234,567"
std::string grouped(std::int64_t number);

// A value in decimal digits that tell it from all others, and its bits.
template <class Real>
std::string exactly(Real value)
{
  constexpr int digits = sizeof(Real) == sizeof(double) ? 17 : 9;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(value)); // little endian, as all that is supported
  char text[64];
  std::snprintf(text, sizeof(text), "%.*g (%0*llx)", digits, static_cast<double>(value),
    static_cast<int>(2 * sizeof(Real)), static_cast<unsigned long long>(bits));
  return text;
}

struct BitsCount
{
  std::int64_t Of = 0;
  std::int64_t Differ = 0;
  std::string First; // the first place that differs, with both values

  // Counts one thing; describe() is called for the first that differs.
  template <class Describe>
  void Add(bool isSame, const Describe& describe)
  {
    ++this->Of;
    if (!isSame && ++this->Differ == 1)
    {
      this->First = describe();
    }
  }
};

// "what: the device ..., the processor ..."
template <class Value>
std::string bothValues(const std::string& what, const Value& device, const Value& processor)
{
  return what + ": device " + device + ", processor " + processor;
}

// Prints each row when it is known.
class BitsTable
{
public:
  static void PrintHead(const char* title);

  void Add(const std::string& kernel, const std::string& what, const BitsCount& count);
  // The device did not do it.
  void AddFault(const std::string& kernel, const std::string& what, const std::string& fault);
  // What should differ, to see that a difference is found; it does not count.
  static void Print(const std::string& kernel, const std::string& what, const BitsCount& count);

  std::int64_t Compared() const { return this->All; }
  bool IsRight() const { return this->Wrong == 0; }

private:
  std::int64_t All = 0;
  std::int64_t Wrong = 0; // rows
};

} // namespace RectifiedTransport

#endif
