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

void drawPlaces(
  RandomSource& random, vtkImageData* about, vtkPoints* points, vtkIdType count, Input& input)
{
  double bounds[6] = { 0.0, 2.0, 0.0, 1.0, 0.0, 0.5 };
  if (about && about->GetNumberOfPoints() > 0)
  {
    about->GetBounds(bounds);
  }
  const auto kind = random.Of({ 0, 0, 0, 0, 1, 2, 3, 4, 5 });
  const int flat = random.Chance(0.4) ? 2 : -1;
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    double x[3];
    for (int a = 0; a < 3; ++a)
    {
      const double low = bounds[2 * a];
      const double length = bounds[2 * a + 1] - low;
      const double unit = kind == 1 ? 0.4 + 0.01 * random.Unit()                    // in one place
        : kind == 2                 ? static_cast<double>(random.Whole(0, 8)) / 8.0 // on each other
        : kind == 3                 ? random.Real(-1.0, 2.0)                        // outside, too
        : kind == 4                 ? static_cast<double>(i) / static_cast<double>(count) // a line
        : kind == 5                 ? 0.25
                                    : random.Unit();
      x[a] = low + length * (a == flat ? 0.5 : unit);
    }
    points->SetPoint(i, x);
  }
  input.Describe(std::to_string(count) + " points of kind " + std::to_string(kind));
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
  if (count > 0 && random.Chance(0.03))
  {
    points->SetPoint(
      random.Whole(0, count - 1), drawExceptional(random), 0.5, drawExceptional(random));
    input.Worsen(State::Odd);
    input.Describe("an exceptional one");
  }
}

vtkSmartPointer<vtkPointSet> drawCells(RandomSource& random, vtkPoints* points)
{
  const vtkIdType count = points->GetNumberOfPoints();
  switch (random.Whole(0, 3))
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
      if (random.Chance(0.5))
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

void drawPointArrays(RandomSource& random, vtkPointSet* data, Input& input)
{
  const vtkIdType count = data->GetNumberOfPoints();
  for (const char* name : { "Mass", "Displacement", "Other" })
  {
    if (!random.Chance(0.35))
    {
      continue;
    }
    const bool vector = name[0] == 'D';
    std::string text;
    const vtkSmartPointer<vtkDataArray> array = drawArray(random, count, vector ? 3 : 1, text);
    array->SetName(name);
    data->GetPointData()->AddArray(array);
    input.Describe(std::string(name) + " " + text);
    if (name[0] == 'M')
    {
      input.Values = array;
    }
  }
  if (random.Chance(0.06))
  {
    // VTK's own structured grids read past the end of a short one to tell their blanked cells.
    drawGhosts(random, data->GetPointData(), count, !data->IsA("vtkStructuredGrid"), input);
  }
}

} // namespace

Input drawPoints(RandomSource& random, vtkImageData* about, vtkIdType most)
{
  Input input;
  const vtkIdType count = random.Chance(0.03) ? random.Whole(0, 3) : random.Whole(2, most);
  if (count == 0)
  {
    input.Worsen(State::Empty);
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(random.Of({ VTK_DOUBLE, VTK_DOUBLE, VTK_FLOAT, VTK_FLOAT, VTK_INT }));
  drawPlaces(random, about, points, count, input);
  const vtkSmartPointer<vtkPointSet> data = drawCells(random, points);
  if (count < 2 || points->GetDataType() == VTK_INT)
  {
    input.Worsen(count == 0 ? State::Empty : State::Odd);
  }
  drawPointArrays(random, data, input);
  input.Data = data;
  return input;
}

void changeInPlace(RandomSource& random, Input& input)
{
  if (input.Series)
  {
    const auto last = static_cast<std::int64_t>(input.Steps.size()) - 1;
    changeInPlace(random, input.Steps[static_cast<std::size_t>(random.Whole(0, last))]);
    input.Series->Modified();
    return;
  }
  auto* set = vtkPointSet::SafeDownCast(input.Data);
  if (set && set->GetNumberOfPoints() > 0)
  {
    double x[3];
    const vtkIdType from = random.Whole(0, set->GetNumberOfPoints() - 1);
    set->GetPoint(from, x);
    set->GetPoints()->SetPoint(random.Whole(0, set->GetNumberOfPoints() - 1), x);
    set->GetPoints()->Modified();
    auto* surface = vtkPolyData::SafeDownCast(set);
    if (surface &&
      surface->GetNumberOfLines() + surface->GetNumberOfPolys() + surface->GetNumberOfStrips() > 0)
    {
      // Coinciding points can tear a surface, close an open one, or make an outline cross itself.
      input.Condition = State::Odd;
    }
    else if (set->GetNumberOfPoints() < 8)
    {
      input.Worsen(State::Odd); // two in one place
    }
  }
  vtkDataArray* array = input.Values;
  if (array && array->GetNumberOfTuples() > 0)
  {
    const vtkIdType i = random.Whole(0, array->GetNumberOfTuples() - 1);
    array->SetComponent(i, 0, random.Chance(0.95) ? static_cast<double>(random.Whole(0, 1)) : -1.0);
    if (input.Texts)
    {
      input.Texts->SetValue(i * array->GetNumberOfComponents(), textOf(array->GetComponent(i, 0)));
    }
    // Who writes in place may say so of the array or of the data set.
    if (random.Chance(0.5))
    {
      array->Modified();
      if (input.Texts)
      {
        input.Texts->Modified();
      }
    }
    else
    {
      input.Data->Modified();
    }
  }
}

} // namespace Campaign
