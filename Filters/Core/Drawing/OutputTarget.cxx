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

// The number of an open descriptor of this process, as which a path names a file; -1: it does not.
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

class TargetSearch
{
public:
  explicit TargetSearch(const std::string& name)
    : Path(name)
  {
    this->Found.Name = name;
  }

  OutputTarget Find()
  {
    this->FollowLinks();
    const int own = ownDescriptor(this->Path.string());
    if (own >= 0)
    {
      this->Found.Direct = FileDescriptor(fcntl(own, F_DUPFD_CLOEXEC, 0));
      this->Require(this->Found.Direct.IsOpen());
      return std::move(this->Found);
    }
    this->OpenExisting();
    if (!this->Found.Direct.IsOpen())
    {
      this->OpenFolder();
    }
    return std::move(this->Found);
  }

private:
  void Require(bool isDone) const
  {
    if (!isDone)
    {
      this->Found.Fail();
    }
  }

  // The folders before the name may be links, too, which the system follows.
  void FollowLinks()
  {
    constexpr int most = 40; // as in Linux
    for (int links = 0; ownDescriptor(this->Path.string()) < 0; ++links)
    {
      std::error_code none;
      const std::filesystem::path next = std::filesystem::read_symlink(this->Path, none);
      if (none)
      {
        return;
      }
      errno = ELOOP;
      this->Require(links < most);
      this->Path = this->Path.parent_path() / next;
    }
  }

  // By the given name: the system may not follow links that others have made in shared folders.
  void OpenExisting()
  {
    const std::string& name = this->Found.Name;
    FileDescriptor file(open(name.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    if (!file.IsOpen())
    {
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
      this->Require(errno == ENOENT);
      return;
    }
    struct stat status
    {
    };
    this->Require(fstat(file.Get(), &status) == 0);
    if (S_ISBLK(status.st_mode))
    {
      fail("FileName '", name, "' is a block device, such as a disk; it must be a file");
    }
    (S_ISREG(status.st_mode) ? this->Found.Existing : this->Found.Direct) = std::move(file);
  }

  void OpenFolder()
  {
    const std::filesystem::path folder = this->Path.parent_path();
    this->Found.File = this->Path.filename().string();
    this->Found.Folder = FileDescriptor(
      open(folder.empty() ? "." : folder.c_str(), folderAccess | O_DIRECTORY | O_CLOEXEC));
    this->Require(this->Found.Folder.IsOpen());
    if (!this->Found.Existing.IsOpen())
    {
      return;
    }
    struct stat opened
    {
    };
    struct stat named
    {
    };
    this->Require(fstat(this->Found.Existing.Get(), &opened) == 0);
    const bool isThere =
      fstatat(this->Found.Folder.Get(), this->Found.File.c_str(), &named, AT_SYMLINK_NOFOLLOW) == 0;
    if (!isThere || opened.st_dev != named.st_dev || opened.st_ino != named.st_ino)
    {
      fail("FileName '", this->Found.Name,
        "' leads to a file without a name of its own; it must be a file in a folder");
    }
  }

  std::filesystem::path Path;
  OutputTarget Found;
};

} // namespace

void OutputTarget::Fail() const
{
  const std::string reason = errno != 0 ? std::strerror(errno) : "unknown error";
  fail("FileName '", this->Name, "' cannot be written (", reason,
    "); its folder must exist and have room, and the folder and the file must be writable");
}

OutputTarget findOutputTarget(const std::string& name)
{
  return TargetSearch(name).Find();
}

void copyAccess(const FileDescriptor& earlier, const FileDescriptor& file)
{
  struct stat status
  {
  };
  if (fstat(earlier.Get(), &status) != 0)
  {
    return; // the file stays its owner's alone
  }
  constexpr mode_t ofGroup = 070;
  mode_t mode = status.st_mode & 0777;
  if (fchown(file.Get(), status.st_uid, status.st_gid) != 0 &&
    fchown(file.Get(), static_cast<uid_t>(-1), status.st_gid) != 0)
  {
    mode &= ~ofGroup | (mode << 3); // another group may do what all may
  }
#ifdef __linux__
  constexpr const char* list = "system.posix_acl_access";
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
