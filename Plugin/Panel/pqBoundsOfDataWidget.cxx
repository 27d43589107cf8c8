// SPDX-License-Identifier: BSD-3-Clause
#include "pqBoundsOfDataWidget.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "pqView.h"

#include "vtkBoundingBox.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProxy.h"
#include "vtkSetGet.h"

#include <QBoxLayout>
#include <QMenu>
#include <QToolButton>

namespace
{

void addBounds(pqOutputPort* port, vtkBoundingBox& box)
{
  double bounds[6];
  if (vtkPVDataInformation* data = port ? port->getDataInformation() : nullptr)
  {
    data->GetBounds(bounds);
    if (vtkBoundingBox::IsValid(bounds))
    {
      box.AddBounds(bounds);
    }
  }
}

} // namespace

pqBoundsOfDataWidget::pqBoundsOfDataWidget(
  vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parentObject)
  : Superclass(property, proxy, parentObject)
  , Outputs(new QMenu(this))
{
  auto* button = new QToolButton(this);
  button->setObjectName("TakeBounds");
  button->setIcon(QIcon(":/pqWidgets/Icons/pqZoomToData.svg"));
  button->setToolTip(tr("Take the bounds of all visible data, or of one data set by the arrow"));
  button->setPopupMode(QToolButton::MenuButtonPopup);
  button->setMenu(this->Outputs);
  QObject::connect(button, SIGNAL(clicked()), this, SLOT(takeVisible()));
  QObject::connect(this->Outputs, SIGNAL(aboutToShow()), this, SLOT(listOutputs()));
  // First, for a narrow panel cuts off what stands at the right.
  if (auto* row = qobject_cast<QBoxLayout*>(this->layout()))
  {
    row->insertWidget(0, button);
  }
  else
  {
    this->layout()->addWidget(button);
  }
}

void pqBoundsOfDataWidget::takeVisible()
{
  vtkBoundingBox box;
  if (pqView* view = pqActiveObjects::instance().activeView())
  {
    for (pqRepresentation* shown : view->getRepresentations())
    {
      auto* data = qobject_cast<pqDataRepresentation*>(shown);
      if (data && data->isVisible() && data->getInput() &&
        data->getInput()->getProxy() != this->proxy())
      {
        addBounds(data->getOutputPortFromInput(), box);
      }
    }
  }
  if (!box.IsValid())
  {
    // Without a colon: ParaView's list of messages leaves out what stands before one.
    vtkGenericWarningMacro(<< "Show the data in the active view first, or choose them by the arrow "
                              "beside the button. The view shows no data but these seeds");
    return;
  }
  double bounds[6];
  box.GetBounds(bounds);
  this->resetToBounds(bounds);
}

void pqBoundsOfDataWidget::listOutputs()
{
  this->Outputs->clear();
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    if (source->getProxy() == this->proxy())
    {
      continue;
    }
    for (pqOutputPort* port : source->getOutputPorts())
    {
      vtkBoundingBox box;
      addBounds(port, box);
      if (box.IsValid())
      {
        const QString name = source->getNumberOfOutputPorts() > 1
          ? QString("%1: %2").arg(source->getSMName(), port->getPortName())
          : source->getSMName();
        this->Outputs->addAction(name, this, [this, box]() {
          double bounds[6];
          box.GetBounds(bounds);
          this->resetToBounds(bounds);
        });
      }
    }
  }
  if (this->Outputs->isEmpty())
  {
    this->Outputs->addAction(tr("(no data)"))->setEnabled(false);
  }
}
