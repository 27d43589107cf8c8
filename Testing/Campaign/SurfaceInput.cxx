// SPDX-License-Identifier: BSD-3-Clause
#include "Input.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"

#include <array>
#include <cmath>
#include <vector>

namespace Campaign
{

namespace
{

using Corners = std::vector<vtkIdType>;

struct Mesh
{
  std::vector<std::array<double, 3>> Points;
  std::vector<Corners> Faces;

  void Add(const Mesh& other)
  {
    const auto first = static_cast<vtkIdType>(this->Points.size());
    this->Points.insert(this->Points.end(), other.Points.begin(), other.Points.end());
    for (Corners face : other.Faces)
    {
      for (vtkIdType& corner : face)
      {
        corner += first;
      }
      this->Faces.push_back(face);
    }
  }
};

Mesh makeBox()
{
  return { { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 },
             { 1, 1, 1 }, { 0, 1, 1 } },
    { { 0, 3, 2, 1 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 },
      { 3, 0, 4, 7 } } };
}

Mesh makeTetrahedron()
{
  return { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
    { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 2 } } };
}

// A ring of quads over a tiling of a square whose sides are glued: a torus, with corners from
// rational points of circles.
Mesh makeTorus(int around, int across)
{
  Mesh mesh;
  const auto onCircle = [](int i, int n) {
    // t runs over the whole line; the point of the circle follows.
    const double turn = (static_cast<double>(i) + 0.5) / n; // (0,1)
    const double t = (2.0 * turn - 1.0) / (4.0 * turn * (1.0 - turn));
    return std::array<double, 2>{ (1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t) };
  };
  for (int i = 0; i < around; ++i)
  {
    for (int j = 0; j < across; ++j)
    {
      const auto u = onCircle(i, around);
      const auto v = onCircle(j, across);
      mesh.Points.push_back({ (1.0 + 0.4 * v[0]) * u[0], (1.0 + 0.4 * v[0]) * u[1], 0.4 * v[1] });
      const int ni = (i + 1) % around;
      const int nj = (j + 1) % across;
      mesh.Faces.push_back({ i * across + j, ni * across + j, ni * across + nj, i * across + nj });
    }
  }
  return mesh;
}

Mesh drawSolid(RandomSource& random)
{
  switch (random.Whole(0, 2))
  {
    case 0:
      return makeBox();
    case 1:
      return makeTetrahedron();
    default:
      return makeTorus(
        static_cast<int>(random.Whole(3, 24)), static_cast<int>(random.Whole(3, 16)));
  }
}

void place(RandomSource& random, Mesh& mesh)
{
  const double size = random.Chance(0.5) ? 1.0 : random.Real(0.1, 3.0);
  const double stretch[3] = { size, size * random.Of({ 1.0, 0.3, 2.0 }), size };
  const double shift[3] = { random.Real(-1, 1), random.Of({ 0.0, random.Real(-1, 1) }), 0.0 };
  const bool turned = random.Chance(0.5);
  for (auto& x : mesh.Points)
  {
    const double c = turned ? 0.6 : 1.0;
    const double s = turned ? 0.8 : 0.0;
    x = { c * x[0] - s * x[2], x[1], s * x[0] + c * x[2] };
    for (std::size_t a = 0; a < 3; ++a)
    {
      x[a] = x[a] * stretch[a] + shift[a];
    }
  }
}

void drawDefect(RandomSource& random, Mesh& mesh, Input& input)
{
  auto& face = mesh.Faces[static_cast<std::size_t>(
    random.Whole(0, static_cast<std::int64_t>(mesh.Faces.size()) - 1))];
  auto& point = mesh.Points[static_cast<std::size_t>(
    random.Whole(0, static_cast<std::int64_t>(mesh.Points.size()) - 1))];
  const auto defect = random.Whole(0, 8);
  input.Describe("defect " + std::to_string(defect));
  State state = State::Odd;
  switch (defect)
  {
    case 0: // a hole
      mesh.Faces.pop_back();
      state = State::Faulty;
      break;
    case 1: // one face the other way
      face = Corners(face.rbegin(), face.rend());
      break;
    case 2:
      mesh.Faces.push_back(Corners(face));
      break;
    case 3:
      point = { drawExceptional(random), point[1], drawExceptional(random) };
      break;
    case 4: // flat
      for (auto& x : mesh.Points)
      {
        x[2] = 0.0;
      }
      break;
    case 5: // huge or tiny
    {
      const double factor = random.Of({ 1e150, 1e-150, 1e300, 1e-300, 5e-324, 1e12 });
      for (auto& x : mesh.Points)
      {
        x = { x[0] * factor, x[1] * factor, x[2] * factor };
      }
      break;
    }
    case 6:
      mesh.Faces.clear();
      state = State::Faulty;
      break;
    case 7: // a face of few or of equal corners
      mesh.Faces.push_back(
        random.Chance(0.5) ? Corners{ face[0], face[1] } : Corners{ face[0], face[0], face[1] });
      break;
    default: // points that no face uses, far away
      mesh.Points.push_back({ 1e6, -1e6, 0.0 });
      break;
  }
  input.Worsen(state);
}

} // namespace

Input drawSurface(RandomSource& random)
{
  Input input;
  Mesh mesh = drawSolid(random);
  place(random, mesh);
  if (random.Chance(0.3))
  {
    Mesh other = drawSolid(random);
    place(random, other);
    mesh.Add(other);
    input.Describe("two solids");
  }
  if (random.Chance(0.2))
  {
    for (Corners& face : mesh.Faces)
    {
      face = Corners(face.rbegin(), face.rend());
    }
  }
  if (random.Chance(0.3))
  {
    drawDefect(random, mesh, input);
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(random.Of({ VTK_DOUBLE, VTK_FLOAT }));
  const bool empty = random.Chance(0.02);
  for (const auto& x : mesh.Points)
  {
    if (!empty)
    {
      points->InsertNextPoint(x.data());
    }
  }
  data->SetPoints(points);
  vtkNew<vtkCellArray> faces;
  for (const Corners& face : mesh.Faces)
  {
    if (!empty)
    {
      faces->InsertNextCell(static_cast<vtkIdType>(face.size()), face.data());
    }
  }
  data->SetPolys(faces);
  if (empty)
  {
    input.Condition = State::Empty;
  }
  input.Describe(std::to_string(mesh.Points.size()) + " points, " +
    std::to_string(mesh.Faces.size()) + " faces");
  input.Data = data;
  return input;
}

} // namespace Campaign
