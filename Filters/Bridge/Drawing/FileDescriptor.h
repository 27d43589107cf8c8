// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_FileDescriptor_h
#define RectifiedTransport_FileDescriptor_h

#include <unistd.h>

#include <utility>

namespace RectifiedTransport::Bridge
{

// An open file of POSIX, or none.
class FileDescriptor
{
public:
  explicit FileDescriptor(int number = -1)
    : Number(number)
  {
  }
  ~FileDescriptor() { this->Close(); }
  FileDescriptor(FileDescriptor&& other) noexcept
    : Number(std::exchange(other.Number, -1))
  {
  }
  FileDescriptor& operator=(FileDescriptor&& other) noexcept
  {
    std::swap(this->Number, other.Number);
    return *this;
  }

  bool IsOpen() const { return this->Number >= 0; }
  int Get() const { return this->Number; }
  // Returns whether all of it was written; errno says why not.
  bool Close() { return this->Number < 0 || close(std::exchange(this->Number, -1)) == 0; }

private:
  int Number;
};

} // namespace RectifiedTransport::Bridge

#endif
