// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Messages/NumberText.h"

#include <charconv>
#include <system_error>

namespace RectifiedTransport
{

namespace
{

const char* const blanks = " \t\r\n\f\v";

} // namespace

bool isBlank(const std::string& text)
{
  return text.find_first_not_of(blanks) == std::string::npos;
}

std::optional<double> parseNumber(const std::string& text)
{
  if (isBlank(text))
  {
    return std::nullopt;
  }
  const char* first = text.data() + text.find_first_not_of(blanks);
  const char* last = text.data() + text.find_last_not_of(blanks) + 1;
  // from_chars takes a minus alone.
  if (*first == '+' && last - first > 1 && first[1] != '-')
  {
    ++first;
  }
  double number = 0.0;
  std::from_chars_result read = std::from_chars(first, last, number);
  if (read.ec == std::errc::result_out_of_range)
  {
    // Infinite past the largest double, 0 below the least one, as literals are.
    long double wide = 0.0L;
    read = std::from_chars(first, last, wide);
    number = static_cast<double>(wide);
  }
  return read.ec == std::errc() && read.ptr == last ? std::optional<double>(number) : std::nullopt;
}

std::string shortened(const std::string& text)
{
  // The bound keeps a message that quotes a text on one line.
  constexpr std::size_t most = 40;
  return text.size() > most ? text.substr(0, most) + "..." : text;
}

} // namespace RectifiedTransport
