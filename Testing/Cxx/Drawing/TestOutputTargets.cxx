// SPDX-License-Identifier: BSD-3-Clause
// What the writers do to the file of their name and to those beside it: modes and links stay,
// devices and pipes are written or refused, and nothing else changes.
#include "DrawingTest.h"
#include "ProgressTest.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#ifdef __linux__
#include <sys/xattr.h>
#endif

#include <csignal>
#include <cstdint>
#include <map>
#include <thread>

namespace
{

namespace fs = std::filesystem;

// A folder for files, which is removed at the end.
class TemporaryFolder
{
public:
  TemporaryFolder()
    : Path(fs::temp_directory_path() / ("rectifiedtransport-targets-" + std::to_string(getpid())))
  {
    fs::remove_all(this->Path);
    fs::create_directories(this->Path);
  }
  ~TemporaryFolder() { fs::remove_all(this->Path); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  fs::path At(const std::string& name) const { return this->Path / name; }
  void Keep(const std::string& name, const std::string& text) const
  {
    std::ofstream(this->At(name)) << text;
  }
  std::string Text(const std::string& name) const
  {
    std::ifstream file(this->At(name), std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }
  // The files and what is in the plain ones.
  std::map<std::string, std::string> All() const
  {
    std::map<std::string, std::string> all;
    for (const fs::directory_entry& file : fs::directory_iterator(this->Path))
    {
      const std::string name = file.path().filename().string();
      all[name] = fs::is_regular_file(file.symlink_status()) ? this->Text(name) : "";
    }
    return all;
  }

private:
  fs::path Path;
};

vtkSmartPointer<vtkPolyData> dots(int count)
{
  std::vector<std::array<double, 3>> places;
  for (int i = 0; i < count; ++i)
  {
    places.push_back({ static_cast<double>(i % 300), static_cast<double>(i / 300), 0 }); // NOLINT
  }
  return shapes(places, Cells::Verts);
}

class Target
{
public:
  Target(Checks& checks, vtkTransportVectorWriter* writer)
    : Check(checks)
    , Writer(writer)
    , Reported(writer)
  {
    writer->SetInputData(dots(20));
  }

  int Write(const fs::path& path)
  {
    this->Reported.Clear();
    this->Writer->SetFileName(path.c_str());
    return this->Writer->Write();
  }

  // Nothing in the folder changes.
  void ExpectRefused(const fs::path& path, const std::string& part, int line)
  {
    const auto before = this->Folder.All();
    this->Check.That(this->Write(path) == 0, "is refused", line, path.string());
    this->Check.That(this->Reported.IsOneError(part), part.c_str(), line,
      this->Reported.Errors.empty() ? "no error" : this->Reported.Errors[0]);
    this->Check.That(this->Folder.All() == before, "nothing changes", line);
  }

  bool IsDrawing(const std::string& name) const
  {
    const std::string text = this->Folder.Text(name);
    return contains(text.substr(0, 8), "<?xml")
      ? contains(text, "</svg>\n")
      : contains(text, "%PDF-1.4") && contains(text, "%%EOF");
  }

  mode_t ModeOf(const std::string& name) const
  {
    struct stat status
    {
    };
    stat(this->Folder.At(name).c_str(), &status);
    return status.st_mode & 0777;
  }

  Checks& Check;
  vtkTransportVectorWriter* Writer;
  TemporaryFolder Folder;
  Messages Reported;
};

void checkModes(Checks& checks, vtkTransportVectorWriter* writer)
{
  Target target(checks, writer);
  const mode_t mask = umask(027);
  for (const mode_t mode : { 0600, 0640, 0666, 0755 })
  {
    target.Folder.Keep("a", "earlier");
    chmod(target.Folder.At("a").c_str(), mode);
    CHECK(checks, target.Write(target.Folder.At("a")) == 1);
    checks.That(target.ModeOf("a") == mode, "the mode stays", __LINE__, std::to_string(mode));
    CHECK(checks, target.IsDrawing("a"));
  }
  CHECK(checks, target.Write(target.Folder.At("new")) == 1);
  CHECK(checks, target.ModeOf("new") == 0640);
  umask(mask);
  CHECK(checks, target.Folder.All().size() == 2);
}

#ifdef __linux__
// As Linux keeps it: the owner, a user, the group, the mask and all others, each with rights.
std::string accessList(std::uint16_t ofUser, std::uint16_t mask)
{
  constexpr std::uint32_t nobody = 0xffffffff;
  const auto bytesOf = [](const auto& value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  std::string list = bytesOf(std::uint32_t{ 2 });
  const auto add = [&](std::uint16_t who, std::uint16_t rights, std::uint32_t number) {
    list += bytesOf(who) + bytesOf(rights) + bytesOf(number);
  };
  add(0x01, 6, nobody);
  add(0x02, ofUser, 12345);
  add(0x04, 0, nobody);
  add(0x10, mask, nobody);
  add(0x20, 0, nobody);
  return list;
}

std::string accessOf(const fs::path& path)
{
  std::array<char, 256> list{};
  const ssize_t size = getxattr(path.c_str(), "system.posix_acl_access", list.data(), list.size());
  return { list.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)) };
}
#endif

// Who may read the earlier file, and nobody else, may read the new one.
void checkAccessLists(Checks& checks, vtkTransportVectorWriter* writer)
{
#ifdef __linux__
  Target target(checks, writer);
  const TemporaryFolder& folder = target.Folder;
  folder.Keep("plain", "earlier");
  folder.Keep("list", "earlier");
  chmod(folder.At("plain").c_str(), 0640);
  const std::string list = accessList(4, 4);
  const std::string wide = accessList(7, 7);
  const auto set = [](const fs::path& path, const char* name, const std::string& value) {
    return setxattr(path.c_str(), name, value.data(), value.size(), 0) == 0;
  };
  if (!set(folder.At("list"), "system.posix_acl_access", list) ||
    !set(folder.At("."), "system.posix_acl_default", wide))
  {
    return; // this file system has no lists
  }
  for (const char* name : { "plain", "list" })
  {
    checks.That(target.Write(folder.At(name)) == 1, "is written", __LINE__, name);
    checks.That(target.IsDrawing(name), "is a drawing", __LINE__, name);
  }
  CHECK(checks, accessOf(folder.At("plain")).empty() && target.ModeOf("plain") == 0640);
  CHECK(checks, accessOf(folder.At("list")) == list && target.ModeOf("list") == 0640);
  CHECK(checks, target.Write(folder.At("new")) == 1 && !accessOf(folder.At("new")).empty());
#else
  (void)checks;
  (void)writer;
#endif
}

// Without the right to make files there, the earlier one stays.
void checkReadOnlyFolders(Checks& checks, vtkTransportVectorWriter* writer)
{
  Target target(checks, writer);
  const TemporaryFolder& folder = target.Folder;
  fs::create_directory(folder.At("closed"));
  folder.Keep("closed/a", "earlier");
  chmod(folder.At("closed/a").c_str(), 0666);
  chmod(folder.At("closed").c_str(), 0555);
  const uid_t user = geteuid();
  constexpr uid_t nobody = 65534; // for whom the folder is closed if the user is root
  const bool isOther = user != 0 || seteuid(nobody) == 0;
  for (const char* name : { "closed/a", "closed/new" })
  {
    if (isOther)
    {
      target.ExpectRefused(folder.At(name), "Permission denied", __LINE__);
    }
  }
  CHECK(checks, user != 0 || seteuid(user) == 0);
  chmod(folder.At("closed").c_str(), 0755);
  CHECK(checks, folder.Text("closed/a") == "earlier");
}

// To a file, to nothing yet, over others, in another folder, around in a circle.
void checkLinks(Checks& checks, vtkTransportVectorWriter* writer)
{
  Target target(checks, writer);
  const TemporaryFolder& folder = target.Folder;
  fs::create_directory(folder.At("other"));
  folder.Keep("old", "earlier");
  const std::map<std::string, std::string> links{ { "file", "old" }, { "nothing", "new" },
    { "chain", "nothing" }, { "folder", "other/there" },
    { "absolute", folder.At("old").string() } };
  for (const auto& [link, to] : links)
  {
    fs::create_symlink(to, folder.At(link));
  }
  for (const auto& [link, to] : links)
  {
    CHECK(checks, target.Write(folder.At(link)) == 1);
    checks.That(fs::is_symlink(folder.At(link)), "stays a link", __LINE__, link);
    checks.That(target.IsDrawing(link), "leads to the drawing", __LINE__, link);
  }
  CHECK(checks, target.IsDrawing("old") && target.IsDrawing("new"));
  CHECK(checks, target.IsDrawing("other/there"));
  fs::create_symlink("circle", folder.At("circle"));
  target.ExpectRefused(folder.At("circle"), "Too many levels of symbolic links", __LINE__);
  fs::create_symlink("missing/x", folder.At("far"));
  target.ExpectRefused(folder.At("far"), "No such file or directory", __LINE__);
}

// Whatever users call their files.
void checkNames(Checks& checks, vtkTransportVectorWriter* writer)
{
  Target target(checks, writer);
  const TemporaryFolder& folder = target.Folder;
  folder.Keep("x.svg.part", "precious");
  folder.Keep("precious", "precious");
  fs::create_symlink("precious", folder.At("y.svg.part"));
  folder.Keep(".rectifiedtransport-" + std::to_string(getpid()) + "-0.part", "precious");
  for (const std::string& name : { std::string("x.svg"), std::string("y.svg"),
         std::string("\xC3\xA9\xE2\x82\xAC.svg"), std::string(251, 'a'), std::string(255, 'b') })
  {
    checks.That(target.Write(folder.At(name)) == 1, "is written", __LINE__, name);
    checks.That(target.IsDrawing(name), "is a drawing", __LINE__, name);
  }
  CHECK(checks, folder.All().size() == 9);
  CHECK(checks, folder.Text("x.svg.part") == "precious" && folder.Text("precious") == "precious");
  target.ExpectRefused(folder.At(std::string(256, 'c')), "File name too long", __LINE__);
  target.ExpectRefused(folder.At("x.svg") / "y.svg", "Not a directory", __LINE__);
  fs::create_directory(folder.At("folder"));
  target.ExpectRefused(folder.At("folder"), "is a folder", __LINE__);
}

void checkDevices(Checks& checks, vtkTransportVectorWriter* writer)
{
  Target target(checks, writer);
  const TemporaryFolder& folder = target.Folder;
  fs::create_symlink("/dev/null", folder.At("null"));
  CHECK(checks, target.Write(folder.At("null")) == 1);
  CHECK(checks, fs::is_character_file("/dev/null") && fs::is_symlink(folder.At("null")));
#ifdef __linux__
  target.ExpectRefused(
    "/dev/full", "No space left on device); its folder must exist and have room", __LINE__);
#endif
  const fs::path pipe = folder.At("pipe");
  CHECK(checks, mkfifo(pipe.c_str(), 0600) == 0);
  target.ExpectRefused(pipe, "is a pipe that no program reads", __LINE__);
  // Larger than a pipe holds.
  writer->SetInputData(dots(30000));
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  const int held = open(pipe.c_str(), O_WRONLY); // before a writer comes, a read would be the end
  std::thread reading([&]() {
    fcntl(reader, F_SETFL, 0);
    std::ofstream all(folder.At("read"), std::ios::binary);
    std::vector<char> bytes(1 << 14);
    ssize_t count = 0;
    while ((count = read(reader, bytes.data(), bytes.size())) > 0)
    {
      all.write(bytes.data(), count);
    }
    close(reader);
  });
  const int written = target.Write(pipe);
  close(held);
  reading.join();
  CHECK(checks, written == 1 && target.IsDrawing("read") && fs::is_fifo(pipe));
}

// A reader that goes away and a file that may not grow: an error, not a signal.
void checkSignals(Checks& checks, vtkTransportVectorWriter* writer)
{
  Target target(checks, writer);
  const TemporaryFolder& folder = target.Folder;
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
  writer->SetInputData(dots(30000));
  int ends[2];
  CHECK(checks, pipe(ends) == 0);
  close(ends[0]);
  target.ExpectRefused("/dev/fd/" + std::to_string(ends[1]), "Broken pipe", __LINE__);
  close(ends[1]);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit little{ 1 << 14, before.rlim_max };
  folder.Keep("a", "earlier");
  setrlimit(RLIMIT_FSIZE, &little);
  target.ExpectRefused(folder.At("a"), "File too large", __LINE__);
  setrlimit(RLIMIT_FSIZE, &before);
  CHECK(checks, target.Write(folder.At("a")) == 1 && target.IsDrawing("a"));
}

// A descriptor is written on.
void checkDescriptors(Checks& checks, vtkTransportVectorWriter* writer)
{
#ifdef __linux__
  Target target(checks, writer);
  const int file = open(target.Folder.At("a").c_str(), O_WRONLY | O_CREAT, 0600);
  CHECK(checks, write(file, "before", 6) == 6);
  CHECK(checks, target.Write("/proc/self/fd/" + std::to_string(file)) == 1);
  CHECK(checks, write(file, "after", 5) == 5);
  close(file);
  const std::string text = target.Folder.Text("a");
  CHECK(checks, text.rfind("before", 0) == 0 && text.substr(text.size() - 5) == "after");
  CHECK(checks, contains(text, "</svg>\n") || contains(text, "%%EOF"));
  CHECK(checks, target.Folder.All().size() == 1);
  target.ExpectRefused("/dev/fd/999999", "Bad file descriptor", __LINE__);
#else
  (void)checks;
  (void)writer;
#endif
}

// An abort leaves nothing; two at a time are both whole.
void checkTwo(Checks& checks, vtkTransportVectorWriter* writer)
{
  Target target(checks, writer);
  const TemporaryFolder& folder = target.Folder;
  folder.Keep("a", "earlier");
  writer->SetInputData(dots(90000));
  {
    ProgressTest progress(writer);
    progress.AbortFrom = 0.1;
    target.Write(folder.At("a"));
    CHECK(checks, folder.All().size() == 1 && folder.Text("a") == "earlier");
    writer->SetAbortExecute(0);
  }
  vtkSmartPointer<vtkTransportVectorWriter> other;
  other.TakeReference(writer->NewInstance());
  other->SetInputData(dots(60000));
  other->SetFileName(folder.At("a").c_str());
  std::thread second([&]() { other->Write(); });
  CHECK(checks, target.Write(folder.At("a")) == 1);
  second.join();
  CHECK(checks, target.IsDrawing("a") && folder.All().size() == 1);
}

} // namespace

int TestOutputTargets(int, char*[])
{
  return runChecks({ ofBoth<checkModes>, ofBoth<checkAccessLists>, ofBoth<checkReadOnlyFolders>,
    ofBoth<checkLinks>, ofBoth<checkNames>, ofBoth<checkDevices>, ofBoth<checkSignals>,
    ofBoth<checkDescriptors>, ofBoth<checkTwo> });
}
