// SPDX-License-Identifier: BSD-3-Clause
// What vtkAreaPreservingParameterization gives: coordinates that keep areas, figures that agree
// with them, and all that the surface had.
#include "ParameterizationTest.h"

#include "vtkIntArray.h"
#include "vtkStripper.h"
#include "vtkTriangle.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <set>

namespace
{

// The sheet's points on its border are on the sides, each where it belongs.
void expectSides(Checks& checks, const Values& square, int columns, int rows, int line)
{
  for (int y = 0; y <= rows; ++y)
  {
    for (int x = 0; x <= columns; ++x)
    {
      const auto i = static_cast<std::size_t>(2 * (x + y * (columns + 1)));
      checks.That((square[i] == 0.0) == (x == 0), "left", line);
      checks.That((square[i] == 1.0) == (x == columns), "right", line);
      checks.That((square[i + 1] == 0.0) == (y == 0), "lower", line);
      checks.That((square[i + 1] == 1.0) == (y == rows), "upper", line);
    }
  }
}

// A rectangle is mapped as it is.
void checkRectangle(Checks& checks)
{
  constexpr int columns = 12;
  constexpr int rows = 6;
  auto filter = makeParameterization(makeFlatSheet(columns, rows));
  Messages messages(filter);
  setCorners(filter, { 0, columns, (columns + 1) * (rows + 1) - 1, (columns + 1) * rows });
  const Values found = runSquare(filter);
  Values wanted;
  for (int y = 0; y <= rows; ++y)
  {
    for (int x = 0; x <= columns; ++x)
    {
      wanted.push_back(static_cast<double>(x) / columns);
      wanted.push_back(static_cast<double>(y) / rows);
    }
  }
  CHECK(checks, largestDifference(squareValues(filter, "Conformal"), wanted) < 1e-12);
  CHECK(checks, largestDifference(found, wanted) < 2e-3);
  expectSides(checks, found, columns, rows, __LINE__);
  expectFigures(checks, filter, __LINE__);
  for (const double angle : cellValues(filter, "AngleDistortion"))
  {
    CHECK_NEAR(checks, angle, 2.0, 0.05); // the square is half as wide
  }
  CHECK(checks, fieldValue(filter->GetOutput(), "AreaDistortionRMS") < 5e-3);
  // The corners are also what is found, in some turn.
  filter->ClearCorners();
  const Values automatic = runSquare(filter);
  const auto isCorner = [&](int i) {
    const double u = automatic[static_cast<std::size_t>(2 * i)];
    const double v = automatic[static_cast<std::size_t>(2 * i + 1)];
    return (u == 0.0 || u == 1.0) && (v == 0.0 || v == 1.0);
  };
  for (int i = 0; i < (columns + 1) * (rows + 1); ++i)
  {
    CHECK(
      checks, isCorner(i) == (i % (columns + 1) % columns == 0 && i / (columns + 1) % rows == 0));
  }
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

void checkHills(Checks& checks)
{
  constexpr int columns = 16;
  constexpr int rows = 20;
  auto input = makeHills(columns, rows);
  auto filter = makeParameterization(input);
  filter->SetResolution(128);
  Messages messages(filter);
  const vtkIdType last = (columns + 1) * (rows + 1) - 1;
  setCorners(filter, { 0, columns, last, last - columns });
  const Values found = runSquare(filter);
  expectFigures(checks, filter, __LINE__);
  expectSides(checks, found, columns, rows, __LINE__);
  expectSides(checks, squareValues(filter, "Conformal"), columns, rows, __LINE__);
  CHECK(checks, fieldValue(filter->GetOutput(), "FlippedCount") == 0.0);
  const double polished = fieldValue(filter->GetOutput(), "AreaDistortionRMS");
  CHECK(checks, polished < 0.025);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());

  filter->PolishOff();
  const Values flowOnly = runSquare(filter);
  expectFigures(checks, filter, __LINE__);
  expectSides(checks, flowOnly, columns, rows, __LINE__);
  const double rough = fieldValue(filter->GetOutput(), "AreaDistortionRMS");
  CHECK(checks, rough > 1.5 * polished && rough < 0.5);

  filter->SetResolution(8);
  CHECK(checks, runSquare(filter) != flowOnly);
  filter->PolishOn();
  filter->SetResolution(128);
  CHECK(checks, runSquare(filter) == found);
}

void checkHemisphere(Checks& checks)
{
  auto filter = makeParameterization(makeCap(16, 0.5));
  filter->SetResolution(256);
  Messages messages(filter);
  CHECK(checks, isInSquare(runSquare(filter)));
  CHECK(checks, isInSquare(squareValues(filter, "Conformal")));
  expectFigures(checks, filter, __LINE__);
  CHECK(checks, fieldValue(filter->GetOutput(), "AreaDistortionRMS") < 0.02);
  CHECK(checks, fieldValue(filter->GetOutput(), "FlippedCount") == 0.0);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

// The first goes to (0,0), and the others follow in the order of the boundary.
void checkCorners(Checks& checks)
{
  constexpr int columns = 9;
  constexpr int rows = 7;
  const vtkIdType width = columns + 1;
  const vtkIdType last = width * (rows + 1) - 1;
  auto filter = makeParameterization(makeHills(columns, rows));
  const auto at = [&](vtkIdType point) {
    const Values square = squareValues(filter);
    return std::array<double, 2>{ square[static_cast<std::size_t>(2 * point)],
      square[static_cast<std::size_t>(2 * point) + 1] };
  };
  using Place = std::array<double, 2>;
  for (const std::vector<vtkIdType>& corners :
    { std::vector<vtkIdType>{ 3, 5 * width - 1, last - 4, 2 * width },
      std::vector<vtkIdType>{ 3, 2 * width, last - 4, 5 * width - 1 } })
  {
    setCorners(filter, corners);
    filter->Update();
    CHECK(checks, (at(3) == Place{ 0.0, 0.0 }));
    CHECK(checks, (at(5 * width - 1) == Place{ 1.0, 0.0 }));
    CHECK(checks, (at(last - 4) == Place{ 1.0, 1.0 }));
    CHECK(checks, (at(2 * width) == Place{ 0.0, 1.0 }));
    expectFigures(checks, filter, __LINE__);
  }
  const vtkMTimeType before = filter->GetMTime();
  filter->SetCorner(2, last - 4);
  filter->SetNumberOfCorners(4);
  CHECK(checks, filter->GetMTime() == before);
  filter->SetCorner(2, last);
  CHECK(checks, filter->GetMTime() > before && filter->GetCorner(2) == last);
  filter->Update();
  CHECK(checks, (at(last) == Place{ 1.0, 1.0 }));
  filter->SetNumberOfCorners(2);
  CHECK(checks, filter->GetNumberOfCorners() == 2 && filter->GetCorner(2) == -1);
  filter->ClearCorners();
  CHECK(checks, filter->GetNumberOfCorners() == 0);
  filter->SetCorner(1, 5);
  CHECK(checks, filter->GetNumberOfCorners() == 2);
  CHECK(
    checks, filter->GetCorner(0) == -1 && filter->GetCorner(1) == 5 && filter->GetCorner(-1) == -1);
}

// Points, cells, and their data in their order; arrays of the names of outputs are replaced.
void checkWhatIsKept(Checks& checks)
{
  auto input = makeHills(6, 5);
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({ 4, 2 });
  input->SetVerts(vertices);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 3, 7, 9 });
  input->SetLines(lines);
  const vtkIdType points = input->GetNumberOfPoints();
  const vtkIdType cells = input->GetNumberOfCells();
  CHECK(checks, cells == 62);
  auto pointNumbers = makeNumbers("Number", points);
  auto cellNumbers = makeNumbers("Number", cells);
  input->GetPointData()->SetScalars(pointNumbers);
  input->GetCellData()->SetScalars(cellNumbers);
  vtkNew<vtkDoubleArray> texture;
  texture->SetName("Texture");
  texture->SetNumberOfComponents(2);
  texture->SetNumberOfTuples(points);
  texture->Fill(0.25);
  input->GetPointData()->SetTCoords(texture);
  for (const char* name : { "AreaPreserving", "Conformal" })
  {
    vtkNew<vtkIntArray> old;
    old->SetName(name);
    old->SetNumberOfTuples(points);
    input->GetPointData()->AddArray(old);
  }
  for (const char* name : { "AreaDistortion", "AngleDistortion", "Flipped" })
  {
    vtkNew<vtkIntArray> old;
    old->SetName(name);
    old->SetNumberOfTuples(cells);
    input->GetCellData()->AddArray(old);
  }
  input->GetFieldData()->AddArray(makeNumbers("AreaDistortionRMS", 7));
  auto own = makeNumbers("Own", 3);
  input->GetFieldData()->AddArray(own);

  auto filter = makeParameterization(input);
  Messages messages(filter);
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  CHECK(checks, output->GetPoints() == input->GetPoints());
  CHECK(checks, output->GetPolys() == input->GetPolys() && output->GetLines() == lines);
  CHECK(checks, output->GetVerts() == vertices && output->GetNumberOfCells() == cells);
  vtkPointData* pointData = output->GetPointData();
  CHECK(checks, pointData->GetNumberOfArrays() == 5);
  CHECK(
    checks, pointData->GetScalars() == pointNumbers && pointData->GetArray("Texture") == texture);
  CHECK(checks, pointData->GetTCoords() == pointData->GetArray("AreaPreserving"));
  for (const char* name : { "AreaPreserving", "AreaPreservingExact", "Conformal" })
  {
    vtkDataArray* array = pointData->GetArray(name);
    CHECK(checks, array && array->GetNumberOfComponents() == 2);
    CHECK(checks, array && array->GetNumberOfTuples() == points);
    const bool isActive = array == pointData->GetTCoords(); // float: writers ask for it
    CHECK(checks, array && array->GetDataType() == (isActive ? VTK_FLOAT : VTK_DOUBLE));
  }
  const Values exact = squareValues(filter);
  const Values rounded = squareValues(filter, "AreaPreserving");
  CHECK(checks, exact.size() == rounded.size());
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    CHECK(checks, rounded[i] == static_cast<double>(static_cast<float>(exact[i])));
  }
  vtkCellData* cellData = output->GetCellData();
  CHECK(checks, cellData->GetNumberOfArrays() == 4 && cellData->GetScalars() == cellNumbers);
  CHECK(checks, vtkDoubleArray::SafeDownCast(cellData->GetArray("AreaDistortion")));
  CHECK(checks, vtkDoubleArray::SafeDownCast(cellData->GetArray("AngleDistortion")));
  CHECK(checks, vtkUnsignedCharArray::SafeDownCast(cellData->GetArray("Flipped")));
  for (vtkIdType cell = 0; cell < 2; ++cell) // the vertex and the line
  {
    CHECK(checks, cellData->GetArray("AreaDistortion")->GetTuple1(cell) == 1.0);
    CHECK(checks, cellData->GetArray("AngleDistortion")->GetTuple1(cell) == 1.0);
    CHECK(checks, cellData->GetArray("Flipped")->GetTuple1(cell) == 0.0);
  }
  CHECK(checks, output->GetFieldData()->GetArray("Own") == own);
  CHECK(checks, fieldValue(output, "AreaDistortionRMS") < 0.05); // one value
  expectFigures(checks, filter, __LINE__);
  // The input is as it was.
  CHECK(checks, input->GetPointData()->GetTCoords() == texture);
  CHECK(checks, vtkIntArray::SafeDownCast(input->GetPointData()->GetArray("Conformal")));
  CHECK(checks, input->GetCellData()->GetNumberOfArrays() == 4);
  CHECK(checks, messages.Errors.empty());
}

// Quads and strips are cut into the triangles that a sheet of triangles has, or others.
void checkPolygons(Checks& checks)
{
  constexpr int columns = 8;
  constexpr int rows = 6;
  auto sheet = makeFlatSheet(columns, rows, false);
  sheet->GetCellData()->AddArray(makeNumbers("Number", columns * rows));
  auto filter = makeParameterization(sheet);
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  CHECK(checks, output->GetNumberOfCells() == 2 * columns * rows);
  CHECK(checks, output->GetPolys()->IsHomogeneous() == 3);
  vtkDataArray* numbers = output->GetCellData()->GetArray("Number");
  for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i)
  {
    CHECK(checks, numbers && numbers->GetTuple1(i) == static_cast<double>(i / 2));
  }
  expectFigures(checks, filter, __LINE__);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(makeHills(columns, rows));
  stripper->Update();
  CHECK(checks, stripper->GetOutput()->GetNumberOfStrips() > 0);
  filter->SetInputData(stripper->GetOutput());
  filter->Update();
  CHECK(checks, filter->GetOutput()->GetNumberOfPolys() == 2 * columns * rows);
  CHECK(checks, filter->GetOutput()->GetNumberOfStrips() == 0);
  expectFigures(checks, filter, __LINE__);
}

// A triangle without area joins another one's side to two: it is left out, and that one is cut in
// two, which have its data.
void checkFlatTriangle(Checks& checks)
{
  constexpr vtkIdType columns = 8;
  auto hills = makeHills(columns, 6);
  vtkPoints* points = hills->GetPoints();
  const vtkIdType low = 3 + 2 * (columns + 1);
  const vtkIdType high = low + columns + 2;
  double from[3];
  double to[3];
  points->GetPoint(low, from);
  points->GetPoint(high, to);
  const vtkIdType middle = points->InsertNextPoint(
    0.6 * from[0] + 0.4 * to[0], 0.6 * from[1] + 0.4 * to[1], 0.6 * from[2] + 0.4 * to[2]);
  vtkCellArray* cells = hills->GetPolys();
  cells->ReplaceCellAtId(2 * (3 + 2 * columns) + 1, { low, middle, high - 1 });
  cells->InsertNextCell({ middle, high, high - 1 });
  cells->InsertNextCell({ low, high, middle });
  hills->GetCellData()->AddArray(makeNumbers("Number", hills->GetNumberOfCells()));
  auto filter = makeParameterization(hills);
  Messages messages(filter);
  filter->Update();
  CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 1);
  CHECK(checks, contains(messages.Warnings[0], "1 triangle without area left out"));
  Values numbers = cellValues(filter, "Number");
  const double cut = 2 * (3 + 2 * columns);
  CHECK(checks, std::count(numbers.begin(), numbers.end(), cut) == 2);
  numbers.erase(std::find(numbers.begin(), numbers.end(), cut));
  numbers.push_back(static_cast<double>(hills->GetNumberOfCells() - 1)); // left out
  CHECK(checks, numbers == arrayValues(hills->GetCellData()->GetArray("Number")));
  CHECK(checks, filter->GetOutput()->GetNumberOfPoints() == hills->GetNumberOfPoints());
  expectFigures(checks, filter, __LINE__);
}

// Turned polygons are mapped as the others, and inside out is as good.
void checkOrientation(Checks& checks)
{
  auto input = makeHills(8, 6);
  auto filter = makeParameterization(input);
  const vtkIdType last = 62;
  setCorners(filter, { 0, 8, last, last - 8 });
  const Values wanted = runSquare(filter);
  for (const vtkIdType turned : { 3, 4, 50, 77 })
  {
    vtkNew<vtkIdList> ids;
    input->GetPolys()->GetCellAtId(turned, ids);
    input->GetPolys()->ReplaceCellAtId(turned, { ids->GetId(0), ids->GetId(2), ids->GetId(1) });
  }
  input->Modified();
  CHECK(checks, largestDifference(runSquare(filter), wanted) < 1e-9);
  CHECK(checks, fieldValue(filter->GetOutput(), "FlippedCount") == 0.0);
  CHECK(checks, filter->GetOutput()->GetPolys() == input->GetPolys());
}

// Along a cut points are there twice, and are mapped to two sides.
void checkCut(Checks& checks)
{
  const double pi = std::acos(-1.0);
  constexpr int around = 24;
  auto tube = makeSheet(around, 10, [&](double x, double y) {
    const double angle = 2.0 * pi * (x == around ? 0.0 : x) / around;
    return std::array<double, 3>{ std::cos(angle), std::sin(angle), 0.3 * y };
  });
  auto filter = makeParameterization(tube);
  const vtkIdType last = (around + 1) * 11 - 1;
  setCorners(filter, { 0, around, last, last - around });
  const Values found = runSquare(filter);
  expectSides(checks, found, around, 10, __LINE__);
  CHECK(checks, fieldValue(filter->GetOutput(), "AreaDistortionRMS") < 0.01);
}

} // namespace

int TestAreaPreserving(int, char*[])
{
  return runChecks({ checkRectangle, checkHills, checkHemisphere, checkCorners, checkWhatIsKept,
    checkPolygons, checkFlatTriangle, checkOrientation, checkCut });
}
