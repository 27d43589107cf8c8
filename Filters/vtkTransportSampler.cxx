// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportSampler.h"

#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/FlowCache.h"
#include "Bridge/Points/ParticleSet.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Points/SeedInput.h"
#include "Bridge/Points/UnitSeeds.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/PropertyCheck.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportSampler);

namespace
{
using namespace RectifiedTransport;

constexpr std::int64_t grain = std::int64_t{ 1 } << 14;

// What RequestData has fetched and checked.
struct SamplerRun
{
  Progress& Work;
  DensityImage& Density;
  FlowCache& Cache;
  FlowOptions Options;
  vtkPointSet* GivenSeeds;
  SeedPattern Pattern;
  vtkIdType Count;
  int RandomSeed;
  int SamplesPerCell;
  double FlowTime;
  bool Paths;
};

// What the user should be warned of.
struct SamplerReport
{
  std::int64_t SeedsMoved = 0;
  std::int64_t ParticlesMoved = 0;
};

// Progress at the ends of the stages, in proportion to the times that they take.
struct SamplerStages
{
  double Tables;
  double Seeds;
  double Flow;
};

SamplerStages planStages(const SamplerRun& run, double particles, std::size_t times)
{
  const ImageGrid& geometry = run.Density.Geometry();
  const double evaluations =
    run.Options.NumberOfSteps * (run.Options.Method == Integrator::RungeKutta4 ? 4.0 : 1.0);
  // Nanoseconds, as measured.
  const double tables =
    run.Cache.IsOutdated(run.Density) ? 10.0 * static_cast<double>(geometry.NumberOfCells()) : 0.0;
  const double seeds = tables + 20.0 * particles;
  const double flow = seeds + particles * evaluations * (geometry.Dimension() == 3 ? 60.0 : 15.0);
  const double all = flow + 50.0 * particles * static_cast<double>(times);
  return { tables / all, seeds / all, flow / all };
}

// The moments at which positions are wanted: FlowTime, or all of a path.
std::vector<double> timesOf(const SamplerRun& run)
{
  const int steps = run.Paths ? run.Options.NumberOfSteps : 0;
  std::vector<double> times;
  for (int i = 0; i < steps; ++i)
  {
    times.push_back(run.FlowTime * i / steps);
  }
  times.push_back(run.FlowTime);
  return times;
}

template <int D>
UnitSeeds<D> patternOf(const SamplerRun& run)
{
  const ImageGrid& geometry = run.Density.Geometry();
  if (run.SamplesPerCell > 0 &&
    (run.Pattern == SeedPattern::Lattice || run.Pattern == SeedPattern::Jittered))
  {
    GridSize<D> grid = geometry.Size<D>();
    for (std::int64_t& cells : grid)
    {
      cells *= run.SamplesPerCell;
    }
    return UnitSeeds<D>(run.Pattern, grid, run.RandomSeed);
  }
  return UnitSeeds<D>(run.Pattern, geometry.Lengths<D>(), run.Count, run.RandomSeed);
}

std::string describeParticles(double count, bool paths)
{
  constexpr double mostDigits = 1e15;
  const std::string number =
    count < mostDigits ? std::to_string(static_cast<std::int64_t>(count)) : "more than 1e15";
  return (paths ? "the paths of " : "") + number +
    " particles (see NumberOfParticles, SamplesPerCell and Seeds)";
}

template <int D>
void makeSeeds(const UnitSeeds<D>& pattern, const SamplerRun& run, const std::string& purpose,
  double end, ParticleSet<D>& particles)
{
  constexpr double partOfPattern = 0.8;
  double* seeds = particles.Seeds();
  run.Work.BeginStage(run.Work.StageEnd() + partOfPattern * (end - run.Work.StageEnd()));
  withMemory(purpose, pattern.Count() * D * sizeof(double), [&]() {
    pattern.Generate({ seeds, particles.Count() }, run.Work.Stage());
  });
  run.Work.BeginStage(end);
  const GridSize<D> size = run.Density.Geometry().Size<D>();
  run.Work.For(particles.Count(), grain, [=](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      for (int a = 0; a < D; ++a)
      {
        seeds[i * D + a] *= static_cast<double>(size[a]);
      }
    }
  });
}

// Returns how many particles had to be put into cells with mass.
template <int D>
std::int64_t advect(const SamplerRun& run, const std::vector<double>& times,
  const std::string& purpose, ParticleSet<D>& particles)
{
  const double* seeds = particles.Seeds();
  double* positions = particles.Positions();
  const std::int64_t count = particles.Count();
  if (times.size() == 1 && times[0] == 0.0)
  {
    run.Work.For(count, grain, [=](std::int64_t first, std::int64_t last) {
      std::copy(seeds + first * D, seeds + last * D, positions + first * D);
    });
    return 0;
  }
  const RectifiedFlow<D>& flow = run.Cache.Flow<D>();
  const bool toEnd = times.size() == 1 && times[0] == 1.0;
  const ConstPointSpan<D> from(seeds, count);
  const PointSpan<D> to(positions, count * static_cast<std::int64_t>(times.size()));
  return withMemory(purpose, static_cast<double>(count) * sizeof(std::int64_t), [&]() {
    const FlowReport report = toEnd
      ? flow.Forward(from, to, run.Options, run.Work.Stage())
      : flow.ForwardAt(from, times, to, run.Options, run.Work.Stage());
    return report.MovedToMass;
  });
}

template <int D>
SamplerReport sample(const SamplerRun& run, vtkPolyData* output)
{
  const ImageGrid& geometry = run.Density.Geometry();
  const UnitSeeds<D> pattern = patternOf<D>(run);
  const double count =
    run.GivenSeeds ? static_cast<double>(run.GivenSeeds->GetNumberOfPoints()) : pattern.Count();
  const std::vector<double> times = timesOf(run);
  const SamplerStages stages = planStages(run, count, times.size());
  const std::string purpose = describeParticles(count, run.Paths);
  ParticleSet<D> particles(
    geometry, purpose, count, static_cast<std::int64_t>(times.size()), run.GivenSeeds != nullptr);

  run.Cache.Update(run.Density, run.Work, stages.Tables);
  SamplerReport report;
  if (run.GivenSeeds)
  {
    run.Work.BeginStage(stages.Seeds);
    report.SeedsMoved = readSeeds<D>(run.GivenSeeds, "input Seeds", geometry, run.Work,
      particles.Seeds(), particles.PhysicalSeeds());
  }
  else
  {
    makeSeeds<D>(pattern, run, purpose, stages.Seeds, particles);
  }
  run.Work.BeginStage(stages.Flow);
  report.ParticlesMoved = advect<D>(run, times, purpose, particles);

  vtkDataSetAttributes* cellsOrPoints = output->GetPointData();
  if (run.Paths)
  {
    cellsOrPoints = output->GetCellData();
  }
  if (run.GivenSeeds)
  {
    cellsOrPoints->PassData(run.GivenSeeds->GetPointData());
  }
  const double mass = run.Cache.TotalMass();
  const double cost = run.Paths ? particles.WritePaths(mass, times, run.Work, 1.0, output)
                                : particles.WriteParticles(mass, run.Work, 1.0, output);
  addFieldValue(output, "TotalMass", mass);
  addFieldValue(output, "TransportCost", cost);
  return report;
}
} // namespace

//------------------------------------------------------------------------------
vtkTransportSampler::vtkTransportSampler()
  : NumberOfParticles(8192)
  , SeedPattern(BLUE_NOISE)
  , RandomSeed(1)
  , SamplesPerCell(0)
  , FlowTime(1.0)
  , OutputPaths(false)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(1);
}

//------------------------------------------------------------------------------
vtkTransportSampler::~vtkTransportSampler() = default;

//------------------------------------------------------------------------------
const char* vtkTransportSampler::GetSeedPatternAsString()
{
  return choiceText(SeedPatternTexts, this->SeedPattern);
}

//------------------------------------------------------------------------------
void vtkTransportSampler::SetSeedsConnection(vtkAlgorithmOutput* seeds)
{
  this->SetInputConnection(1, seeds);
}

//------------------------------------------------------------------------------
void vtkTransportSampler::SetSeedsData(vtkDataObject* seeds)
{
  this->SetInputData(1, seeds);
}

//------------------------------------------------------------------------------
vtkPolyData* vtkTransportSampler::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
int vtkTransportSampler::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
    return 1;
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportSampler::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportSampler::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* seeds = pointSetOf(inputVector[1]);
  const bool usesGrid =
    this->SamplesPerCell > 0 && (this->SeedPattern == LATTICE || this->SeedPattern == JITTERED);
  requireChoice("SeedPattern", this->SeedPattern, SeedPatternTexts);
  requireThat(
    this->SamplesPerCell >= 0, "SamplesPerCell", this->SamplesPerCell, "0 (not used) or greater");
  requireThat(this->NumberOfParticles >= 1 || seeds || usesGrid, "NumberOfParticles",
    this->NumberOfParticles, "at least 1");
  requireThat(
    this->FlowTime >= 0.0 && this->FlowTime <= 1.0, "FlowTime", this->FlowTime, "from 0 to 1");
  const FlowOptions options = this->GetFlowOptions();
  std::unique_ptr<Executor> executor(this->NewExecutor());

  // All particles are in the first piece, whatever pieces a consumer asks for.
  if (vtkGuardedAlgorithm::IsLaterPiece(request, outputVector))
  {
    return 1;
  }
  const std::unique_ptr<DensityImage> density(this->NewDensity(inputVector));
  if (!density || (seeds && seeds->GetNumberOfPoints() == 0))
  {
    return 1;
  }
  AlgorithmProgress progress(this, std::move(executor));
  const SamplerRun run{ progress, *density, this->GetFlowCache(), options, seeds,
    static_cast<RectifiedTransport::SeedPattern>(this->SeedPattern), this->NumberOfParticles,
    this->RandomSeed, this->SamplesPerCell, this->FlowTime, this->OutputPaths != 0 };
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const int dimension = density->Geometry().Dimension();
  const SamplerReport report = dimension == 1 ? sample<1>(run, output)
    : dimension == 2                          ? sample<2>(run, output)
                                              : sample<3>(run, output);
  if (report.SeedsMoved > 0)
  {
    vtkWarningMacro(<< report.SeedsMoved << " of " << seeds->GetNumberOfPoints()
                    << " seeds outside the domain of the density moved to its border");
  }
  if (report.ParticlesMoved > 0)
  {
    vtkWarningMacro(<< report.ParticlesMoved << " of " << output->GetNumberOfCells()
                    << " particles in empty cells moved to the nearest cell with mass (more "
                       "NumberOfSteps may spare them that)");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportSampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfParticles: " << this->NumberOfParticles << "\n";
  os << indent << "SeedPattern: " << this->GetSeedPatternAsString() << "\n";
  os << indent << "RandomSeed: " << this->RandomSeed << "\n";
  os << indent << "SamplesPerCell: " << this->SamplesPerCell << "\n";
  os << indent << "FlowTime: " << this->FlowTime << "\n";
  os << indent << "OutputPaths: " << (this->OutputPaths ? "On" : "Off") << "\n";
}
VTK_ABI_NAMESPACE_END
