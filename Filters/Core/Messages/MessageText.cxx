// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Messages/MessageText.h"

#include <cstddef>

namespace RectifiedTransport
{

namespace
{

// The bytes of the character of UTF-8 at the beginning of a text that ends with '\0'; 0: none is
// there.
std::size_t lengthOfCharacter(const char* text)
{
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80)
  {
    return 1;
  }
  // Leads 0xC0 and 0xC1 could only begin overlong forms, and leads from 0xF5 on would begin
  // characters beyond U+10FFFF.
  const std::size_t length = lead >= 0xC2 && lead < 0xE0 ? 2
    : (lead & 0xF0) == 0xE0                              ? 3
    : lead >= 0xF0 && lead < 0xF5                        ? 4
                                                         : 0;
  for (std::size_t i = 1; i < length; ++i)
  {
    if ((byte(i) & 0xC0) != 0x80)
    {
      return 0;
    }
  }
  // These second bytes begin an overlong form, a surrogate, or a character beyond U+10FFFF.
  const unsigned char next = length > 2 ? byte(1) : 0;
  const bool isNone = (lead == 0xE0 && next < 0xA0) || (lead == 0xED && next > 0x9F) ||
    (lead == 0xF0 && next < 0x90) || (lead == 0xF4 && next > 0x8F);
  return isNone ? 0 : length;
}

} // namespace

std::string messageText(const std::string& text)
{
  std::string result;
  for (std::size_t i = 0; i < text.size();)
  {
    const std::size_t length = lengthOfCharacter(text.c_str() + i);
    if (length > 0)
    {
      result.append(text, i, length);
    }
    else
    {
      // A Latin-1 byte has the code point of its value, which takes two bytes in UTF-8.
      const auto byte = static_cast<unsigned char>(text[i]);
      result += static_cast<char>(0xC0 | (byte >> 6));
      result += static_cast<char>(0x80 | (byte & 0x3F));
    }
    i += length > 0 ? length : 1;
  }
  return result;
}

} // namespace RectifiedTransport
