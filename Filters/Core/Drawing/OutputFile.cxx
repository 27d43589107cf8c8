// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Drawing/OutputFile.h"

#include "Core/Messages/Failure.h"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <sys/stat.h>

#include <cerrno>
#include <csignal>
#include <cstdio>

namespace RectifiedTransport
{

namespace
{

// Blocks SIGPIPE and SIGXFSZ while it exists. Writing to a pipe without a reader, or to a file that
// may not grow, then fails instead of ending the program.
class WriteSignals
{
public:
  WriteSignals()
  {
    sigemptyset(&this->Blocked);
    sigaddset(&this->Blocked, SIGPIPE);
    sigaddset(&this->Blocked, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &this->Blocked, &this->Before);
  }
  ~WriteSignals() { pthread_sigmask(SIG_SETMASK, &this->Before, nullptr); }
  WriteSignals(const WriteSignals&) = delete;
  WriteSignals& operator=(const WriteSignals&) = delete;

  // Removes a pending signal. Call it after a failure.
  void Drop() const
  {
    sigset_t pending;
    sigpending(&pending);
    int dropped = 0;
    if (sigismember(&pending, SIGPIPE) || sigismember(&pending, SIGXFSZ))
    {
      sigwait(&this->Blocked, &dropped);
    }
  }

private:
  sigset_t Blocked;
  sigset_t Before;
};

} // namespace

// A pipe or a device is written directly. A plain file is written under a hidden name in its folder
// and gets its own name in Close: an error or an abort leaves the earlier file as it was.
OutputFile::OutputFile(const std::string& name)
  : Target(findOutputTarget(name))
{
  if (this->Target.Direct.IsOpen())
  {
    this->File = std::move(this->Target.Direct);
  }
  else
  {
    this->OpenPart();
  }
}

// Without Close, the hidden file is removed.
OutputFile::~OutputFile()
{
  if (!this->Part.empty())
  {
    unlinkat(this->Target.Folder.Get(), this->Part.c_str(), 0);
  }
}

void OutputFile::OpenPart()
{
  // Killed programs leave hidden files, and other programs write some at present.
  constexpr int most = 1000;
  const bool isNew = !this->Target.Existing.IsOpen();
  // O_EXCL never opens a file of another program, and O_NOFOLLOW no link that someone put there.
  for (int i = 0; i < most && !this->File.IsOpen() && (i == 0 || errno == EEXIST); ++i)
  {
    // The process number and a counter make the name unique among running programs.
    const std::string part =
      ".rectifiedtransport-" + std::to_string(getpid()) + "-" + std::to_string(i) + ".part";
    this->File = FileDescriptor(openat(this->Target.Folder.Get(), part.c_str(),
      O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, isNew ? 0666 : 0600));
    this->Part = this->File.IsOpen() ? part : "";
  }
  this->Target.Require(this->File.IsOpen());
  if (!isNew)
  {
    // The new file has the rights of the one that it replaces; until now, only its owner can read
    // it.
    copyAccess(this->Target.Existing, this->File);
    this->Target.Existing.Close();
  }
}

void OutputFile::Write(std::string_view bytes)
{
  // Signals are blocked on this thread only while it writes.
  const WriteSignals signals;
  this->Written += static_cast<std::int64_t>(bytes.size());
  while (!bytes.empty())
  {
    const ssize_t count = write(this->File.Get(), bytes.data(), bytes.size());
    if (count >= 0)
    {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    else if (errno == EAGAIN)
    {
      this->WaitForReader();
    }
    else if (errno != EINTR)
    {
      // sigwait() may change errno, which the message reports.
      const int reason = errno;
      signals.Drop();
      errno = reason;
      this->Target.Require(false);
    }
  }
}

// Waits until a full pipe can be written, at most two minutes.
void OutputFile::WaitForReader() const
{
  constexpr int longest = 120000; // milliseconds
  pollfd file{ this->File.Get(), POLLOUT, 0 };
  if (poll(&file, 1, longest) == 0)
  {
    fail("FileName '", this->Target.Name, "' is a pipe whose reader has read nothing for ",
      longest / 1000, " s; a program must read it");
  }
}

// Some file systems report a full disk only when the file is closed.
void OutputFile::Close()
{
  errno = 0;
  this->Target.Require(this->File.Close());
  const int folder = this->Target.Folder.Get();
  this->Target.Require(this->Part.empty() ||
    // rename() replaces an earlier file atomically: readers see the old or the new file, never a
    // part.
    renameat(folder, this->Part.c_str(), folder, this->Target.File.c_str()) == 0);
  this->Part.clear();
}

} // namespace RectifiedTransport
