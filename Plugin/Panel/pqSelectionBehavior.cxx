// SPDX-License-Identifier: BSD-3-Clause
#include "pqSelectionBehavior.h"

#include "Display/ProxyTexts.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqPipelineSource.h"
#if __has_include("pqProxyAction.h")
#include "pqProxyAction.h"
#endif
#include "pqProxyGroupMenuManager.h"
#include "pqServerManagerModel.h"

#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyManager.h"

#include <QAction>
#include <QActionEvent>
#include <QList>
#include <QTimer>
#include <QWidget>

namespace
{

// ParaView 5.13 has it for actions of all menus, and its menus have it no more from 6.1 on.
vtkSMProxy* prototypeOf(QAction* action, [[maybe_unused]] pqProxyGroupMenuManager* manager)
{
#if __has_include("pqProxyAction.h")
  return pqProxyAction::GetProxyPrototype(action);
#else
  return manager->getPrototype(action);
#endif
}

QString tipOf(vtkSMProxy* prototype)
{
  vtkSMProperty* input = prototype ? prototype->GetProperty("Input") : nullptr;
  vtkPVXMLElement* hints = input ? input->GetHints() : nullptr;
  vtkPVXMLElement* tip = hints ? hints->FindNestedElementByName("SelectionTip") : nullptr;
  return tip ? tip->GetAttributeOrEmpty("text") : QString();
}

// Without a session, prototypeOf crashes.
bool isConnected()
{
  return vtkSMProxyManager::IsInitialized() &&
    vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager();
}

QList<pqProxyGroupMenuManager*> managers()
{
  QWidget* window = pqCoreUtilities::mainWidget();
  return window ? window->findChildren<pqProxyGroupMenuManager*>()
                : QList<pqProxyGroupMenuManager*>();
}

// The pipeline browser moves a filter that gets or loses an input, and selects its neighbour.
void keepActive(pqPipelineSource*, pqPipelineSource* filter)
{
  if (filter == pqActiveObjects::instance().activeSource() &&
    RectifiedTransport::isOfPlugin(filter->getProxy()))
  {
    QTimer::singleShot(
      0, filter, [filter]() { pqActiveObjects::instance().setActiveSource(filter); });
  }
}

} // namespace

pqSelectionBehavior::pqSelectionBehavior(QObject* parentObject)
  : QObject(parentObject)
{
}

void pqSelectionBehavior::startup()
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::preConnectionAdded, this, keepActive);
  QObject::connect(model, &pqServerManagerModel::preConnectionRemoved, this, keepActive);
  // A plugin that is loaded at the start is there before the menus.
  QTimer::singleShot(0, this, [this]() {
    for (pqProxyGroupMenuManager* manager : managers())
    {
      manager->widgetActionsHolder()->installEventFilter(this);
      for (QAction* action : manager->actions())
      {
        this->follow(action, manager);
      }
    }
  });
}

bool pqSelectionBehavior::eventFilter(QObject* holder, QEvent* event)
{
  if (event->type() == QEvent::ActionAdded)
  {
    for (pqProxyGroupMenuManager* manager : managers())
    {
      if (manager->widgetActionsHolder() == holder)
      {
        this->follow(static_cast<QActionEvent*>(event)->action(), manager);
      }
    }
  }
  return false;
}

void pqSelectionBehavior::follow(QAction* action, pqProxyGroupMenuManager* manager)
{
  // ParaView sets the tip again whenever the selection changes, and when a server has gone.
  QObject::connect(action, &QAction::changed, this, [action, manager]() {
    if (!action->isEnabled() && isConnected())
    {
      const QString tip = tipOf(prototypeOf(action, manager));
      if (!tip.isEmpty() && action->statusTip() != tip)
      {
        action->setStatusTip(tip);
      }
    }
  });
}
