// SPDX-License-Identifier: BSD-3-Clause
// A file that appears under its name only when it is complete.
#ifndef RectifiedTransport_OutputFile_h
#define RectifiedTransport_OutputFile_h

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace RectifiedTransport
{

// Writes to a file beside it, NAME.part, which replaces it at the end.
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
  [[noreturn]] void Fail() const;

  const std::string Name;
  const std::filesystem::path Path;
  const std::filesystem::path Part;
  std::ofstream Stream;
  std::int64_t Written = 0;
  bool IsClosed = false;
};

} // namespace RectifiedTransport

#endif
