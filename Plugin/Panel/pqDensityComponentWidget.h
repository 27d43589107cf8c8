// SPDX-License-Identifier: BSD-3-Clause
// A list of what can be the density of an array of several components: Auto, with what it takes of
// this array, the luminance, the magnitude, then each component by its name. For an integer
// property beside a property DensityArray.
#ifndef pqDensityComponentWidget_h
#define pqDensityComponentWidget_h

#include "pqPropertyWidget.h"

class QComboBox;
class pqPropertyWidgetDecorator;

class pqDensityComponentWidget : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(int component READ component WRITE setComponent NOTIFY componentChanged)
  typedef pqPropertyWidget Superclass;

public:
  pqDensityComponentWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

  int component() const { return this->Component; }
  void setComponent(int component);

  // An array of one component leaves none, unless another one is set already.
  bool hasChoice() const { return this->HasChoice; }

Q_SIGNALS:
  void componentChanged();

private Q_SLOTS:
  // Fills the list for the array that is chosen. A component that the array does not have stays
  // chosen, as the last entry: the filter's error names it.
  void updateList();
  void take(int row);

private:
  Q_DISABLE_COPY(pqDensityComponentWidget)

  QComboBox* List;
  pqPropertyWidgetDecorator* Choices;
  bool HasChoice = true;
  int Component = -1;
};

#endif
