// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the writers of SVG and PDF share.
#ifndef DrawingTest_h
#define DrawingTest_h

#include "Checks.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTransportPDFWriter.h"
#include "vtkTransportSVGWriter.h"
#include "vtkUnsignedCharArray.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

// A file in the folder of temporary files, which is removed at the end.
class TemporaryFile
{
public:
  explicit TemporaryFile(const std::string& name)
    : Path(std::filesystem::temp_directory_path() / ("rectifiedtransport-" + name))
  {
    std::filesystem::remove(this->Path);
  }
  ~TemporaryFile()
  {
    std::error_code ignored;
    std::filesystem::remove(this->Path, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::string Name() const { return this->Path.string(); }
  bool Exists() const { return std::filesystem::exists(this->Path); }
  // Whether this process has left a hidden part of a file beside it.
  bool HasPart() const
  {
    const std::string begin = ".rectifiedtransport-" + std::to_string(getpid()) + "-";
    const std::filesystem::directory_iterator files(this->Path.parent_path());
    return std::any_of(std::filesystem::begin(files), std::filesystem::end(files),
      [&](const auto& file) { return file.path().filename().string().rfind(begin, 0) == 0; });
  }
  std::string Text() const
  {
    std::ifstream file(this->Path, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }

private:
  std::filesystem::path Path;
};

inline int countOf(const std::string& text, const std::string& part)
{
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
  {
    ++count;
  }
  return count;
}

enum class Cells
{
  None,
  Verts,
  Line,
  Polygon
};

// Points of one cell of a kind, or vertices.
inline vtkSmartPointer<vtkPolyData> shapes(
  const std::vector<std::array<double, 3>>& points, Cells cells)
{
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> coordinates;
  coordinates->SetDataTypeToDouble();
  vtkNew<vtkCellArray> made;
  const bool isOne = cells == Cells::Line || cells == Cells::Polygon;
  if (isOne)
  {
    made->InsertNextCell(static_cast<int>(points.size()));
  }
  for (const std::array<double, 3>& point : points)
  {
    const vtkIdType id = coordinates->InsertNextPoint(point.data());
    if (isOne)
    {
      made->InsertCellPoint(id);
    }
    else if (cells == Cells::Verts)
    {
      made->InsertNextCell(1, &id);
    }
  }
  data->SetPoints(coordinates);
  if (cells == Cells::Verts)
  {
    data->SetVerts(made);
  }
  if (cells == Cells::Line)
  {
    data->SetLines(made);
  }
  if (cells == Cells::Polygon)
  {
    data->SetPolys(made);
  }
  return data;
}

inline vtkSmartPointer<vtkUnsignedCharArray> bytes(
  const char* name, int components, const std::vector<unsigned char>& values)
{
  const auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (const unsigned char value : values)
  {
    array->InsertNextValue(value);
  }
  return array;
}

// A check of the writers of both formats.
template <void (*Check)(Checks&, vtkTransportVectorWriter*)>
void ofBoth(Checks& checks)
{
  vtkNew<vtkTransportSVGWriter> svg;
  Check(checks, svg);
  vtkNew<vtkTransportPDFWriter> pdf;
  Check(checks, pdf);
}

#endif
