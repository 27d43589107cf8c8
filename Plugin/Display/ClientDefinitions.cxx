// SPDX-License-Identifier: BSD-3-Clause
// A server's definitions of proxies name ParaView's own classes, since many clients have no plugin.
// A client that has it lays what ParaView lacks over them: an element takes the name of its
// attribute client_element, and goes where that is empty.
#include "Representations.h"

#include "vtkClientServerStream.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPVProxyDefinitionIterator.h"
#include "vtkPVSessionBase.h"
#include "vtkPVXMLElement.h"
#include "vtkProcessModule.h"
#include "vtkSIProxyDefinitionManager.h"
#include "vtkSessionIterator.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <string>

namespace
{

constexpr const char* group = "representations";
constexpr const char* representation = "FilledOutlinesRepresentation";

bool isServer()
{
  switch (vtkProcessModule::GetProcessType())
  {
    case vtkProcessModule::PROCESS_SERVER:
    case vtkProcessModule::PROCESS_DATA_SERVER:
    case vtkProcessModule::PROCESS_RENDER_SERVER:
      return true;
    default:
      return false;
  }
}

void layOver(vtkPVXMLElement* element)
{
  for (unsigned int i = element->GetNumberOfNestedElements(); i-- > 0;)
  {
    vtkPVXMLElement* nested = element->GetNestedElement(i);
    const char* name = nested->GetAttribute("client_element");
    if (name && !*name)
    {
      element->RemoveNestedElement(nested);
      continue;
    }
    layOver(nested);
  }
  if (const char* name = element->GetAttribute("client_element"))
  {
    element->SetName(name);
  }
}

// The manager's own derived classes alone may call this.
struct DefinitionCache : vtkSIProxyDefinitionManager
{
  static void Clear(vtkSIProxyDefinitionManager* definitions)
  {
    (definitions->*&DefinitionCache::InvalidateCollapsedDefinition)();
  }
};

// Follows the definitions of one session: ParaView loads them anew with each plugin of a server.
class DefinitionFollower : public vtkCommand
{
public:
  vtkTypeMacro(DefinitionFollower, vtkCommand);

  static DefinitionFollower* New() { return new DefinitionFollower; }

  void Follow(vtkPVSessionBase* session)
  {
    vtkSIProxyDefinitionManager* definitions = session->GetProxyDefinitionManager();
    if (!definitions)
    {
      return;
    }
    this->Session = session;
    definitions->AddObserver(vtkCommand::RegisterEvent, this);
    if (isServer())
    {
      return;
    }
    const auto each =
      vtkSmartPointer<vtkPVProxyDefinitionIterator>::Take(definitions->NewIterator());
    for (each->GoToFirstItem(); !each->IsDoneWithTraversal(); each->GoToNextItem())
    {
      layOver(each->GetProxyDefinition());
    }
    definitions->AddObserver(vtkSIProxyDefinitionManager::ProxyDefinitionsUpdated, this);
    this->AddRepresentations(definitions);
  }

  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    auto* definitions = vtkSIProxyDefinitionManager::SafeDownCast(caller);
    if (event == vtkSIProxyDefinitionManager::ProxyDefinitionsUpdated)
    {
      this->AddRepresentations(definitions);
      return;
    }
    const auto* added =
      static_cast<vtkSIProxyDefinitionManager::RegisteredDefinitionInformation*>(data);
    if (std::string(added->ProxyName) == representation)
    {
      DefinitionCache::Clear(definitions); // what the representations extend may be in use
      layOver(definitions->GetProxyDefinition(group, "GeometryRepresentation"));
    }
    vtkPVXMLElement* element =
      definitions->GetProxyDefinition(added->GroupName, added->ProxyName, false);
    if (element && !isServer())
    {
      layOver(element);
    }
  }

private:
  // Both sides make the representations, so both have to have their classes.
  void AddRepresentations(vtkSIProxyDefinitionManager* definitions)
  {
    if (!this->Session || definitions->HasDefinition(group, representation) ||
      !definitions->HasDefinition("filters", "TransportSampler"))
    {
      return;
    }
    definitions->LoadConfigurationXMLFromString(representationDefinitions);
    if ((this->Session->GetProcessRoles() & vtkPVSession::SERVERS) == 0)
    {
      vtkClientServerStream manager;
      manager << vtkClientServerStream::Invoke << vtkClientServerID(1) << "GetSIObject"
              << vtkSIProxyDefinitionManager::GetReservedGlobalID() << vtkClientServerStream::End;
      vtkClientServerStream stream;
      stream << vtkClientServerStream::Invoke << manager << "LoadConfigurationXMLFromString"
             << representationDefinitions << vtkClientServerStream::End;
      this->Session->ExecuteStream(vtkPVSession::SERVERS, stream);
    }
  }

  vtkWeakPointer<vtkPVSessionBase> Session;
};

void follow(vtkSession* session)
{
  if (auto* known = vtkPVSessionBase::SafeDownCast(session))
  {
    vtkNew<DefinitionFollower> follower;
    follower->Follow(known);
  }
}

class SessionFollower : public vtkCommand
{
public:
  vtkTypeMacro(SessionFollower, vtkCommand);

  static SessionFollower* New() { return new SessionFollower; }

  void Execute(vtkObject* caller, unsigned long, void* id) override
  {
    follow(static_cast<vtkProcessModule*>(caller)->GetSession(*static_cast<vtkIdType*>(id)));
  }
};

// When the plugin's library is loaded.
const bool isFollowing = []() {
  vtkProcessModule* process = vtkProcessModule::GetProcessModule();
  if (!process)
  {
    return false;
  }
  const auto each = vtkSmartPointer<vtkSessionIterator>::Take(process->NewSessionIterator());
  for (each->InitTraversal(); !each->IsDoneWithTraversal(); each->GoToNextItem())
  {
    follow(each->GetCurrentSession());
  }
  vtkNew<SessionFollower> follower;
  process->AddObserver(vtkCommand::ConnectionCreatedEvent, follower);
  return true;
}();

} // namespace
