// SPDX-License-Identifier: BSD-3-Clause
// Draws the points of a stippling as round dots that have together the area of the ink, the ink
// itself faintly below them, a circle for the brush, and a line of text.
#ifndef StippleView_h
#define StippleView_h

#include "Painting.h"

#include <vtkNew.h>

#include <string>

class Stippling;
class vtkActor;
class vtkImageData;
class vtkPlaneSource;
class vtkPointGaussianMapper;
class vtkRegularPolygonSource;
class vtkRenderWindow;
class vtkRenderer;
class vtkTextActor;

class StippleView
{
public:
  StippleView(Stippling& stippling, vtkRenderWindow* window);
  ~StippleView();
  StippleView(const StippleView&) = delete;
  StippleView& operator=(const StippleView&) = delete;

  // Fetches what has changed in the stippling.
  void ShowPoints();
  void ShowBrush(Place place, bool shown);
  void ShowText(const std::string& line);
  void ToggleInk();
  void ToggleHelp();

  // Draws; fits the sheet to the window's size of the moment.
  void Render();
  // The place in cells of a pixel of the window.
  Place PlaceOf(int x, int y) const;

private:
  void MakeScene();
  void ShowInk();
  void FitSheet();

  Stippling& Model;
  vtkRenderWindow* Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPointGaussianMapper> Dots;
  vtkNew<vtkImageData> Thumbnail; // of the ink
  vtkNew<vtkPlaneSource> Sheet;
  vtkNew<vtkActor> SheetActor;
  vtkNew<vtkRegularPolygonSource> Circle;
  vtkNew<vtkActor> CircleActor;
  vtkNew<vtkTextActor> Status;
  vtkNew<vtkTextActor> Help;
  int CanvasNumber = -1;
  bool InkIsShown = true;
};

#endif
