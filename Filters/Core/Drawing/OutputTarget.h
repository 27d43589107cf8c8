// SPDX-License-Identifier: BSD-3-Clause
// What the name of a file to write leads to.
#ifndef RectifiedTransport_OutputTarget_h
#define RectifiedTransport_OutputTarget_h

#include <unistd.h>

#include <string>
#include <utility>

namespace RectifiedTransport
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

struct OutputTarget
{
  std::string Name;        // as it was given, for messages
  FileDescriptor Direct;   // a pipe or character device
  FileDescriptor Existing; // the plain file that is there
  FileDescriptor Folder;   // that has the plain file, where links end
  std::string File;        // its name there

  // Throws Failure unless it is done, with errno as the reason.
  void Require(bool isDone) const;
};

// Follows symbolic links, if the system would. Writes to a descriptor of this process, such as
// /dev/stdout, directly. Throws Failure for folders, block devices, sockets, pipes that no program
// reads, files that may not be written and folders that do not exist.
OutputTarget findOutputTarget(const std::string& name);

// Gives a new file the owner, the group, the access list and the mode of an earlier one, or less
// access where the system does not allow that.
void copyAccess(const FileDescriptor& earlier, const FileDescriptor& file);

} // namespace RectifiedTransport

#endif
