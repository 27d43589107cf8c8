// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/StepCache.h"

#include "Bridge/Plan/DensityQueries.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

namespace
{

vtkMTimeType inputTime(vtkAlgorithm* filter)
{
  vtkAlgorithm* producer = filter->GetInputAlgorithm();
  auto* pipeline =
    vtkDemandDrivenPipeline::SafeDownCast(producer ? producer->GetExecutive() : nullptr);
  return pipeline ? pipeline->GetPipelineMTime() : 0;
}

void read(InputDensity& density, StepDensity& step, Progress& progress)
{
  step.Values = wholeValues(density, step.ArrayName, progress);
  requireValues(density, *step.Values);
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

bool StepCache::RemoveOutdated(vtkAlgorithm* filter)
{
  if (inputTime(filter) == this->Changed)
  {
    return false;
  }
  for (CachedStep& step : this->Steps)
  {
    step.IsCached = false;
    step.Data = nullptr;
  }
  this->Stamp(filter);
  return true;
}

void StepCache::Stamp(vtkAlgorithm* filter)
{
  this->Changed = inputTime(filter);
}

int StepCache::Find(double time) const
{
  const auto found = std::find_if(this->Steps.begin(), this->Steps.end(),
    [time](const CachedStep& step) { return step.IsCached && step.Time == time; });
  return found == this->Steps.end() ? -1 : static_cast<int>(found - this->Steps.begin());
}

int StepCache::Use(double time)
{
  const int place = this->Find(time);
  (*this)[place].Used = ++this->Clock;
  return place;
}

// Evicts the step that was used least recently, unless one of this time is there.
void StepCache::Insert(double time, vtkDataObject* data)
{
  // One of this time, kept or outdated, has the density that is probably the same.
  auto place = std::find_if(this->Steps.begin(), this->Steps.end(),
    [time](const CachedStep& step) { return step.Used > 0 && step.Time == time; });
  if (place == this->Steps.end())
  {
    place = std::min_element(this->Steps.begin(), this->Steps.end(),
      [](const CachedStep& a, const CachedStep& b) { return a.Used < b.Used; });
    *place = CachedStep();
  }
  place->IsCached = true;
  place->Time = time;
  place->Data = data ? vtkSmartPointer<vtkDataObject>::Take(data->NewInstance()) : nullptr;
  if (data)
  {
    place->Data->ShallowCopy(data);
  }
  place->Used = ++this->Clock;
}

} // namespace RectifiedTransport::Bridge
