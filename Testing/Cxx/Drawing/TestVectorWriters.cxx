// SPDX-License-Identifier: BSD-3-Clause
// What is drawn, where and in which colours: read from the text of SVG files. Python's
// TestVectorFiles compares the pictures of both formats.
#include "DrawingTest.h"

#include "vtkBitArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkLookupTable.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTransportPDFWriter.h"
#include "vtkTransportSVGWriter.h"

#include <clocale>

namespace
{

const std::vector<std::array<double, 3>> corners = { { 10, 5, 7 }, { 30, 5, 7 }, { 30, 15, 7 },
  { 10, 15, 7 } };

class Svg
{
public:
  explicit Svg(vtkDataObject* data)
    : File("test.svg")
  {
    this->Writer->SetFileName(this->File.Name().c_str());
    this->Writer->SetInputData(data);
  }

  std::string Written(Checks& checks, int line)
  {
    checks.That(this->Writer->Write() == 1, "written", line);
    checks.That(!this->File.HasPart(), "nothing is left beside it", line);
    return this->File.Text();
  }

  vtkNew<vtkTransportSVGWriter> Writer;
  TemporaryFile File;
};

void expectParts(
  Checks& checks, const std::string& text, std::initializer_list<const char*> parts, int line)
{
  for (const char* part : parts)
  {
    checks.That(contains(text, part), part, line, text);
  }
}

// The page is as wide as told, its height follows, and the dots lie on it wholly.
void checkPage(Checks& checks)
{
  for (const Cells cells : { Cells::Verts, Cells::None })
  {
    Svg svg(shapes(corners, cells));
    svg.Writer->SetPointRadius(2);
    svg.Writer->SetWidth(48); // 2 mm a unit: from 8 to 32
    const std::string text = svg.Written(checks, __LINE__);
    expectParts(checks, text,
      { "width=\"48mm\" height=\"28mm\" viewBox=\"0 0 48 28\"",
        "<circle cx=\"4\" cy=\"24\" r=\"4\"/>", "<circle cx=\"44\" cy=\"24\" r=\"4\"/>",
        "<circle cx=\"44\" cy=\"4\" r=\"4\"/>" },
      __LINE__);
    CHECK(checks, countOf(text, "<circle") == 4);

    svg.Writer->SetPageMargin(12); // 1 mm a unit
    expectParts(checks, svg.Written(checks, __LINE__),
      { "width=\"48mm\" height=\"38mm\"", "<circle cx=\"14\" cy=\"24\" r=\"2\"/>" }, __LINE__);
  }
}

// PageBounds are the page but for its margin, whatever is drawn; what lies outside is cut off.
void checkPageBounds(Checks& checks)
{
  Svg svg(shapes(corners, Cells::Verts));
  svg.Writer->SetPointRadius(2);
  svg.Writer->SetPageBounds(10, 30, 5, 20, 0, 0);
  svg.Writer->SetWidth(40); // 2 mm a unit
  std::string text = svg.Written(checks, __LINE__);
  expectParts(checks, text,
    { "width=\"40mm\" height=\"30mm\"", "<circle cx=\"0\" cy=\"30\" r=\"4\"/>" }, __LINE__);
  CHECK(checks, !contains(text, "clip"));

  svg.Writer->SetPageMargin(10); // 1 mm a unit
  text = svg.Written(checks, __LINE__);
  expectParts(checks, text,
    { "width=\"40mm\" height=\"35mm\"", "<circle cx=\"10\" cy=\"25\" r=\"2\"/>",
      "<clipPath id=\"inside\"><rect x=\"10\" y=\"10\" width=\"20\" height=\"15\"/>",
      "<g clip-path=\"url(#inside)\">" },
    __LINE__);
  CHECK(checks, countOf(text, "<g ") == countOf(text, "</g>"));

  // They choose the plane, too; lines do not widen the page.
  Svg line(shapes(corners, Cells::Line));
  line.Writer->SetPageBounds(10, 10, 5, 15, 0, 20);
  line.Writer->SetLineWidth(1);
  expectParts(checks, line.Written(checks, __LINE__),
    { "width=\"100mm\" height=\"200mm\"", "points=\"0,130 0,130 100,130 100,130\"" }, __LINE__);
}

// The shortest axis is not seen; the others keep their order.
void checkAxes(Checks& checks)
{
  const std::vector<std::array<double, 3>> inXZ = { { 0, 5, 0 }, { 4, 5, 0 }, { 4, 6, 2 } };
  Svg svg(shapes(inXZ, Cells::Line));
  svg.Writer->SetWidth(5);
  svg.Writer->SetLineWidth(1);
  expectParts(checks, svg.Written(checks, __LINE__),
    { "height=\"3mm\"", "stroke-width=\"1\"", "points=\"0.5,2.5 4.5,2.5 4.5,0.5\"" }, __LINE__);

  // A vertical line has no width: its length is the page's.
  Svg vertical(shapes({ { 3, 0, 0 }, { 3, 8, 0 } }, Cells::Line));
  vertical.Writer->SetWidth(5);
  vertical.Writer->SetLineWidth(1);
  expectParts(checks, vertical.Written(checks, __LINE__),
    { "width=\"5mm\" height=\"5mm\"", "points=\"2.5,4.5 2.5,0.5\"" }, __LINE__);
}

// Half the distance of neighbours where points are dense: ten of 1 apart, the others of 3.
void checkRadiusFromSpacing(Checks& checks)
{
  std::vector<std::array<double, 3>> row;
  for (int i = 0; i < 20; ++i)
  {
    row.push_back({ i < 10 ? i : 10.0 + 3 * (i - 9), 0, 0 });
  }
  Svg svg(shapes(row, Cells::Verts));
  svg.Writer->SetWidth(410); // from -0.5 to 40.5
  const std::string text = svg.Written(checks, __LINE__);
  CHECK(checks, countOf(text, "r=\"5\"") == 20);

  // One dot alone, and all at one place, are there, too.
  for (const std::size_t count : { 1, 3 })
  {
    Svg alone(shapes(std::vector<std::array<double, 3>>(count, { 1, 2, 3 }), Cells::Verts));
    CHECK(checks,
      countOf(alone.Written(checks, __LINE__), "<circle cx=\"50\" cy=\"50\" r=\"50\"/>") ==
        static_cast<int>(count));
  }
}

void checkRadii(Checks& checks)
{
  const auto data = shapes(corners, Cells::Verts);
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("Size");
  for (const double radius : { 1.0, 0.0, 2.0, 3.0 })
  {
    radii->InsertNextValue(radius);
  }
  data->GetPointData()->AddArray(radii);
  Svg svg(data);
  svg.Writer->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Size");
  svg.Writer->SetWidth(25); // from 7 to 32
  const std::string text = svg.Written(checks, __LINE__);
  expectParts(checks, text, { "r=\"1\"", "r=\"2\"", "r=\"3\"", "cx=\"3\"" }, __LINE__);
  CHECK(checks, countOf(text, "<circle") == 3); // nothing is drawn without an area
}

// Bytes are colours as they are, on points and on cells; greys and black are not written twice.
void checkColours(Checks& checks)
{
  const auto data = shapes(corners, Cells::Verts);
  data->GetPointData()->AddArray(bytes("Rgb", 3, { 255, 0, 0, 0, 128, 255, 0, 0, 0, 10, 10, 10 }));
  data->GetCellData()->AddArray(
    bytes("Rgba", 4, { 255, 0, 0, 255, 0, 0, 0, 51, 1, 2, 3, 0, 9, 8, 7, 255 }));
  Svg svg(data);
  svg.Writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Rgb");
  std::string text = svg.Written(checks, __LINE__);
  expectParts(
    checks, text, { "fill=\"#ff0000\"/>", "fill=\"#0080ff\"/>", "fill=\"#0a0a0a\"/>" }, __LINE__);
  CHECK(checks, countOf(text, "fill=\"#000000\"") == 1); // of the group

  svg.Writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Rgba");
  text = svg.Written(checks, __LINE__);
  expectParts(checks, text, { "fill=\"#ff0000\"/>", " fill-opacity=\"0.2\"/>" }, __LINE__);
}

// Others by the table, with the table's colour for what is not a number.
void checkTable(Checks& checks)
{
  const auto data = shapes(corners, Cells::Verts);
  vtkNew<vtkDoubleArray> values;
  values->SetName("Value");
  for (const double value : { 0.0, 1.0, 2.0, std::nan("") })
  {
    values->InsertNextValue(value);
  }
  data->GetPointData()->AddArray(values);
  Svg svg(data);
  svg.Writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Value");
  expectParts(checks, svg.Written(checks, __LINE__), { "fill=\"#ff0000\"", "fill=\"#0000ff\"" },
    __LINE__); // VTK's own from red to blue

  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(2);
  table->SetTableRange(0.5, 1.5);
  table->SetTableValue(0, 0, 1, 0);
  table->SetTableValue(1, 1, 1, 1);
  table->SetNanColor(0, 0, 1, 1);
  table->BuildSpecialColors();
  svg.Writer->SetLookupTable(table);
  const std::string text = svg.Written(checks, __LINE__);
  expectParts(checks, text, { "fill=\"#00ff00\"", "fill=\"#0000ff\"" }, __LINE__);
  CHECK(checks, countOf(text, "fill=\"#ffffff\"") == 2);
}

// Vectors of bits are vectors of these numbers.
void checkBits(Checks& checks)
{
  const auto data = shapes(corners, Cells::Verts);
  vtkNew<vtkBitArray> bits;
  vtkNew<vtkDoubleArray> doubles;
  for (vtkDataArray* array :
    { static_cast<vtkDataArray*>(bits.Get()), static_cast<vtkDataArray*>(doubles.Get()) })
  {
    array->SetName(array == bits.Get() ? "Bits" : "Doubles");
    array->SetNumberOfComponents(3);
    for (const int count : { 0, 1, 2, 3 })
    {
      array->InsertNextTuple3(count > 0, count > 1, count > 2);
    }
    data->GetPointData()->AddArray(array);
  }
  Svg svg(data);
  svg.Writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Bits");
  const std::string text = svg.Written(checks, __LINE__);
  svg.Writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Doubles");
  CHECK(checks, svg.Written(checks, __LINE__) == text);
}

// A polygon is outlined without colours and filled with them, in the mean colour of its points; a
// line has a colour for each segment.
void checkPolygonsAndLines(Checks& checks)
{
  const std::vector<unsigned char> colours = { 0, 0, 0, 100, 0, 0, 100, 0, 0, 0, 200, 0 };
  const auto polygon = shapes(corners, Cells::Polygon);
  Svg outlined(polygon);
  outlined.Writer->SetLineWidth(2);
  outlined.Writer->SetWidth(22);
  expectParts(checks, outlined.Written(checks, __LINE__),
    { "fill=\"none\"", "<polygon points=\"1,11 21,11 21,1 1,1\"/>" }, __LINE__);

  polygon->GetPointData()->AddArray(bytes("Rgb", 3, colours));
  Svg filled(polygon);
  filled.Writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Rgb");
  filled.Writer->SetWidth(20);
  const std::string text = filled.Written(checks, __LINE__);
  expectParts(
    checks, text, { "<polygon points=\"0,10 20,10 20,0 0,0\" fill=\"#323200\"/>" }, __LINE__);
  CHECK(checks, !contains(text, "stroke-width"));

  const auto line = shapes(corners, Cells::Line);
  line->GetPointData()->AddArray(bytes("Rgb", 3, colours));
  Svg path(line);
  path.Writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Rgb");
  expectParts(checks, path.Written(checks, __LINE__),
    { "stroke=\"#320000\"", "stroke=\"#640000\"", "stroke=\"#326400\"" }, __LINE__);
}

// Polygons of one colour that follow each other are one area, all turned the same way, so that no
// seams show; transparent ones are not, as they count where they overlap.
void checkAreas(Checks& checks)
{
  const auto two = shapes(corners, Cells::Polygon);
  vtkNew<vtkCellArray> cells;
  for (const std::array<vtkIdType, 3>& triangle :
    { std::array<vtkIdType, 3>{ 0, 1, 2 }, { 0, 3, 2 }, { 0, 1, 3 } })
  {
    cells->InsertNextCell(3, triangle.data());
  }
  two->SetPolys(cells);
  for (const unsigned char opacity : { std::uint8_t{ 255 }, std::uint8_t{ 128 } })
  {
    two->GetCellData()->Initialize();
    two->GetCellData()->AddArray(
      bytes("Rgba", 4, { 9, 0, 0, opacity, 9, 0, 0, opacity, 0, 9, 0, opacity }));
    Svg svg(two);
    svg.Writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Rgba");
    svg.Writer->SetWidth(20);
    const std::string text = svg.Written(checks, __LINE__);
    if (opacity == 255)
    {
      expectParts(checks, text,
        { "<path d=\"M0,10 20,10 20,0zM0,10 20,0 0,0z\" fill=\"#090000\"/>",
          "<polygon points=\"0,10 20,10 0,0\" fill=\"#000900\"/>" },
        __LINE__);
    }
    else
    {
      CHECK(checks, countOf(text, "<polygon") == 3);
    }
  }
}

// What is later lies on top: polygons, lines, dots; and the blocks of a composite data set in their
// order. An array that only one of them has colours only this one.
void checkOrder(Checks& checks)
{
  const auto dots = shapes(corners, Cells::Verts);
  dots->GetCellData()->AddArray(bytes("Rgb", 3, { 255, 0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0 }));
  const auto mixed = shapes(corners, Cells::Polygon);
  mixed->SetLines(shapes(corners, Cells::Line)->GetLines());
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, dots);
  blocks->SetBlock(2, mixed);
  Svg svg(blocks);
  svg.Writer->SetPointRadius(1);
  svg.Writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Rgb");
  const std::string text = svg.Written(checks, __LINE__);
  CHECK(checks, text.find("<circle") < text.find("<polygon"));
  CHECK(checks, text.find("<polygon") < text.find("<polyline"));
  CHECK(checks, countOf(text, "#ff0000") == 4);

  blocks->SetBlock(0, mixed);
  blocks->SetBlock(2, dots);
  const std::string turned = svg.Written(checks, __LINE__);
  CHECK(checks, turned.find("<circle") > turned.find("<polyline"));
}

// Ghosts are left out.
void checkGhosts(Checks& checks)
{
  const auto data = shapes(corners, Cells::Verts);
  const std::string name = vtkDataSetAttributes::GhostArrayName();
  data->GetPointData()->AddArray(
    bytes(name.c_str(), 1, { 0, vtkDataSetAttributes::DUPLICATEPOINT, 0, 0 }));
  data->GetCellData()->AddArray(
    bytes(name.c_str(), 1, { 0, 0, vtkDataSetAttributes::HIDDENCELL, 0 }));
  Svg svg(data);
  CHECK(checks, countOf(svg.Written(checks, __LINE__), "<circle") == 2);
}

// One group a value, from the least to the greatest; shapes without a value lie below.
void checkLayers(Checks& checks)
{
  const auto dots = shapes(corners, Cells::Verts);
  vtkNew<vtkDoubleArray> numbers;
  vtkNew<vtkStringArray> texts;
  numbers->SetName("Pen");
  texts->SetName("Ink");
  for (const double value : { 10.0, 2.0, -3.0, 10.0 })
  {
    numbers->InsertNextValue(value);
    texts->InsertNextValue(value > 0.0 ? "a<b" : "a");
  }
  dots->GetCellData()->AddArray(numbers);
  dots->GetPointData()->AddArray(texts);
  const auto paper = shapes(corners, Cells::Polygon);
  vtkNew<vtkMultiBlockDataSet> both;
  both->SetBlock(0, dots);
  both->SetBlock(1, paper);
  Svg svg(both);
  svg.Writer->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Pen");
  std::string text = svg.Written(checks, __LINE__);
  const std::string layer = "inkscape:groupmode=\"layer\" inkscape:label=\"";
  std::size_t last = text.find("<polygon");
  for (const char* label : { "Pen -3", "Pen 2", "Pen 10" })
  {
    const std::size_t at = text.find(layer + label + "\">\n");
    checks.That(at != std::string::npos && at > last, label, __LINE__, text);
    last = at;
  }
  CHECK(checks, countOf(text, layer) == 3 && countOf(text, "<circle") == 4);
  CHECK(checks, countOf(text.substr(last), "<circle") == 2);
  CHECK(checks, countOf(text, "<g ") == countOf(text, "</g>"));

  svg.Writer->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Ink");
  svg.Writer->SetPageBounds(10, 30, 5, 20, 0, 0);
  svg.Writer->SetPageMargin(10);
  text = svg.Written(checks, __LINE__);
  expectParts(checks, text,
    { "inkscape:label=\"Ink a\" clip-path=\"url(#inside)\">",
      "inkscape:label=\"Ink a&#60;b\" clip-path=\"url(#inside)\">" },
    __LINE__);
  CHECK(checks, countOf(text, layer) == 2 && countOf(text, "<circle") == 4);
  CHECK(checks, countOf(text, "clip-path=\"url") == 3); // of the polygon below, too
}

// A whole outline belongs to a layer, and filled ones, too.
void checkLayersOfLines(Checks& checks)
{
  std::vector<std::array<double, 3>> ring = corners;
  ring.push_back(corners[0]);
  const auto lines = shapes(ring, Cells::Line);
  lines->GetLines()->InsertNextCell({ 0, 1, 2, 0 });
  lines->GetCellData()->AddArray(bytes("Land", 1, { 7, 5 }));
  Svg svg(lines);
  svg.Writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Land");
  svg.Writer->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Land");
  svg.Writer->SetFillOutlines(true);
  const std::string text = svg.Written(checks, __LINE__);
  const std::size_t first = text.find("inkscape:label=\"Land 5\"");
  const std::size_t second = text.find("inkscape:label=\"Land 7\"");
  checks.That(first < second && second != std::string::npos, "in order", __LINE__, text);
  for (const std::string& part : { text.substr(first, second - first), text.substr(second) })
  {
    checks.That(countOf(part, "<polygon") == 2, "an area and its outline", __LINE__, part);
  }
}

// LineWidth 0: a quarter of the median edge on the page, from 0.05 to 0.25.
void checkLineWidth(Checks& checks)
{
  for (const auto& [segments, width] : { std::pair<int, const char*>{ 10, "0.25" }, { 100, "0.25" },
         { 200, "0.125" }, { 400, "0.0625" }, { 1000, "0.05" } })
  {
    std::vector<std::array<double, 3>> row{ { 0, 0, 0 } };
    for (int i = 0; i < segments; ++i)
    {
      row.push_back({ 1.0 + i, 0, 0 });
    }
    for (const Cells cells : { Cells::Line, Cells::Polygon })
    {
      Svg svg(shapes(row, cells));
      checks.That(svg.Writer->GetLineWidth() == 0.0, "automatic at first", __LINE__);
      const std::string part = std::string("stroke-width=\"") + width + "\"";
      expectParts(checks, svg.Written(checks, __LINE__), { part.c_str() }, __LINE__);
    }
  }
  // Filled polygons have no lines, so that their edges do not count.
  const auto line = shapes({ { 0, 0, 0 }, { 50, 0, 0 }, { 100, 0, 0 } }, Cells::Line);
  const auto area = shapes({ { 0, 0, 0 }, { 0.1, 0, 0 }, { 0.1, 0.1, 0 } }, Cells::Polygon);
  area->GetCellData()->AddArray(bytes("Rgb", 3, { 1, 2, 3 }));
  vtkNew<vtkMultiBlockDataSet> both;
  both->SetBlock(0, line);
  both->SetBlock(1, area);
  Svg svg(both);
  svg.Writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Rgb");
  expectParts(checks, svg.Written(checks, __LINE__), { "stroke-width=\"0.25\"" }, __LINE__);
}

// A decimal comma of the user's language is in no file.
void checkLocale(Checks& checks)
{
  for (const char* name : { "de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8" })
  {
    if (std::setlocale(LC_ALL, name))
    {
      Svg svg(shapes({ { 0, 0, 0 }, { 1, 0.3, 0 } }, Cells::Line));
      CHECK(checks, contains(svg.Written(checks, __LINE__), "stroke-width=\"0.25\""));
    }
  }
  std::setlocale(LC_ALL, "C");
}

// The same data give the same bytes; PDF's table of objects says where they are.
void checkPdf(Checks& checks)
{
  const TemporaryFile file("test.pdf");
  const auto data = shapes(corners, Cells::Verts);
  data->GetPointData()->AddArray(
    bytes("Rgba", 4, { 255, 0, 0, 255, 0, 0, 0, 51, 1, 2, 3, 0, 9, 8, 7, 255 }));
  vtkNew<vtkTransportPDFWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(file.Name().c_str());
  writer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Rgba");
  writer->SetWidth(254);
  CHECK(checks, writer->Write() == 1);
  const std::string text = file.Text();
  CHECK(checks, contains(text, "/MediaBox [0 0 720 ")); // 10 inches
  CHECK(checks, contains(text, "/Opacity51 << /ca 0.2 /CA 0.2 >>"));
  const std::size_t table = text.rfind("xref\n", text.rfind("startxref") - 1);
  CHECK(checks, contains(text, "startxref\n" + std::to_string(table) + "\n%%EOF"));
  std::istringstream entries(text.substr(table));
  std::string word;
  int count = 0;
  entries >> word >> word >> count >> word >> word >> word; // xref 0 count, object 0
  for (int object = 1; object < count; ++object)
  {
    std::size_t offset = 0;
    entries >> offset >> word >> word;
    const std::string begin = std::to_string(object) + " 0 obj\n";
    checks.That(text.compare(offset, begin.size(), begin) == 0, begin.c_str(), __LINE__);
  }
  CHECK(checks, count > 5);
  CHECK(checks, writer->Write() == 1);
  CHECK(checks, file.Text() == text);
}

} // namespace

int TestVectorWriters(int, char*[])
{
  return runChecks({ checkPage, checkPageBounds, checkAxes, checkRadiusFromSpacing, checkRadii,
    checkColours, checkTable, checkBits, checkPolygonsAndLines, checkAreas, checkOrder, checkGhosts,
    checkLayers, checkLayersOfLines, checkLineWidth, checkLocale, checkPdf });
}
