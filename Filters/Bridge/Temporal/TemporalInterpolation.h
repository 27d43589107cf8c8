// SPDX-License-Identifier: BSD-3-Clause
// A series of densities at a time between its steps: the worker of
// vtkTransportTemporalInterpolator.
#ifndef RectifiedTransport_TemporalInterpolation_h
#define RectifiedTransport_TemporalInterpolation_h

#include "Bridge/Temporal/AdvectedArrays.h"
#include "Bridge/Temporal/StepCache.h"
#include "Core/Series/SeriesTracks.h"

#include <list>

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
class vtkInformation;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

struct TemporalSettings
{
  TrackSettings Moving;
  bool TracksParticles;
  bool AdvectsArrays;
  SplatOptions Splat;
};

struct TemporalStep
{
  int Number;
  std::string Title; // in messages
  std::shared_ptr<InputDensity> Input;
  std::shared_ptr<const StepDensity> Density;
};

// With one step alone, First and Second are the same and Length is 0.
struct TemporalInput
{
  TemporalStep First;
  TemporalStep Second;
  double Part;   // the share of the interval that has passed, from 0 to 1
  double Length; // the length of the interval, in time
};

struct TemporalOutput
{
  vtkInformation* Announced; // the pipeline information of the image
  vtkImageData* Image;
  vtkPolyData* Particles;
};

// Collective. Throws Failure and Cancelled.
class TemporalInterpolation
{
public:
  // With TracksParticles: its positions must reach the second step. Returns warnings of new
  // intervals. Keeps the last two intervals.
  std::vector<std::string> Run(const TemporalInput& moment, const TemporalSettings& settings,
    Progress& progress, const TemporalOutput& output);

  SeriesTracks& Tracks() { return this->Tracked; }
  // Finds the tracked particles at the next step; `before` is the step before, nullptr at the first
  // one. Both have mass. Returns why the flow took the place of the optimal map; else nothing.
  std::string Track(const TemporalStep* before, const TemporalStep& step, Progress& progress);

  // How many intervals have been solved, of Run and of tracked particles.
  std::int64_t NumberOfMaps() const { return this->Made; }

private:
  struct Interval
  {
    std::shared_ptr<const StepDensity> First;
    std::shared_ptr<const StepDensity> Second;
    TrackSettings Settings;
    double Length;
    int Ranks;
    SeriesParticles Particles;
    vtkSmartPointer<vtkDoubleArray> Velocities;
    bool AdvectsArrays = false; // whether the arrays were made
    AdvectedArrays Arrays;
  };

  Interval& Find(const TemporalInput& moment, const TemporalSettings& settings, Progress& progress,
    std::vector<std::string>& warnings);
  Interval Make(const TemporalInput& moment, const TemporalSettings& settings, Progress& progress);
  void WriteParticles(const Interval& interval, const ImageGrid& geometry,
    const SeriesSnapshot& moment, Progress& progress, const TemporalOutput& output);

  std::list<Interval> Intervals; // the last one first
  SeriesTracks Tracked;
  std::int64_t Made = 0;
  vtkSmartPointer<vtkCellArray> Vertices; // kept for runs with as many particles
};

} // namespace RectifiedTransport::Bridge

#endif
