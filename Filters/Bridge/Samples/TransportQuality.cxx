// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Samples/TransportQuality.h"

#include "Bridge/Data/DoubleTuples.h"
#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Plan/FlowCosts.h"
#include "Bridge/Run/TextToNumbers.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Messages/Failure.h"
#include "Core/Quality/GridBlocks.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// Particles between two polls for abort.
constexpr std::int64_t particleGrain = std::int64_t{ 1 } << 12;

// All messages name the array first, because the particles may come from any program.
[[noreturn]] void fail(const char* name, const std::string& what)
{
  throw Failure("The array '" + std::string(name) + "' of the particles " + what);
}

// An array of numbers of the particles, nullptr if there is none of that name.
vtkSmartPointer<vtkDataArray> findArray(vtkPointSet* particles, const char* name, int components)
{
  vtkAbstractArray* found = particles->GetPointData()->GetAbstractArray(name);
  // Files of text, such as CSV, may give an array of numbers as strings.
  const TextToNumbers numbers = parseNumbers(found);
  const vtkSmartPointer<vtkDataArray>& array = numbers.Array;
  if (found && (!array || array->GetNumberOfComponents() != components))
  {
    const int count = array ? array->GetNumberOfComponents() : 0;
    const std::string has =
      "has " + std::to_string(count) + (count == 1 ? " component" : " components");
    fail(name,
      (array ? has : "is not numeric (" + numbers.Wrong + ")") + "; it must be numeric and have " +
        std::to_string(components));
  }
  if (array && array->GetNumberOfTuples() != particles->GetNumberOfPoints())
  {
    fail(name,
      "has " + std::to_string(array->GetNumberOfTuples()) + " tuples, but there are " +
        std::to_string(particles->GetNumberOfPoints()) + " particles; there must be one for each");
  }
  return array;
}

// The points, masses and displacements of the particles that are no ghosts, in double precision.
class ParticleArrays
{
public:
  ParticleArrays(vtkPointSet* particles, const NonGhostPoints& counted, const Ranks& group)
    : Counted(counted)
    , Group(group)
    , Particles(particles)
  {
  }

  // Shapes for n counted particles: points n x 3, masses n, displacements n x 3, all in double
  // precision. The arrays are members, because the sample only points to them.
  ParticleSample Read(Progress& progress)
  {
    // Only checks that coordinates are finite.
    visitPoints(this->Particles, "input point set", progress, [](std::int64_t, const double*) {});
    this->Points.emplace(this->Particles->GetPoints()->GetData(), this->Counted, progress);
    ParticleSample sample;
    sample.Points = { this->Points->data(), this->Counted.Count() };
    // Without the array all masses are equal.
    this->MassArray = this->Find("Mass", 1);
    if (this->MassArray)
    {
      this->Masses.emplace(this->MassArray, this->Counted, progress);
      sample.Masses = this->Masses->data();
    }
    this->CheckMasses(sample.Masses, progress);
    // Without it there is no transport cost.
    this->DisplacementArray = this->Find("Displacement", 3);
    if (this->DisplacementArray)
    {
      this->Displacements.emplace(this->DisplacementArray, this->Counted, progress);
      sample.Displacements = { this->Displacements->data(), this->Counted.Count() };
      this->CheckDisplacements(progress);
    }
    return sample;
  }

private:
  // The array of this rank's particles, nullptr where it has none. Throws Failure where only some
  // ranks have the array.
  vtkSmartPointer<vtkDataArray> Find(const char* name, int components) const
  {
    const bool hasAny = this->Counted.Count() > 0;
    const vtkSmartPointer<vtkDataArray> array =
      hasAny ? findArray(this->Particles, name, components) : nullptr;
    // Both questions are collective, and each rank asks them in the same order.
    const bool areAllWithout = onAllRanks(this->Group, !array);
    if (!onAllRanks(this->Group, array || !hasAny) && !areAllWithout)
    {
      fail(name, "is on some ranks only; all that have particles must have it, or none");
    }
    return array;
  }

  [[noreturn]] void FailValue(
    const char* name, double value, std::int64_t particle, const char* rule) const
  {
    std::ostringstream message;
    message << "has the value " << value << " at index " << this->Counted.Point(particle) << "; "
            << rule;
    fail(name, message.str());
  }

  // nullptr for none on this rank.
  void CheckMasses(const double* masses, Progress& progress)
  {
    double total = 0.0;
    const std::int64_t count = masses ? this->Counted.Count() : 0;
    // In order: the error names the first wrong value on any number of threads.
    progress.ForEachInOrder(count, particleGrain, [&](std::int64_t i) {
      if (!(masses[i] >= 0.0) || std::isinf(masses[i]))
      {
        this->FailValue("Mass", masses[i], i, "every mass must be finite and not negative");
      }
      total += masses[i];
    });
    if (onAllRanks(this->Group, !masses))
    {
      return;
    }
    // The sum only decides whether masses can be compared, so that its order does not matter.
    const std::vector<double> totals = gatherValues(this->Group, total);
    total = std::accumulate(totals.begin(), totals.end(), 0.0);
    if (!(total > 0.0) || std::isinf(total))
    {
      std::ostringstream message;
      message << "sums to " << total << "; the sum must be positive and a double";
      fail("Mass", message.str());
    }
  }

  void CheckDisplacements(Progress& progress)
  {
    const ConstPointSpan<3> displacements(this->Displacements->data(), this->Counted.Count());
    progress.ForEachInOrder(this->Counted.Count(), particleGrain, [&](std::int64_t i) {
      // The cost is a mean of squares, |displacement|^2, which must be a double for each particle.
      double squared = 0.0;
      for (int r = 0; r < 3; ++r)
      {
        const double component = displacements[i][r];
        squared += component * component;
        if (!std::isfinite(squared))
        {
          this->FailValue("Displacement", component, i, "its square must be finite");
        }
      }
    });
  }

  const NonGhostPoints& Counted;
  const Ranks& Group;
  vtkPointSet* Particles;
  vtkSmartPointer<vtkDataArray> MassArray;
  vtkSmartPointer<vtkDataArray> DisplacementArray;
  std::optional<DoubleTuples> Points;
  std::optional<DoubleTuples> Masses;
  std::optional<DoubleTuples> Displacements;
};

template <int D>
ParticleQuality measure(const ParticleSample& particles, const ImageGrid& grid,
  std::int64_t blockSize, const SharedFlow& flow, Progress& progress)
{
  // Each particle has coordinates, a block, a spacing, a measure, and a place in the tree that
  // finds nearest neighbours. Each block has the mass of its particles and that of the density.
  constexpr double eachParticle = 11 * sizeof(double); // bytes that measureQuality takes
  constexpr double eachBlock = 2 * sizeof(double);
  // The mass of independent random particles has a relative error of 1 / sqrt(64) = 12.5 % in a
  // block: smaller blocks would show mostly that noise.
  constexpr double usualParticles = 64.0; // a block, if BlockSize is 0
  const auto count = particles.Points.size();
  // Particles of all ranks count, so that blocks are the same for any distribution.
  if (blockSize == 0)
  {
    blockSize =
      blockSizeFor<D>(grid.Size<D>(), sumOverRanks(progress.Group(), count), usualParticles);
  }
  const double blocks = GridBlocks<D>(grid.Size<D>(), blockSize).Count();
  const MemoryPlan memory{ "the comparison of " + std::to_string(count) + " particles with " +
      std::to_string(static_cast<std::int64_t>(blocks)) + " blocks (see BlockSize)",
    static_cast<double>(count) * eachParticle + blocks * eachBlock };
  return withRequiredMemory(memory,
    [&]() { return measureQuality<D>(particles, flow.Flow<D>(), grid, blockSize, progress); });
}

// Only the shares of boxes around particles are needed: tiles serve them in two and three
// dimensions.
template <int D>
FlowTables choose(TableSetting setting, const ImageGrid& grid, std::int64_t particles)
{
  return requireTables(chooseTablesForShares<D>(
    setting, grid.Size<D>(), boxAspect<D>(grid), static_cast<double>(particles)));
}

} // namespace

ParticleQuality TransportQuality::Run(const DistributedPoints& particles, InputDensity& density,
  FlowCache& cache, Progress& progress) const
{
  const NonGhostPoints& counted = particles.Counted();
  // Most of the time goes to the neighbours of particles and to the density's share around each.
  const double all = Cost::Comparison * static_cast<double>(counted.Count());
  Stages stages(progress,
    { { "tables", Cost::tables(cache, density) }, { "reading", 0.1 * all },
      { "comparison", 0.9 * all } });
  const ImageGrid& grid = density.Grid();
  const FlowTables tables = dispatchDimension(grid.Dimension(), choose<1>, choose<2>, choose<3>)(
    this->Tables, grid, counted.Count());
  const SharedFlow& flow = cache.Update(density, stages["tables"], tables);
  ParticleArrays arrays(particles.Set(), counted, progress.Group());
  ParticleSample sample = arrays.Read(stages["reading"]);
  // Sums in this order have the bits of a single rank.
  sample.Order = particles.Keys();
  return dispatchDimension(grid.Dimension(), measure<1>, measure<2>, measure<3>)(
    sample, grid, this->BlockSize, flow, stages["comparison"]);
}

} // namespace RectifiedTransport::Bridge
