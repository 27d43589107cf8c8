// SPDX-License-Identifier: BSD-3-Clause
// A number for each input, one below another, each with the input's name: for a property that is a
// list of as many numbers, beside a property Input. An empty list is shown as ones.
#ifndef pqInputWeightsWidget_h
#define pqInputWeightsWidget_h

#include "pqPropertyWidget.h"

#include <QList>
#include <QVariant>

class QGridLayout;
class QLabel;
class pqLineEdit;

class pqInputWeightsWidget : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(QList<QVariant> weights READ weights WRITE setWeights NOTIFY weightsChanged)
  typedef pqPropertyWidget Superclass;

public:
  pqInputWeightsWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

  QList<QVariant> weights() const { return this->Weights; }
  void setWeights(const QList<QVariant>& weights);

Q_SIGNALS:
  void weightsChanged();

private Q_SLOTS:
  // One row for each input that there is now, and for each weight beyond.
  void updateRows();
  // One weight for each input; none while all rows are empty.
  void takeRows();

private:
  Q_DISABLE_COPY(pqInputWeightsWidget)

  void makeRows(int count);

  QGridLayout* Grid;
  int NumberOfInputs = 0;
  QList<QLabel*> Labels;
  QList<pqLineEdit*> Edits;
  QList<QVariant> Weights;
};

#endif
