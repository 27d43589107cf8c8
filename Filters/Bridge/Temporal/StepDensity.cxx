// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/StepDensity.h"

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/PlainDensity.h"
#include "Core/Parallel/Stages.h"
#include "Core/Tables/DensityInspection.h"

#include <cmath>

namespace RectifiedTransport::Bridge
{

namespace
{

// A density without mass is none for a map, but one of a series.
void requireValues(InputDensity& density, const StepDensity& step)
{
  const DensitySummary found =
    summarize(step.Values->GetPointer(0), step.Values->GetNumberOfTuples(), 0);
  if (found.NotFinite > 0 || found.Negative > 0 || std::isinf(found.Total))
  {
    density.ThrowInvalid(found);
  }
}

void read(InputDensity& density, StepDensity& step, Progress& progress)
{
  step.Values = wholeValues(density, step.ArrayName, progress);
  requireValues(density, step);
  step.Mass = massOf(density, progress);
  density.ReleaseGathered();
}

} // namespace

std::shared_ptr<const StepDensity> readStepDensity(
  InputDensity& density, StoreSlot& kept, Progress& progress)
{
  Stages stages(progress, { { "hash", 1 }, { "values", 9 } });
  DataIdentity identity = density.Identity();
  identity.AddGrid(density.Grid());
  for (const char letter : density.NameOfArray())
  {
    identity.AddNumber(static_cast<unsigned char>(letter));
  }
  return kept.Get<const StepDensity>(
    identity, progress.Group(), stages["hash"], Sharing::None, [&]() {
      auto step = std::make_shared<StepDensity>();
      step->ArrayName = density.NameOfArray();
      step->Grid = density.Grid();
      step->Identity = identity;
      step->Identity.Hash(stages["hash"]);
      read(density, *step, stages["values"]);
      return step;
    });
}

} // namespace RectifiedTransport::Bridge
