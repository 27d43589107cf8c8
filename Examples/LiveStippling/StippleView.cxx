// SPDX-License-Identifier: BSD-3-Clause
#include "StippleView.h"

#include "Stippling.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>
#include <vtkVersionMacros.h>

#include <algorithm>
#include <cmath>

namespace
{

constexpr int cellsPerTexel = 4;   // of the faint picture
constexpr double faintness = 70.0; // of 255, for full ink

const char* const helpText = "left button: add ink (with shift: remove)\n"
                             "right button: remove ink\n"
                             "wheel, slider: number of points\n"
                             "ctrl + wheel, [ ]: size of the brush\n"
                             "o: start over   c: clear   i: invert\n"
                             "d: show the ink   h: help   p: save a picture\n"
                             "drop a picture's file here to open it\n"
                             "q: quit";

void setUp(vtkTextActor* text, double y, bool atTop)
{
  text->GetTextProperty()->SetFontSize(15);
  text->GetTextProperty()->SetColor(0.1, 0.2, 0.5);
  text->GetTextProperty()->SetBackgroundColor(1.0, 1.0, 1.0);
  text->GetTextProperty()->SetBackgroundOpacity(0.8);
  if (atTop)
  {
    text->GetTextProperty()->SetVerticalJustificationToTop();
  }
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->GetPositionCoordinate()->SetValue(0.01, y);
}

} // namespace

StippleView::StippleView(Stippling& stippling, vtkRenderWindow* window)
  : Model(stippling)
  , Window(window)
{
  this->MakeScene();
  this->ShowPoints();
}

StippleView::~StippleView() = default;

void StippleView::MakeScene()
{
  this->Window->AddRenderer(this->Renderer);
  this->Window->SetMultiSamples(0);
  this->Renderer->SetBackground(0.85, 0.85, 0.85);
  this->Renderer->GetActiveCamera()->ParallelProjectionOn();

  vtkNew<vtkTexture> texture;
  texture->SetInputData(this->Thumbnail);
  texture->InterpolateOn();
  texture->SetColorModeToDirectScalars();
  vtkNew<vtkPolyDataMapper> sheet;
  sheet->SetInputConnection(this->Sheet->GetOutputPort());
  this->SheetActor->SetMapper(sheet);
  this->SheetActor->SetTexture(texture);
  this->SheetActor->GetProperty()->LightingOff();

  this->Dots->EmissiveOff();
  this->Dots->ScalarVisibilityOff();
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  this->Dots->SetBoundScale(1.0f);
#else
  this->Dots->SetTriangleScale(1.0f);
#endif
  this->Dots->SetSplatShaderCode("//VTK::Color::Impl\n"
                                 "if (dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy) > 1.0)\n"
                                 "{ discard; }\n");
  vtkNew<vtkActor> dots;
  dots->SetMapper(this->Dots);
  dots->GetProperty()->SetColor(0.0, 0.0, 0.0);
  dots->GetProperty()->LightingOff();

  this->Circle->GeneratePolygonOff();
  this->Circle->SetNumberOfSides(64);
  vtkNew<vtkPolyDataMapper> circle;
  circle->SetInputConnection(this->Circle->GetOutputPort());
  this->CircleActor->SetMapper(circle);
  this->CircleActor->GetProperty()->SetColor(0.8, 0.1, 0.1);
  this->CircleActor->GetProperty()->LightingOff();
  this->CircleActor->VisibilityOff();

  setUp(this->Status, 0.01, false);
  setUp(this->Help, 0.99, true);
  this->Help->SetInput(helpText);
  this->Help->VisibilityOff();
  for (vtkProp* prop : { static_cast<vtkProp*>(this->SheetActor), static_cast<vtkProp*>(dots),
         static_cast<vtkProp*>(this->CircleActor), static_cast<vtkProp*>(this->Status),
         static_cast<vtkProp*>(this->Help) })
  {
    this->Renderer->AddViewProp(prop);
  }
}

void StippleView::ShowPoints()
{
  vtkPolyData* points = this->Model.GetTransport().GetOutput();
  this->Dots->SetInputData(points);
  if (points->GetNumberOfPoints() > 0)
  {
    const double ink = points->GetPointData()->GetArray("Mass")->GetTuple1(0);
    this->Dots->SetScaleFactor(std::sqrt(ink / vtkMath::Pi()));
  }
  this->ShowInk();
}

void StippleView::ShowInk()
{
  Painting& painting = this->Model.GetPainting();
  const int width = (painting.Width() + cellsPerTexel - 1) / cellsPerTexel;
  const int height = (painting.Height() + cellsPerTexel - 1) / cellsPerTexel;
  if (this->CanvasNumber != this->Model.GetCanvasNumber())
  {
    this->CanvasNumber = this->Model.GetCanvasNumber();
    this->Thumbnail->SetDimensions(width, height, 1);
    this->Thumbnail->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
    this->Thumbnail->GetPointData()->GetScalars()->Fill(255);
    const double depth = -1.0;
    this->Sheet->SetOrigin(0.0, 0.0, depth);
    this->Sheet->SetPoint1(painting.Width(), 0.0, depth);
    this->Sheet->SetPoint2(0.0, painting.Height(), depth);
  }
  if (!this->InkIsShown)
  {
    return;
  }
  auto* texels = static_cast<unsigned char*>(this->Thumbnail->GetScalarPointer());
  const float* shown = painting.Shown();
  for (int y = 0; y < height; ++y)
  {
    const int row = std::min(y * cellsPerTexel + cellsPerTexel / 2, painting.Height() - 1);
    const float* cells = shown + static_cast<std::ptrdiff_t>(row) * painting.Width();
    for (int x = 0; x < width; ++x)
    {
      const int column = std::min(x * cellsPerTexel + cellsPerTexel / 2, painting.Width() - 1);
      texels[y * width + x] = static_cast<unsigned char>(255.0 - faintness * cells[column]);
    }
  }
  this->Thumbnail->Modified();
}

void StippleView::ShowBrush(Place place, bool shown)
{
  this->Circle->SetCenter(place.X, place.Y, 1.0);
  this->Circle->SetRadius(this->Model.GetBrushRadius());
  this->CircleActor->SetVisibility(shown);
}

void StippleView::ShowText(const std::string& line)
{
  this->Status->SetInput(line.c_str());
}

void StippleView::ToggleInk()
{
  this->InkIsShown = !this->InkIsShown;
  this->Thumbnail->GetPointData()->GetScalars()->Fill(255);
  this->Thumbnail->Modified();
  this->ShowInk();
}

void StippleView::ToggleHelp()
{
  this->Help->SetVisibility(!this->Help->GetVisibility());
}

void StippleView::Render()
{
  this->FitSheet();
  this->Window->Render();
}

void StippleView::FitSheet()
{
  constexpr double margin = 1.02;
  Painting& painting = this->Model.GetPainting();
  const int* window = this->Window->GetSize();
  const double aspect = std::max(window[0], 1) / static_cast<double>(std::max(window[1], 1));
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  const double centre[2] = { 0.5 * painting.Width(), 0.5 * painting.Height() };
  camera->SetFocalPoint(centre[0], centre[1], 0.0);
  camera->SetPosition(centre[0], centre[1], 10.0);
  camera->SetClippingRange(1.0, 20.0);
  camera->SetParallelScale(margin * std::max(centre[1], centre[0] / aspect));
}

Place StippleView::PlaceOf(int x, int y) const
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  const int* window = this->Window->GetSize();
  const double cells = 2.0 * camera->GetParallelScale() / std::max(window[1], 1); // a pixel's side
  const double* centre = camera->GetFocalPoint();
  return { centre[0] + cells * (x + 0.5 - 0.5 * window[0]),
    centre[1] + cells * (y + 0.5 - 0.5 * window[1]) };
}
