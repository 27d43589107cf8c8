// SPDX-License-Identifier: BSD-3-Clause
// Texts of files that may be numbers.
#ifndef RectifiedTransport_NumberText_h
#define RectifiedTransport_NumberText_h

#include <optional>
#include <string>

namespace RectifiedTransport
{

bool isBlank(const std::string& text);

// Returns the number that a text represents, in any locale with a dot as decimal separator and with
// blanks around it; NaN and infinity are read by their names. Returns no value for other texts.
std::optional<double> parseNumber(const std::string& text);

// Returns the first 40 bytes, for a message.
std::string shortened(const std::string& text);

} // namespace RectifiedTransport

#endif
