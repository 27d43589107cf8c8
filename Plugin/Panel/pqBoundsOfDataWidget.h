// SPDX-License-Identifier: BSD-3-Clause
// The six numbers of a box, with a button that takes them from what is shown in the active view,
// and a menu that takes them from one output of the pipeline.
#ifndef pqBoundsOfDataWidget_h
#define pqBoundsOfDataWidget_h

#include "pqDoubleVectorPropertyWidget.h"

class QMenu;

class pqBoundsOfDataWidget : public pqDoubleVectorPropertyWidget
{
  Q_OBJECT
  typedef pqDoubleVectorPropertyWidget Superclass;

public:
  pqBoundsOfDataWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

private Q_SLOTS:
  void takeVisible();
  void listOutputs();

private:
  Q_DISABLE_COPY(pqBoundsOfDataWidget)

  QMenu* Outputs;
};

#endif
