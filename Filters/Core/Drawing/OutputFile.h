// SPDX-License-Identifier: BSD-3-Clause
// A file that appears under its name only when it is complete.
#ifndef RectifiedTransport_OutputFile_h
#define RectifiedTransport_OutputFile_h

#include "Core/Drawing/OutputTarget.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace RectifiedTransport
{

// Writes to a hidden file beside the target, which replaces it at the end and has its mode.
// Symbolic links stay and lead to the new file. Pipes and character devices are written directly.
class OutputFile
{
public:
  // `name` in UTF-8. Throws Failure if the file cannot be written.
  explicit OutputFile(const std::string& name);
  // Removes what was written, unless Close has been called.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Throws Failure if the disk is full, for example.
  void Write(std::string_view bytes);
  std::int64_t Size() const { return this->Written; }
  // Gives the file its name, in place of an earlier one. Throws Failure.
  void Close();

private:
  void OpenPart();
  void WaitForReader() const;

  OutputTarget Target;
  std::string Part; // the name of the hidden file; empty: there is none
  FileDescriptor File;
  std::int64_t Written = 0;
};

} // namespace RectifiedTransport

#endif
