// SPDX-License-Identifier: BSD-3-Clause
// What the tests of filters share that move the points of any vtkPointSet in a density.
#ifndef PointSetTest_h
#define PointSetTest_h

#include "TestData.h"

#include "vtkCellArray.h"
#include "vtkPlaneSource.h"
#include "vtkStructuredGrid.h"
#include "vtkTrivialProducer.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <functional>

// The same types of cells with the same points, in one order.
inline bool sameCells(vtkPointSet* a, vtkPointSet* b)
{
  bool same = a->GetNumberOfCells() == b->GetNumberOfCells();
  for (vtkIdType i = 0; same && i < a->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> ofA;
    vtkNew<vtkIdList> ofB;
    a->GetCellPoints(i, ofA);
    b->GetCellPoints(i, ofB);
    same = a->GetCellType(i) == b->GetCellType(i) &&
      ofA->GetNumberOfIds() == ofB->GetNumberOfIds() &&
      std::equal(ofA->begin(), ofA->end(), ofB->begin());
  }
  return same;
}

// Calls expect(set, line) for polygons in [1,7] x [1,5], and for a curvilinear and an unstructured
// grid of 24 points, which are 4 x 3 x 2.
template <class Expect>
void checkPointSetTypes(vtkPoints* points, const Expect& expect, int line)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(1, 1, 0);
  plane->SetPoint1(7, 1, 0);
  plane->SetPoint2(1, 5, 0);
  plane->SetResolution(6, 4);
  plane->Update();
  expect(plane->GetOutput(), line);

  vtkNew<vtkStructuredGrid> curvilinear;
  curvilinear->SetDimensions(4, 3, 2);
  curvilinear->SetPoints(points);
  expect(curvilinear, line);

  vtkNew<vtkUnstructuredGrid> mixed;
  mixed->SetPoints(points);
  const vtkIdType ids[8] = { 0, 1, 5, 4, 12, 13, 17, 16 };
  mixed->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  mixed->InsertNextCell(VTK_VERTEX, 1, ids);
  mixed->InsertNextCell(VTK_QUAD, 4, ids + 4);
  expect(mixed, line);
}

// After an error with points of another type a smaller grid is asked for no more than it has.
template <class Filter>
void checkTypesAroundAnError(Checks& checks, Filter* filter, const std::function<void()>& spoil,
  const std::function<void()>& mend, int line)
{
  const auto makeGrid = [](int count) {
    auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
    vtkNew<vtkPoints> points;
    for (int i = 0; i < count; ++i)
    {
      points->InsertNextPoint(1.0 + 6.0 * i / count, 2.0, 0.0);
    }
    grid->SetDimensions(count, 1, 1);
    grid->SetPoints(points);
    return grid;
  };
  vtkNew<vtkTrivialProducer> trivial; // says what is asked in vain
  Messages messages(filter);
  Messages ofProducer(trivial);
  filter->SetInputConnection(0, trivial->GetOutputPort());
  const auto run = [&](vtkDataObject* points) {
    trivial->SetOutput(points);
    filter->Update();
    return filter->GetOutput() ? filter->GetOutput()->GetNumberOfPoints() : 0;
  };
  checks.That(run(makeGrid(241)) == 241, "the large grid", line);
  spoil();
  checks.That(
    run(makePoints({ 1, 1, 0, 3, 2, 0 })) == 0 && messages.Errors.size() == 1, "one error", line);
  mend();
  checks.That(run(makeGrid(17)) == 17, "the small grid", line);
  checks.That(messages.Errors.size() == 1 && ofProducer.Errors.empty(), "no other error", line);
}

#endif
