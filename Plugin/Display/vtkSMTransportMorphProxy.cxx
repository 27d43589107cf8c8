// SPDX-License-Identifier: BSD-3-Clause
#include "Display/vtkSMTransportMorphProxy.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyProperty.h"
#include "vtkSMTimeKeeperProxy.h"

#include <utility>

vtkStandardNewMacro(vtkSMTransportMorphProxy);

namespace
{

void addProducers(vtkSMProxy* consumer, std::set<vtkSMProxy*>& sources)
{
  for (unsigned int i = 0; i < consumer->GetNumberOfProducers(); ++i)
  {
    vtkSMProxy* producer = consumer->GetProducerProxy(i);
    vtkSMProxy* source =
      producer ? vtkSMSourceProxy::SafeDownCast(producer->GetTrueParentProxy()) : nullptr;
    if (source && sources.insert(source).second)
    {
      addProducers(source, sources);
    }
  }
}

// ParaView ignores the times of the inputs of a filter that has times of its own.
bool isIgnoredByParaView(vtkSMProxy* source)
{
  for (unsigned int i = 0; i < source->GetNumberOfConsumers(); ++i)
  {
    vtkSMProxy* consumer = source->GetConsumerProxy(i);
    consumer = consumer ? consumer->GetTrueParentProxy() : nullptr;
    if (vtkSMSourceProxy::SafeDownCast(consumer) && consumer->GetProperty("TimestepValues"))
    {
      return true;
    }
  }
  return false;
}

} // namespace

vtkSMTransportMorphProxy::~vtkSMTransportMorphProxy()
{
  this->RestoreTimes();
}

void vtkSMTransportMorphProxy::UpdateVTKObjects()
{
  this->Superclass::UpdateVTKObjects();
  if (!this->TimeKeeper && this->GetSession())
  {
    vtkNew<vtkSMParaViewPipelineController> controller;
    this->TimeKeeper =
      vtkSMTimeKeeperProxy::SafeDownCast(controller->FindTimeKeeper(this->GetSession()));
  }
  const bool isOn = vtkSMPropertyHelper(this, "PublishTime").GetAsInt() != 0;
  std::set<vtkSMProxy*> sources;
  if (isOn)
  {
    addProducers(this, sources);
  }
  this->SetIgnored(sources);
  const Publishing before = std::exchange(this->State, isOn ? Publishing::On : Publishing::Off);
  if (before != Publishing::Unknown && before != this->State)
  {
    this->UpdatePipelineInformation(); // its own times
  }
}

void vtkSMTransportMorphProxy::RestoreTimes()
{
  this->SetIgnored({});
}

// Sources that are no longer upstream are restored, except those that ParaView ignores by itself
// and those that were ignored before; new ones are ignored.
void vtkSMTransportMorphProxy::SetIgnored(const std::set<vtkSMProxy*>& sources)
{
  vtkSMTimeKeeperProxy* times = this->TimeKeeper;
  auto* ignored =
    times ? vtkSMProxyProperty::SafeDownCast(times->GetProperty("SuppressedTimeSources")) : nullptr;
  if (!ignored)
  {
    this->Ignored.clear();
    return;
  }
  for (auto old = this->Ignored.begin(); old != this->Ignored.end();)
  {
    vtkSMProxy* source = old->first;
    if (source && sources.count(source) > 0)
    {
      ++old;
      continue;
    }
    if (source && old->second && !isIgnoredByParaView(source))
    {
      ignored->RemoveProxy(source);
    }
    old = this->Ignored.erase(old);
  }
  for (vtkSMProxy* source : sources)
  {
    if (this->Ignored.count(source) > 0)
    {
      continue;
    }
    const bool isNew = times->IsTimeSourceTracked(source);
    this->Ignored[source] = isNew || this->State == Publishing::Unknown;
    if (isNew)
    {
      ignored->AddProxy(source);
    }
  }
  times->UpdateVTKObjects();
}
