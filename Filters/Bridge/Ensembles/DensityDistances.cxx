// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ensembles/DensityDistances.h"

#include "Bridge/Density/DensityMass.h"
#include "Bridge/Density/WholeValues.h"
#include "Bridge/Image/CommonGrid.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/Failure.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Stages.h"

namespace RectifiedTransport::Bridge
{

namespace
{

template <int D>
DistanceInput read(InputDensity& density, Progress& progress)
{
  DistanceInput input;
  input.Reading = density.HowRead();
  input.Grid = density.Grid();
  input.Values = wholeValues<D>(density, "Density", progress);
  density.ReleaseGathered();
  const DensityArray<D, double> values(input.Values->GetPointer(0), input.Grid.Size<D>());
  input.Mass = requireMass(density, values, progress);
  input.Identity.AddArray(input.Values);
  input.Identity.Hash(progress);
  return input;
}

} // namespace

DistanceInput readDistanceInput(InputDensity& density, Progress& progress)
{
  return dispatchDimension(density.Grid().Dimension(), read<1>, read<2>, read<3>)(
    density, progress);
}

void DensityDistances::Begin(DistanceMethod method)
{
  this->Method = method;
  this->Given.clear();
  this->Distances.Begin(method);
}

void DensityDistances::Add(DistanceInput input, Progress& progress)
{
  if (!this->Given.empty())
  {
    const DistanceInput& first = this->Given.front();
    requireSameBox({ first.Grid, first.Title }, { input.Grid, input.Title });
    if (this->Method == DistanceMethod::Certified &&
      input.Grid.NumberOfValues() != first.Grid.NumberOfValues())
    {
      fail("Method Certified needs densities with the same number of cells along each axis; ",
        first.Title, " has ", describeValues(first.Grid), ", ", input.Title, " ",
        describeValues(input.Grid), " (Linearized takes both)");
    }
  }
  const std::shared_ptr<const double> values(
    input.Values->GetPointer(0), [kept = input.Values](const double*) {});
  input.Values = nullptr;
  this->Given.push_back(std::move(input));
  const DistanceInput& added = this->Given.back();
  if (this->Distances.Add(added.Identity.Content(), added.Grid, values, progress))
  {
    this->MakeMaps(progress);
  }
}

void DensityDistances::MakeMaps(Progress& progress)
{
  const std::string cells =
    std::to_string(static_cast<std::int64_t>(this->Distances.CellsOfMaps()));
  withRequiredMemory(
    { "the optimal map to a density of " + cells + " cells (a coarser image takes less)",
      this->Distances.MemoryForMaps() },
    [&]() { this->Distances.MakeMaps(progress); });
}

std::vector<DistancePair> DensityDistances::Find(Progress& progress)
{
  const bool lacksMaps = this->Distances.LacksMaps();
  Stages stages(progress, { { "maps", lacksMaps ? 9.0 : 0.0 }, { "pairs", 1 } });
  if (lacksMaps)
  {
    this->MakeMaps(stages["maps"]);
  }
  return withRequiredMemory(
    { "the bounds of a distance (Method Linearized takes less)", this->Distances.MemoryForPairs() },
    [&]() { return this->Distances.Find(stages["pairs"]); });
}

} // namespace RectifiedTransport::Bridge
