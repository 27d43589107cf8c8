// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/TemporalInterpolation.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Plan/DensityPlan.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Ranks/ParticleExchange.h"
#include "Bridge/Ranks/RankConsistency.h"
#include "Core/Geometry/Boxes/CommonGrid.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Series/FadingParticles.h"
#include "Core/Series/IntervalPlan.h"

#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <sstream>

namespace RectifiedTransport::Bridge
{

namespace
{

// Cells in a range of a thread.
constexpr std::int64_t grain = std::int64_t{ 1 } << 13;

// The data of the image in which the density lies.
int ownerOf(const ImageGrid& grid)
{
  return grid.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
}

// The grid between two steps: the smallest box that contains both, at the finer spacing along each
// axis. Throws Failure, with the titles, if their axes or planes differ. Equal grids are kept to
// the bit.
ImageGrid gridBetween(const TemporalStep& first, const TemporalStep& second)
{
  constexpr int any[3] = { 0, 0, 0 };
  return commonGrid(
    { { first.Density->Grid, first.Title }, { second.Density->Grid, second.Title } }, any,
    MostCells::Any);
}

// Makes what moves points between two steps with mass; all ranks together move `samples`.
template <int D>
std::unique_ptr<const TransportPlan<D>> solve(const StepDensity& from, const StepDensity& to,
  const ImageGrid& box, bool isOptimal, double samples, Progress& progress)
{
  // With the flow, tables of both densities are needed at once: backward from one to the uniform
  // measure, forward to the other (Section 3.4).
  const OptimalNeeds needs{ { isOptimal }, samples };
  const MemoryPlan memory = isOptimal
    ? memoryOfOptimalMap<D>(from.Grid.Size<D>(), to.Grid.Size<D>(), needs, progress.Group())
    : MemoryPlan{ "the tables of a density", bytesOfIntervalFlows(from.Step(), to.Step()) };
  return withRequiredMemory(
    memory, [&]() { return planInterval<D>(from.Step(), to.Step(), box, isOptimal, progress); });
}

// Makes particles of both steps that fade into each other.
template <int D>
SeriesParticles fade(const StepDensity& from, const StepDensity& to, const ImageGrid& box,
  const TrackSettings& settings, Progress& progress)
{
  // `move` is called only if both steps have mass: otherwise nothing moves, and the bound stays 0.
  double bound = 0.0;
  std::string warning;
  const auto move = [&](PointSpan<D> first, PointSpan<D> second, Progress& moving) {
    Stages stages(moving, { { "map", 8 }, { "forward", 1 }, { "backward", 1 } });
    const auto plan = solve<D>(from, to, box, settings.IsOptimal, 0.0, stages["map"]);
    bound = LengthScale(box).CostFromUnits(plan->LowerBound());
    // In place: images overwrite the points. Particles of the first step go forward in time,
    // those of the second step back, so that both sets are where their own step has its mass.
    plan->Forward(ConstPointSpan<D>(first), first, stages["forward"]);
    plan->Backward(ConstPointSpan<D>(second), second, stages["backward"]);
    warning = plan->Warning();
  };
  SeriesParticles particles =
    makeFadingParticles<D>(from.Step(), to.Step(), settings.ParticlesPerCell, move, progress);
  particles.Bound = bound;
  particles.HasBound = settings.IsOptimal && from.Mass > 0.0 && to.Mass > 0.0;
  particles.Warning = warning;
  return particles;
}

// Makes the particles of an interval: ParticlesPerCell in each cell of both steps, divided among
// the ranks.
SeriesParticles makeParticles(const StepDensity& from, const StepDensity& to, const ImageGrid& box,
  const TrackSettings& settings, Progress& progress)
{
  const double particles = settings.ParticlesPerCell *
    (static_cast<double>(from.Grid.NumberOfCells()) + static_cast<double>(to.Grid.NumberOfCells()));
  // Positions at both ends and between them, velocities, masses, numbers and vertices.
  constexpr double each = 4.0 * 24.0 + 5.0 * 8.0;
  std::ostringstream purpose;
  purpose.precision(20);
  purpose << particles << " particles (see ParticlesPerCell)";
  return withRequiredMemory({ purpose.str(), each * particles / progress.Group().Count() }, [&]() {
    return dispatchDimension(from.Grid.Dimension(), fade<1>, fade<2>, fade<3>)(
      from, to, box, settings, progress);
  });
}

// Returns the plan's warning.
// Finds the tracked particles at the next step; without a step before, places them in the first
// one.
template <int D>
std::string extend(SeriesTracks& tracks, const StepDensity* before, const StepDensity& next,
  const ImageGrid& box, Progress& progress)
{
  std::string warning;
  // The samples have equal shares of the mass. AsSamples lets the optimal map move them together,
  // so that cells get their exact numbers, and errors do not add up over the steps.
  const auto move = [&](PointSpan<D> samples, Progress& moving) -> MoveReport {
    Stages stages(moving, { { "map", 6 }, { "images", 4 } });
    const bool isOptimal = tracks.Settings().IsOptimal;
    const auto plan = solve<D>(
      *before, next, box, isOptimal, static_cast<double>(tracks.Particles().All()), stages["map"]);
    const double bound = LengthScale(box).CostFromUnits(plan->LowerBound());
    const FlowSeeds<D> seeds{ ConstPointSpan<D>(samples) };
    plan->Forward(seeds.AsSamples(), samples, stages["images"]);
    warning = plan->Warning();
    return { bound, isOptimal };
  };
  tracks.Extend<D>(
    before ? &before->Grid : nullptr, next.Step(), next.Identity.Content(), move, progress);
  return warning;
}

// The total mass moves linearly from the first step's to the second one's: m(s) = (1 - s) m0 + s
// m1.
double massAt(const TemporalInput& moment)
{
  return (1.0 - moment.Part) * moment.First.Density->Mass +
    moment.Part * moment.Second.Density->Mass;
}

// The part of an image that this rank gives. Where the grid changes, requests are of another one.
Extent extentOfRank(const Extent& whole, vtkInformation* announced, const Ranks& ranks)
{
  const Extent wanted = extentToGive(whole, announced, ranks);
  const auto pointsOf = [&](const Extent& extent) {
    return tuplesOf(extent, vtkDataObject::POINT, whole);
  };
  // The box around all requested extents must be the whole image. If it is less, requests were
  // computed for another grid, and the image is divided among the ranks instead.
  TupleBox all = pointsOf(wanted);
  for (const Extent& other : gatherValues(ranks, wanted))
  {
    all = all.With(pointsOf(other));
  }
  return all.Contains(pointsOf(whole))
    ? wanted
    : dividedExtent(whole, ranks.Count())[static_cast<std::size_t>(ranks.Own())];
}

// Particles move on straight ways with constant speed: v = (To - From) / Length, in physical units
// a unit of time.
vtkSmartPointer<vtkDoubleArray> velocitiesOf(
  const SeriesParticles& particles, const TemporalInput& moment, Progress& progress)
{
  auto velocities = newArray<vtkDoubleArray>("Velocity", 3, particles.Count());
  const bool areFinite = writeVelocities(
    particles, moment.Length, { velocities->GetPointer(0), particles.Count() }, progress);
  // All ranks fail together, whichever of them has the fast particle.
  if (!onAllRanks(progress.Group(), areFinite))
  {
    throw Failure(moment.First.Title + " and the next one are " + textOf(moment.Length) +
      " apart in time, so that velocities pass the largest double; the steps must be further "
      "apart");
  }
  return velocities;
}

// The tuples [begin, begin + count) of an array; itself for all of them.
vtkSmartPointer<vtkDoubleArray> partOf(
  vtkDoubleArray* array, std::int64_t begin, std::int64_t count)
{
  auto part = vtkSmartPointer<vtkDoubleArray>::New();
  if (begin == 0 && count == array->GetNumberOfTuples())
  {
    // A new array object on the same memory: the output may rename or delete its own.
    part->ShallowCopy(array);
    return part;
  }
  const int components = array->GetNumberOfComponents();
  part = newArray<vtkDoubleArray>(array->GetName(), components, count);
  std::copy_n(array->GetPointer(begin * components), count * components, part->GetPointer(0));
  return part;
}

// Clouds as wide as the distances between particles, which fill the space between them evenly where
// mass spreads out. Memory: two doubles a cell of the grid for the sums.
template <int D>
void writeClouds(const SeriesSnapshot& moment, const SplatTarget& target, double most,
  const TupleBox& wanted, double* density, Progress& progress)
{
  const ImageGrid& grid = target.Geometry;
  const double bytes = 16.0 * static_cast<double>(grid.NumberOfCells());
  withMemory({ "the sums of the cells", bytes }, [&]() {
    splatClouds<D>(
      moment.CloudsIn<D>(grid), grid, most, latticePartOf<D>(wanted, grid), density, progress);
  });
}

// Writes the density of particles in the wanted cells; `most`: the largest mass of the interval.
void writeDensity(const SeriesSnapshot& moment, const SplatTarget& target, double most,
  const TupleBox& wanted, Progress& progress, vtkDoubleArray* density)
{
  // All mass might be in one cell.
  requireFiniteDensity(most, target, "The particles' masses", "or the cells larger");
  // Only the cloud-in-cell kernel has widths of its own for each particle. Tracked particles have
  // no clouds.
  if (target.Options.Kernel == SplatKernel::CloudInCell && !moment.All().Clouds[0].empty())
  {
    dispatchDimension(target.Geometry.Dimension(), writeClouds<1>, writeClouds<2>, writeClouds<3>)(
      moment, target, most, wanted, density->GetPointer(0), progress);
    return;
  }
  splatDistributed(
    moment.Points(), moment.Masses(), moment.Numbers(), target, wanted, progress, density);
}

// Writes the density of a step itself.
void copyDensity(
  const StepDensity& step, const TupleBox& wanted, Progress& progress, vtkDoubleArray* density)
{
  // Every rank has the values of the whole step, axis 0 fastest; it copies those of its extent.
  const Extent& whole = step.Grid.Extent();
  const TupleBox all = tuplesOf(whole, ownerOf(step.Grid), whole);
  double* to = density->GetPointer(0);
  const double* from = step.Values->GetPointer(0);
  progress.ForEach(
    wanted.Count(), grain, [&](std::int64_t i) { to[i] = from[all.NumberOf(wanted.CellOf(i))]; });
}

// The input's image at a step, in an extent. Collective: ranks exchange the parts that they hold.
AdvectedImage advectedImage(const TemporalStep& step, const Extent& wanted)
{
  return { step.Input->ImageIn(wanted), step.Density->Grid, step.Density->ArrayName };
}

// A warning that names the arrays that only one of both steps has, or that differ in type; empty if
// there are none.
std::string describeMissing(const TemporalInput& moment, const AdvectedArrays& arrays)
{
  std::string names;
  for (const std::string& name : arrays.Missing())
  {
    names += (names.empty() ? "'" : ", '") + name + "'";
  }
  return names.empty()
    ? ""
    : moment.First.Title + " and the next one do not both have, of one type: " + names +
      "; between them there is no such array (all steps should have the same arrays)";
}

// A warning about steps without mass; empty if both have some.
std::string describeEmpty(const TemporalInput& moment)
{
  const bool isFirst = !(moment.First.Density->Mass > 0.0);
  const bool isSecond = !(moment.Second.Density->Mass > 0.0);
  if (isFirst == isSecond)
  {
    return isFirst ? moment.First.Title + " and the next one have no mass" : "";
  }
  return (isFirst ? moment.First.Title : moment.Second.Title) + " has no mass: that of " +
    (isFirst ? "the next step appears" : "the step before disappears") + " where it is";
}

} // namespace

std::vector<std::string> TemporalInterpolation::Run(const TemporalInput& moment,
  const TemporalSettings& settings, Progress& progress, const TemporalOutput& output)
{
  Stages stages(progress, { { "map", 8 }, { "particles", 1 }, { "image", 1 } });
  const ImageGrid between = gridBetween(moment.First, moment.Second);
  std::vector<std::string> warnings;
  Interval& interval = this->Find(moment, settings, stages["map"], warnings);
  const SeriesParticles& particles = interval.Particles;
  // At a step itself the output is that step, on its own grid and to the bit. Tracked particles are
  // splat also there, so that the image does not change its nature at the steps.
  const bool isStep = !settings.TracksParticles && (moment.Part <= 0.0 || moment.Part >= 1.0);
  const TemporalStep& nearest = moment.Part < 1.0 ? moment.First : moment.Second;
  // The splat would smooth the step's density by its kernel.
  const ImageGrid& geometry = isStep ? nearest.Density->Grid : between;
  applyGrid(geometry, output.Image);
  // The particles before they go to their owners.
  // x(s) = (1 - s) From + s To, s = Part. Shape of the points: particles of this rank x 3; masses
  // in units of density times measure, which sum to massAt(moment) over all ranks.
  SeriesSnapshot now(particles, moment.Part);
  const std::int64_t count = now.Count();
  const auto points = newArray<vtkDoubleArray>("Points", 3, count);
  const auto masses = newArray<vtkDoubleArray>("Mass", 1, count);
  now.Write(
    massAt(moment), { points->GetPointer(0), count }, masses->GetPointer(0), stages["particles"]);
  vtkNew<vtkPoints> placed;
  placed->SetData(points);
  output.Particles->SetPoints(placed);
  output.Particles->GetPointData()->AddArray(masses);
  // `now` refers to `points` and `masses`, which the image needs below: particles move to their
  // owners in arrays of their own.
  this->WriteParticles(interval, geometry, now, stages["particles"], output);

  Extent wanted = extentOfRank(geometry.Extent(), output.Announced, progress.Group());
  const TupleBox box = tuplesOf(wanted, ownerOf(geometry), geometry.Extent());
  output.Image->SetExtent(wanted.data());
  const StepDensity& named = isStep ? *nearest.Density : *interval.First;
  const auto density =
    newArray<vtkDoubleArray>(named.ArrayName.empty() ? "Density" : named.ArrayName, 1, box.Count());
  const double most = std::max(interval.First->Mass, interval.Second->Mass);
  isStep
    ? copyDensity(*nearest.Density, box, stages["image"], density)
    : writeDensity(now, { geometry, settings.Splat, true }, most, box, stages["image"], density);
  output.Image->GetAttributes(ownerOf(geometry))->SetScalars(density);
  // At a step, arrays pass as they are; between steps, they come from the particles.
  if (settings.AdvectsArrays)
  {
    isStep
      ? passAdvected(advectedImage(nearest, wanted), output.Image)
      : interval.Arrays.Write(now, geometry, settings.Splat, wanted, stages["image"], output.Image);
  }
  announceGrid(geometry, output.Announced); // which extents to give depends on that before
  // Both outputs say what they are of. They are the same on all ranks.
  for (vtkDataObject* part :
    { static_cast<vtkDataObject*>(output.Image), static_cast<vtkDataObject*>(output.Particles) })
  {
    addFieldValue(part, "TotalMass", massAt(moment));
    addFieldValue(part, "TransportCost", particles.Cost);
    addReadings(part, { moment.First.Input->HowRead() });
    if (particles.HasBound)
    {
      addCostBound(part, particles.Bound, particles.Cost, between);
    }
  }
  return warnings;
}

std::string TemporalInterpolation::Track(
  const TemporalStep* before, const TemporalStep& step, Progress& progress)
{
  const StepDensity& density = *step.Density;
  const ImageGrid box = before ? gridBetween(*before, step) : density.Grid;
  // A series is tracked from its first step on, each step once.
  if (this->Tracked.Knows(density.Identity.Content(), progress.Group()))
  {
    return {};
  }
  // Each particle takes about 160 bytes: its positions at the steps, and what moves it between
  // them.
  const std::int64_t particles = before ? this->Tracked.Particles().All()
                                        : density.Grid.NumberOfCells() *
      static_cast<std::int64_t>(this->Tracked.Settings().ParticlesPerCell);
  const MemoryPlan memory{ std::to_string(particles) + " particles (see ParticlesPerCell)",
    160.0 * static_cast<double>(particles) / progress.Group().Count() };
  const std::string warning = withRequiredMemory(memory, [&]() {
    return dispatchDimension(box.Dimension(), extend<1>, extend<2>, extend<3>)(
      this->Tracked, before ? before->Density.get() : nullptr, density, box, progress);
  });
  ++this->Made;
  return warning;
}

TemporalInterpolation::Interval& TemporalInterpolation::Find(const TemporalInput& moment,
  const TemporalSettings& settings, Progress& progress, std::vector<std::string>& warnings)
{
  Stages stages(progress, { { "interval", 9 }, { "arrays", settings.AdvectsArrays ? 1.0 : 0.0 } });
  const auto found =
    std::find_if(this->Intervals.begin(), this->Intervals.end(), [&](const Interval& interval) {
      return interval.First->IsSameAs(*moment.First.Density) &&
        interval.Second->IsSameAs(*moment.Second.Density) && interval.Settings == settings.Moving &&
        interval.Particles.AreTracked == settings.TracksParticles &&
        interval.Length == moment.Length && interval.Ranks == progress.Group().Count();
    });
  // What tracked particles do in an interval depends on the intervals before it.
  // Collective: if a rank has lost the interval, for example after an error there, all make it
  // again.
  const bool isKept = onAllRanks(progress.Group(), found != this->Intervals.end()) &&
    !(settings.TracksParticles &&
      found->Particles.From !=
        this->Tracked.Particles()
          .Between(moment.First.Number, moment.Second.Number, progress.Group())
          .From);
  if (isKept)
  {
    this->Intervals.splice(this->Intervals.begin(), this->Intervals, found);
  }
  else
  {
    // With two intervals, times that go back and forth over a step need no new maps.
    constexpr std::size_t kept = 2;
    while (this->Intervals.size() >= kept)
    {
      this->Intervals.pop_back(); // before the memory of the next one
    }
    this->Intervals.push_front(this->Make(moment, settings, stages["interval"]));
    warnings = { this->Intervals.front().Particles.Warning, describeEmpty(moment) };
  }
  Interval& interval = this->Intervals.front();
  // Arrays are made for a new interval, or when the property is switched on for one that exists.
  if (settings.AdvectsArrays && !interval.AdvectsArrays)
  {
    const auto whole = [](const TemporalStep& step) {
      return advectedImage(step, step.Density->Grid.Extent());
    };
    interval.Arrays.Make(whole(moment.First), whole(moment.Second), interval.Particles,
      gridBetween(moment.First, moment.Second), stages["arrays"]);
    warnings.push_back(describeMissing(moment, interval.Arrays));
  }
  // Switched off and on again, arrays are read anew: they may have changed meanwhile.
  interval.AdvectsArrays = settings.AdvectsArrays;
  // Only texts that say something are shown.
  warnings.erase(std::remove(warnings.begin(), warnings.end(), ""), warnings.end());
  return interval;
}

TemporalInterpolation::Interval TemporalInterpolation::Make(
  const TemporalInput& moment, const TemporalSettings& settings, Progress& progress)
{
  Stages stages(progress, { { "particles", 98 }, { "velocities", 2 } });
  Interval interval;
  interval.First = moment.First.Density;
  interval.Second = moment.Second.Density;
  interval.Settings = settings.Moving;
  interval.Length = moment.Length;
  interval.Ranks = progress.Group().Count();
  SeriesParticles& particles = interval.Particles;
  // Tracked positions exist already (see Track): the interval only refers to them.
  if (settings.TracksParticles)
  {
    particles = this->Tracked.Particles().Between(
      moment.First.Number, moment.Second.Number, progress.Group());
  }
  else
  {
    particles = makeParticles(*interval.First, *interval.Second,
      gridBetween(moment.First, moment.Second), settings.Moving, stages["particles"]);
    ++this->Made;
    if (!particles.Warning.empty())
    {
      particles.Warning = moment.Second.Title + ": " + particles.Warning;
    }
  }
  // Constant within the interval, so that they are made with it.
  interval.Velocities = velocitiesOf(particles, moment, stages["velocities"]);
  return interval;
}

// Adds what particles have besides places and masses, and gives them to their ranks.
void TemporalInterpolation::WriteParticles(const Interval& interval, const ImageGrid& geometry,
  const SeriesSnapshot& moment, Progress& progress, const TemporalOutput& output)
{
  vtkPointData* data = output.Particles->GetPointData();
  // At an end of the interval only particles of one step have mass: those [First, First + Count).
  data->SetVectors(partOf(interval.Velocities, moment.First(), moment.Count()));
  if (interval.Particles.AreTracked)
  {
    // The number of a tracked particle is the same at all times, for path lines.
    auto ids = newArray<vtkIdTypeArray>("SeedId", 1, moment.Count());
    std::copy_n(interval.Particles.Numbers.begin(), moment.Count(), ids->GetPointer(0));
    data->AddArray(ids);
  }
  moveToOwners(output.Particles, geometry, this->Vertices, progress);
}

} // namespace RectifiedTransport::Bridge
