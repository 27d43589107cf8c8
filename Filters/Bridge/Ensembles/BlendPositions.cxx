// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ensembles/BlendPositions.h"

#include "Bridge/Density/DensityPlan.h"
#include "Bridge/Ensembles/DensityBlend.h"
#include "Bridge/Run/Memory.h"
#include "Core/Blend/OptimalBlend.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cstddef>
#include <functional>

namespace RectifiedTransport::Bridge
{

namespace
{

// What the optimal maps of a blend need. `particles` are those of all ranks.
template <int D>
std::vector<MemoryPlan> memoriesOfMaps(const std::vector<BlendInput>& inputs,
  const BlendSettings& settings, const ImageGrid& geometry, double particles, const Ranks& ranks)
{
  const OptimalNeeds needs{ settings.Optimal, particles };
  const auto sizeOf = [&](std::size_t i) { return inputs[i].Density->Grid().Size<D>(); };
  if (settings.ComparesEnds)
  {
    return { memoryOfOptimalMap<D>(sizeOf(0), sizeOf(1), needs, ranks) };
  }
  std::vector<MemoryPlan> memories;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    if (inputs[i].Weight > 0.0)
    {
      memories.push_back(memoryOfOptimalMap<D>(geometry.Size<D>(), sizeOf(i), needs, ranks));
    }
  }
  // The mean of one density is that density.
  return memories.size() > 1 ? memories : std::vector<MemoryPlan>();
}

template <int D>
void requireFor(const std::vector<BlendInput>& inputs, const BlendSettings& settings,
  const ImageGrid& geometry, double particles, const Ranks& ranks)
{
  // Positions in the inputs and slack, and points and images in index spaces.
  const double each = sizeof(double) * (3.0 * static_cast<double>(inputs.size()) + 1.0 + 2.0 * D);
  for (const MemoryPlan& memory : memoriesOfMaps<D>(inputs, settings, geometry, particles, ranks))
  {
    requireMemory(memory.With(each * particles / ranks.Count()));
  }
}

ConstPointSpan<3> spanOf(vtkDoubleArray* points)
{
  return { points->GetPointer(0), points->GetNumberOfTuples() };
}

// The displacements y - x of particles between their positions x and y.
vtkSmartPointer<vtkDoubleArray> displacementsOf(
  ConstPointSpan<3> from, ConstPointSpan<3> to, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  auto displacements = newArray<vtkDoubleArray>("Displacement", 3, from.size());
  double* values = displacements->GetPointer(0);
  progress.For(from.size(), grain, [&](std::int64_t first, std::int64_t last) {
    std::transform(to.data() + 3 * first, to.data() + 3 * last, from.data() + 3 * first,
      values + 3 * first, std::minus<>());
  });
  return displacements;
}

template <int D>
void findOptimal(const std::vector<BlendInput>& inputs, const BlendSettings& settings,
  const ImageGrid& geometry, std::int64_t particles, Progress& progress, BlendPositions& found,
  std::vector<std::string>& warnings)
{
  std::vector<BlendedDensity<D>> densities;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    const ImageGrid& grid = inputs[i].Density->Grid();
    densities.push_back({ planEnd<D>(PlanEnd<D>::In(geometry, grid), *inputs[i].Density), grid,
      inputs[i].Weight, spanOf(found.Positions[i]) });
  }
  MemoryPlan largest{ "the optimal maps", 0.0 };
  for (const MemoryPlan& memory :
    memoriesOfMaps<D>(inputs, settings, geometry, static_cast<double>(particles), progress.Group()))
  {
    largest = memory.Bytes > largest.Bytes ? memory : largest;
  }
  const OptimalBlendOptions options{ settings.Optimal.IsOptimal, settings.Optimal.Tolerance,
    settings.ComparesEnds, geometry };
  OptimalPositions moved =
    withRequiredMemory(largest, [&]() { return blendOptimally<D>(densities, options, progress); });
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    if (moved.Moved[i])
    {
      found.Positions[i] = arrayOf<vtkDoubleArray>("Positions", 3, *moved.Moved[i]);
    }
  }
  found.Slack = arrayOf<vtkDoubleArray>("Slack", 1, moved.Slack);
  found.Bound = moved.Bound;
  found.Cost = moved.Cost;
  found.Functional = moved.Functional;
  for (const auto& [input, text] : moved.Warnings)
  {
    warnings.push_back(inputs[input].Name + ": " + text);
  }
}

} // namespace

void requireMemoryForMaps(const std::vector<BlendInput>& inputs, const BlendSettings& settings,
  const ImageGrid& geometry, double particles, const Ranks& ranks)
{
  dispatchDimension(geometry.Dimension(), requireFor<1>, requireFor<2>, requireFor<3>)(
    inputs, settings, geometry, particles, ranks);
}

std::shared_ptr<const BlendPositions> makePositions(const std::vector<BlendInput>& inputs,
  const std::vector<vtkSmartPointer<vtkDoubleArray>>& given, const BlendSettings& settings,
  const ImageGrid& geometry, std::int64_t particles, Progress& progress,
  std::vector<std::string>& warnings)
{
  Stages stages(progress, { { "maps", settings.Optimal.NeedsMap() ? 99.0 : 0.0 }, { "ends", 1 } });
  auto found = std::make_shared<BlendPositions>();
  found->Positions = given;
  if (settings.Optimal.NeedsMap())
  {
    dispatchDimension(geometry.Dimension(), findOptimal<1>, findOptimal<2>, findOptimal<3>)(
      inputs, settings, geometry, particles, stages["maps"], *found, warnings);
  }
  if (settings.ComparesEnds)
  {
    const ConstPointSpan<3> from = spanOf(found->Positions[0]);
    const ConstPointSpan<3> to = spanOf(found->Positions[1]);
    found->Cost =
      meanSquare(from, to, static_cast<double>(particles), LengthScale(geometry), stages["ends"]);
    found->Displacements = displacementsOf(from, to, stages["ends"]);
  }
  return found;
}

} // namespace RectifiedTransport::Bridge
