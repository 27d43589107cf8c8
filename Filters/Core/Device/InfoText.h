// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_InfoText_h
#define RectifiedTransport_InfoText_h

#include <cstddef>
#include <string>

namespace RectifiedTransport
{

// A text that OpenCL gives by get(size, text, needed size).
template <class Get>
std::string infoText(const Get& get)
{
  std::size_t size = 0;
  get(0, nullptr, &size);
  std::string text(size, '\0');
  if (size > 0)
  {
    get(size, text.data(), nullptr);
  }
  return text.substr(0, text.find('\0'));
}

} // namespace RectifiedTransport

#endif
