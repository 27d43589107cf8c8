// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/ParticleSet.h"

#include "Bridge/Data/Cells/ParticleCells.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/ExactSum.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport::Bridge
{

template <int D>
ParticleSet<D>::ParticleSet(const ImageGrid& geometry, const std::string& purpose, double count,
  std::int64_t times, bool seedsGiven)
  : Geometry(geometry)
  , Times(times)
  , SeedsGiven(seedsGiven)
{
  const bool paths = times > 1;
  // In 3D index and physical positions have the same size and share the memory of the output array.
  // Given seeds keep their physical coordinates beside those in index space, and paths have no
  // output array of seeds.
  const bool separateSeeds = D != 3 || paths || seedsGiven;
  const bool separatePositions = D != 3;
  const double each = static_cast<double>(times);
  constexpr double real = sizeof(double);
  constexpr double id = sizeof(vtkIdType);
  // A point of a path has 3 coordinates, Mass and Time, SeedId and an id in its cell, and a path an
  // offset. A particle has 3 coordinates, SeedPosition, Displacement and Mass, SeedId and a cell of
  // two ids.
  const double written = paths ? each * (5 * real + 2 * id) + id : 10 * real + 3 * id;
  const double scratch =
    real * D * ((separateSeeds ? 1.0 : 0.0) + (separatePositions ? each : 0.0));
  // `count` is a double, as it may be beyond any integer before this check. All memory together is
  // checked before any of it is allocated.
  requireMemory({ purpose, count * (written + scratch) });

  this->NumberOfParticles = static_cast<std::int64_t>(count);
  this->AllParticles = this->NumberOfParticles;
  this->Points = newArray<vtkDoubleArray>("Points", 3, this->NumberOfParticles * times);
  if (!paths || seedsGiven)
  {
    this->SeedPosition = newArray<vtkDoubleArray>("SeedPosition", 3, this->NumberOfParticles);
  }
  withMemory({ purpose, count * scratch }, [&]() {
    if (separateSeeds)
    {
      this->SeedBuffer = LargeBuffer<double>(this->NumberOfParticles * D);
    }
    if (separatePositions)
    {
      this->PositionBuffer = LargeBuffer<double>(this->NumberOfParticles * times * D);
    }
  });
}

template <int D>
PointSpan<D> ParticleSet<D>::Seeds()
{
  // Without a buffer the index coordinates are in the memory of the output array, until Write.
  double* own = this->SeedBuffer.data();
  return { own ? own : this->SeedPosition->GetPointer(0), this->NumberOfParticles };
}

template <int D>
PointSpan<D> ParticleSet<D>::Positions()
{
  double* own = this->PositionBuffer.data();
  return { own ? own : this->Points->GetPointer(0), this->NumberOfParticles * this->Times };
}

template <int D>
PointSpan<3> ParticleSet<D>::PhysicalSeeds()
{
  return { this->SeedPosition->GetPointer(0), this->NumberOfParticles };
}

// Calls write(i) for every particle, which returns the squared distance that it moved, in units of
// the scale. Returns the mean squared displacement. The sum is exact, so that it is the same for
// every number of threads and ranks.
template <int D>
template <class WriteParticle>
double ParticleSet<D>::WriteEach(
  const LengthScale& scale, Progress& progress, const WriteParticle& write) const
{
  // About 4096 points a range, however many of them a particle has.
  const std::int64_t chunk = std::max<std::int64_t>(1, 4096 / this->Times);
  const auto total = sumExactly<ExactSum>(progress, this->NumberOfParticles, chunk,
    [&write](std::int64_t first, std::int64_t last, ExactSum& sum) {
      for (std::int64_t i = first; i < last; ++i)
      {
        sum.Add(write(i));
      }
    });
  return scale.CostFromUnits(
    sumOverRanks(progress.Group(), total).Value() / static_cast<double>(this->AllParticles));
}

template <int D>
void ParticleSet<D>::ToPhysicalSeed(std::int64_t particle, const double* index, double* seed) const
{
  if (this->SeedsGiven)
  {
    std::copy_n(this->SeedPosition->GetPointer(3 * particle), 3, seed);
    return;
  }
  this->Geometry.template ToPhysical<D>(index, seed);
}

// A particle that has not moved gets the coordinates of its seed, without rounding by index space.
template <int D>
void ParticleSet<D>::ToPhysical(
  const double* index, const double* indexSeed, const double* seed, double* x) const
{
  if (std::equal(index, index + D, indexSeed))
  {
    std::copy_n(seed, 3, x);
    return;
  }
  this->Geometry.template ToPhysical<D>(index, x);
}

template <int D>
double ParticleSet<D>::Write(
  double totalMass, const std::vector<double>& times, Progress& progress, vtkPolyData* output)
{
  const std::int64_t each = this->Times;
  const std::int64_t count = this->NumberOfParticles * each;
  const bool arePaths = each > 1;
  // Arrays of points, one tuple for each of the `each` positions of each particle, particle by
  // particle.
  const auto ids = newArray<vtkIdTypeArray>("SeedId", 1, count);
  const auto masses = newArray<vtkDoubleArray>("Mass", 1, count);
  const auto further = arePaths ? newArray<vtkDoubleArray>("Time", 1, count)
                                : newArray<vtkDoubleArray>("Displacement", 3, count);
  vtkIdType* id = ids->GetPointer(0);
  double* mass = masses->GetPointer(0);
  double* time = arePaths ? further->GetPointer(0) : nullptr;
  double* displacement = arePaths ? nullptr : further->GetPointer(0);
  double* points = this->Points->GetPointer(0);
  double* physicalSeeds = arePaths ? nullptr : this->SeedPosition->GetPointer(0);
  const double* seeds = this->Seeds().data();
  const double* positions = this->Positions().data();
  // All particles of all ranks carry equal parts of the mass.
  const double share = totalMass / static_cast<double>(this->AllParticles);
  const LengthScale scale(this->Geometry);

  Stages stages(progress, { { "points", 8 }, { "cells", 2 } });
  const double cost = this->WriteEach(scale, stages["points"], [&](std::int64_t i) {
    double index[D];
    std::copy_n(seeds + i * D, D, index); // in 3D the same memory as the physical seed
    // The seed is converted first, as in 3D this overwrites its index coordinates; `index` keeps
    // them for the comparison with the positions, which are converted in place, too.
    double ofPath[3];
    double* seed = arePaths ? ofPath : physicalSeeds + i * 3;
    this->ToPhysicalSeed(i, index, seed);
    for (std::int64_t p = i * each; p < (i + 1) * each; ++p)
    {
      this->ToPhysical(positions + p * D, index, seed, points + p * 3);
      id[p] = this->FirstId + i;
      mass[p] = share;
      if (arePaths)
      {
        time[p] = times[static_cast<std::size_t>(p - i * each)];
      }
    }
    // The last position is the end of the way: the displacement and the cost compare it with the
    // seed.
    const double* x = points + ((i + 1) * each - 1) * 3;
    for (int r = 0; r < 3 && !arePaths; ++r)
    {
      displacement[i * 3 + r] = x[r] - seed[r];
    }
    return scale.SquaredDistanceInUnits(x, seed);
  });

  // The output takes over the arrays; nothing is copied.
  setParticles(output, std::exchange(this->Points, nullptr), each, stages["cells"]);
  vtkPointData* data = output->GetPointData();
  data->AddArray(ids);
  if (arePaths)
  {
    data->AddArray(further);
  }
  else
  {
    data->AddArray(std::exchange(this->SeedPosition, nullptr));
    data->SetVectors(further);
  }
  data->AddArray(masses);
  return cost;
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(ParticleSet);

} // namespace RectifiedTransport::Bridge
