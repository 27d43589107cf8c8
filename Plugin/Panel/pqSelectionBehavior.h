// SPDX-License-Identifier: BSD-3-Clause
// What to select for a filter that the menu greys: the status tip of its action, from the hint
// SelectionTip of its Input. ParaView's own tips name classes. And a selected filter that gets
// another input stays selected.
#ifndef pqSelectionBehavior_h
#define pqSelectionBehavior_h

#include <QObject>

class QAction;
class pqProxyGroupMenuManager;

class pqSelectionBehavior : public QObject
{
  Q_OBJECT

public:
  explicit pqSelectionBehavior(QObject* parent = nullptr);

  // When the plugin is loaded, and before it is unloaded.
  void startup();
  void shutdown() {}

protected:
  // Receives the events of the widgets that hold a menu's actions.
  bool eventFilter(QObject* holder, QEvent* event) override;

private:
  Q_DISABLE_COPY(pqSelectionBehavior)

  void follow(QAction* action, pqProxyGroupMenuManager* manager);
};

#endif
