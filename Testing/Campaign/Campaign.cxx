// SPDX-License-Identifier: BSD-3-Clause
// Runs cases and prints a line for each: its number, a digest of what came out, the number of
// findings and the filter. run.py compares the lines of several settings.
#include "Case.h"
#include "Crafted.h"
#include "DrawnInputs.h"
#include "Watch.h"
#include "Written.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkLogger.h"
#include "vtkMassSplatter.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkTransportSampler.h"
#include "vtkUniformSeedSource.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

namespace
{

const char* const usage =
  "usage: campaign [--first N] [--count N] [--seed S] [--backend NAME] [--threads N] [--case N]\n"
  "                [--fork N] [--crafted FOLDER] [--written FOLDER]\n"
  "  --case N   runs one case and prints its steps and findings\n"
  "  --filter NAME   runs only the cases of a filter, as the output names it\n"
  "  --fork N   each N-th case runs in a child that fork() made\n"
  "  --crafted FOLDER   cases of broken inputs, whose files are written there\n"
  "  --written FOLDER   cases of the writers, whose targets are there\n";

struct Arguments
{
  std::uint64_t First = 0;
  std::uint64_t Count = 100;
  std::uint64_t Seed = 1;
  std::string Backend;
  std::string Filter;  // the only one
  std::string Folder;  // of crafted files; without one cases are random pipelines
  std::string Targets; // the folder of the writers' targets
  int Threads = 1;
  std::uint64_t Fork = 0; // none
  bool PrintsLog = false;
};

bool parse(int argc, char* argv[], Arguments& arguments)
{
  for (int i = 1; i < argc; i += 2)
  {
    if (i + 1 == argc)
    {
      return false;
    }
    const std::string name = argv[i];
    const char* value = argv[i + 1];
    if (name == "--backend")
    {
      arguments.Backend = value;
      continue;
    }
    if (name == "--filter")
    {
      arguments.Filter = value;
      continue;
    }
    if (name == "--crafted" || name == "--written")
    {
      (name == "--crafted" ? arguments.Folder : arguments.Targets) = value;
      continue;
    }
    const std::uint64_t number = std::strtoull(value, nullptr, 10);
    if (name == "--first" || name == "--case")
    {
      arguments.First = number;
      arguments.PrintsLog = name == "--case";
    }
    else if (name == "--count")
    {
      arguments.Count = number;
    }
    else if (name == "--seed")
    {
      arguments.Seed = number;
    }
    else if (name == "--threads")
    {
      arguments.Threads = static_cast<int>(number);
    }
    else if (name == "--fork")
    {
      arguments.Fork = number;
    }
    else
    {
      return false;
    }
  }
  return true;
}

// OpenMP keeps its threads; it ends the program where a case with little memory is the first that
// asks for them.
void makeThreads()
{
  vtkNew<vtkUniformSeedSource> points;
  points->SetNumberOfPoints(100000);
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputConnection(points->GetOutputPort());
  splatter->SetThreadingToOpenMP();
  splatter->Update();
}

// To open a device takes as long as many cases: this filter keeps it open for them. Without one
// there is a warning, and each case has the processor.
void openDevice(vtkTransportSampler* sampler)
{
  if (Campaign::isOnProcessor())
  {
    return;
  }
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 1);
  image->AllocateScalars(VTK_DOUBLE, 1);
  image->GetPointData()->GetScalars()->Fill(1.0);
  sampler->SetInputData(image);
  sampler->SetDeviceToOpenCL();
  sampler->Update();
}

Campaign::CaseResult resultOf(const Arguments& arguments, std::uint64_t number)
{
  if (!arguments.Targets.empty())
  {
    return Campaign::runWrittenCase(arguments.Seed, number, arguments.Targets);
  }
  return arguments.Folder.empty()
    ? Campaign::runCase(arguments.Seed, number)
    : Campaign::runCraftedCase(arguments.Seed, number, arguments.Folder);
}

// Returns whether there are no findings.
bool run(const Arguments& arguments, std::uint64_t number)
{
  Campaign::startWatch(150);
  const std::clock_t start = std::clock();
  const Campaign::CaseResult result = resultOf(arguments, number);
  const double ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%llu %016llx %zu %s %d %d %d %d %.1f %016llx\n",
    static_cast<unsigned long long>(number), static_cast<unsigned long long>(result.Digest),
    result.Findings.size(), result.Filter.c_str(), result.Runs, result.Errors, result.Aborts,
    result.Limits, ms, static_cast<unsigned long long>(result.Input));
  if (arguments.PrintsLog)
  {
    std::printf("%s", result.Log.c_str());
  }
  else
  {
    for (const std::string& finding : result.Findings)
    {
      std::printf("! %s\n", finding.substr(0, finding.find('\n')).c_str());
    }
  }
  std::fflush(stdout);
  return result.Findings.empty();
}

// The same, by a child that has none of the threads that are there by now. It ends as the child
// ends.
bool runInChild(const Arguments& arguments, std::uint64_t number)
{
  const pid_t child = fork();
  if (child == 0)
  {
    alarm(300); // one that waits takes no time of the processor, which the watch counts
    vtkSMPTools::SetBackend("Sequential"); // newer VTK's own filters wait for ever for its pool
    _exit(run(arguments, number) ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status))
  {
    std::raise(WTERMSIG(status));
  }
  return status == 0;
}

} // namespace

int main(int argc, char* argv[])
{
  Arguments arguments;
  if (!parse(argc, argv, arguments))
  {
    std::fputs(usage, stderr);
    return 2;
  }
  if (!arguments.Backend.empty() && !vtkSMPTools::SetBackend(arguments.Backend.c_str()))
  {
    std::fprintf(stderr, "VTK has no backend %s\n", arguments.Backend.c_str());
    return 2;
  }
  vtkSMPTools::Initialize(arguments.Threads);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  makeThreads();
  vtkNew<vtkTransportSampler> keeper;
  openDevice(keeper);
  bool failed = false;
  const std::uint64_t count = arguments.PrintsLog ? 1 : arguments.Count;
  for (std::uint64_t number = arguments.First; number < arguments.First + count; ++number)
  {
    if (!arguments.Filter.empty() &&
      arguments.Filter != Campaign::filterOfCase(arguments.Seed, number))
    {
      continue;
    }
    const bool isForked = arguments.Fork > 0 && number % arguments.Fork == arguments.Fork - 1;
    const bool isRight = isForked ? runInChild(arguments, number) : run(arguments, number);
    failed = failed || !isRight;
  }
  return failed ? 1 : 0;
}
