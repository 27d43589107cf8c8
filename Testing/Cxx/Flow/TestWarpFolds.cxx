// SPDX-License-Identifier: BSD-3-Clause
// FoldedCells of vtkDensityEqualizingWarp: cells of all types and their measures, turned over by
// hand and by too few steps, in all kinds of data sets; ghosts; the warning.
#include "WarpTest.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Flow/DensityEqualizingWarp.h"

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

// What is found where each point x is moved.
template <class Move>
InvertedCells movedBy(vtkPointSet* before, int dimension, const Move& move)
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
  return countInvertedCells(grid, before, after, progress);
}

// The two counts of it.
template <class Move>
std::array<std::int64_t, 2> turnedBy(vtkPointSet* before, int dimension, const Move& move)
{
  const InvertedCells found = movedBy(before, dimension, move);
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

Corners prism(int sides, double height)
{
  Corners corners;
  for (const double z : { 0.0, height })
  {
    for (int i = 0; i < sides; ++i)
    {
      const double angle = 2.0 * std::acos(-1.0) * i / sides;
      corners.push_back({ std::cos(angle), std::sin(angle), z });
    }
  }
  return corners;
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
  // Their points on edges are anywhere, except those of polygons, which must not cross themselves.
  Corners all = quad;
  all.insert(all.end(), { { 8, 8, 1 }, { 3, 3, 1 }, { -4, 1, 0 }, { 9, 1, 7 } });
  checkCell(checks, VTK_QUADRATIC_QUAD, all, 2, __LINE__);
  checkCell(checks, VTK_QUADRATIC_TRIANGLE, { quad[0], quad[1], quad[2], all[5], all[6], all[7] },
    2, __LINE__);
  const Corners round = { { 1, 2, 0 }, { 2, 2.5, 0 }, { 2.5, 4, 0 }, { 0.5, 3, 0 }, { 1.5, 2, 0 },
    { 2.5, 3, 0 }, { 1.5, 4, 0 }, { 0.5, 2.5, 0 } };
  checkCell(checks, VTK_QUADRATIC_POLYGON, round, 2, __LINE__);

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
    checkCell(checks, sides == 5 ? VTK_PENTAGONAL_PRISM : VTK_HEXAGONAL_PRISM, prism(sides, 1.5), 3,
      __LINE__);
  }
  Corners quadratic = hexahedron;
  const std::array<std::size_t, 2> edges[] = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 4, 5 },
    { 5, 6 }, { 6, 7 }, { 7, 4 }, { 0, 4 }, { 1, 5 }, { 2, 6 }, { 3, 7 } };
  for (const auto& [a, b] : edges)
  {
    const auto &p = hexahedron[a], &q = hexahedron[b];
    quadratic.push_back({ 0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]) + 0.1, 0.5 * (p[2] + q[2]) });
  }
  checkCell(checks, VTK_QUADRATIC_HEXAHEDRON, quadratic, 3, __LINE__);
}

// Lengths, areas along z, and volumes; those of mirrored cells are twice as large.
void checkMeasures(Checks& checks)
{
  constexpr double cells[] = { 0.0, 0.5, 0.125, 0.25 }; // the size of a cell of the density
  const auto check = [&](
                       int type, const Corners& corners, int dimension, double measure, int line) {
    const auto grid = makeCell(type, corners);
    const InvertedCells found = movedBy(grid, dimension, [](double* x) { x[0] *= -2.0; });
    const std::string name = "a cell of type " + std::to_string(type);
    checks.That(found.Inverted == 1 && found.All == 1, name.c_str(), line);
    const double moved = 2.0 * measure / cells[dimension];
    checks.Near(found.Area.Value(), moved, 1e-13 * moved, name.c_str(), line);
    checks.That(found.InvertedArea.Value() == found.Area.Value(), name.c_str(), line);
  };
  check(VTK_LINE, { { 1, 0, 0 }, { 1.5, 7, 7 } }, 1, 0.5, __LINE__);
  check(VTK_POLY_LINE, { { 1, 0, 0 }, { 1.5, 7, 7 }, { 3, 0, 7 } }, 1, 2.0, __LINE__);
  const Corners box = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 0, 1, 0 }, { 0, 0, 3 },
    { 2, 0, 3 }, { 2, 1, 3 }, { 0, 1, 3 } };
  check(VTK_TRIANGLE, { box[0], box[1], box[6] }, 2, 1.0, __LINE__);
  check(VTK_QUAD, { box[0], box[1], box[6], box[7] }, 2, 2.0, __LINE__);
  check(VTK_PIXEL, { box[0], box[1], box[3], box[2] }, 2, 2.0, __LINE__);
  check(VTK_TRIANGLE_STRIP, { box[0], box[1], box[3], box[2] }, 2, 2.0, __LINE__);
  check(VTK_POLYGON, { box[0], box[1], { 0.5, 0.5, 0 }, box[3] }, 2, 0.75, __LINE__);
  check(VTK_TETRA, { box[0], box[1], box[3], box[4] }, 3, 1.0, __LINE__);
  check(VTK_HEXAHEDRON, box, 3, 6.0, __LINE__);
  check(VTK_VOXEL, { box[0], box[1], box[3], box[2], box[4], box[5], box[7], box[6] }, 3, 6.0,
    __LINE__);
  check(VTK_PYRAMID, { box[0], box[1], box[2], box[3], box[4] }, 3, 2.0, __LINE__);
  check(VTK_WEDGE, { box[0], box[1], box[3], box[4], box[5], box[7] }, 3, 3.0, __LINE__);
  check(VTK_PENTAGONAL_PRISM, prism(5, 1.0), 3, 2.5 * std::sin(0.4 * std::acos(-1.0)), __LINE__);
  check(VTK_HEXAGONAL_PRISM, prism(6, 1.0), 3, 1.5 * std::sqrt(3.0), __LINE__);
}

// One line of a polyline, or one triangle of a strip, is enough.
void checkPieces(Checks& checks)
{
  const std::array<std::int64_t, 2> turned = { 1, 1 };
  const auto move = [](double* x) { x[0] = x[0] > 2.5 ? 0.5 : x[0]; };
  CHECK(checks,
    turnedBy(makeCell(VTK_POLY_LINE, { { 0, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 } }), 1, move) ==
      turned);
  const Corners strip = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, { 3, 0.25, 0 } };
  CHECK(checks, turnedBy(makeCell(VTK_TRIANGLE_STRIP, strip), 2, move) == turned);
}

// A cube with a notch in its top.
void checkPolyhedron(Checks& checks)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (const auto& x : Corners{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
         { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 }, { 0.5, 0.5, 0.25 }, { 9, 9, 9 } })
  {
    points->InsertNextPoint(x.data());
  }
  grid->SetPoints(points);
  const vtkIdType faces[] = { 4, 0, 3, 2, 1, 4, 0, 1, 5, 4, 4, 1, 2, 6, 5, 4, 2, 3, 7, 6, 4, 3, 0,
    4, 7, 3, 4, 5, 8, 3, 5, 6, 8, 3, 6, 7, 8, 3, 7, 4, 8 };
  const vtkIdType ids[] = { 0, 1, 2, 3, 4, 5, 6, 7, 8 };
  grid->InsertNextCell(VTK_POLYHEDRON, 9, ids, 9, faces);
  for (const double factor : { 0.5, -0.5 })
  {
    const InvertedCells found = movedBy(grid, 3, [=](double* x) { x[2] *= factor; });
    CHECK(checks, found.All == 1);
    CHECK(checks, found.Inverted == (factor < 0.0 ? 1 : 0));
    CHECK_NEAR(checks, found.Area.Value(), 0.5 * 0.75 / 0.25, 1e-13);
  }
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
  return runChecks({ checkTypes, checkMeasures, checkPieces, checkPolyhedron, checkEdgeOn,
    checkFilter, checkVolumes });
}
