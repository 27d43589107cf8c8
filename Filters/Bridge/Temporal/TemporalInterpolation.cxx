// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/TemporalInterpolation.h"

#include "Bridge/Density/DensityPlan.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Image/CommonGrid.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/ParticleCells.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Ranks/ParticleExchange.h"
#include "Bridge/Ranks/SameOnRanks.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Splat/DistributedSplat.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include "vtkCellArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 13;

std::string densityName(const StepDensity& density)
{
  return density.ArrayName.empty() ? "Density" : density.ArrayName;
}

int ownerOf(const ImageGrid& grid)
{
  return grid.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
}

ImageGrid gridBetween(const TemporalStep& first, const TemporalStep& second)
{
  constexpr int any[3] = { 0, 0, 0 };
  return commonGrid(
    { { first.Density->Grid, first.Title }, { second.Density->Grid, second.Title } }, any,
    MostCells::Any);
}

double massAt(const TemporalMoment& moment)
{
  return (1.0 - moment.Part) * moment.First.Density->Mass +
    moment.Part * moment.Second.Density->Mass;
}

// The part of an image that this rank gives. Where the grid changes, requests are of another one.
Extent extentOfRank(const Extent& whole, vtkInformation* announced, const Ranks& ranks)
{
  const Extent wanted = extentToGive(whole, announced, ranks);
  Extent all = wanted;
  for (const Extent& other : gatherValues(ranks, wanted))
  {
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i] = i % 2 == 0 ? std::min(all[i], other[i]) : std::max(all[i], other[i]);
    }
  }
  return all == whole ? wanted
                      : dividedExtent(whole, ranks.Count())[static_cast<std::size_t>(ranks.Own())];
}

vtkSmartPointer<vtkDoubleArray> velocitiesOf(
  const SeriesParticles& particles, const TemporalMoment& moment, Progress& progress)
{
  auto velocities = newArray<vtkDoubleArray>("Velocity", 3, particles.Count());
  const bool areFinite = writeVelocities(
    particles, moment.Length, { velocities->GetPointer(0), particles.Count() }, progress);
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
    part->ShallowCopy(array);
    return part;
  }
  const int components = array->GetNumberOfComponents();
  part = newArray<vtkDoubleArray>(array->GetName(), components, count);
  std::copy_n(array->GetPointer(begin * components), count * components, part->GetPointer(0));
  return part;
}

template <int D>
void writeClouds(const SeriesMoment& moment, const ImageGrid& geometry, double most,
  const TupleBox& wanted, double* density, Progress& progress)
{
  const double bytes = 16.0 * static_cast<double>(geometry.NumberOfCells());
  withMemory({ "the sums of the cells", bytes }, [&]() {
    splatClouds<D>(moment.CloudsIn<D>(geometry), geometry, most, latticePartOf<D>(wanted, geometry),
      density, progress);
  });
}

AdvectedImage advectedImage(const TemporalStep& step)
{
  const StepDensity& density = *step.Density;
  return { step.Input->ImageIn(density.Grid.Extent()), density.Grid, density.ArrayName };
}

std::string describeMissing(const TemporalMoment& moment, const AdvectedArrays& arrays)
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

std::string describeEmpty(const TemporalMoment& moment)
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

void requireOneSpace(const TemporalStep& first, const TemporalStep& second)
{
  gridBetween(first, second);
}

std::vector<std::string> TemporalInterpolation::Run(const TemporalMoment& moment,
  const TemporalSettings& settings, Progress& progress, const TemporalOutput& output)
{
  Stages stages(progress, { { "map", 8 }, { "particles", 1 }, { "image", 1 } });
  const ImageGrid between = gridBetween(moment.First, moment.Second);
  std::vector<std::string> warnings;
  Interval& interval = this->Find(moment, settings, stages["map"], warnings);
  const bool isStep = !settings.TracksParticles && (moment.Part <= 0.0 || moment.Part >= 1.0);
  const TemporalStep& nearest = moment.Part < 1.0 ? moment.First : moment.Second;
  const ImageGrid& geometry = isStep ? nearest.Density->Grid : between;
  applyGrid(geometry, output.Image);
  SeriesMoment particlesNow(interval.Particles, moment.Part);
  this->WriteParticles(interval, geometry, particlesNow, stages["particles"], output);
  if (isStep)
  {
    WriteStep(nearest, settings.AdvectsArrays, stages["image"], output);
  }
  else
  {
    WriteImage(interval, settings, geometry, particlesNow, stages["image"], output);
  }
  announceGrid(geometry, output.Announced); // which extents to give depends on that before
  const SeriesParticles& particles = interval.Particles;
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

TemporalInterpolation::Interval& TemporalInterpolation::Find(const TemporalMoment& moment,
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
    constexpr std::size_t kept = 2;
    while (this->Intervals.size() >= kept)
    {
      this->Intervals.pop_back(); // before the memory of the next one
    }
    Interval interval;
    this->Make(moment, settings, stages["interval"], interval);
    warnings = { interval.Particles.Warning, describeEmpty(moment) };
    this->Intervals.push_front(std::move(interval));
  }
  Interval& interval = this->Intervals.front();
  if (settings.AdvectsArrays && !interval.AdvectsArrays)
  {
    interval.Arrays.Make(advectedImage(moment.First), advectedImage(moment.Second),
      interval.Particles, gridBetween(moment.First, moment.Second), stages["arrays"]);
    warnings.push_back(describeMissing(moment, interval.Arrays));
  }
  interval.AdvectsArrays = settings.AdvectsArrays;
  warnings.erase(std::remove(warnings.begin(), warnings.end(), ""), warnings.end());
  return interval;
}

void TemporalInterpolation::Make(const TemporalMoment& moment, const TemporalSettings& settings,
  Progress& progress, Interval& interval)
{
  Stages stages(progress, { { "particles", 98 }, { "velocities", 2 } });
  interval.First = moment.First.Density;
  interval.Second = moment.Second.Density;
  interval.Settings = settings.Moving;
  interval.Length = moment.Length;
  interval.Ranks = progress.Group().Count();
  if (settings.TracksParticles)
  {
    interval.Particles = this->Tracked.Particles().Between(
      moment.First.Number, moment.Second.Number, progress.Group());
  }
  else
  {
    interval.Particles = makeParticles(
      *moment.First.Density, *moment.Second.Density, settings.Moving, stages["particles"]);
    this->CountMap();
    if (!interval.Particles.Warning.empty())
    {
      interval.Particles.Warning = moment.Second.Title + ": " + interval.Particles.Warning;
    }
  }
  interval.Velocities = velocitiesOf(interval.Particles, moment, stages["velocities"]);
}

void TemporalInterpolation::WriteParticles(const Interval& interval, const ImageGrid& geometry,
  SeriesMoment& moment, Progress& progress, const TemporalOutput& output)
{
  const std::int64_t count = moment.Count();
  const double part = moment.Part();
  this->Points = newArray<vtkDoubleArray>("Points", 3, count);
  this->Masses = newArray<vtkDoubleArray>("Mass", 1, count);
  moment.Write((1.0 - part) * interval.First->Mass + part * interval.Second->Mass,
    { this->Points->GetPointer(0), count }, this->Masses->GetPointer(0), progress);
  vtkNew<vtkPoints> points;
  points->SetData(this->Points);
  output.Particles->SetPoints(points);
  vtkPointData* data = output.Particles->GetPointData();
  data->AddArray(this->Masses);
  data->SetVectors(partOf(interval.Velocities, moment.First(), count));
  if (interval.Particles.AreTracked)
  {
    auto ids = newArray<vtkIdTypeArray>("SeedId", 1, count);
    std::copy_n(interval.Particles.Numbers.begin(), count, ids->GetPointer(0));
    data->AddArray(ids);
  }
  const Ranks& ranks = progress.Group();
  if (ranks.AreSeveral())
  {
    moveToOwners(output.Particles, 1, ownersOf(geometry, nullptr, ranks), ranks, progress);
    return;
  }
  if (!this->Vertices || this->Vertices->GetNumberOfCells() != count)
  {
    this->Vertices = newParticleCells(count, 1, progress);
  }
  output.Particles->SetVerts(this->Vertices);
}

void TemporalInterpolation::WriteImage(const Interval& interval, const TemporalSettings& settings,
  const ImageGrid& geometry, const SeriesMoment& moment, Progress& progress,
  const TemporalOutput& output)
{
  Extent wanted = extentOfRank(geometry.Extent(), output.Announced, progress.Group());
  const TupleBox box = tuplesOf(wanted, ownerOf(geometry), geometry.Extent());
  const SplatTarget target{ geometry, settings.Splat, true };
  const double most = std::max(interval.First->Mass, interval.Second->Mass);
  requireFiniteDensity(most, target, "The particles' masses", "or the cells larger");
  output.Image->SetExtent(wanted.data());
  auto density = newArray<vtkDoubleArray>(densityName(*interval.First), 1, box.Count());
  if (settings.Splat.Kernel == SplatKernel::CloudInCell && !interval.Particles.Clouds[0].empty())
  {
    dispatchDimension(geometry.Dimension(), writeClouds<1>, writeClouds<2>, writeClouds<3>)(
      moment, geometry, most, box, density->GetPointer(0), progress);
  }
  else
  {
    splatDistributed(
      moment.Points(), moment.Masses(), moment.Numbers(), target, box, progress, density);
  }
  output.Image->GetAttributes(ownerOf(geometry))->SetScalars(density);
  if (settings.AdvectsArrays)
  {
    interval.Arrays.Write(moment, geometry, settings.Splat, wanted, progress, output.Image);
  }
}

void TemporalInterpolation::WriteStep(
  const TemporalStep& step, bool advects, Progress& progress, const TemporalOutput& output)
{
  const StepDensity& density = *step.Density;
  const Extent& whole = density.Grid.Extent();
  Extent wanted = extentOfRank(whole, output.Announced, progress.Group());
  const int owner = ownerOf(density.Grid);
  const TupleBox box = tuplesOf(wanted, owner, whole);
  const TupleBox all = tuplesOf(whole, owner, whole);
  output.Image->SetExtent(wanted.data());
  auto values = newArray<vtkDoubleArray>(densityName(density), 1, box.Count());
  double* to = values->GetPointer(0);
  const double* from = density.Values->GetPointer(0);
  progress.For(box.Count(), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      to[i] = from[all.NumberOf(box.CellOf(i))];
    }
  });
  output.Image->GetAttributes(owner)->SetScalars(values);
  if (!advects)
  {
    return;
  }
  const AdvectedImage image{ step.Input->ImageIn(wanted), density.Grid, density.ArrayName };
  for (const int type : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = image.Image->GetAttributes(type);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      if (isAdvected(image, type, attributes->GetAbstractArray(i)))
      {
        output.Image->GetAttributes(type)->AddArray(attributes->GetAbstractArray(i));
      }
    }
  }
}

} // namespace RectifiedTransport::Bridge
