// SPDX-License-Identifier: BSD-3-Clause
#include "pqDensityComponentWidget.h"

#include "Bridge/Run/Settings/ComponentChoice.h"
#include "ChosenInput.h"

#include "pqApplicationCore.h"
#include "pqPropertyWidgetDecorator.h"
#include "pqServerManagerModel.h"

#include "vtkDataObject.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMArrayListDomain.h"
#include "vtkSMProxy.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QSignalBlocker>

namespace
{

vtkSMProperty* inputOf(vtkSMProperty* array)
{
  auto* list =
    array ? vtkSMArrayListDomain::SafeDownCast(array->FindDomain("vtkSMArrayListDomain")) : nullptr;
  return list ? list->GetRequiredProperty("Input") : nullptr;
}

// The array in the first input, where there are several; nullptr where it is not known yet.
vtkPVArrayInformation* chosenArray(vtkSMProperty* array)
{
  vtkPVDataInformation* data = RectifiedTransport::chosenData(inputOf(array));
  if (!data)
  {
    return nullptr;
  }
  vtkSMUncheckedPropertyHelper choice(array);
  const char* name = choice.GetNumberOfElements() > 4 ? choice.GetAsString(4) : nullptr;
  if (!name)
  {
    return nullptr;
  }
  const int association = choice.GetAsInt(3);
  return association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS
    ? data->GetArrayInformation(name, vtkDataObject::FIELD_ASSOCIATION_POINTS)
    : data->GetArrayInformation(name, association);
}

class ChoiceDecorator : public pqPropertyWidgetDecorator
{
public:
  explicit ChoiceDecorator(pqDensityComponentWidget* widget)
    : pqPropertyWidgetDecorator(nullptr, widget)
    , Widget(widget)
  {
  }
  bool canShowWidget(bool) const override { return this->Widget->hasChoice(); }

private:
  pqDensityComponentWidget* Widget;
};

} // namespace

pqDensityComponentWidget::pqDensityComponentWidget(
  vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parentObject)
  : Superclass(proxy, parentObject)
  , List(new QComboBox(this))
  , Choices(new ChoiceDecorator(this))
{
  this->setProperty(property);
  this->setChangeAvailableAsChangeFinished(true);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(this->List);
  this->List->setObjectName("ComboBox");
  QObject::connect(this->List, SIGNAL(currentIndexChanged(int)), this, SLOT(take(int)));
  vtkSMProperty* array = proxy->GetProperty("DensityArray");
  for (vtkSMProperty* source : { array, inputOf(array) })
  {
    RectifiedTransport::followChoice(source, this, SLOT(updateList()));
  }
  // The arrays of an input are known once it is updated.
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(),
    SIGNAL(dataUpdated(pqPipelineSource*)), this, SLOT(updateList()));
  this->updateList();
  this->addPropertyLink(this, "component", SIGNAL(componentChanged()), property);
}

void pqDensityComponentWidget::setComponent(int component)
{
  if (component != this->Component)
  {
    this->Component = component;
    this->updateList();
    Q_EMIT this->componentChanged();
  }
}

// The entries depend on the array: what Auto takes, Luminance only for as many components as a
// colour has, and the names of the components. A value that the array lacks stays in the list,
// marked, so that the property does not change by itself.
void pqDensityComponentWidget::updateList()
{
  const QSignalBlocker blocker(this->List);
  this->List->clear();
  vtkPVArrayInformation* array = chosenArray(this->proxy()->GetProperty("DensityArray"));
  const int count = array ? array->GetNumberOfComponents() : 0;
  const int automatic = array
    ? RectifiedTransport::Bridge::automaticComponent(array->GetDataType(), count)
    : RectifiedTransport::AutoComponent;
  this->List->addItem(automatic == RectifiedTransport::Magnitude ? tr("Auto (magnitude)")
      : automatic == RectifiedTransport::Luminance               ? tr("Auto (luminance)")
                                                                 : tr("Auto"),
    RectifiedTransport::AutoComponent);
  if (count <= RectifiedTransport::MostColorComponents)
  {
    this->List->addItem(tr("Luminance"), RectifiedTransport::Luminance);
  }
  this->List->addItem(tr("Magnitude"), RectifiedTransport::Magnitude);
  for (int i = 0; i < count; ++i)
  {
    const QString name = array->GetComponentName(i);
    this->List->addItem(name.isEmpty() ? QString::number(i) : name, i);
  }
  if (this->List->findData(this->Component) < 0)
  {
    this->List->addItem(tr("%1 (not in the array)").arg(this->Component), this->Component);
  }
  this->List->setCurrentIndex(this->List->findData(this->Component));
  this->HasChoice = count != 1 || this->Component != RectifiedTransport::AutoComponent;
  Q_EMIT this->Choices->visibilityChanged();
}

void pqDensityComponentWidget::take(int row)
{
  if (row >= 0)
  {
    this->setComponent(this->List->itemData(row).toInt());
  }
}
