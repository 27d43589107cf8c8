// SPDX-License-Identifier: BSD-3-Clause
#include "pqSelectionTips.h"

#include "pqCoreUtilities.h"
#include "pqProxyGroupMenuManager.h"

#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMProxy.h"

#include <QAction>
#include <QActionEvent>
#include <QWidget>

namespace
{

QString tipOf(vtkSMProxy* prototype)
{
  vtkSMProperty* input = prototype ? prototype->GetProperty("Input") : nullptr;
  vtkPVXMLElement* hints = input ? input->GetHints() : nullptr;
  vtkPVXMLElement* tip = hints ? hints->FindNestedElementByName("SelectionTip") : nullptr;
  return tip ? tip->GetAttributeOrEmpty("text") : QString();
}

} // namespace

pqSelectionTips::pqSelectionTips(QObject* parentObject)
  : QObject(parentObject)
{
}

void pqSelectionTips::startup()
{
  QWidget* window = pqCoreUtilities::mainWidget();
  if (!window)
  {
    return;
  }
  for (auto* manager : window->findChildren<pqProxyGroupMenuManager*>())
  {
    manager->widgetActionsHolder()->installEventFilter(this);
    for (QAction* action : manager->actions())
    {
      this->follow(action, manager);
    }
  }
}

bool pqSelectionTips::eventFilter(QObject* holder, QEvent* event)
{
  if (event->type() == QEvent::ActionAdded)
  {
    for (auto* manager :
      pqCoreUtilities::mainWidget()->findChildren<pqProxyGroupMenuManager*>())
    {
      if (manager->widgetActionsHolder() == holder)
      {
        this->follow(static_cast<QActionEvent*>(event)->action(), manager);
      }
    }
  }
  return false;
}

void pqSelectionTips::follow(QAction* action, pqProxyGroupMenuManager* manager)
{
  // ParaView sets the tip again whenever the selection changes.
  QObject::connect(action, &QAction::changed, this, [action, manager]() {
    if (!action->isEnabled())
    {
      const QString tip = tipOf(manager->getPrototype(action));
      if (!tip.isEmpty() && action->statusTip() != tip)
      {
        action->setStatusTip(tip);
      }
    }
  });
}
