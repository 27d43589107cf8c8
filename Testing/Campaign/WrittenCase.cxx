// SPDX-License-Identifier: BSD-3-Clause
#include "Written.h"

#include "Crafted.h"
#include "Input.h"
#include "Listener.h"
#include "Outcome.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkPolyData.h"
#include "vtkTransportPDFWriter.h"
#include "vtkTransportSVGWriter.h"
#include "vtkXMLParser.h"

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <vector>

namespace Campaign
{

namespace
{

namespace fs = std::filesystem;

std::string textOfFile(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

// All in a folder: where links lead, modes and what is in plain files.
std::map<std::string, std::string> stateOf(const fs::path& folder)
{
  std::map<std::string, std::string> state;
  for (const fs::directory_entry& file : fs::directory_iterator(folder))
  {
    const fs::file_status status = file.symlink_status();
    const std::string what = fs::is_symlink(status) ? fs::read_symlink(file).string()
      : fs::is_regular_file(status)                 ? textOfFile(file)
                                                    : std::string();
    const auto mode = static_cast<unsigned int>(status.permissions());
    state[file.path().filename().string()] =
      std::to_string(static_cast<int>(status.type())) + " " + std::to_string(mode) + " " + what;
  }
  return state;
}

bool isWholeSvg(const std::string& text)
{
  vtkNew<vtkXMLParser> parser;
  return text.find("nan") == std::string::npos && text.find("inf\"") == std::string::npos &&
    parser->Parse(text.c_str()) == 1;
}

// The table is where the end says, and there is one page.
bool isWholePdf(const std::string& text)
{
  const std::size_t end = text.rfind("startxref\n");
  if (text.rfind("%PDF-1.4", 0) != 0 || end == std::string::npos)
  {
    return false;
  }
  const std::size_t table = std::stoul(text.substr(end + 10));
  return text.compare(table, 5, "xref\n") == 0 && text.substr(text.size() - 6) == "%%EOF\n" &&
    text.find("/Type /Page ") != std::string::npos;
}

enum class Refused
{
  No,
  Maybe, // whatever the size of the file
  Yes
};

struct Target
{
  std::string Name;  // in the folder, or a path
  std::string Leads; // to this plain file; empty: to none
  Refused IsRefused = Refused::No;
  bool IsLimited = false; // the size of files
};

class WrittenRun
{
public:
  WrittenRun(std::uint64_t seed, std::uint64_t number, const std::string& folder)
    : Random(seed * 0x9e3779b97f4a7c15 + number * 0xd1342543de82ef95)
    , Folder(fs::path(folder) / std::to_string(number))
    , IsSvg(this->Random.Chance(0.5))
  {
    fs::remove_all(this->Folder);
    fs::create_directories(this->Folder);
    if (this->IsSvg)
    {
      this->Writer = vtkSmartPointer<vtkTransportSVGWriter>::New();
    }
    else
    {
      this->Writer = vtkSmartPointer<vtkTransportPDFWriter>::New();
    }
    this->Result.Filter = this->IsSvg ? "SVGWriter" : "PDFWriter";
    std::signal(SIGPIPE, SIG_DFL);
    std::signal(SIGXFSZ, SIG_DFL);
  }
  ~WrittenRun() { fs::remove_all(this->Folder); }
  WrittenRun(const WrittenRun&) = delete;
  WrittenRun& operator=(const WrittenRun&) = delete;

  CaseResult Run()
  {
    this->DrawData();
    this->DrawSettings();
    const auto runs = this->Random.Of({ 1, 1, 2 });
    for (int i = 0; i < runs; ++i)
    {
      this->WriteTo(this->DrawTarget());
    }
    for (const std::string& finding : this->Found.All)
    {
      this->Result.Log += "  WRONG: " + finding + "\n";
    }
    this->Result.Findings = this->Found.All;
    return this->Result;
  }

private:
  void Print(const std::string& text) { this->Result.Log += text + "\n"; }

  void DrawData()
  {
    std::string text;
    vtkSmartPointer<vtkDataObject> data;
    switch (this->Random.Whole(0, 3))
    {
      case 0:
        data = drawMap(this->Random).Data;
        break;
      case 1:
        data = drawPoints(this->Random, nullptr, 3000).Data;
        break;
      case 2:
        data = drawSurface(this->Random).Data;
        break;
      default:
        data = drawSoundObject(this->Random, text);
        if (this->Random.Chance(0.5))
        {
          damage(this->Random, data, text);
        }
    }
    if (!data || !(data->IsA("vtkPolyData") || data->IsA("vtkCompositeDataSet")))
    {
      data = drawSurface(this->Random).Data; // VTK refuses others
    }
    if (auto* shapes = vtkPolyData::SafeDownCast(data); shapes && this->Random.Chance(0.3))
    {
      const bool haveValues = this->Random.Chance(0.5);
      text += haveValues ? " with cells without points" : " with cells without points and values";
      this->AddEmptyCells(shapes, haveValues);
    }
    this->Writer->SetInputDataObject(data);
    this->Print(std::string(data ? data->GetClassName() : "nothing") + " " + text);
  }

  // They have the values of the first one, or the arrays are too short.
  void AddEmptyCells(vtkPolyData* shapes, bool haveValues)
  {
    vtkNew<vtkCellArray> cells;
    const bool areLines = this->Random.Chance(0.5);
    cells->DeepCopy(areLines ? shapes->GetLines() : shapes->GetPolys());
    cells->InsertNextCell(0);
    areLines ? shapes->SetLines(cells) : shapes->SetPolys(cells);
    for (int i = 0; haveValues && i < shapes->GetCellData()->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = shapes->GetCellData()->GetAbstractArray(i);
      while (
        array->GetNumberOfTuples() > 0 && array->GetNumberOfTuples() < shapes->GetNumberOfCells())
      {
        array->InsertNextTuple(0, array);
      }
    }
  }

  void DrawSettings()
  {
    this->Writer->SetWidth(this->Random.Of({ 100.0, 1.0, 1000.0, 0.5 }));
    this->Writer->SetPageMargin(this->Random.Of({ 0.0, 0.0, 3.0 }));
    this->Writer->SetLineWidth(this->Random.Of({ 0.0, 0.25, 0.01, 2.0 }));
    this->Writer->SetOrder(this->Random.Of({ 0, 0, 1 }));
    this->Writer->SetPointRadius(this->Random.Of({ 0.0, 0.0, 0.1, 1e300 }));
    this->Writer->SetFillOutlines(this->Random.Chance(0.5));
    if (this->Random.Chance(0.2))
    {
      this->Writer->SetPageBounds(0, this->Random.Magnitude(-20, 10), 0, 1, 0, 0);
    }
    this->Writer->SetInputArrayToProcess(0, 0, 0, this->Random.Of({ 0, 1 }),
      this->Random.Of({ "None", "v", "p", "Mass", "Land", "None" }));
    this->Writer->SetInputArrayToProcess(
      2, 0, 0, this->Random.Of({ 0, 1 }), this->Random.Of({ "None", "None", "None", "Land", "v" }));
  }

  void Keep(const std::string& name, const std::string& text, mode_t mode = 0644)
  {
    std::ofstream(this->Folder / name) << text;
    chmod((this->Folder / name).c_str(), mode);
  }

  Target DrawTarget()
  {
    const std::string name = this->Random.Of({ "a", "\xC3\xA9", "b c" }) +
      std::to_string(++this->Targets) + (this->IsSvg ? ".svg" : ".pdf");
    const auto link = [&](const std::string& to) {
      fs::create_symlink(to, this->Folder / name);
      return name;
    };
    this->Keep(name + ".part", "precious");
    switch (this->Random.Whole(0, 11))
    {
      case 0:
        this->Keep(name, "earlier", this->Random.Of<mode_t>({ 0600, 0644, 0666, 0640 }));
        return { name, name };
      case 1:
        this->Keep("old", "earlier", 0600);
        return { link("old"), "old" };
      case 2:
        return { link("new" + name), "new" + name };
      case 3:
        fs::create_symlink("end" + name, this->Folder / ("next" + name));
        return { link("next" + name), "end" + name };
      case 4:
        return { link(name), "", Refused::Yes };
      case 5:
        fs::create_directory(this->Folder / name);
        return { name, "", Refused::Yes };
      case 6:
        mkfifo((this->Folder / name).c_str(), 0600);
        return { name, "", Refused::Yes };
      case 7:
        return { link(this->Random.Of({ "/dev/null", "/dev/full" })), "", Refused::Maybe };
      case 8:
      {
        const auto size = static_cast<std::size_t>(this->Random.Whole(249, 257));
        const std::string longest(size, 'x');
        return { longest, size <= 255 ? longest : "", size <= 255 ? Refused::No : Refused::Yes };
      }
      case 9:
        return { "missing/" + name, "", Refused::Yes };
      case 10:
        this->Keep(name, "earlier", 0600);
        return { name, name, Refused::Maybe, true };
      default:
        return { name, name };
    }
  }

  void WriteTo(const Target& target)
  {
    this->Print("to " + target.Name);
    const auto before = stateOf(this->Folder);
    this->Writer->SetFileName((this->Folder / target.Name).c_str());
    const int abortAt = this->Random.Chance(0.1) ? static_cast<int>(this->Random.Whole(0, 6)) : -1;
    this->MayAbort = abortAt >= 0;
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlimit little{ target.IsLimited ? rlim_t{ 200 } : limit.rlim_cur, limit.rlim_max };
    setrlimit(RLIMIT_FSIZE, &little);
    Listener listener(this->Writer, abortAt);
    const bool isWritten = this->Writer->Write() == 1 && listener.Errors.empty();
    setrlimit(RLIMIT_FSIZE, &limit);
    const bool isDone = isWritten && !listener.HasAborted;
    this->Writer->SetAbortExecute(0);
    for (const std::string& text : listener.Errors)
    {
      this->Print("  message: " + text);
    }
    ++this->Result.Runs;
    this->Result.Errors += listener.Errors.empty() ? 0 : 1;
    this->Result.Aborts += listener.HasAborted ? 1 : 0;
    this->Judge(target, before, isDone, listener);
  }

  void Judge(const Target& target, std::map<std::string, std::string> before, bool isDone,
    const Listener& listener)
  {
    auto after = stateOf(this->Folder);
    this->Found.That(listener.Errors.size() <= 1, "at most one error");
    this->Found.That(isDone || listener.HasAborted || !listener.Errors.empty(), "an error");
    this->Found.That(!isDone || target.IsRefused != Refused::Yes, "the target is refused");
    // An abort may come when the file is there already.
    const bool isThere =
      isDone || (listener.HasAborted && after[target.Leads] != before[target.Leads]);
    if (isThere && !target.Leads.empty())
    {
      const std::string text = textOfFile(this->Folder / target.Leads);
      this->Found.That(this->IsSvg ? isWholeSvg(text) : isWholePdf(text), "a whole file");
      if (!this->MayAbort) // when depends on the time
      {
        this->Result.Digest = this->Result.Digest * 31 + std::hash<std::string>()(text);
      }
      const bool wasThere = !before[target.Leads].empty();
      const std::string is = after[target.Leads].substr(0, 5);
      this->Found.That(!wasThere || before[target.Leads].substr(0, 5) == is, "the mode stays");
      before.erase(target.Leads);
      after.erase(target.Leads);
    }
    this->Found.That(after == before, "nothing else has changed");
  }

  RandomSource Random;
  const fs::path Folder;
  const bool IsSvg;
  vtkSmartPointer<vtkTransportVectorWriter> Writer;
  int Targets = 0;
  bool MayAbort = false;
  Findings Found;
  CaseResult Result;
};

} // namespace

CaseResult runWrittenCase(std::uint64_t seed, std::uint64_t number, const std::string& folder)
{
  return WrittenRun(seed, number, folder).Run();
}

} // namespace Campaign
