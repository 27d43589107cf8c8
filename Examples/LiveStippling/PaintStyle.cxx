// SPDX-License-Identifier: BSD-3-Clause
#include "PaintStyle.h"

#include "PointSlider.h"
#include "StippleView.h"
#include "Stippling.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkStringArray.h>
#include <vtkTimerLog.h>
#include <vtkWindowToImageFilter.h>

#include <sstream>

namespace
{

constexpr double statusInterval = 0.25; // seconds
constexpr double longestFrame =
  0.5; // after a longer time without updates their rate is counted anew
constexpr double brushFactor = 1.15;

double smoothed(double before, double now)
{
  constexpr double weight = 0.1;
  return before > 0.0 ? before + weight * (now - before) : now;
}

} // namespace

vtkStandardNewMacro(PaintStyle);

void PaintStyle::Connect(Stippling* stippling, StippleView* view, PointSlider* slider)
{
  this->Model = stippling;
  this->View = view;
  this->Slider = slider;
}

Place PaintStyle::Mouse() const
{
  const int* pixel = this->Interactor->GetEventPosition();
  return this->View->PlaceOf(pixel[0], pixel[1]);
}

void PaintStyle::OnMouseMove()
{
  this->View->ShowBrush(this->Mouse(), true);
  this->Draws = true;
}

void PaintStyle::OnLeave()
{
  this->View->ShowBrush(this->Mouse(), false);
  this->Draws = true;
}

void PaintStyle::StartPainting(bool removes)
{
  this->Paints = true;
  this->Removes = removes || this->Interactor->GetShiftKey() != 0;
}

void PaintStyle::StopPainting()
{
  this->Paints = false;
  this->Model->LiftBrush();
}

void PaintStyle::Turn(double factor)
{
  if (this->Interactor->GetControlKey())
  {
    this->Model->ScaleBrush(factor);
    this->OnMouseMove();
    return;
  }
  this->Model->ScaleNumberOfPoints(factor);
}

void PaintStyle::OnDropFiles(vtkStringArray* files)
{
  if (files->GetNumberOfValues() > 0)
  {
    this->Model->Open(files->GetValue(0));
    this->Draws = true;
  }
}

void PaintStyle::OnChar()
{
  this->Draws = true;
  switch (this->Interactor->GetKeyCode())
  {
    case '[':
      this->Model->ScaleBrush(1.0 / brushFactor);
      return this->OnMouseMove();
    case ']':
      this->Model->ScaleBrush(brushFactor);
      return this->OnMouseMove();
    case 'o':
      return this->Model->StartOver();
    case 'c':
      return this->Model->Clear();
    case 'i':
      return this->Model->Invert();
    case 'd':
      return this->View->ToggleInk();
    case 'h':
      return this->View->ToggleHelp();
    case 'p':
      return this->SavePicture();
    case 'q':
      return this->Interactor->ExitCallback();
    default:
      return;
  }
}

void PaintStyle::SavePicture()
{
  const char* const path = "live-stippling.png";
  this->Model->Tell(savePicture(this->Interactor->GetRenderWindow(), path)
      ? std::string("Saved ") + path
      : std::string("Could not write ") + path);
}

void PaintStyle::OnTimer()
{
  if (this->Paints)
  {
    this->Model->Paint(this->Mouse(), this->Removes);
  }
  const bool moved = this->Model->Update();
  const double now = vtkTimerLog::GetUniversalTime();
  if (moved)
  {
    this->View->ShowPoints();
    this->ComputeSeconds = smoothed(this->ComputeSeconds, this->Model->GetUpdateSeconds());
    const double interval = now - this->LastUpdate;
    this->FrameSeconds = interval < longestFrame ? smoothed(this->FrameSeconds, interval) : 0.0;
    this->LastUpdate = now;
  }
  if (!moved && !this->Draws)
  {
    return;
  }
  if (now - this->LastStatus > statusInterval || !moved)
  {
    this->WriteStatus();
    this->LastStatus = now;
  }
  this->Slider->Show(this->Model->GetTransport().GetNumberOfPoints());
  this->Draws = false;
  this->View->Render();
}

void PaintStyle::WriteStatus()
{
  std::ostringstream line;
  line.precision(0);
  line << std::fixed << this->Model->GetTransport().GetNumberOfPoints() << " points   brush "
       << this->Model->GetBrushRadius();
  if (this->ComputeSeconds > 0.0)
  {
    line << "   updates a second: " << 1.0 / this->ComputeSeconds << " computed";
  }
  if (this->FrameSeconds > 0.0)
  {
    line << ", " << 1.0 / this->FrameSeconds << " drawn";
  }
  line << "   h: help";
  if (!this->Model->GetMessage().empty())
  {
    line << "\n" << this->Model->GetMessage();
  }
  this->View->ShowText(line.str());
}

bool savePicture(vtkRenderWindow* window, const std::string& path)
{
  vtkNew<vtkWindowToImageFilter> pixels;
  pixels->SetInput(window);
  pixels->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputConnection(pixels->GetOutputPort());
  writer->Write();
  return writer->GetErrorCode() == 0;
}
