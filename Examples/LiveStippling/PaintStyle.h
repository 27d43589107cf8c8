// SPDX-License-Identifier: BSD-3-Clause
// The interaction: mouse and keys to a stippling, its updates to a view, one at each timer event.
#ifndef PaintStyle_h
#define PaintStyle_h

#include "Painting.h"

#include <vtkInteractorStyle.h>

#include <string>

class PointSlider;
class Stippling;
class StippleView;
class vtkRenderWindow;

class PaintStyle : public vtkInteractorStyle
{
public:
  static PaintStyle* New();
  vtkTypeMacro(PaintStyle, vtkInteractorStyle);

  // All have to live as long as events are processed.
  void Connect(Stippling* stippling, StippleView* view, PointSlider* slider);

  void OnLeftButtonDown() override { this->StartPainting(false); }
  void OnLeftButtonUp() override { this->StopPainting(); }
  void OnRightButtonDown() override { this->StartPainting(true); }
  void OnRightButtonUp() override { this->StopPainting(); }
  void OnMiddleButtonDown() override {}
  void OnMiddleButtonUp() override {}
  void OnMouseMove() override;
  void OnMouseWheelForward() override { this->Turn(1.1); }
  void OnMouseWheelBackward() override { this->Turn(1.0 / 1.1); }
  void OnEnter() override { this->OnMouseMove(); }
  void OnLeave() override;
  void OnDropFiles(vtkStringArray* files) override;
  void OnChar() override;
  void OnKeyPress() override {}
  void OnKeyRelease() override {}
  void OnExpose() override { this->Draws = true; }
  void OnConfigure() override { this->Draws = true; }
  void OnTimer() override; // one update

protected:
  PaintStyle() = default;
  ~PaintStyle() override = default;

private:
  PaintStyle(const PaintStyle&) = delete;
  PaintStyle& operator=(const PaintStyle&) = delete;

  Place Mouse() const;
  void StartPainting(bool removes);
  void StopPainting();
  void Turn(double factor);
  void SavePicture();
  void WriteStatus();

  Stippling* Model = nullptr;
  StippleView* View = nullptr;
  PointSlider* Slider = nullptr;
  bool Paints = false;
  bool Removes = false;
  bool Draws = true;           // at the next update, whether or not the points move
  double ComputeSeconds = 0.0; // of an update, smoothed
  double FrameSeconds = 0.0;   // from update to update, with drawing
  double LastUpdate = -1.0;    // its time
  double LastStatus = -1.0;
};

// Writes what a window shows to a PNG. Returns whether it could.
bool savePicture(vtkRenderWindow* window, const std::string& path);

#endif
