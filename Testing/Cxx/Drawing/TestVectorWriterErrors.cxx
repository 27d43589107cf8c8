// SPDX-License-Identifier: BSD-3-Clause
// Errors and aborts of the writers: an earlier file stays as it was, and none is left half.
#include "DrawingTest.h"
#include "ProgressTest.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTransportPDFWriter.h"
#include "vtkTransportSVGWriter.h"

#include <limits>

namespace
{

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

class WriterTest
{
public:
  explicit WriterTest(Checks& checks, vtkTransportVectorWriter* writer)
    : Check(checks)
    , Writer(writer)
    , File("errors.out")
    , Reported(writer)
  {
    this->Keep("earlier");
    writer->SetFileName(this->File.Name().c_str());
  }

  void Keep(const std::string& text) { std::ofstream(this->File.Name()) << text; }

  void Expect(std::initializer_list<std::string> parts, int line)
  {
    this->Reported.Clear();
    this->Check.That(this->Writer->Write() == 0, "fails", line);
    const std::string found = this->Reported.Errors.empty() ? "no error" : this->Reported.Errors[0];
    this->Check.That(this->Reported.Errors.size() == 1, "one error", line, found);
    for (const std::string& part : parts)
    {
      this->Check.That(contains(found, part), part.c_str(), line, found);
    }
    this->ExpectEarlier(line);
  }

  void ExpectEarlier(int line)
  {
    this->Check.That(this->File.Text() == "earlier", "the earlier file is unchanged", line);
    this->Check.That(!this->File.HasPart(), "no part is left", line);
  }

  Checks& Check;
  vtkTransportVectorWriter* Writer;
  TemporaryFile File;
  Messages Reported;
};

vtkSmartPointer<vtkPolyData> row(vtkIdType count)
{
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(i, static_cast<double>(i % 1000), static_cast<double>(i / 1000), 0.0);
  }
  data->SetPoints(points);
  return data;
}

void checkProperties(Checks& checks, vtkTransportVectorWriter* writer)
{
  WriterTest test(checks, writer);
  writer->SetInputData(row(100));
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { 0.0, -1.0, notANumber, infinity })
  {
    writer->SetWidth(bad);
    test.Expect({ "Width is ", "more than 0 (millimetres)" }, __LINE__);
    writer->SetWidth(100);
  }
  for (const double bad : { -1.0, notANumber, infinity })
  {
    writer->SetLineWidth(bad);
    test.Expect(
      { "LineWidth is ", "more than 0 (millimetres), or 0 for a quarter of the median edge" },
      __LINE__);
    writer->SetLineWidth(0);
    writer->SetPageMargin(bad);
    test.Expect({ "PageMargin is ", "0 or more (millimetres)" }, __LINE__);
    writer->SetPageMargin(0);
    writer->SetPointRadius(bad);
    test.Expect({ "PointRadius is ", "more than 0, or 0" }, __LINE__);
    writer->SetPointRadius(0);
  }
  for (const std::array<double, 6>& bad :
    { std::array<double, 6>{ 0, 1, 0, 1, 1, 0 }, { 0, 1, 2, 2, 3, 3 }, { 5, 5, 5, 5, 5, 5 },
      { 0, infinity, 0, 1, 0, 1 }, { 0, notANumber, 0, 1, 0, 1 } })
  {
    writer->SetPageBounds(bad.data());
    test.Expect({ "PageBounds are ", "longer than 0 along two axes, or all 0" }, __LINE__);
  }
  writer->SetPageBounds(0, 1e-6, 0, 1e-6, 0, 0);
  test.Expect({ "PageBounds are so small that the input reaches " }, __LINE__);
  writer->SetPageBounds(0, 0, 0, 0, 0, 0);
  writer->SetPageMargin(50);
  test.Expect({ "Width is 100; it must be more than 100, twice PageMargin" }, __LINE__);
  writer->SetPageMargin(0);
  writer->SetWidth(1e7);
  test.Expect({ "The page is 1e+07 x ", "Width must be at most " }, __LINE__);
}

void checkPages(Checks& checks)
{
  vtkNew<vtkTransportPDFWriter> writer;
  WriterTest test(checks, writer);
  writer->SetInputData(shapes({ { 0, 0, 0 }, { 1, 1000, 0 } }, Cells::Line));
  writer->SetLineWidth(0.001);
  test.Expect({ "The page is 100 x ", "no side may be longer than 5080 mm in this format",
                "Width must be at most 5.08" },
    __LINE__);
  writer->SetWidth(5.08);
  CHECK(checks, writer->Write() == 1);
}

void checkInputs(Checks& checks, vtkTransportVectorWriter* writer)
{
  WriterTest test(checks, writer);
  vtkNew<vtkPolyData> nothing;
  writer->SetInputData(nothing);
  test.Expect({ "The input has no points; there is nothing to draw" }, __LINE__);
  vtkNew<vtkMultiBlockDataSet> blocks;
  writer->SetInputData(blocks);
  test.Expect({ "The input has no points" }, __LINE__);
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  blocks->SetBlock(0, image);
  test.Expect({ "a block of type vtkImageData", "vtkPolyData" }, __LINE__);

  writer->SetInputData(shapes({ { 0, 0, 0 }, { 1, notANumber, 0 } }, Cells::Verts));
  test.Expect({ "NaN or infinite, at index 1" }, __LINE__);
  writer->SetInputData(shapes({ { -1e308, 0, 0 }, { 1e308, 1, 0 } }, Cells::Line));
  test.Expect({ "past the largest double" }, __LINE__);
  writer->SetInputData(shapes({ { 0, 0, 0 }, { 1e-310, 0, 0 } }, Cells::Line));
  test.Expect({ "too little for a page" }, __LINE__);
  const auto without = shapes({ { 0, 0, 0 }, { 1, 0, 0 } }, Cells::None);
  vtkNew<vtkCellArray> empty;
  empty->InsertNextCell(0);
  without->SetPolys(empty);
  writer->SetInputData(without);
  test.Expect({ "none that is drawn", "its cells have no points" }, __LINE__);
  const auto damaged = shapes({ { 0, 0, 0 }, { 1, 0, 0 } }, Cells::Line);
  damaged->GetLines()->GetConnectivityArray()->SetComponent(1, 0, 7);
  writer->SetInputData(damaged);
  test.Expect({ "7" }, __LINE__);
  writer->SetInputData(row(10));
  writer->SetFileName("");
  test.Expect({ "FileName is empty" }, __LINE__);
}

void checkArrays(Checks& checks, vtkTransportVectorWriter* writer)
{
  WriterTest test(checks, writer);
  const auto data = row(3);
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("Size");
  for (const double radius : { 1.0, notANumber, 1.0 })
  {
    radii->InsertNextValue(radius);
  }
  data->GetPointData()->AddArray(radii);
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("Vector");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(2);
  data->GetPointData()->AddArray(vectors);
  writer->SetInputData(data);

  writer->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Size");
  test.Expect({ "RadiusArray", "nan at index 1", "finite and not negative" }, __LINE__);
  radii->SetValue(1, -1.0);
  test.Expect({ "RadiusArray", "-1 at index 1" }, __LINE__);
  writer->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Vector");
  test.Expect({ "RadiusArray 'Vector'", "3" }, __LINE__);
  writer->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Missing");
  test.Expect({ "The input has no RadiusArray 'Missing'", "Size, Vector (point)" }, __LINE__);
  writer->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");

  writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Size");
  test.Expect({ "The input has no ColorArray 'Size'" }, __LINE__);
  writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Vector");
  test.Expect(
    { "The point array 'Vector' of the input has 2 tuples; it must have one for each of the 3 "
      "points" },
    __LINE__);
  vtkNew<vtkStringArray> names;
  names->SetName("Name");
  names->SetNumberOfValues(3);
  data->GetPointData()->AddArray(names);
  writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Name");
  test.Expect(
    { "ColorArray 'Name' has no numbers; choose one that has, or a LookupTable" }, __LINE__);
  vtkNew<vtkLookupTable> table;
  table->SetIndexedLookup(1);
  table->SetAnnotation(vtkVariant(""), "none");
  table->Build();
  writer->SetLookupTable(table);
  CHECK(checks, writer->Write() == 1);
  test.Keep("earlier");
  writer->SetLookupTable(nullptr);
  writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_NONE, "Size");
  test.Expect({ "The field association of the ColorArray" }, __LINE__);
}

// Layers have whole numbers or texts, few of them, one a point or cell.
void checkLayerArrays(Checks& checks, vtkTransportVectorWriter* writer)
{
  WriterTest test(checks, writer);
  const vtkIdType count = 101;
  const auto data = row(count);
  vtkNew<vtkDoubleArray> values;
  values->SetName("Value");
  for (vtkIdType i = 0; i < count; ++i)
  {
    values->InsertNextValue(static_cast<double>(i));
  }
  data->GetPointData()->AddArray(values);
  writer->SetInputData(data);
  writer->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Missing");
  test.Expect({ "The input has no LayerArray 'Missing'", "Value (point)" }, __LINE__);
  writer->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Value");
  test.Expect({ "The input has no LayerArray 'Value'" }, __LINE__);
  writer->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Value");
  test.Expect({ "LayerArray 'Value' has more than 100 values", "fewer values" }, __LINE__);
  for (const double bad : { 0.5, notANumber, std::numeric_limits<double>::infinity(), 1e300 })
  {
    values->SetValue(7, bad);
    test.Expect({ "LayerArray 'Value' has the value ", "whole numbers or texts" }, __LINE__);
  }
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(count);
  test.Expect({ "LayerArray 'Value' has 3 components; it must have 1" }, __LINE__);
  values->SetNumberOfComponents(1);
  values->SetNumberOfTuples(count - 1);
  test.Expect({ "LayerArray 'Value' has 100 values, but there are 101 points" }, __LINE__);
  values->SetNumberOfTuples(count);
  values->Fill(3.0);
  CHECK(checks, writer->Write() == 1);
}

// Filled outlines are told apart by all arrays of the cells.
void checkArraysOfOutlines(Checks& checks, vtkTransportVectorWriter* writer)
{
  WriterTest test(checks, writer);
  const auto data = shapes({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 0, 0 } }, Cells::Line);
  data->GetLines()->InsertNextCell({ 0, 1, 2, 0 });
  data->GetCellData()->AddArray(bytes("Colours", 3, { 9, 9, 9, 9, 9, 9 }));
  data->GetCellData()->AddArray(bytes("Land", 1, { 1 }));
  writer->SetInputData(data);
  writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Colours");
  writer->SetFillOutlines(true);
  test.Expect({ "The cell array 'Land' of the input has 1 tuples; it must have one for each of the "
                "2 cells" },
    __LINE__);
  writer->SetFillOutlines(false);
  CHECK(checks, writer->Write() == 1);
}

void checkFiles(Checks& checks)
{
  vtkNew<vtkTransportSVGWriter> writer;
  WriterTest test(checks, writer);
  writer->SetInputData(row(10));
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  writer->SetFileName(folder.string().c_str());
  test.Expect({ "is a folder" }, __LINE__);
  writer->SetFileName((folder / "missing" / "x.svg").string().c_str());
  test.Expect(
    { "cannot be written", "No such file or directory", "its folder must exist" }, __LINE__);
#ifdef __linux__
  writer->SetFileName("/proc/self/x.svg");
  test.Expect({ "/proc/self/x.svg' cannot be written" }, __LINE__);
#endif
}

// Progress rises; an abort in any stage leaves the earlier file.
void checkProgress(Checks& checks, vtkTransportVectorWriter* writer)
{
  WriterTest test(checks, writer);
  writer->SetInputData(row(400000));
  for (const double from : { 0.05, 0.15, 0.3, 0.55, 0.9 })
  {
    ProgressTest progress(writer);
    progress.AbortFrom = from;
    writer->Write();
    checks.That(writer->GetAbortExecute() != 0, "aborted", __LINE__, std::to_string(from));
    test.ExpectEarlier(__LINE__);
    CHECK(checks, test.Reported.Errors.empty());
    writer->SetAbortExecute(0);
  }
  ProgressTest progress(writer);
  CHECK(checks, writer->Write() == 1);
  progress.ExpectRising(checks, 10, __LINE__);
}

} // namespace

int TestVectorWriterErrors(int, char*[])
{
  return runChecks({ ofBoth<checkProperties>, checkPages, ofBoth<checkInputs>, ofBoth<checkArrays>,
    ofBoth<checkLayerArrays>, ofBoth<checkArraysOfOutlines>, checkFiles, ofBoth<checkProgress> });
}
