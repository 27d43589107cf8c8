// SPDX-License-Identifier: BSD-3-Clause
#include "pqNoteDecorator.h"

#include "ChosenInput.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Messages/Failure.h"
#include "Core/SiteCells/LabelPixels.h"

#include "pqApplicationCore.h"
#include "pqPropertyWidget.h"
#include "pqServerManagerModel.h"

#include "vtkBoundingBox.h"
#include "vtkDataObject.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProxy.h"

#include <QBoxLayout>
#include <QLabel>

namespace
{

constexpr const char* Inputs[] = { "Domain", "Input" };

// What the sites are in, or they themselves.
vtkPVDataInformation* dataOfBox(vtkSMProxy* filter)
{
  for (const char* name : Inputs)
  {
    if (auto* data = RectifiedTransport::chosenData(filter->GetProperty(name)))
    {
      return data;
    }
  }
  return nullptr;
}

QString pixelsIn(vtkPVDataInformation* data, int resolution)
{
  double bounds[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  if (data)
  {
    data->GetBounds(bounds);
  }
  const vtkBoundingBox box(bounds);
  if (!box.IsValid() || box.GetMaxLength() <= 0.0)
  {
    return QString();
  }
  try
  {
    using namespace RectifiedTransport;
    return describeLabelPixels(labelPixels(gridOfBox(bounds), resolution)).c_str();
  }
  catch (const RectifiedTransport::Failure& failure)
  {
    return failure.what();
  }
}

QString numberIn(vtkSMProxy* filter, const QString& field, const QString& text)
{
  auto* source = vtkSMSourceProxy::SafeDownCast(filter);
  vtkPVDataInformation* data = source ? source->GetDataInformation(0) : nullptr;
  vtkPVArrayInformation* array = data
    ? data->GetArrayInformation(field.toUtf8().data(), vtkDataObject::FIELD_ASSOCIATION_NONE)
    : nullptr;
  const double number = array ? array->GetComponentRange(0)[0] : 0.0;
  return number != 0.0 ? text.arg(number) : QString();
}

} // namespace

pqNoteDecorator::pqNoteDecorator(vtkPVXMLElement* config, pqPropertyWidget* parentWidgetOfProperty)
  : Superclass(config, parentWidgetOfProperty)
  , Field(config->GetAttributeOrEmpty("field"))
  , Text(config->GetAttributeOrEmpty("text"))
  , Note(new QLabel(parentWidgetOfProperty))
{
  this->Note->setObjectName("Note");
  this->Note->setWordWrap(true);
  if (auto* row = qobject_cast<QBoxLayout*>(parentWidgetOfProperty->layout()))
  {
    row->setDirection(QBoxLayout::TopToBottom);
  }
  parentWidgetOfProperty->layout()->addWidget(this->Note);
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(),
    SIGNAL(dataUpdated(pqPipelineSource*)), this, SLOT(renew()));
  vtkSMProxy* filter = parentWidgetOfProperty->proxy();
  for (vtkSMProperty* source : { parentWidgetOfProperty->property(), filter->GetProperty(Inputs[0]),
         filter->GetProperty(Inputs[1]) })
  {
    RectifiedTransport::followChoice(source, this, SLOT(renew()));
  }
  this->renew();
}

void pqNoteDecorator::renew()
{
  vtkSMProxy* filter = this->parentWidget()->proxy();
  vtkSMUncheckedPropertyHelper value(this->parentWidget()->property());
  const QString text = this->Field.isEmpty() ? pixelsIn(dataOfBox(filter), value.GetAsInt())
                                             : numberIn(filter, this->Field, this->Text);
  this->Note->setText(text);
  this->Note->setVisible(!text.isEmpty());
}
