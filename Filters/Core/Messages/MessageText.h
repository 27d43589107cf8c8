// SPDX-License-Identifier: BSD-3-Clause
// Errors and warnings as UTF-8, whatever the names in a file are.
#ifndef RectifiedTransport_MessageText_h
#define RectifiedTransport_MessageText_h

#include <string>

namespace RectifiedTransport
{

// Bytes that are no UTF-8 are read as Latin-1, as in old files: Python's observers get no text at
// all if one byte is wrong.
std::string messageText(const std::string& text);

} // namespace RectifiedTransport

#endif
