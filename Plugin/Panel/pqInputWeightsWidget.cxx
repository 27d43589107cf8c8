// SPDX-License-Identifier: BSD-3-Clause
#include "pqInputWeightsWidget.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqLineEdit.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"

#include "vtkCommand.h"
#include "vtkDataAssembly.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <QDoubleValidator>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>

#include <algorithm>

namespace
{

// The names of the blocks, where the data are composite.
QList<QString> namesOfBlocks(vtkPVDataInformation* data)
{
  QList<QString> names;
  vtkDataAssembly* blocks = data && data->IsCompositeDataSet() ? data->GetHierarchy() : nullptr;
  if (!blocks)
  {
    return names;
  }
  for (int node : blocks->GetChildNodes(blocks->GetRootNode()))
  {
    if (blocks->GetNumberOfChildren(node) == 0)
    {
      names.append(blocks->GetAttributeOrDefault(node, "label", blocks->GetNodeName(node)));
    }
  }
  return names;
}

QList<QString> namesOfInputs(vtkSMProxy* proxy)
{
  QList<QString> names;
  vtkSMProperty* inputs = proxy->GetProperty("Input");
  if (!inputs)
  {
    return names;
  }
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  vtkSMUncheckedPropertyHelper helper(inputs);
  for (unsigned int i = 0; i < helper.GetNumberOfElements(); ++i)
  {
    auto* source = vtkSMSourceProxy::SafeDownCast(helper.GetAsProxy(i));
    if (!source)
    {
      continue;
    }
    const QList<QString> blocks =
      namesOfBlocks(source->GetDataInformation(helper.GetOutputPort(i)));
    if (!blocks.isEmpty())
    {
      names.append(blocks);
      continue;
    }
    auto* item = model->findItem<pqPipelineSource*>(source);
    names.append(item ? item->getSMName() : QObject::tr("input %1").arg(i + 1));
  }
  return names;
}

} // namespace

pqInputWeightsWidget::pqInputWeightsWidget(
  vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parentObject)
  : Superclass(proxy, parentObject)
  , Grid(new QGridLayout(this))
{
  this->setProperty(property);
  this->setShowLabel(false);
  this->setChangeAvailableAsChangeFinished(true);
  this->Grid->setContentsMargins(0, 0, 0, 0);
  this->Grid->setColumnStretch(1, 1);
  if (vtkSMProperty* inputs = proxy->GetProperty("Input"))
  {
    pqCoreUtilities::connect(inputs, vtkCommand::ModifiedEvent, this, SLOT(updateRows()));
  }
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, SIGNAL(nameChanged(pqServerManagerModelItem*)), this, SLOT(updateRows()));
  this->updateRows();
  this->addPropertyLink(this, "weights", SIGNAL(weightsChanged()), property);
}

void pqInputWeightsWidget::setWeights(const QList<QVariant>& weights)
{
  if (weights != this->Weights)
  {
    this->Weights = weights;
    this->updateRows();
    Q_EMIT this->weightsChanged();
  }
}

void pqInputWeightsWidget::updateRows()
{
  this->Names = namesOfInputs(this->proxy());
  const int count = std::max(this->Names.size(), this->Weights.size());
  if (this->Edits.size() != count)
  {
    qDeleteAll(this->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly));
    this->Edits.clear();
    for (int i = 0; i < count; ++i)
    {
      auto* label = new QLabel(this);
      label->setObjectName(QString("Name%1").arg(i));
      auto* edit = new pqLineEdit(this);
      edit->setObjectName(QString("Weight%1").arg(i));
      edit->setValidator(new QDoubleValidator(edit));
      this->Grid->addWidget(label, i, 0);
      this->Grid->addWidget(edit, i, 1);
      this->Edits.append(edit);
      QObject::connect(edit, SIGNAL(textEdited(const QString&)), this, SLOT(takeRows()));
      QObject::connect(edit, SIGNAL(textChangedAndEditingFinished()), this, SLOT(takeRows()));
    }
  }
  for (int i = 0; i < count; ++i)
  {
    const bool isInput = i < this->Names.size();
    const bool isGiven = i < this->Weights.size();
    auto* label = this->findChild<QLabel*>(QString("Name%1").arg(i));
    label->setText(isInput ? this->Names[i] : tr("(no input)"));
    const QSignalBlocker blocker(this->Edits[i]);
    const QString text = isGiven ? this->Weights[i].toString() : QString();
    if (this->Edits[i]->text().toDouble() != text.toDouble() || !isGiven)
    {
      this->Edits[i]->setTextAndResetCursor(text);
    }
    // Weights that are given are one for each input; without any all count the same.
    this->Edits[i]->setPlaceholderText(this->Weights.isEmpty() ? "1" : tr("missing"));
  }
}

void pqInputWeightsWidget::takeRows()
{
  QList<QVariant> weights;
  bool isGiven = false;
  for (const pqLineEdit* edit : this->Edits)
  {
    isGiven |= !edit->text().isEmpty();
    weights.append(edit->text().isEmpty() ? 1.0 : edit->text().toDouble());
  }
  this->setWeights(isGiven ? weights : QList<QVariant>());
}
