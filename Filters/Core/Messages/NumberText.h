// SPDX-License-Identifier: BSD-3-Clause
// Texts of files that may be numbers.
#ifndef RectifiedTransport_NumberText_h
#define RectifiedTransport_NumberText_h

#include <optional>
#include <string>

namespace RectifiedTransport
{

bool isBlank(const std::string& text);

// The number that a text is, with a dot and blanks around it in any locale; NaN and infinite ones
// by their names. No value for other texts.
std::optional<double> numberOfText(const std::string& text);

// The first 40 bytes for a message.
std::string shortened(const std::string& text);

} // namespace RectifiedTransport

#endif
