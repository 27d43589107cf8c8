// SPDX-License-Identifier: BSD-3-Clause
// What to select for a filter that the menu greys: the status tip of its action, from the hint
// SelectionTip of its Input. ParaView's own tips name classes.
#ifndef pqSelectionTips_h
#define pqSelectionTips_h

#include <QObject>

class QAction;
class pqProxyGroupMenuManager;

class pqSelectionTips : public QObject
{
  Q_OBJECT

public:
  explicit pqSelectionTips(QObject* parent = nullptr);

  // When the plugin is loaded, and before it is unloaded.
  void startup();
  void shutdown() {}

protected:
  // Receives the events of the widgets that hold a menu's actions.
  bool eventFilter(QObject* holder, QEvent* event) override;

private:
  Q_DISABLE_COPY(pqSelectionTips)

  void follow(QAction* action, pqProxyGroupMenuManager* manager);
};

#endif
