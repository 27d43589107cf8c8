// SPDX-License-Identifier: BSD-3-Clause
#include "PointSlider.h"

#include "Stippling.h"

#include <vtkCallbackCommand.h>
#include <vtkCoordinate.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>

#include <cmath>

namespace
{

void place(vtkCoordinate* end, double x)
{
  end->SetCoordinateSystemToNormalizedDisplay();
  end->SetValue(x, 0.97);
}

} // namespace

PointSlider::PointSlider(Stippling& stippling, vtkRenderWindowInteractor* interactor)
  : Model(stippling)
{
  place(this->Looks->GetPoint1Coordinate(), 0.62);
  place(this->Looks->GetPoint2Coordinate(), 0.97);
  this->Looks->SetMinimumValue(0.0);
  this->Looks->SetMaximumValue(std::log10(LiveTransport::MostPoints));
  this->Looks->ShowSliderLabelOff();
  this->Looks->SetSliderWidth(0.02);
  this->Looks->SetTubeWidth(0.006);
  this->Looks->SetEndCapLength(0.0);
  this->Looks->GetTubeProperty()->SetColor(0.5, 0.55, 0.7);
  this->Looks->GetSliderProperty()->SetColor(0.1, 0.2, 0.5);
  this->Looks->GetSelectedProperty()->SetColor(0.8, 0.1, 0.1);
  this->Widget->SetInteractor(interactor);
  this->Widget->SetRepresentation(this->Looks);
  this->Widget->SetAnimationModeToJump();
  this->Widget->KeyPressActivationOff();
  vtkNew<vtkCallbackCommand> changed;
  changed->SetClientData(this);
  changed->SetCallback([](vtkObject*, unsigned long, void* slider, void*) {
    auto* self = static_cast<PointSlider*>(slider);
    self->Model.SetNumberOfPoints(std::pow(10.0, self->Looks->GetValue()));
  });
  this->Widget->AddObserver(vtkCommand::InteractionEvent, changed);
  this->Widget->EnabledOn();
}

PointSlider::~PointSlider()
{
  this->Widget->EnabledOff();
}

void PointSlider::Show(int numberOfPoints)
{
  if (std::lround(std::pow(10.0, this->Looks->GetValue())) != numberOfPoints)
  {
    this->Looks->SetValue(std::log10(static_cast<double>(numberOfPoints)));
  }
}
