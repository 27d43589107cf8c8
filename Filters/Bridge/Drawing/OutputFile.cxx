// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Drawing/OutputFile.h"

#include "Bridge/Run/Failure.h"

#include <cerrno>
#include <cstring>
#include <system_error>

namespace RectifiedTransport
{

OutputFile::OutputFile(const std::string& name)
  : Name(name)
  , Path(std::filesystem::u8path(name))
  , Part(std::filesystem::u8path(name + ".part"))
{
  std::error_code ignored;
  if (std::filesystem::is_directory(this->Path, ignored))
  {
    fail("FileName '", name, "' is a folder; it must be a file");
  }
  // A file that may not be written is not replaced, either.
  errno = 0;
  if (std::filesystem::exists(this->Path, ignored) &&
    !std::ofstream(this->Path, std::ios::binary | std::ios::app))
  {
    this->Fail();
  }
  this->Stream.open(this->Part, std::ios::binary | std::ios::trunc);
  if (!this->Stream)
  {
    this->Fail();
  }
}

OutputFile::~OutputFile()
{
  if (!this->IsClosed)
  {
    this->Stream.close();
    std::error_code ignored;
    std::filesystem::remove(this->Part, ignored);
  }
}

void OutputFile::Write(std::string_view bytes)
{
  errno = 0;
  this->Stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!this->Stream)
  {
    this->Fail();
  }
  this->Written += static_cast<std::int64_t>(bytes.size());
}

void OutputFile::Close()
{
  errno = 0;
  this->Stream.close();
  if (!this->Stream)
  {
    this->Fail();
  }
  std::error_code error;
  std::filesystem::rename(this->Part, this->Path, error);
  if (error)
  {
    fail("FileName '", this->Name, "' cannot be written (", error.message(), ")");
  }
  this->IsClosed = true;
}

void OutputFile::Fail() const
{
  const std::string reason = errno != 0 ? std::strerror(errno) : "unknown error";
  fail("FileName '", this->Name, "' cannot be written (", reason,
    "); its folder must exist, and the file must be writable");
}

} // namespace RectifiedTransport
