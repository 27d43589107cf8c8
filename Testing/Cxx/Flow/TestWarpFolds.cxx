// SPDX-License-Identifier: BSD-3-Clause
// FoldedCells of vtkDensityEqualizingWarp: cells of all types, turned over by hand and by too few
// steps, in all kinds of data sets; ghosts; the warning.
#include "WarpTest.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Flow/MeshInversion.h"

#include "vtkCellType.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkIdList.h"
#include "vtkPlaneSource.h"
#include "vtkStripper.h"
#include "vtkStructuredGrid.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

namespace
{
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

using Corners = std::vector<std::array<double, 3>>;

vtkSmartPointer<vtkUnstructuredGrid> makeCell(int type, const Corners& corners)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIdList> ids;
  for (const auto& corner : corners)
  {
    ids->InsertNextId(points->InsertNextPoint(corner.data()));
  }
  grid->SetPoints(points);
  grid->InsertNextCell(type, ids);
  return grid;
}

// The two counts, where each point x is moved.
template <class Move>
std::array<std::int64_t, 2> turnedBy(vtkPointSet* before, int dimension, const Move& move)
{
  auto after = vtkSmartPointer<vtkPointSet>::Take(before->NewInstance());
  after->DeepCopy(before);
  for (vtkIdType i = 0; i < after->GetNumberOfPoints(); ++i)
  {
    double x[3];
    after->GetPoint(i, x);
    move(x);
    after->GetPoints()->SetPoint(i, x);
  }
  auto image = makeImage(
    10, dimension > 1 ? 8 : 1, dimension > 2 ? 6 : 1, true, [](vtkIdType) { return 1.0; });
  image->SetOrigin(11.0, -7.0, 0.5);
  image->SetSpacing(0.5, 0.25, 2.0);
  const ImageGrid grid = gridOf(image, false);
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  const InvertedCells found = countInvertedCells(grid, before, after, progress);
  return { found.Inverted, found.All };
}

void checkCell(Checks& checks, int type, const Corners& corners, int dimension, int line)
{
  const auto grid = makeCell(type, corners);
  const std::string name = "a cell of type " + std::to_string(type);
  const auto expect = [&](const auto& move, std::int64_t turned, int at) {
    const auto found = turnedBy(grid, dimension, move);
    checks.That(found[0] == turned && found[1] == 1, name.c_str(), line,
      std::to_string(at) + ": " + std::to_string(found[0]) + " of " + std::to_string(found[1]));
  };
  expect([](double*) {}, 0, __LINE__);
  expect(
    [](double* x) {
      x[0] = 0.1 * x[0] + 3.0;
      x[1] += 0.5 * x[0];
    },
    0, __LINE__);
  expect([](double* x) { x[0] = 4.0 - x[0]; }, 1, __LINE__);
  expect([](double* x) { x[0] = 4.0; }, 1, __LINE__); // to nothing
  // Cells of fewer or more dimensions do not count.
  for (const int other : { 1, 2, 3 })
  {
    if (other != dimension)
    {
      const auto found = turnedBy(grid, other, [](double* x) { x[0] = 4.0 - x[0]; });
      checks.That(found[0] == 0 && found[1] == 0, name.c_str(), line, "in another dimension");
    }
  }
}

void checkTypes(Checks& checks)
{
  const Corners line = { { 1, 2, 3 }, { 2, 4, 1 } };
  checkCell(checks, VTK_LINE, line, 1, __LINE__);
  checkCell(checks, VTK_QUADRATIC_EDGE, { line[0], line[1], { 0, 0, 0 } }, 1, __LINE__);
  checkCell(
    checks, VTK_LAGRANGE_CURVE, { line[0], line[1], { 9, 0, 0 }, { 8, 0, 0 } }, 1, __LINE__);
  checkCell(checks, VTK_POLY_LINE, { line[0], line[1], { 3, 0, 0 } }, 1, __LINE__);

  const Corners quad = { { 1, 2, 3 }, { 2, 2.5, 1 }, { 2.5, 4, 0 }, { 0.5, 3, 9 } };
  checkCell(checks, VTK_TRIANGLE, { quad[0], quad[1], quad[2] }, 2, __LINE__);
  checkCell(checks, VTK_QUAD, quad, 2, __LINE__);
  checkCell(checks, VTK_PIXEL, { { 1, 1, 0 }, { 2, 1, 0 }, { 1, 2, 0 }, { 2, 2, 0 } }, 2, __LINE__);
  checkCell(
    checks, VTK_POLYGON, { quad[0], quad[1], quad[2], { 1.5, 4, 0 }, quad[3] }, 2, __LINE__);
  checkCell(
    checks, VTK_TRIANGLE_STRIP, { quad[0], quad[1], quad[3], quad[2], { 1, 5, 0 } }, 2, __LINE__);
  // Their points on edges are anywhere.
  Corners all = quad;
  all.insert(all.end(), { { 8, 8, 1 }, { 3, 3, 1 }, { -4, 1, 0 }, { 9, 1, 7 } });
  checkCell(checks, VTK_QUADRATIC_QUAD, all, 2, __LINE__);
  checkCell(checks, VTK_QUADRATIC_POLYGON, all, 2, __LINE__);
  checkCell(checks, VTK_QUADRATIC_TRIANGLE, { quad[0], quad[1], quad[2], all[5], all[6], all[7] },
    2, __LINE__);

  const Corners hexahedron = { { 0, 0, 0 }, { 1, 0.1, 0 }, { 1.2, 1, 0 }, { 0, 1, 0.3 },
    { 0, 0, 1 }, { 1, 0, 1.4 }, { 1, 1, 1 }, { 0.2, 1, 1 } };
  checkCell(checks, VTK_HEXAHEDRON, hexahedron, 3, __LINE__);
  checkCell(checks, VTK_VOXEL,
    { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 2, 0 }, { 1, 2, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 0, 2, 1 },
      { 1, 2, 1 } },
    3, __LINE__);
  checkCell(
    checks, VTK_TETRA, { hexahedron[0], hexahedron[1], hexahedron[2], hexahedron[6] }, 3, __LINE__);
  checkCell(checks, VTK_WEDGE,
    { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1.5 }, { 0, 1, 1 } }, 3,
    __LINE__);
  checkCell(checks, VTK_PYRAMID,
    { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.3, 0.2, 2 } }, 3, __LINE__);
  for (const int sides : { 5, 6 })
  {
    Corners prism;
    for (const double z : { 0.0, 1.5 })
    {
      for (int i = 0; i < sides; ++i)
      {
        prism.push_back({ std::cos(6.2832 * i / sides), std::sin(6.2832 * i / sides), z });
      }
    }
    checkCell(checks, sides == 5 ? VTK_PENTAGONAL_PRISM : VTK_HEXAGONAL_PRISM, prism, 3, __LINE__);
  }
  Corners quadratic = hexahedron;
  quadratic.resize(20, { 7, 7, 7 });
  checkCell(checks, VTK_QUADRATIC_HEXAHEDRON, quadratic, 3, __LINE__);
}

void checkPolyhedron(Checks& checks)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (const auto& x : Corners{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 9, 9, 9 } })
  {
    points->InsertNextPoint(x.data());
  }
  grid->SetPoints(points);
  const vtkIdType faces[] = { 3, 0, 2, 1, 3, 0, 1, 3, 3, 0, 3, 2, 3, 1, 2, 3 };
  const vtkIdType ids[] = { 0, 1, 2, 3 };
  grid->InsertNextCell(VTK_POLYHEDRON, 4, ids, 4, faces);
  const auto turned = [&](double factor) {
    return turnedBy(grid, 3, [=](double* x) { x[2] *= factor; });
  };
  CHECK(checks, (turned(0.5) == std::array<std::int64_t, 2>{ 0, 1 }));
  CHECK(checks, (turned(-0.5) == std::array<std::int64_t, 2>{ 1, 1 }));
}

// What has no area before cannot lose it, whatever rounding says: cells edge-on, or of one point.
void checkEdgeOn(Checks& checks)
{
  const auto expectNone = [&](const Corners& corners, int line) {
    const auto found = turnedBy(makeCell(VTK_POLYGON, corners), 2, [](double* x) {
      x[0] = 0.3 * x[0] + 0.1;
      x[1] = 0.7 * x[1] - 1e3;
    });
    checks.That(found[0] == 0 && found[1] == 0, "no area", line);
  };
  expectNone({ { 0.1, 0.3, 0 }, { 0.2, 0.6, 0 }, { 0.2, 0.6, 1 }, { 0.1, 0.3, 1 } }, __LINE__);
  expectNone({ { 0.1, 1e6 + 0.3, 0 }, { 0.3, 1e6 + 0.9, 0 }, { 0.7, 1e6 + 2.1, 5 } }, __LINE__);
  expectNone({ { 0.1, 0.3, 0 }, { 0.1, 0.3, 0 }, { 0.1, 0.3, 0 } }, __LINE__);
}

double discOf(vtkIdType i, int n)
{
  const double x = (static_cast<double>(i % n) + 0.5) / n - 0.5;
  const double y = (static_cast<double>(i / n % n) + 0.5) / n - 0.5;
  return x * x + y * y < 0.03 ? 300.0 : 1.0;
}

// The quadrilaterals of a grid of points, in rows of n + 1, that turned over.
int turnedQuads(const Values& x, int n)
{
  int turned = 0;
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const auto at = [&](int p, int q) { return x.data() + 3 * ((j + q) * (n + 1) + i + p); };
      const double *a = at(0, 0), *b = at(1, 0), *c = at(1, 1), *d = at(0, 1);
      turned += (c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]) <= 0.0 ? 1 : 0;
    }
  }
  return turned;
}

void checkFilter(Checks& checks)
{
  constexpr int n = 40;
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetDensityData(makeImage(n + 1, n + 1, 1, true, [](vtkIdType i) { return discOf(i, n); }));
  warp->SetNumberOfSteps(6);
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(0, 0, 0);
  plane->SetPoint1(n, 0, 0);
  plane->SetPoint2(0, n, 0);
  plane->SetResolution(n, n);
  plane->Update();
  vtkPolyData* quads = plane->GetOutput();
  const auto folded = [&](vtkPointSet* input) {
    warp->SetInputData(input);
    warp->Update();
    return fieldValue(warp->GetOutput(), "FoldedCells");
  };
  Messages messages(warp);
  const double found = folded(quads);
  const int turned = turnedQuads(coordinates(warp->GetOutput()), n);
  CHECK(checks, turned > 20);
  CHECK_NEAR(checks, found, turned, 0.0);
  CHECK(checks, messages.Warnings.size() == 1);
  CHECK(checks,
    !messages.Warnings.empty() &&
      contains(messages.Warnings[0], (std::to_string(turned) + " of 1600 cells (").c_str()) &&
      contains(messages.Warnings[0], " %) turned over; more NumberOfSteps turn most of them back"));

  // The same grid of other types, and of single precision.
  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(n + 1, n + 1, 1);
  structured->SetPoints(quads->GetPoints());
  CHECK_NEAR(checks, folded(structured), turned, 0.0);
  vtkNew<vtkUnstructuredGrid> unstructured;
  unstructured->SetPoints(quads->GetPoints());
  unstructured->SetCells(VTK_QUAD, quads->GetPolys());
  CHECK_NEAR(checks, folded(unstructured), turned, 0.0);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(quads);
  triangles->Update();
  const double turnedTriangles = folded(triangles->GetOutput());
  CHECK(checks, turnedTriangles >= turned && turnedTriangles < 4 * turned);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(triangles->GetOutputPort());
  stripper->Update();
  const double strips = folded(stripper->GetOutput());
  CHECK(checks,
    strips > 0.0 && strips <= static_cast<double>(stripper->GetOutput()->GetNumberOfStrips()));

  // Beside lines and points, and a part of them as ghosts.
  vtkNew<vtkPolyData> mixed;
  mixed->DeepCopy(quads);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 5, 9 });
  mixed->SetLines(lines);
  CHECK_NEAR(checks, folded(mixed), turned, 0.0);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(n * n);
  ghosts->FillValue(0);
  for (int i = 0; i < n * n / 2; ++i)
  {
    ghosts->SetValue(i, vtkDataSetAttributes::DUPLICATECELL);
  }
  vtkNew<vtkPolyData> ghostly;
  ghostly->DeepCopy(quads);
  ghostly->GetCellData()->AddArray(ghosts);
  CHECK_NEAR(checks, folded(ghostly), turned / 2.0, 1.0);

  // With more steps none, with half of the way fewer; nothing moves without it.
  warp->SetBlend(0.5);
  CHECK(checks, folded(quads) < turned);
  messages.Clear();
  warp->SetBlend(0.0);
  CHECK(checks, folded(quads) == 0.0);
  warp->SetBlend(1.0);
  warp->SetNumberOfSteps(512);
  CHECK(checks, folded(quads) == 0.0);
  CHECK(checks, folded(makePoints({ 1, 1, 0, 2, 2, 0 })) == 0.0);
  CHECK(checks, messages.Warnings.empty() && messages.Errors.empty());
}

// Hexahedra and what they consist of, in a density of three axes.
void checkVolumes(Checks& checks)
{
  constexpr int n = 20;
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetDensityData(
    makeImage(n + 1, n + 1, n + 1, true, [](vtkIdType i) { return discOf(i % (n * n), n); }));
  warp->SetNumberOfSteps(4);
  vtkNew<vtkStructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < (n + 1) * (n + 1) * 3; ++i)
  {
    const int layer = (n + 1) * (n + 1);
    points->InsertNextPoint(i % (n + 1), i / (n + 1) % (n + 1), 8 + i / layer);
  }
  grid->SetDimensions(n + 1, n + 1, 3);
  grid->SetPoints(points);
  warp->SetInputData(grid);
  warp->Update();
  const double hexahedra = fieldValue(warp->GetOutput(), "FoldedCells");
  CHECK(checks, hexahedra > 10.0 && hexahedra < 2.0 * n * n);
  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputData(grid);
  warp->SetInputConnection(tetrahedra->GetOutputPort());
  warp->Update();
  const double turned = fieldValue(warp->GetOutput(), "FoldedCells");
  CHECK(checks, turned > hexahedra && turned < 12.0 * hexahedra);
  for (const int threading : { 1, 2, 3 })
  {
    warp->SetThreading(threading);
    warp->Update();
    CHECK(checks, fieldValue(warp->GetOutput(), "FoldedCells") == turned);
  }
}

} // namespace

int TestWarpFolds(int, char*[])
{
  return runChecks({ checkTypes, checkPolyhedron, checkEdgeOn, checkFilter, checkVolumes });
}
