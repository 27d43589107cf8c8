// SPDX-License-Identifier: BSD-3-Clause
#include "Input.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>
#include <array>

namespace Campaign
{

namespace
{

using Corners = std::vector<vtkIdType>;

struct Disk
{
  std::vector<std::array<double, 3>> Points;
  std::vector<Corners> Faces;
  std::vector<Corners> Strips;
  std::vector<vtkIdType> Boundary; // in order
};

// Squares, each as a quad or as two triangles, at times as strips of a row.
Disk makeSheet(RandomSource& random, int columns, int rows)
{
  Disk disk;
  const std::int64_t cut = random.Whole(0, 3); // 0 quads, 1 strips
  const double steepness = random.Of({ 0.0, 0.2, 0.2, cut == 0 ? 0.2 : 2.0 });
  const vtkIdType width = columns + 1;
  for (int y = 0; y <= rows; ++y)
  {
    Corners strip;
    for (int x = 0; x <= columns; ++x)
    {
      disk.Points.push_back(
        { static_cast<double>(x), static_cast<double>(y), steepness * random.Unit() });
      const vtkIdType i = x + y * width;
      strip.insert(strip.end(), { i, i + width });
      if (x == columns || y == rows || cut == 1)
      {
        continue;
      }
      if (cut == 0)
      {
        disk.Faces.push_back({ i, i + 1, i + width + 1, i + width });
      }
      else
      {
        disk.Faces.push_back({ i, i + 1, i + width + 1 });
        disk.Faces.push_back({ i, i + width + 1, i + width });
      }
    }
    if (cut == 1 && y < rows)
    {
      disk.Strips.push_back(strip);
    }
  }
  const vtkIdType last = width * (rows + 1) - 1;
  for (vtkIdType x = 0; x < columns; ++x)
  {
    disk.Boundary.push_back(x);
  }
  for (vtkIdType y = 0; y < rows; ++y)
  {
    disk.Boundary.push_back(columns + y * width);
  }
  for (vtkIdType x = 0; x < columns; ++x)
  {
    disk.Boundary.push_back(last - x);
  }
  for (vtkIdType y = rows; y > 0; --y)
  {
    disk.Boundary.push_back(y * width);
  }
  return disk;
}

// Triangles about a point: all around it, or about a corner of the boundary.
Disk makeFan(int triangles, bool closed)
{
  Disk disk;
  disk.Points.push_back({ 0.0, 0.0, 0.5 });
  const int rim = triangles + (closed ? 0 : 1);
  for (int i = 0; i < rim; ++i)
  {
    // The rational points of a circle.
    const double turn = (i + 0.5) / rim;
    const double t = (2.0 * turn - 1.0) / (4.0 * turn * (1.0 - turn));
    disk.Points.push_back({ (1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t), 0.0 });
    disk.Boundary.push_back(i + 1);
  }
  for (int i = 0; i < triangles; ++i)
  {
    disk.Faces.push_back({ 0, i + 1, (i + 1) % rim + 1 });
  }
  if (!closed)
  {
    disk.Boundary.push_back(0);
  }
  return disk;
}

Disk drawShape(RandomSource& random)
{
  switch (random.Whole(0, 4))
  {
    case 0:
      return makeFan(static_cast<int>(random.Whole(4, 30)), true);
    case 1:
      return makeFan(static_cast<int>(random.Whole(2, 12)), false);
    default:
      return makeSheet(
        random, static_cast<int>(random.Whole(1, 12)), static_cast<int>(random.Whole(1, 10)));
  }
}

Corners& drawFace(RandomSource& random, Disk& disk)
{
  auto& faces = disk.Faces.empty() ? disk.Strips : disk.Faces;
  return faces[static_cast<std::size_t>(
    random.Whole(0, static_cast<std::int64_t>(faces.size()) - 1))];
}

void drawDefect(RandomSource& random, Disk& disk, Input& input)
{
  const auto drawn = [&]() {
    return static_cast<std::size_t>(
      random.Whole(0, static_cast<std::int64_t>(disk.Points.size()) - 1));
  };
  Corners& face = drawFace(random, disk);
  const auto defect = random.Whole(0, 8);
  input.Describe("defect " + std::to_string(defect));
  State state = State::Faulty;
  switch (defect)
  {
    case 0: // a face less: maybe a hole, maybe another disk with points that it does not use
      face.resize(2);
      state = State::Odd;
      break;
    case 1: // one face the other way
      std::reverse(face.begin(), face.end());
      state = disk.Faces.empty() ? State::Odd : State::Sound;
      break;
    case 2: // a face twice
      disk.Faces.push_back({ face[0], face[1], face[2] });
      state = State::Odd;
      break;
    case 3:
      disk.Points[drawn()] = { drawExceptional(random), 0.0, drawExceptional(random) };
      state = State::Odd;
      break;
    case 4: // two points in one place
      disk.Points[drawn()] = disk.Points[drawn()];
      state = State::Odd;
      break;
    case 5: // huge or tiny
    {
      const double factor = random.Of({ 1e150, 1e-150, 1e300, 1e-300, 5e-324, 1e12 });
      for (auto& x : disk.Points)
      {
        x = { x[0] * factor, x[1] * factor, x[2] * factor };
      }
      state = State::Odd;
      break;
    }
    case 6:
      disk.Faces.clear();
      disk.Strips.clear();
      break;
    case 7:
      disk.Points.push_back({ 1e6, -1e6, 0.0 });
      state = State::Sound; // left out
      break;
    default: // another component, far from all points of the first
    {
      const auto first = static_cast<vtkIdType>(disk.Points.size());
      disk.Points.insert(disk.Points.end(), { { 99, 0, 0 }, { 99, 1, 0 }, { 99, 0, 1 } });
      disk.Faces.push_back({ first, first + 1, first + 2 });
      break;
    }
  }
  input.Worsen(state);
}

vtkSmartPointer<vtkCellArray> cellsOf(const std::vector<Corners>& faces)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const Corners& face : faces)
  {
    cells->InsertNextCell(static_cast<vtkIdType>(face.size()), face.data());
  }
  return cells;
}

// Vertices and lines beside the disk, and arrays of all.
void drawOthers(RandomSource& random, vtkPolyData* data, Input& input)
{
  if (random.Chance(0.2))
  {
    data->SetVerts(cellsOf({ { 0 }, { 1, 0 } }));
  }
  if (random.Chance(0.2))
  {
    data->SetLines(cellsOf({ { 0, 1, 2 } }));
  }
  if (random.Chance(0.4))
  {
    std::string text;
    const auto array = drawArray(random, data->GetNumberOfPoints(), 2, text);
    array->SetName(random.Of({ "Own", "Conformal", "AreaPreserving", "AreaPreservingExact" }));
    data->GetPointData()->AddArray(array);
    if (random.Chance(0.5))
    {
      data->GetPointData()->SetActiveTCoords(array->GetName());
    }
    input.Describe(std::string("points have ") + array->GetName());
  }
  if (random.Chance(0.4))
  {
    const bool isShort = random.Chance(0.1);
    std::string text;
    const auto array = drawArray(random, data->GetNumberOfCells() - (isShort ? 1 : 0), 1, text);
    array->SetName(random.Of({ "Own", "Flipped", "AreaDistortion" }));
    data->GetCellData()->SetScalars(array);
    input.Worsen(isShort ? State::Odd : State::Sound); // an error where polygons are cut
    input.Describe(std::string("cells have ") + array->GetName());
  }
}

} // namespace

Input drawDisk(RandomSource& random, std::vector<vtkIdType>& boundary)
{
  Input input;
  Disk disk = drawShape(random);
  boundary = disk.Boundary;
  if (random.Chance(0.3))
  {
    drawDefect(random, disk, input);
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(random.Of({ VTK_DOUBLE, VTK_FLOAT }));
  data->SetPoints(points);
  if (random.Chance(0.02))
  {
    input.Condition = State::Empty;
    input.Describe("none of");
  }
  else
  {
    for (const auto& x : disk.Points)
    {
      points->InsertNextPoint(x.data());
    }
    data->SetPolys(cellsOf(disk.Faces));
    data->SetStrips(cellsOf(disk.Strips));
    drawOthers(random, data, input);
  }
  input.Describe(std::to_string(disk.Points.size()) + " points, " +
    std::to_string(disk.Faces.size()) + " faces, " + std::to_string(disk.Strips.size()) +
    " strips");
  input.Data = data;
  return input;
}

} // namespace Campaign
