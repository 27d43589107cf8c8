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
#include <QLocale>
#include <QSignalBlocker>

#include <algorithm>

namespace
{

// The names of the leaves below a node, in their order: pieces have the name of what they are part
// of. A multiblock does not tell which of its blocks are missing: these have rows, and the filter's
// error says how many inputs there are.
void addLeaves(vtkDataAssembly* blocks, int parent, const QString& prefix, QList<QString>& names)
{
  for (int node : blocks->GetChildNodes(parent, false))
  {
    const QString name =
      prefix + blocks->GetAttributeOrDefault(node, "label", blocks->GetNodeName(node));
    if (blocks->GetNumberOfChildren(node) > 0)
    {
      addLeaves(blocks, node, name + "/", names);
      continue;
    }
    const int partitions = blocks->GetAttributeOrDefault(node, "number_of_partitions", 1);
    const int pieces = blocks->GetAttributeOrDefault(node, "vtk_num_pieces", partitions);
    for (int piece = 0; piece < pieces; ++piece)
    {
      names.append(pieces == 1 ? name : QString("%1/%2").arg(name).arg(piece));
    }
  }
}

// The names of the blocks, where the data are composite.
QList<QString> namesOfBlocks(vtkPVDataInformation* data)
{
  QList<QString> names;
  vtkDataAssembly* blocks = data && data->IsCompositeDataSet() ? data->GetHierarchy() : nullptr;
  if (blocks)
  {
    addLeaves(blocks, blocks->GetRootNode(), QString(), names);
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

double weightOf(const pqLineEdit& edit)
{
  return edit.text().isEmpty() ? 1.0 : edit.text().toDouble();
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
  // Composite data have their blocks only once they are updated.
  QObject::connect(model, SIGNAL(dataUpdated(pqPipelineSource*)), this, SLOT(updateRows()));
  this->updateRows();
  this->addPropertyLink(this, "weights", SIGNAL(weightsChanged()), property);
}

void pqInputWeightsWidget::setWeights(const QList<QVariant>& weights)
{
  if (weights != this->Weights)
  {
    this->Weights = weights;
    this->updateRows();
    for (int i = 0; i < weights.size(); ++i)
    {
      const QSignalBlocker blocker(this->Edits[i]);
      this->Edits[i]->setTextAndResetCursor(weights[i].toString()); // a given 1, too
    }
    Q_EMIT this->weightsChanged();
  }
}

void pqInputWeightsWidget::makeRows(int count)
{
  // Later, for one of them may be the sender of the signal that led here.
  for (QWidget* row : this->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly))
  {
    row->setObjectName(QString());
    row->hide();
    row->deleteLater();
  }
  this->Labels.clear();
  this->Edits.clear();
  for (int i = 0; i < count; ++i)
  {
    auto* label = new QLabel(this);
    label->setTextFormat(Qt::PlainText);
    auto* edit = new pqLineEdit(this);
    edit->setObjectName(QString("Weight%1").arg(i));
    auto* validator = new QDoubleValidator(edit);
    // Points, in any language, as in all of ParaView's numbers and as QString::toDouble() reads.
    QLocale locale = QLocale::c();
    locale.setNumberOptions(QLocale::RejectGroupSeparator);
    validator->setLocale(locale);
    edit->setValidator(validator);
    this->Grid->addWidget(label, i, 0);
    this->Grid->addWidget(edit, i, 1);
    this->Labels.append(label);
    this->Edits.append(edit);
    QObject::connect(edit, SIGNAL(textEdited(const QString&)), this, SLOT(takeRows()));
    QObject::connect(edit, SIGNAL(textChangedAndEditingFinished()), this, SLOT(takeRows()));
  }
}

void pqInputWeightsWidget::updateRows()
{
  const QList<QString> names = namesOfInputs(this->proxy());
  this->NumberOfInputs = names.size();
  const int count = std::max(names.size(), this->Weights.size());
  if (this->Edits.size() != count)
  {
    this->makeRows(count);
  }
  for (int i = 0; i < count; ++i)
  {
    const QString name = i < names.size() ? names[i] : tr("(no input)");
    this->Labels[i]->setText(name);
    this->Labels[i]->setToolTip(name);
    pqLineEdit* edit = this->Edits[i];
    const bool isGiven = i < this->Weights.size();
    // Weights that are given are one for each input; without any all count the same.
    edit->setPlaceholderText(isGiven || this->Weights.isEmpty() ? "1" : tr("missing"));
    const QString text = isGiven ? this->Weights[i].toString() : QString();
    // Who has emptied a row, or types 0.50, shall not find other text in it.
    const bool isTyped = isGiven && weightOf(*edit) == text.toDouble();
    if (!isTyped && edit->text() != text)
    {
      const QSignalBlocker blocker(edit);
      edit->setTextAndResetCursor(text);
    }
  }
}

void pqInputWeightsWidget::takeRows()
{
  // As many as there are inputs: rows beyond them are those of inputs that were taken away.
  QList<QVariant> weights;
  bool isGiven = false;
  for (const pqLineEdit* edit : this->Edits.mid(0, this->NumberOfInputs))
  {
    if (!edit->text().isEmpty() && !edit->hasAcceptableInput())
    {
      return; // half a number, as "1e"
    }
    isGiven |= !edit->text().isEmpty();
    weights.append(weightOf(*edit));
  }
  if (!isGiven)
  {
    weights.clear();
  }
  if (weights != this->Weights)
  {
    this->Weights = weights;
    this->updateRows();
    Q_EMIT this->weightsChanged();
  }
}
