// SPDX-License-Identifier: BSD-3-Clause
// Closed lines and polygons as triangles: which lines are one region, the area, the data of cells
// and points; cells without points, in views and in files.
#include "DrawingTest.h"

#include "Bridge/Drawing/OutlineFilling.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTransportSVGWriter.h"
#include "vtkTriangle.h"
#include "vtkUnsignedLongLongArray.h"
#include "vtkVariantArray.h"

#include <limits>
#include <map>

namespace
{

using Ring = std::vector<std::array<double, 2>>;

Ring square(double low, double high)
{
  return { { low, low }, { high, low }, { high, high }, { low, high } };
}

vtkSmartPointer<vtkPolyData> dataOf(const std::vector<Ring>& rings, bool asLines)
{
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const Ring& ring : rings)
  {
    vtkNew<vtkIdList> ids;
    for (const std::array<double, 2>& place : ring)
    {
      ids->InsertNextId(points->InsertNextPoint(place[0], place[1], 7.0));
    }
    if (asLines && !ring.empty())
    {
      ids->InsertNextId(ids->GetId(0));
    }
    cells->InsertNextCell(ids);
  }
  data->SetPoints(points);
  asLines ? data->SetLines(cells) : data->SetPolys(cells);
  return data;
}

// A land and its enclave, with a value each.
vtkSmartPointer<vtkPolyData> landOf(vtkAbstractArray* values)
{
  const auto data = dataOf({ square(0, 10), square(3, 7) }, true);
  values->SetName("Values");
  data->GetCellData()->AddArray(values);
  return data;
}

// Of all polygons.
double areaOf(vtkPolyData* data)
{
  double sum = 0.0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < data->GetNumberOfPolys(); ++i)
  {
    data->GetPolys()->GetCellAtId(i, ids);
    for (vtkIdType k = 1; k + 1 < ids->GetNumberOfIds(); ++k)
    {
      double corners[3][3];
      data->GetPoint(ids->GetId(0), corners[0]);
      data->GetPoint(ids->GetId(k), corners[1]);
      data->GetPoint(ids->GetId(k + 1), corners[2]);
      sum += vtkTriangle::TriangleArea(corners[0], corners[1], corners[2]);
    }
  }
  return sum;
}

double filledArea(const std::vector<Ring>& rings, bool asLines)
{
  const auto data = dataOf(rings, asLines);
  RectifiedTransport::Bridge::fillOutlines(data);
  return areaOf(data);
}

// Two regions fill the enclave, too; one has a hole there.
void expectRegions(Checks& checks, vtkAbstractArray* values, int regions, int line)
{
  const auto data = landOf(values);
  const std::string type = values->GetDataTypeAsString();
  vtkNew<vtkTransportSVGWriter> writer;
  const TemporaryFile file("regions.svg");
  writer->SetInputData(data);
  writer->SetFileName(file.Name().c_str());
  writer->SetFillOutlines(true);
  data->GetCellData()->AddArray(bytes("Colours", 3, { 9, 9, 9, 9, 9, 9 }));
  writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Colours");
  CHECK(checks, writer->Write() == 1);
  checks.That(countOf(file.Text(), "evenodd") == regions, "regions of a file", line, type);
  RectifiedTransport::Bridge::fillOutlines(data);
  checks.Near(areaOf(data), regions == 2 ? 116 : 84, 1e-9, type.c_str(), line);
}

template <class Array, class Value>
void expectValues(Checks& checks, Value land, Value enclave, int regions, int line)
{
  for (const int components : { 1, 3 })
  {
    vtkNew<Array> values;
    values->SetNumberOfComponents(components);
    values->SetNumberOfTuples(2);
    for (int i = 0; i < 2 * components; ++i)
    {
      values->SetValue(i, i + 1 < 2 * components ? land : enclave);
    }
    expectRegions(checks, values, regions, line);
  }
}

void checkValues(Checks& checks)
{
  expectValues<vtkDoubleArray>(checks, 131210089021.0, 131210089022.0, 2, __LINE__);
  expectValues<vtkDoubleArray>(checks, 0.1 + 0.2, 0.3, 2, __LINE__);
  expectValues<vtkFloatArray>(checks, 1.0000001f, 1.0f, 2, __LINE__);
  const double none = std::numeric_limits<double>::quiet_NaN();
  expectValues<vtkDoubleArray>(checks, none, -none, 1, __LINE__);
  expectValues<vtkDoubleArray>(checks, none, 0.0, 2, __LINE__);
  expectValues<vtkDoubleArray>(checks, 0.0, -0.0, 1, __LINE__);
  const unsigned long long most = std::numeric_limits<unsigned long long>::max();
  expectValues<vtkUnsignedLongLongArray>(checks, most, most - 1, 2, __LINE__);
  expectValues<vtkIdTypeArray>(
    checks, vtkIdType{ 1 } << 60, (vtkIdType{ 1 } << 60) + 1, 2, __LINE__);
  expectValues<vtkIdTypeArray>(checks, vtkIdType{ 5 }, vtkIdType{ 5 }, 1, __LINE__);
  expectValues<vtkStringArray>(checks, "01", "1", 2, __LINE__);
  expectValues<vtkStringArray>(checks, "a\n", "a", 2, __LINE__);
  expectValues<vtkStringArray>(checks, "Land", "Land", 1, __LINE__);
  expectValues<vtkVariantArray>(checks, vtkVariant(1e12 + 1), vtkVariant(1e12), 2, __LINE__);
}

void checkAreas(Checks& checks)
{
  for (const bool asLines : { true, false })
  {
    const Ring arrow{ { 0, 0 }, { 4, 2 }, { 0, 4 }, { 1, 2 } };
    const Ring eight{ { 0, 0 }, { 2, 2 }, { 2, 0 }, { 0, 3 } };
    CHECK_NEAR(checks, filledArea({ arrow }, asLines), 6.0, 1e-9);
    CHECK_NEAR(checks, filledArea({ eight, square(5, 6) }, asLines), 0.8 * 1 + 1.2 * 1.5 + 1, 1e-9);
  }
  CHECK_NEAR(checks, filledArea({ square(0, 4), square(1, 3) }, true), 12.0, 1e-9);
  CHECK_NEAR(checks, filledArea({ square(0, 4), square(1, 3) }, false), 20.0, 1e-9);
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_NEAR(checks, filledArea({ square(0, 4), square(0, infinity) }, true), 16.0, 1e-9);
  CHECK_NEAR(
    checks, filledArea({ { { 0, 0 }, { 1, 1 }, { 2, 2 } }, square(0, 1) }, true), 1.0, 1e-9);
}

// Points where edges cross have the data between the ends of an edge; cells those of their line.
void checkData(Checks& checks)
{
  const auto data = dataOf({ { { 0, 0 }, { 4, 3 }, { 4, 0 }, { 0, 4 } }, square(5, 6) }, true);
  const auto numbers = vtkSmartPointer<vtkDoubleArray>::New();
  numbers->SetName("X");
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    numbers->InsertNextValue(10.0 * data->GetPoint(i)[0]);
  }
  data->GetPointData()->AddArray(numbers);
  vtkNew<vtkStringArray> names;
  names->SetName("Name");
  names->InsertNextValue("eight");
  names->InsertNextValue("square");
  data->GetCellData()->AddArray(names);
  RectifiedTransport::Bridge::fillOutlines(data);
  CHECK(checks, data->GetNumberOfPoints() == 9);
  auto* found = vtkDoubleArray::SafeDownCast(data->GetPointData()->GetArray("X"));
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    CHECK_NEAR(checks, found->GetValue(i), 10.0 * data->GetPoint(i)[0], 1e-9);
    CHECK_NEAR(checks, data->GetPoint(i)[2], 7.0, 1e-12);
  }
  auto* given = vtkStringArray::SafeDownCast(data->GetCellData()->GetAbstractArray("Name"));
  CHECK(checks, given->GetNumberOfValues() == data->GetNumberOfCells());
  std::map<std::string, int> cells;
  for (vtkIdType i = 0; i < given->GetNumberOfValues(); ++i)
  {
    ++cells[given->GetValue(i)];
  }
  CHECK(checks, cells["eight"] == 3 && cells["square"] == 3);
}

// Shorter arrays than the cells, which regions and the filled cells would read.
void checkShortArrays(Checks& checks)
{
  vtkNew<vtkDoubleArray> values;
  values->InsertNextValue(1.0);
  const auto data = landOf(values);
  vtkNew<vtkDoubleArray> ofPoints;
  ofPoints->SetName("OfPoints");
  ofPoints->SetNumberOfTuples(7);
  ofPoints->Fill(1.0);
  const auto expect = [&](const std::string& text, int line) {
    const vtkIdType cells = data->GetNumberOfCells();
    try
    {
      RectifiedTransport::Bridge::fillOutlines(data);
      checks.That(false, "is refused", line, text);
    }
    catch (const std::exception& problem)
    {
      checks.That(problem.what() == text, "the message", line, problem.what());
    }
    CHECK(checks, data->GetNumberOfCells() == cells);
  };
  expect("The cell array 'Values' of the input has 1 tuples; it must have one for each of the 2 "
         "cells",
    __LINE__);
  values->InsertNextValue(1.0);
  data->GetPointData()->AddArray(ofPoints);
  expect("The point array 'OfPoints' of the input has 7 tuples; it must have one for each of the 8 "
         "points",
    __LINE__);
  ofPoints->InsertNextValue(1.0);
  RectifiedTransport::Bridge::fillOutlines(data);
  CHECK_NEAR(checks, areaOf(data), 84.0, 1e-9);
}

// Polygons, lines, strips and vertices without points are none.
void checkCellsWithoutPoints(Checks& checks, vtkTransportVectorWriter* writer)
{
  const TemporaryFile file("empty.out");
  const TemporaryFile wanted("whole.out");
  for (const bool asLines : { true, false })
  {
    const auto data = dataOf({ {}, square(0, 4), {} }, asLines);
    const auto whole = dataOf({ square(0, 4) }, asLines);
    vtkNew<vtkCellArray> empty;
    empty->InsertNextCell(0);
    data->SetStrips(empty);
    data->SetVerts(empty);
    for (vtkPolyData* drawn : { data.Get(), whole.Get() })
    {
      drawn->GetPointData()->AddArray(bytes("P", 3, std::vector<unsigned char>(12, 7)));
      const auto count = static_cast<std::size_t>(3 * drawn->GetNumberOfCells());
      drawn->GetCellData()->AddArray(bytes("C", 3, std::vector<unsigned char>(count, 9)));
    }
    for (const char* colours : { "", "P", "C" })
    {
      writer->SetInputArrayToProcess(0, 0, 0,
        *colours == 'C' ? vtkDataObject::FIELD_ASSOCIATION_CELLS
                        : vtkDataObject::FIELD_ASSOCIATION_POINTS,
        *colours ? colours : "None");
      writer->SetInputData(data);
      writer->SetFileName(file.Name().c_str());
      checks.That(writer->Write() == 1, "is written", __LINE__, colours);
      writer->SetInputData(whole);
      writer->SetFileName(wanted.Name().c_str());
      CHECK(checks, writer->Write() == 1);
      checks.That(file.Text() == wanted.Text(), "is the same file", __LINE__, colours);
    }
    RectifiedTransport::Bridge::fillOutlines(data);
    CHECK_NEAR(checks, areaOf(data), 16.0, 1e-9);
  }
}

} // namespace

int TestOutlineFilling(int, char*[])
{
  return runChecks(
    { checkValues, checkAreas, checkData, checkShortArrays, ofBoth<checkCellsWithoutPoints> });
}
