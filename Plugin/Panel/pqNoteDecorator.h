// SPDX-License-Identifier: BSD-3-Clause
// Shows a line below a property of the panel:
//
//   <PropertyWidgetDecorator type="note" field="RegionsMissed" text="%1 regions miss it"/>
//   <PropertyWidgetDecorator type="note"/>
//
// With a field, it is the number that the field data of the last run have, if that is not 0.
// Without one, the property is the Resolution of Equal Mass Cells, and the line says how many
// pixels it means before they are made, and about how much memory they take.
#ifndef pqNoteDecorator_h
#define pqNoteDecorator_h

#include "pqPropertyWidgetDecorator.h"

#include <QString>

class QLabel;

class pqNoteDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT
  typedef pqPropertyWidgetDecorator Superclass;

public:
  pqNoteDecorator(vtkPVXMLElement* config, pqPropertyWidget* parent);

private Q_SLOTS:
  void renew();

private:
  Q_DISABLE_COPY(pqNoteDecorator)

  QString Field;
  QString Text;
  QLabel* Note;
};

#endif
