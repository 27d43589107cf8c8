// SPDX-License-Identifier: BSD-3-Clause
// Shows a property only if an optional input is given, or with inverse="1" only if it is not:
//
//   <PropertyWidgetDecorator type="given_input" property="Target"/>
//
// GenericDecorator of ParaView 5.11 cannot tell an input that was never given from one that is.
#ifndef pqGivenInputDecorator_h
#define pqGivenInputDecorator_h

#include "pqPropertyWidgetDecorator.h"

#include "vtkWeakPointer.h"

class vtkSMProperty;

class pqGivenInputDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT
  typedef pqPropertyWidgetDecorator Superclass;

public:
  pqGivenInputDecorator(vtkPVXMLElement* config, pqPropertyWidget* parent);

  bool canShowWidget(bool showAdvanced) const override;

private:
  Q_DISABLE_COPY(pqGivenInputDecorator)

  vtkWeakPointer<vtkSMProperty> Input;
  bool IsInverse = false;
};

#endif
