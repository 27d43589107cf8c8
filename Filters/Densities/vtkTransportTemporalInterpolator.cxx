// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportTemporalInterpolator.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Pipeline/ConsumerExtents.h"
#include "Bridge/Run/Pipeline/OutputInformation.h"
#include "Bridge/Run/Settings/SplatSettings.h"
#include "Bridge/Run/Settings/TransportSettings.h"
#include "Bridge/Temporal/StepCache.h"
#include "Bridge/Temporal/TemporalInterpolation.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Core/Series/StepTimes.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportTemporalInterpolator);

namespace
{
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;
using Pipeline = vtkStreamingDemandDrivenPipeline;

// Bound the list of time steps, which hosts display.
constexpr int MaximumResampleFactor = 1000000;
constexpr double MaximumTimeSteps = 1e7;

// That an input announces.
StepTimes announcedTimes(vtkInformation* input)
{
  const int count = input ? input->Length(Pipeline::TIME_STEPS()) : 0;
  const double* times = count > 0 ? input->Get(Pipeline::TIME_STEPS()) : nullptr;
  return { times, static_cast<std::size_t>(count) };
}

// "Time step 3 of 10 (t = 0.2)".
std::string titleOf(int step, const StepTimes& times)
{
  return "Time step " + std::to_string(step + 1) + " of " + std::to_string(times.Count()) +
    " (t = " + textOf(times[step]) + ")";
}

// The time that is requested of an output; the first step's, or 0, without a request. A time
// outside the steps is that of the next one.
double requestedTime(
  vtkInformation* request, vtkInformationVector* outputVector, const StepTimes& times)
{
  const int port = std::max(0, request->Get(Pipeline::FROM_OUTPUT_PORT()));
  vtkInformation* output = outputVector->GetInformationObject(port);
  const bool isGiven = output->Has(Pipeline::UPDATE_TIME_STEP());
  const double first = times.Count() > 0 ? times[0] : 0.0;
  const double time = isGiven ? output->Get(Pipeline::UPDATE_TIME_STEP()) : first;
  return times.Count() > 0 && !std::isnan(time) ? times.Clamp(time) : time;
}
} // namespace

// An execution takes several passes, because the input has one time step at a time: each pass
// requests a step that is missing, and the last one interpolates. These members carry on from pass
// to pass.
struct vtkTransportTemporalInterpolator::vtkInternals
{
  StepTimes Times;       // the times of the input, as announced
  bool IsSeries = false; // else Times is the time of the one input
  StepCache Steps;
  TemporalInterpolation Interpolation;
  int AllPasses = 1;            // how many this execution is going to take
  int Passes = 0;               // how many of them are done
  int Agreed = -1;              // the step that all ranks request next; -1 in the first pass
  int Requested = 0;            // the step of the data that the input has
  bool Changed = false;         // whether something upstream has changed
  bool IsWarned = false;        // whether it warned that there are no two steps
  vtkMTimeType ChangedTime = 0; // the filter's modification time at its last execution

  double TimeOf(vtkInformation* request, vtkInformationVector* outputs) const
  {
    return requestedTime(request, outputs, this->IsSeries ? this->Times : StepTimes());
  }
};

//------------------------------------------------------------------------------
vtkTransportTemporalInterpolator::vtkTransportTemporalInterpolator()
  : Internals(new vtkInternals)
{
  this->AddDensityPort(PORT_PARTITIONED_DENSITY);
  this->AddOutputPort("vtkImageData");
  this->AddOutputPort("vtkPolyData");
}

//------------------------------------------------------------------------------
vtkTransportTemporalInterpolator::~vtkTransportTemporalInterpolator() = default;

//------------------------------------------------------------------------------
const char* vtkTransportTemporalInterpolator::GetMethodAsString()
{
  return choiceText(MethodTexts, this->Method);
}

//------------------------------------------------------------------------------
const char* vtkTransportTemporalInterpolator::GetKernelAsString()
{
  return choiceText(KernelTexts, this->Kernel);
}

//------------------------------------------------------------------------------
vtkIdType vtkTransportTemporalInterpolator::GetNumberOfMaps()
{
  return static_cast<vtkIdType>(this->Internals->Interpolation.NumberOfMaps());
}

//------------------------------------------------------------------------------
// Announces the times and the grid. Without ResampleFactor there is a range alone, within which any
// time may be requested; with it, each interval is divided into so many steps. A list that would be
// too long is left out here, and RequestData reports it. A series that changes may warn again.
int vtkTransportTemporalInterpolator::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  StepTimes& times = this->Internals->Times;
  const StepTimes before = std::exchange(times, announcedTimes(input));
  this->Internals->IsWarned = this->Internals->IsWarned && times == before;
  this->Internals->IsSeries = times.Count() > 0;
  this->Internals->Passes = 0;
  this->Internals->Agreed = -1;
  const bool resamples = this->ResampleFactor > 0 &&
    this->ResampleFactor <= MaximumResampleFactor &&
    static_cast<double>(this->ResampleFactor) * times.Count() <= MaximumTimeSteps;
  if (times.Count() > 0)
  {
    announceTimes(outputVector, { times[0], times[times.Count() - 1] },
      resamples ? times.Resampled(this->ResampleFactor) : std::vector<double>());
  }
  announceSubExtents(outputVector->GetInformationObject(0));
  vtkDataObject* data = vtkDataObject::GetData(input);
  if (data && !vtkImageData::SafeDownCast(data))
  {
    // The information of other data has no extents.
    this->UpdateInputOnRanks(0, inputVector, outputVector);
  }
  // The cached steps have the numbers from 0 to Most - 1; the data before any pass have the next
  // one.
  const ImageGrid grid = this->AnnouncedDensityGrid(input, 0, StepCache::Most);
  if (!grid.IsEmpty())
  {
    announceGrid(grid, outputVector->GetInformationObject(0));
  }
  return 1;
}

//------------------------------------------------------------------------------
// The first step that a time needs and that is not kept; -1 for none.
int vtkTransportTemporalInterpolator::MissingStep(double time)
{
  const StepTimes& times = this->Internals->Times;
  const TimeInterval place = times.Find(time);
  std::array<int, 2> needed = { place.First, place.Second };
  const int tracked = this->Internals->Interpolation.Tracks().Count();
  if (this->TrackParticles && tracked <= place.Second)
  {
    needed = { std::max(0, tracked - 1), tracked };
  }
  int missing = -1;
  for (const int step : needed)
  {
    if (this->Internals->Steps.Has(times[step]))
    {
      this->Internals->Steps.Use(times[step]);
    }
    else if (missing < 0)
    {
      missing = step;
    }
  }
  return missing;
}

//------------------------------------------------------------------------------
// Requests the step of this pass: the one that ranks agreed on, in the first pass the first one
// that is missing here. The executive asks twice, for the time and for the extent, and must get one
// answer. Steps are dropped only before the first pass, because the passes' own requests change the
// pipeline.
void vtkTransportTemporalInterpolator::RequestStep(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInternals& own = *this->Internals;
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  const double time = own.TimeOf(request, outputVector);
  if (!input || !own.IsSeries || std::isnan(time))
  {
    return;
  }
  if (own.Agreed < 0)
  {
    own.Changed = own.Steps.RemoveOutdated(this) || own.Changed;
  }
  const int missing = own.Agreed >= 0 ? own.Agreed : this->MissingStep(time);
  // Without one that is missing, what the input is of already.
  own.Requested = std::clamp(missing >= 0 ? missing : own.Requested, 0, own.Times.Count() - 1);
  input->Set(Pipeline::UPDATE_TIME_STEP(), own.Times[own.Requested]);
}

//------------------------------------------------------------------------------
int vtkTransportTemporalInterpolator::RequestUpdateTime(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->RequestStep(request, inputVector, outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportTemporalInterpolator::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->RequestStep(request, inputVector, outputVector);
  return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
// Runs a pass. After the last one the cache takes the pipeline's state as its own: what the
// requests of this execution changed upstream makes no step outdated.
int vtkTransportTemporalInterpolator::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInternals& own = *this->Internals;
  this->RunPass(request, inputVector, outputVector);
  if (own.Agreed < 0)
  {
    own.Steps.Stamp(this);
    this->EndPasses();
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportTemporalInterpolator::EndPasses()
{
  this->Internals->Passes = 0;
  this->Internals->Agreed = -1;
  this->SetProgressShiftScale(0.0, 1.0);
}

//------------------------------------------------------------------------------
RectifiedTransport::Bridge::TemporalSettings vtkTransportTemporalInterpolator::GetSettings()
{
  requireChoice("Method", this->Method, MethodTexts);
  requireThat(this->ResampleFactor >= 0 && this->ResampleFactor <= MaximumResampleFactor,
    "ResampleFactor", this->ResampleFactor, "from 0 (any time) to 1000000");
  const double steps = static_cast<double>(this->ResampleFactor) * this->Internals->Times.Count();
  if (steps > MaximumTimeSteps)
  {
    throw Failure("ResampleFactor is " + std::to_string(this->ResampleFactor) +
      ", which would make about " + textOf(steps) + " time steps; it must make at most 10000000");
  }
  requireThat(
    this->ParticlesPerCell >= 1, "ParticlesPerCell", this->ParticlesPerCell, "at least 1");
  TemporalSettings settings{};
  // These decide which intervals and tracked particles can be reused.
  settings.Moving = { this->ParticlesPerCell, this->Method == OPTIMAL };
  settings.TracksParticles = this->TrackParticles != 0;
  settings.AdvectsArrays = this->AdvectArrays != 0;
  settings.Splat = splatOptions(this->Kernel, this->Radius);
  return settings;
}

//------------------------------------------------------------------------------
// Stores the step that was requested, and finds the next one that is missing on any rank. If there
// is one, this asks for another pass; else it extends the tracks up to the requested time, and
// interpolates. All ranks take the same branch: each decision is gathered from all of them.
void vtkTransportTemporalInterpolator::RunPass(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInternals& own = *this->Internals;
  const TemporalSettings settings = this->GetSettings();
  const Ranks& ranks = this->GetRanks();
  const double time = own.TimeOf(request, outputVector);
  requireThat(!std::isnan(time), "The pipeline's time", time, "a number");
  SeriesTracks& tracks = own.Interpolation.Tracks();
  tracks.SetSettings(settings.Moving, ranks.Count());
  // Data without time steps are of the time that is requested; there is one step, and no mass
  // moves.
  if (!own.IsSeries)
  {
    own.Times = StepTimes(time);
    own.Requested = 0;
  }
  // Properties change what is read of a step, too.
  const vtkMTimeType changed = this->GetMTime();
  own.Changed = own.Changed || (own.Passes == 0 && changed != own.ChangedTime);
  own.ChangedTime = changed;
  // After a change on any rank, every tracked step is compared with what was tracked.
  if (!onAllRanks(ranks, own.IsSeries && !own.Changed))
  {
    tracks.Recheck();
  }
  own.Changed = !own.IsSeries; // without steps nothing tells which time the data are of
  own.Steps.Insert(own.Times[own.Requested], vtkDataObject::GetData(inputVector[0], 0));
  const TimeInterval place = own.Times.Find(time);
  if (own.Passes++ == 0)
  {
    // Tracked particles need one step after the other; else one may be missing yet.
    const int more =
      settings.TracksParticles ? place.Second - own.Requested : this->MissingStep(time) >= 0;
    own.AllPasses = 1 + std::max(0, more);
  }
  // A step that changed where it lies makes more passes than were counted.
  const double begin = own.Passes > 1 ? this->GetProgress() : 0.0;
  const int rest = std::max(1, own.AllPasses - own.Passes + 1);
  this->SetProgressShiftScale(begin, (1.0 - begin) / rest);
  AlgorithmProgress progress(this, this->Threading, ranks);
  Stages stages(progress, { { "tracks", settings.TracksParticles ? 7.0 : 0.0 }, { "moment", 3 } });
  Rounds rounds(stages["tracks"], 1);
  own.Agreed = -1;
  do
  {
    // Ranks may have kept different steps.
    for (const int missing : gatherValues(ranks, this->MissingStep(time)))
    {
      own.Agreed = missing >= 0 && (own.Agreed < 0 || missing < own.Agreed) ? missing : own.Agreed;
    }
    if (own.Agreed >= 0)
    {
      this->RequestNextPass();
      return;
    }
  } while (settings.TracksParticles && this->ExtendTracks(place.Second, rounds.Next()));
  this->Interpolate(time, stages["moment"], outputVector);
}

//------------------------------------------------------------------------------
// Returns false if the step has no points.
bool vtkTransportTemporalInterpolator::ReadStep(
  int step, RectifiedTransport::Progress& progress, RectifiedTransport::Bridge::TemporalStep& read)
{
  vtkInternals& own = *this->Internals;
  read.Number = step;
  read.Title = titleOf(step, own.Times);
  const int place = own.Steps.Use(own.Times[step]);
  CachedStep& kept = own.Steps[place];
  return withName(read.Title, [&]() {
    read.Input = this->ReadDensity(kept.Data, progress, 0, place);
    if (!read.Input)
    {
      return false;
    }
    read.Input->SetInputName(read.Title);
    read.Density = readStepDensity(*read.Input, kept.Density, progress);
    return true;
  });
}

//------------------------------------------------------------------------------
// Returns whether there is more to do.
bool vtkTransportTemporalInterpolator::ExtendTracks(
  int last, RectifiedTransport::Progress& progress)
{
  vtkInternals& own = *this->Internals;
  const int next = own.Interpolation.Tracks().Count();
  if (next > last)
  {
    return false;
  }
  Stages stages(progress, { { "reading", 1 }, { "track", 9 } });
  TemporalStep before;
  TemporalStep step;
  if ((next > 0 && !this->ReadStep(next - 1, stages["reading"], before)) ||
    !this->ReadStep(next, stages["reading"], step))
  {
    return false;
  }
  if (!(step.Density->Mass > 0.0))
  {
    throw Failure(step.Title +
      " has no mass, and TrackParticles follows particles through all steps; "
      "TrackParticles Off lets mass appear and disappear");
  }
  const std::string warning =
    own.Interpolation.Track(next > 0 ? &before : nullptr, step, stages["track"]);
  if (!warning.empty())
  {
    this->WarnOnFirstRank(step.Title + ": " + warning);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkTransportTemporalInterpolator::Interpolate(
  // The lowest missing step of all ranks is requested by all of them, as reading a step is
  // collective. Each step that is tracked needs the next one, which may be missing in turn.
  double time, RectifiedTransport::Progress& progress, vtkInformationVector* outputVector)
{
  vtkInternals& own = *this->Internals;
  const TimeInterval place = own.Times.Find(time);
  TemporalInput moment;
  moment.Part = place.Part;
  moment.Length = own.Times[place.Second] - own.Times[place.First];
  Stages stages(progress, { { "reading", 1 }, { "interpolation", 9 } });
  if (!this->ReadStep(place.First, stages["reading"], moment.First) ||
    (place.Second != place.First &&
      !this->ReadStep(place.Second, stages["reading"], moment.Second)))
  {
    return;
  }
  // A series of one step has no interval: both ends are the same density.
  if (place.Second == place.First)
  {
    moment.Second = moment.First;
    if (!(moment.First.Density->Mass > 0.0))
    {
      moment.First.Input->ThrowInvalid({}); // in a series, some steps may have no mass
    }
    if (!std::exchange(own.IsWarned, true))
    {
      this->WarnOnFirstRank(std::string("The input has ") +
        (own.IsSeries ? "one time step" : "no time steps") +
        ": no mass moves; the density comes out as it is (two or more time steps are a series)");
    }
  }
  const TemporalOutput output{ outputVector->GetInformationObject(0),
    vtkImageData::GetData(outputVector, 0), vtkPolyData::GetData(outputVector, 1) };
  // Views draw the extent that was announced before; a grid that changes with time has another one.
  const std::array<int, 6> announced = announcedGrid(output.Announced, true).Extent();
  this->WarnOnFirstRank(
    own.Interpolation.Run(moment, this->GetSettings(), stages["interpolation"], output));
  if (!this->GetRanks().AreSeveral())
  {
    announceToViews(output.Announced, announced);
  }
  stampTime(outputVector, time);
}

//------------------------------------------------------------------------------
void vtkTransportTemporalInterpolator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->GetMethodAsString() << "\n";
  os << indent << "ResampleFactor: " << this->ResampleFactor << "\n";
  os << indent << "TrackParticles: " << (this->TrackParticles ? "On" : "Off") << "\n";
  os << indent << "AdvectArrays: " << (this->AdvectArrays ? "On" : "Off") << "\n";
  os << indent << "ParticlesPerCell: " << this->ParticlesPerCell << "\n";
  os << indent << "Kernel: " << this->GetKernelAsString() << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
}
VTK_ABI_NAMESPACE_END
