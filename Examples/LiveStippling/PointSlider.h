// SPDX-License-Identifier: BSD-3-Clause
// A slider for the number of points, in equal ratios.
#ifndef PointSlider_h
#define PointSlider_h

#include <vtkNew.h>

class Stippling;
class vtkRenderWindowInteractor;
class vtkSliderRepresentation2D;
class vtkSliderWidget;

class PointSlider
{
public:
  // Both have to live as long as the slider.
  PointSlider(Stippling& stippling, vtkRenderWindowInteractor* interactor);
  ~PointSlider();
  PointSlider(const PointSlider&) = delete;
  PointSlider& operator=(const PointSlider&) = delete;

  void Show(int numberOfPoints);

private:
  Stippling& Model;
  vtkNew<vtkSliderRepresentation2D> Looks;
  vtkNew<vtkSliderWidget> Widget;
};

#endif
