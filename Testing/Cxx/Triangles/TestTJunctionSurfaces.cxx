// SPDX-License-Identifier: BSD-3-Clause
// Surfaces with T-junctions in the filters that take surfaces: they are closed, with a warning that
// counts them, and particles and cells are those of the input.
#include "HangingNodes.h"
#include "ParameterizationTest.h"

#include "vtkCleanPolyData.h"
#include "vtkDelaunay3D.h"
#include "vtkGeometryFilter.h"
#include "vtkImageData.h"
#include "vtkSolidDensity.h"
#include "vtkSurfaceSampler.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <string>

namespace
{

std::string closedText(int count)
{
  return std::to_string(count) + (count == 1 ? " T-junction closed" : " T-junctions closed");
}

void expectWarning(Checks& checks, const Messages& messages, const std::string& text, int line)
{
  checks.That(messages.Errors.empty(), "no error", line);
  const bool isThere = std::any_of(
    messages.Warnings.begin(), messages.Warnings.end(), [&](const std::string& warning) {
      return contains(warning, "The input surface was repaired: ") && contains(warning, text);
    });
  checks.That(isThere, "repaired", line, text);
}

double solidVolume(
  Checks& checks, vtkPolyData* surface, int count, int line, const std::string& gap = "")
{
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(surface);
  solid->SetResolution(24);
  Messages messages(solid);
  solid->Update();
  expectWarning(checks, messages, closedText(count) + gap, line);
  checks.That(messages.Warnings.size() == 1, "one warning", line);
  const bool gapes = contains(messages.Warnings.front(), "gape");
  checks.That(gapes == !gap.empty(), "gaps", line);
  vtkImageData* image = solid->GetOutput();
  const double* spacing = image->GetSpacing();
  vtkDataArray* density = image->GetCellData()->GetArray("Density");
  density = density ? density : image->GetPointData()->GetArray("Density");
  return sumOf(arrayValues(density)) * spacing[0] * spacing[1] * spacing[2];
}

void checkSolid(Checks& checks)
{
  for (const int ratio : { 2, 4 })
  {
    for (const bool triangles : { true, false })
    {
      auto cube = makeRefinedCube(4, ratio, triangles);
      const int count = 16 * (ratio - 1);
      CHECK_NEAR(checks, solidVolume(checks, cube, count, __LINE__), 1.0, 1e-12);
      CHECK_NEAR(checks, solidVolume(checks, farAway(cube), count, __LINE__), 1e9, 3e4);
    }
  }
}

// Particles lie on the cells that they name, and have the values of these there, whatever those of
// the points on their sides are.
void checkParticles(Checks& checks, vtkPolyData* surface, int count, int method, int line)
{
  constexpr vtkIdType particles = 3000;
  auto wild = vtkSmartPointer<vtkPolyData>::New();
  wild->DeepCopy(surface);
  vtkNew<vtkDoubleArray> values; // linear on the coarse half, all else on the fine one
  values->SetName("Values");
  const vtkIdType coarse = 7 * 7;
  for (vtkIdType i = 0; i < wild->GetNumberOfPoints(); ++i)
  {
    double x[3];
    wild->GetPoint(i, x);
    values->InsertNextValue(i < coarse ? x[0] + 2.0 * x[1] : 100.0);
  }
  wild->GetPointData()->AddArray(values);
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetInputData(wild);
  sampler->SetMethod(method);
  sampler->SetNumberOfParticles(particles);
  Messages messages(sampler);
  sampler->Update();
  expectWarning(checks, messages, closedText(count), line);
  vtkPolyData* output = sampler->GetOutput();
  checks.That(output->GetNumberOfPoints() == particles, "particles", line);
  const Values cells = arrayValues(output->GetPointData()->GetArray("CellId"));
  checks.That(
    cells == arrayValues(output->GetPointData()->GetArray("Cell")), "data of their cells", line);
  const Values found = arrayValues(output->GetPointData()->GetArray("Values"));
  double worst = 0.0;
  double outside = 0.0;
  std::size_t below = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    double x[3];
    output->GetPoint(static_cast<vtkIdType>(i), x);
    double bounds[6];
    wild->GetCellBounds(static_cast<vtkIdType>(cells[i]), bounds);
    outside =
      std::max({ outside, bounds[0] - x[0], x[0] - bounds[1], bounds[2] - x[1], x[1] - bounds[3] });
    const bool isBelow = bounds[3] <= 0.5;
    below += isBelow ? 1 : 0;
    worst = std::max(worst, std::abs(found[i] - (isBelow ? x[0] + 2.0 * x[1] : 100.0)));
  }
  checks.That(worst < 1e-12, "values of their cells", line, std::to_string(worst));
  checks.That(outside < 1e-12, "on their cells", line);
  checks.That(std::abs(static_cast<double>(below) - 0.5 * particles) < 0.02 * particles,
    "as many on both halves", line, std::to_string(below));
}

// A density on points, which is threefold on the fine half: the coarse one, up to the line, has a
// fourth of the mass.
void checkDensity(Checks& checks, vtkPolyData* surface, int method, int line)
{
  constexpr vtkIdType particles = 3000;
  vtkNew<vtkPolyData> dense;
  dense->ShallowCopy(surface);
  vtkNew<vtkDoubleArray> density;
  density->SetName("Density");
  for (vtkIdType i = 0; i < dense->GetNumberOfPoints(); ++i)
  {
    density->InsertNextValue(i < 7 * 7 ? 1.0 : 3.0);
  }
  dense->GetPointData()->AddArray(density);
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetInputData(dense);
  sampler->SetMethod(method);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  sampler->SetNumberOfParticles(particles);
  sampler->Update();
  const Values points = coordinates(sampler->GetOutput());
  double below = 0.0;
  for (std::size_t i = 1; i < points.size(); i += 3)
  {
    below += points[i] < 0.5 ? 1.0 : 0.0;
  }
  checks.That(
    std::abs(below - 0.25 * particles) < 0.01 * particles, "a fourth", line, std::to_string(below));
  checks.That(std::abs(fieldValue(sampler->GetOutput(), "TotalMass") - 2.0) < 1e-12, "mass", line);
}

void checkSampler(Checks& checks)
{
  for (const int ratio : { 2, 4 })
  {
    for (const bool triangles : { true, false })
    {
      auto square = makeRefinedSquare(6, ratio, triangles);
      checkParticles(checks, square, 6 * (ratio - 1), vtkSurfaceSampler::RELAXATION, __LINE__);
      checkParticles(checks, square, 6 * (ratio - 1), vtkSurfaceSampler::FLOW, __LINE__);
      checkDensity(checks, square, vtkSurfaceSampler::RELAXATION, __LINE__);
      checkDensity(checks, square, vtkSurfaceSampler::FLOW, __LINE__);
    }
  }
  // Nothing is wrong with seams, points of no polygon and polygons that end in a point.
  auto cube = makeRefinedCube(4, 1, false);
  cube->GetPoints()->InsertNextPoint(0.5, 0.5, 0.5);
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetInputData(cube);
  Messages messages(sampler);
  sampler->Update();
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

// Areas are kept, and each cell of the input is its parts in the output.
void checkMap(Checks& checks, vtkPolyData* surface, int count, int seams, int line)
{
  auto filter = makeParameterization(surface);
  filter->SetSeams(seams);
  filter->SetResolution(256);
  Messages messages(filter);
  filter->Update();
  expectWarning(checks, messages, closedText(count), line);
  vtkPolyData* output = filter->GetOutput();
  const vtkIdType given = surface->GetNumberOfPoints();
  checks.That(output->GetNumberOfPoints() >= given, "points", line);
  double worst = 0.0;
  for (vtkIdType i = 0; i < given; ++i)
  {
    double x[3];
    double y[3];
    surface->GetPoint(i, x);
    output->GetPoint(i, y);
    worst =
      std::max({ worst, std::abs(x[0] - y[0]), std::abs(x[1] - y[1]), std::abs(x[2] - y[2]) });
  }
  checks.That(worst == 0.0, "the points of the input first", line);
  const Figures figures = figuresOf(filter);
  checks.That(sumOf(figures.Flipped) == 0.0, "no flips", line);
  Values areas = figures.Area;
  for (double& area : areas)
  {
    area = std::abs(area - 1.0);
  }
  std::sort(areas.begin(), areas.end());
  checks.That(areas[areas.size() * 95 / 100] < 0.05, "areas", line,
    std::to_string(areas[areas.size() * 95 / 100]));
  if (seams == Parameterization::SEAMS_NONE)
  {
    expectFigures(checks, filter, line);
  }
  // Cells in their order; triangles have no others' points on their sides.
  const Values cells = cellValues(filter, "Cell");
  checks.That(std::is_sorted(cells.begin(), cells.end()), "order of cells", line);
  checks.That(
    static_cast<vtkIdType>(cells.back()) == surface->GetNumberOfCells() - 1 && cells.front() == 0.0,
    "all cells", line);
  checks.That(static_cast<vtkIdType>(cells.size()) ==
      count + (surface->GetCell(0)->GetNumberOfPoints() == 3 ? 1 : 2) * surface->GetNumberOfCells(),
    "a part more for each T-junction", line);
}

void checkParameterization(Checks& checks)
{
  for (const int ratio : { 2, 4 })
  {
    for (const bool triangles : { true, false })
    {
      auto square = makeRefinedSquare(6, ratio, triangles);
      const int count = 6 * (ratio - 1);
      checkMap(checks, square, count, Parameterization::SEAMS_NONE, __LINE__);
      checkMap(checks, square, count, Parameterization::SEAMS_AUTO, __LINE__);
      auto cube = makeRefinedCube(4, ratio, triangles);
      checkMap(checks, cube, 16 * (ratio - 1), Parameterization::SEAMS_AUTO, __LINE__);
      checkMap(checks, farAway(cube), 16 * (ratio - 1), Parameterization::SEAMS_AUTO, __LINE__);
    }
  }
}

// The cube with the points that its top alone has moved up.
vtkSmartPointer<vtkPolyData> makeGapingCube(double gap)
{
  auto cube = makeRefinedCube(4, 2, true);
  vtkPoints* points = cube->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double x[3];
    points->GetPoint(i, x);
    if (x[2] == 1.0 &&
      (4.0 * x[0] != std::floor(4.0 * x[0]) || 4.0 * x[1] != std::floor(4.0 * x[1])))
    {
      points->SetPoint(i, x[0], x[1], 1.0 + gap);
    }
  }
  return cube;
}

// Points beside the edges by much more than rounding: they are part of the solid if they are near,
// else it is refused, and what the message says leads to one.
void checkGaps(Checks& checks)
{
  for (const double gap : { 2e-6, 1e-4, 9e-3 })
  {
    // Of the 64 squares at the top, 64 points are up, and one lies on an edge.
    std::ostringstream text;
    text << " that gape by up to " << gap;
    auto gaping = makeGapingCube(gap);
    const double volume = solidVolume(checks, gaping, 16, __LINE__, text.str());
    CHECK(checks, volume > 1.0 && volume < 1.0 + gap);
  }
  auto cube = makeGapingCube(0.02);
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(cube);
  solid->SetResolution(24);
  ErrorTest(checks, solid)
    .Expect("has 48 open edges and 0 non-manifold edges; every edge must be", __LINE__);
  vtkNew<vtkDelaunay3D> hull;
  hull->SetInputData(cube);
  vtkNew<vtkGeometryFilter> skin;
  skin->SetInputConnection(hull->GetOutputPort());
  solid->SetInputConnection(skin->GetOutputPort());
  Messages messages(solid);
  solid->Update();
  CHECK(checks, messages.Errors.empty() && solid->GetOutput()->GetNumberOfPoints() > 0);
  // Others take it, with its boundary.
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetInputData(cube);
  sampler->Update();
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 8192);
}

// Strips of a millionth of the width: right in all filters, or what helps is said.
void checkNeedles(Checks& checks)
{
  constexpr double width = 1e-6;
  const Values ticks{ 0.0, width, 0.25, 0.5, 0.5 + width, 0.75, 1.0 - width, 1.0 };
  vtkNew<vtkAppendPolyData> sheets;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double level : { 0.0, 1.0 })
    {
      sheets->AddInputData(makeSheet(7, 7, [&](double u, double v) {
        std::array<double, 3> x;
        x[axis] = level;
        x[(axis + 1) % 3] = ticks[static_cast<std::size_t>(u)];
        x[(axis + 2) % 3] = ticks[static_cast<std::size_t>(v)];
        return x;
      }));
    }
  }
  auto needles = numbered(sheets);
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(needles);
  solid->SetResolution(24);
  Messages ofSolid(solid);
  solid->Update();
  CHECK(checks, ofSolid.Errors.empty() && ofSolid.Warnings.empty());
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetInputData(needles);
  Messages ofSampler(sampler);
  sampler->Update();
  CHECK(checks, ofSampler.Errors.empty() && ofSampler.Warnings.empty());
  const auto flippedAfter = [&](vtkPolyData* surface, bool isAdvised) {
    auto filter = makeParameterization(surface);
    Messages messages(filter);
    filter->Update();
    CHECK(checks, messages.Errors.empty());
    const bool isSaid = std::any_of(
      messages.Warnings.begin(), messages.Warnings.end(), [](const std::string& warning) {
        return contains(
          warning, "needles, lower than 0.0001 of the length: Clean with a Tolerance");
      });
    CHECK(checks, isSaid == isAdvised);
    return fieldValue(filter->GetOutput(), "FlippedCount");
  };
  CHECK(checks, flippedAfter(needles, true) > 0.0);
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(needles);
  clean->ToleranceIsAbsoluteOn();
  clean->SetAbsoluteTolerance(1e-5);
  clean->Update();
  CHECK(checks, flippedAfter(clean->GetOutput(), false) == 0.0);
}

} // namespace

int TestTJunctionSurfaces(int, char*[])
{
  Checks checks;
  checkSolid(checks);
  checkSampler(checks);
  checkParameterization(checks);
  checkGaps(checks);
  checkNeedles(checks);
  return checks.Result();
}
