// SPDX-License-Identifier: BSD-3-Clause
#include "Input.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace Campaign
{

namespace
{

void drawPlaces(Dice& dice, vtkImageData* about, vtkPoints* points, vtkIdType count, Input& input)
{
  double bounds[6] = { 0.0, 2.0, 0.0, 1.0, 0.0, 0.5 };
  if (about && about->GetNumberOfPoints() > 0)
  {
    about->GetBounds(bounds);
  }
  const auto kind = dice.Of({ 0, 0, 0, 0, 1, 2, 3, 4, 5 });
  const int flat = dice.Chance(0.4) ? 2 : -1;
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    double x[3];
    for (int a = 0; a < 3; ++a)
    {
      const double low = bounds[2 * a];
      const double length = bounds[2 * a + 1] - low;
      const double unit = kind == 1 ? 0.4 + 0.01 * dice.Unit()                    // in one place
        : kind == 2                 ? static_cast<double>(dice.Whole(0, 8)) / 8.0 // on each other
        : kind == 3                 ? dice.Real(-1.0, 2.0)                        // outside, too
        : kind == 4                 ? static_cast<double>(i) / static_cast<double>(count) // a line
        : kind == 5                 ? 0.25
                                    : dice.Unit();
      x[a] = low + length * (a == flat ? 0.5 : unit);
    }
    points->SetPoint(i, x);
  }
  input.Say(std::to_string(count) + " points of kind " + std::to_string(kind));
  double first[3];
  bool areInOnePlace = true;
  for (vtkIdType i = 0; i < count; ++i)
  {
    double x[3];
    points->GetPoint(i, x);
    std::copy_n(x, i == 0 ? 3 : 0, first);
    areInOnePlace = areInOnePlace && std::equal(x, x + 3, first);
  }
  if (areInOnePlace)
  {
    input.Worsen(State::Odd);
  }
  if (count > 0 && dice.Chance(0.03))
  {
    points->SetPoint(dice.Whole(0, count - 1), drawStrange(dice), 0.5, drawStrange(dice));
    input.Worsen(State::Odd);
    input.Say("a strange one");
  }
}

vtkSmartPointer<vtkPointSet> drawCells(Dice& dice, vtkPoints* points)
{
  const vtkIdType count = points->GetNumberOfPoints();
  switch (dice.Whole(0, 3))
  {
    case 0:
    {
      const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
      grid->SetPoints(points);
      for (vtkIdType i = 0; i + 2 < count; i += 3)
      {
        const vtkIdType ids[3] = { i, i + 1, i + 2 };
        grid->InsertNextCell(VTK_TRIANGLE, 3, ids);
      }
      return grid;
    }
    case 1:
    {
      const auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
      grid->SetDimensions(static_cast<int>(count), 1, 1);
      grid->SetPoints(points);
      return grid;
    }
    default:
    {
      const auto data = vtkSmartPointer<vtkPolyData>::New();
      data->SetPoints(points);
      if (dice.Chance(0.5))
      {
        vtkNew<vtkCellArray> vertices;
        for (vtkIdType i = 0; i < count; ++i)
        {
          vertices->InsertNextCell(1, &i);
        }
        data->SetVerts(vertices);
      }
      return data;
    }
  }
}

void drawPointArrays(Dice& dice, vtkPointSet* data, Input& input)
{
  const vtkIdType count = data->GetNumberOfPoints();
  for (const char* name : { "Mass", "Displacement", "Other" })
  {
    if (!dice.Chance(0.35))
    {
      continue;
    }
    const bool vector = name[0] == 'D';
    std::string text;
    const vtkSmartPointer<vtkDataArray> array = drawArray(dice, count, vector ? 3 : 1, text);
    array->SetName(name);
    data->GetPointData()->AddArray(array);
    input.Say(std::string(name) + " " + text);
    if (name[0] == 'M')
    {
      input.Values = array;
    }
  }
  if (dice.Chance(0.06))
  {
    // VTK's own structured grids read past the end of a short one to tell their blanked cells.
    drawGhosts(dice, data->GetPointData(), count, !data->IsA("vtkStructuredGrid"), input);
  }
}

} // namespace

Input drawPoints(Dice& dice, vtkImageData* about, vtkIdType most)
{
  Input input;
  const vtkIdType count = dice.Chance(0.03) ? dice.Whole(0, 3) : dice.Whole(2, most);
  if (count == 0)
  {
    input.Worsen(State::Empty);
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(dice.Of({ VTK_DOUBLE, VTK_DOUBLE, VTK_FLOAT, VTK_FLOAT, VTK_INT }));
  drawPlaces(dice, about, points, count, input);
  const vtkSmartPointer<vtkPointSet> data = drawCells(dice, points);
  if (count < 2 || points->GetDataType() == VTK_INT)
  {
    input.Worsen(count == 0 ? State::Empty : State::Odd);
  }
  drawPointArrays(dice, data, input);
  input.Data = data;
  return input;
}

void changeInPlace(Dice& dice, Input& input)
{
  auto* set = vtkPointSet::SafeDownCast(input.Data);
  if (set && set->GetNumberOfPoints() > 0)
  {
    double x[3];
    const vtkIdType from = dice.Whole(0, set->GetNumberOfPoints() - 1);
    set->GetPoint(from, x);
    set->GetPoints()->SetPoint(dice.Whole(0, set->GetNumberOfPoints() - 1), x);
    set->GetPoints()->Modified();
    auto* surface = vtkPolyData::SafeDownCast(set);
    if (surface && surface->GetNumberOfPolys() > 0)
    {
      input.Condition = State::Odd; // coinciding points can tear a surface, or close an open one
    }
    else if (set->GetNumberOfPoints() < 8)
    {
      input.Worsen(State::Odd); // two in one place
    }
  }
  vtkDataArray* array = input.Values;
  if (array && array->GetNumberOfTuples() > 0)
  {
    const vtkIdType i = dice.Whole(0, array->GetNumberOfTuples() - 1);
    array->SetComponent(i, 0, dice.Chance(0.95) ? static_cast<double>(dice.Whole(0, 1)) : -1.0);
    // Who writes in place may say so of the array or of the data set.
    if (dice.Chance(0.5))
    {
      array->Modified();
    }
    else
    {
      input.Data->Modified();
    }
  }
}

} // namespace Campaign
