// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Drawing/OutputTarget.h"

#include "Core/Messages/Failure.h"

#include <fcntl.h>
#include <sys/stat.h>
#ifdef __linux__
#include <sys/xattr.h>
#endif

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

namespace RectifiedTransport
{

namespace
{

#ifdef O_PATH
constexpr int folderAccess = O_PATH; // does not need the right to list it
#else
constexpr int folderAccess = O_RDONLY;
#endif

// Returns the number of an open descriptor of this process if a path names its file in that way,
// otherwise -1.
int ownDescriptor(const std::string& path)
{
  for (const std::string folder : { "/dev/fd/", "/proc/self/fd/" })
  {
    int number = -1;
    const char* const end = path.data() + path.size();
    if (path.rfind(folder, 0) == 0 &&
      std::from_chars(path.data() + folder.size(), end, number).ptr == end)
    {
      return number;
    }
  }
  return -1;
}

// Follows links at the end of a path. Folders before the name may be links, too; the system follows
// these.
std::filesystem::path followLinks(const OutputTarget& target)
{
  constexpr int most = 40; // as in Linux
  std::filesystem::path path = target.Name;
  for (int links = 0; ownDescriptor(path.string()) < 0; ++links)
  {
    std::error_code none;
    const std::filesystem::path next = std::filesystem::read_symlink(path, none);
    if (none)
    {
      break;
    }
    errno = ELOOP;
    target.Require(links < most);
    path = path.parent_path() / next;
  }
  return path;
}

// Opens by the given name: in shared folders, the system may not follow links that others have
// made.
void openExisting(OutputTarget& target)
{
  const std::string& name = target.Name;
  // Without O_TRUNC and with O_NONBLOCK, opening changes no file and waits for no reader.
  // Pipes and devices are written directly; plain files are replaced.
  FileDescriptor file(open(name.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!file.IsOpen())
  {
    // The most frequent mistakes have messages of their own.
    if (errno == EISDIR)
    {
      fail("FileName '", name, "' is a folder; it must be a file");
    }
    if (errno == ENXIO)
    {
      fail("FileName '", name,
        "' is a pipe that no program reads, or a socket; it must be a file, or a program must "
        "read the pipe before");
    }
    // A file that does not exist is made anew.
    target.Require(errno == ENOENT);
    return;
  }
  struct stat status
  {
  };
  target.Require(fstat(file.Get(), &status) == 0);
  if (S_ISBLK(status.st_mode))
  {
    fail("FileName '", name, "' is a block device, such as a disk; it must be a file");
  }
  (S_ISREG(status.st_mode) ? target.Existing : target.Direct) = std::move(file);
}

// Opens the folder, so that later steps refer to it even if its path changes, and checks that the
// file found there is the one that was opened.
void openFolder(OutputTarget& target, const std::filesystem::path& path)
{
  // The folder is needed to make the hidden file beside the target.
  const std::filesystem::path folder = path.parent_path();
  target.File = path.filename().string();
  target.Folder = FileDescriptor(
    open(folder.empty() ? "." : folder.c_str(), folderAccess | O_DIRECTORY | O_CLOEXEC));
  target.Require(target.Folder.IsOpen());
  if (!target.Existing.IsOpen())
  {
    return;
  }
  // Compare the opened file with the one that the folder has under this name: a deleted file, for
  // example, has no name any more.
  struct stat opened
  {
  };
  struct stat named
  {
  };
  target.Require(fstat(target.Existing.Get(), &opened) == 0);
  const bool isThere =
    fstatat(target.Folder.Get(), target.File.c_str(), &named, AT_SYMLINK_NOFOLLOW) == 0;
  if (!isThere || opened.st_dev != named.st_dev || opened.st_ino != named.st_ino)
  {
    fail("FileName '", target.Name,
      "' leads to a file without a name of its own; it must be a file in a folder");
  }
}

} // namespace

void OutputTarget::Require(bool isDone) const
{
  if (!isDone)
  {
    // The system's own words for the error come first.
    const std::string reason = errno != 0 ? std::strerror(errno) : "unknown error";
    fail("FileName '", this->Name, "' cannot be written (", reason,
      "); its folder must exist and have room, and the folder and the file must be writable");
  }
}

OutputTarget findOutputTarget(const std::string& name)
{
  OutputTarget target;
  target.Name = name;
  const std::filesystem::path path = followLinks(target);
  // A descriptor of this process is duplicated, so that closing the output leaves it open.
  const int own = ownDescriptor(path.string());
  if (own >= 0)
  {
    target.Direct = FileDescriptor(fcntl(own, F_DUPFD_CLOEXEC, 0));
    target.Require(target.Direct.IsOpen());
    return target;
  }
  openExisting(target);
  if (!target.Direct.IsOpen())
  {
    openFolder(target, path);
  }
  return target;
}

// What cannot be restored is no error, and leaves the file with fewer rights than the earlier one
// had, never with more.
void copyAccess(const FileDescriptor& earlier, const FileDescriptor& file)
{
  struct stat status
  {
  };
  if (fstat(earlier.Get(), &status) != 0)
  {
    return; // then only the owner has access
  }
  // Owner and group are restored if the system allows it. If not, the new group gets no more rights
  // than everyone.
  constexpr mode_t ofGroup = 070;
  mode_t mode = status.st_mode & 0777;
  if (fchown(file.Get(), status.st_uid, status.st_gid) != 0 &&
    fchown(file.Get(), static_cast<uid_t>(-1), status.st_gid) != 0)
  {
    mode &= ~ofGroup | (mode << 3); // another group may do what everyone may
  }
#ifdef __linux__
  constexpr const char* list = "system.posix_acl_access";
  // The access control list of the earlier file, if it has one; larger lists count as not readable.
  std::array<char, 4096> entries{};
  const ssize_t size = fgetxattr(earlier.Get(), list, entries.data(), entries.size());
  if (size < 0 && errno != ERANGE)
  {
    fremovexattr(file.Get(), list); // which the folder may give to new files
  }
  else if (size < 0 ||
    fsetxattr(file.Get(), list, entries.data(), static_cast<std::size_t>(size), 0) != 0)
  {
    mode &= ~ofGroup; // with a list, these bits are more than the group's own
  }
#endif
  fchmod(file.Get(), mode);
}

} // namespace RectifiedTransport
