// SPDX-License-Identifier: BSD-3-Clause
// A series of densities at a time between its steps: the worker of
// vtkTransportTemporalInterpolator.
#ifndef RectifiedTransport_TemporalInterpolation_h
#define RectifiedTransport_TemporalInterpolation_h

#include "Bridge/Temporal/AdvectedArrays.h"
#include "Bridge/Temporal/MovingParticles.h"
#include "Bridge/Temporal/StepDensity.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Splat/Splat.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <list>
#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
class vtkImageData;
class vtkInformation;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class InputDensity;

struct TemporalSettings
{
  MovingSettings Moving;
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

// Of one step alone, First and Second are the same and Length is 0.
struct TemporalMoment
{
  TemporalStep First;
  TemporalStep Second;
  double Part;   // of the interval
  double Length; // of the interval, in time
};

struct TemporalOutput
{
  vtkInformation* Announced; // the pipeline information of the image
  vtkImageData* Image;
  vtkPolyData* Particles;
};

// Throws Failure for steps of different axes, planes or directions.
void requireOneSpace(const TemporalStep& first, const TemporalStep& second);

class TemporalInterpolation
{
public:
  // With TracksParticles: its positions must reach the second step. Returns warnings of new
  // intervals. Keeps the last two intervals. Collective. Throws Failure and Cancelled.
  std::vector<std::string> Run(const TemporalMoment& moment, const TemporalSettings& settings,
    Progress& progress, const TemporalOutput& output);

  SeriesTracks& Tracks() { return this->Tracked; }
  // How many intervals have been solved, of Run and of tracked particles.
  std::int64_t NumberOfMaps() const { return this->Made; }
  void CountMap() { ++this->Made; }

private:
  struct Interval
  {
    std::shared_ptr<const StepDensity> First;
    std::shared_ptr<const StepDensity> Second;
    MovingSettings Settings;
    double Length;
    int Ranks;
    SeriesParticles Particles;
    vtkSmartPointer<vtkDoubleArray> Velocities;
    bool AdvectsArrays = false; // whether the arrays were made
    AdvectedArrays Arrays;
  };

  Interval& Find(const TemporalMoment& moment, const TemporalSettings& settings, Progress& progress,
    std::vector<std::string>& warnings);
  void Make(const TemporalMoment& moment, const TemporalSettings& settings, Progress& progress,
    Interval& interval);
  void WriteParticles(const Interval& interval, const ImageGrid& geometry, SeriesMoment& moment,
    Progress& progress, const TemporalOutput& output);
  static void WriteImage(const Interval& interval, const TemporalSettings& settings,
    const ImageGrid& geometry, const SeriesMoment& moment, Progress& progress,
    const TemporalOutput& output);
  static void WriteStep(
    const TemporalStep& step, bool advects, Progress& progress, const TemporalOutput& output);

  std::list<Interval> Intervals; // the last one first
  SeriesTracks Tracked;
  std::int64_t Made = 0;
  // Of the particles at the moment, before they go to their owners.
  vtkSmartPointer<vtkDoubleArray> Points;
  vtkSmartPointer<vtkDoubleArray> Masses;
  vtkSmartPointer<vtkCellArray> Vertices;
};

} // namespace RectifiedTransport::Bridge

#endif
