// SPDX-License-Identifier: BSD-3-Clause
// How vtkSolidDensity runs: in a pipeline, the same bits on any number of threads, progress, an
// abort, and what it says of wrong input.
#include "BlocksTest.h"
#include "ProgressTest.h"
#include "SolidTest.h"
#include "ThreadsTest.h"

#include "vtkContourFilter.h"
#include "vtkFeatureEdges.h"
#include "vtkImageShiftScale.h"
#include "vtkMultiBlockDataGroupFilter.h"
#include "vtkPlaneSource.h"

#include <limits>

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// Filters that follow take the image as it is, though its size depends on the surface.
void checkPipeline(Checks& checks)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkTransform> transform;
  vtkNew<vtkTransformPolyDataFilter> stretch;
  stretch->SetTransform(transform);
  stretch->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputConnection(stretch->GetOutputPort());
  solid->SetResolution(24);
  vtkNew<vtkImageShiftScale> twice;
  twice->SetInputConnection(solid->GetOutputPort());
  twice->SetScale(2.0);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(solid->GetOutputPort());
  contour->SetValue(0, 0.5);
  for (const double scale : { 1.0, 0.3, 4.0 })
  {
    transform->Scale(1.0, scale, 1.0);
    twice->Update();
    vtkImageData* image = twice->GetOutput();
    const std::vector<double> values = densityOf(solid);
    CHECK(checks, image->GetNumberOfPoints() == static_cast<vtkIdType>(values.size()));
    CHECK(checks, image->GetDimensions()[1] == solid->GetOutput()->GetDimensions()[1]);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      CHECK(checks,
        image->GetPointData()->GetScalars()->GetTuple1(static_cast<vtkIdType>(i)) == 2 * values[i]);
    }
    contour->Update();
    CHECK_NEAR(checks, volumeOf(contour->GetOutput()), massOf(solid), 0.05 * massOf(solid));
    vtkNew<vtkFeatureEdges> edges;
    edges->SetInputConnection(contour->GetOutputPort());
    edges->FeatureEdgesOff();
    edges->Update();
    CHECK(checks, edges->GetOutput()->GetNumberOfCells() == 0); // the margin is empty
  }
  solid->SetAssociationToCells();
  solid->Update();
  CHECK(checks, solid->GetOutput()->GetPointData()->GetNumberOfArrays() == 0);
  // Field data are passed on, other arrays are not.
  auto box = makeBox(0, 1, 0, 1, 0, 1);
  vtkNew<vtkDoubleArray> own;
  own->SetName("Own");
  own->InsertNextValue(5.0);
  box->GetFieldData()->AddArray(own);
  solid->SetInputData(box);
  solid->Update();
  CHECK(checks, solid->GetOutput()->GetFieldData()->GetArray("Own") == own);
}

// Image filters downstream have nothing to do where there is no surface, and no shape of one.
void checkNoSurface(Checks& checks)
{
  vtkNew<vtkSolidDensity> solid;
  vtkNew<vtkPolyData> none;
  solid->SetInputData(none);
  vtkNew<vtkImageShiftScale> twice;
  twice->SetInputConnection(solid->GetOutputPort());
  twice->Update();
  CHECK(checks, twice->GetOutput()->GetNumberOfPoints() == 0);
}

// A block at a time, with an image for each.
void checkBlocks(Checks& checks)
{
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(makeBlocks({ makeBox(0, 1, 0, 1, 0, 1), makeSphere(9, 9, 9, 2.0) }));
  solid->SetResolution(12);
  solid->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(solid->GetOutputDataObject(0));
  CHECK(checks, output && output->GetNumberOfBlocks() == 2);
  for (const unsigned int block : { 0u, 1u })
  {
    auto* image = outputBlock<vtkImageData>(solid, block);
    CHECK(checks, image && image->GetNumberOfPoints() == 12 * 12 * 12);
  }
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkMultiBlockDataGroupFilter> group; // what makes the blocks is in the pipeline
  group->AddInputConnection(sphere->GetOutputPort());
  group->AddInputConnection(sphere->GetOutputPort());
  solid->SetInputConnection(group->GetOutputPort());
  for (const double radius : { 0.5, 3.0 })
  {
    sphere->SetRadius(radius);
    solid->Update();
    auto* image = outputBlock<vtkImageData>(solid, 1);
    CHECK(checks, image && image->GetNumberOfPoints() == 12 * 12 * 12);
    CHECK_NEAR(checks, image ? image->GetSpacing()[0] : 0.0, radius * 2.2 / 12, 1e-6);
  }
}

void checkThreads(Checks& checks)
{
  // Stretched, with points that coincide, polygons that are turned and parts that overlap.
  auto surface = together(makeSphere(0, 0, 0, 1.0, 90), turned(makeSphere(0.5, 1.1, 0.3, 1.0, 70)));
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(surface);
  solid->SetResolution(70);
  solid->SetSupersampling(3);
  const auto run = [&](int threading) {
    solid->SetThreading(threading);
    solid->Modified();
    return runSolid(solid);
  };
  CHECK(checks, expectSameBits(checks, run, __LINE__).size() > 100000);
}

void checkAborts(Checks& checks)
{
  auto surface = makeSphere(0, 0, 0, 1.0, 500);
  vtkNew<vtkSolidDensity> solid;
  Messages messages(solid);
  solid->SetInputData(surface);
  solid->SetResolution(200);
  solid->SetSupersampling(8);
  const auto outdate = [&]() { solid->Modified(); };
  for (const double from : { 0.001, 0.1, 0.15, 0.3, 0.39, 0.45, 0.5, 0.55, 0.8 })
  {
    checkAbort(checks, solid, from, outdate, __LINE__);
  }
  checkAbort(checks, solid, 0.51, outdate, __LINE__, 20);
  ProgressTest progress(solid);
  solid->Modified();
  CHECK(checks, !runSolid(solid).empty());
  progress.ExpectRising(checks, 11, __LINE__);
  CHECK(checks, messages.Errors.empty());
}

// In vtkTriangleFilter, which has much to cut.
void checkAbortAmongPolygons(Checks& checks)
{
  vtkNew<vtkPlaneSource> plane; // of quads, not closed
  plane->SetResolution(700, 700);
  plane->Update();
  vtkNew<vtkSolidDensity> solid;
  Messages messages(solid);
  solid->SetInputConnection(plane->GetOutputPort());
  checkAbort(
    checks, solid, 0.05, [&]() { solid->Modified(); }, __LINE__);
  CHECK(checks, messages.Errors.empty());
  solid->Modified();
  solid->Update();
  CHECK(checks, messages.IsOneError("2800 open edges"));
}

void checkPropertyErrors(Checks& checks)
{
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(makeBox(0, 1, 0, 1, 0, 1));
  solid->SetResolution(0);
  ErrorTest(checks, solid).Expect("Resolution is 0; it must be from 1 to 1073741824", __LINE__);
  solid->SetResolution(-7);
  ErrorTest(checks, solid).Expect("Resolution is -7; it must be from 1", __LINE__);
  solid->SetResolution(1 << 30);
  ErrorTest(checks, solid)
    .Expect("Not enough memory for a density of 1073741824 x 1073741824 x 1073741824 "
            "cells (see Resolution)",
      __LINE__);
  solid->SetResolution(8);
  solid->SetSupersampling(0);
  ErrorTest(checks, solid).Expect("Supersampling is 0; it must be from 1 to 16", __LINE__);
  solid->SetSupersampling(17);
  ErrorTest(checks, solid).Expect("Supersampling is 17; it must be from 1 to 16", __LINE__);
  solid->SetSupersampling(2);
  for (const double padding : { -0.1, nan, infinity })
  {
    solid->SetPadding(padding);
    std::ostringstream text;
    text << "Padding is " << padding << "; it must be 0 or a positive number";
    ErrorTest(checks, solid).Expect(text.str(), __LINE__);
  }
  solid->SetPadding(1e308);
  ErrorTest(checks, solid).Expect("Padding is 1e+308 and the input's longest side 1", __LINE__);
  solid->SetPadding(0.1);
  solid->SetAssociation(2);
  ErrorTest(checks, solid).Expect("Association is 2; it must be 0 (Points) or 1 (Cells)", __LINE__);
  solid->SetAssociation(0);
  solid->SetThreading(4);
  ErrorTest(checks, solid).Expect("Threading is 4; it must be 0 (Auto)", __LINE__);
  solid->SetThreading(0);
  Messages messages(solid);
  CHECK(checks, runSolid(solid).size() == 512);
  CHECK(checks, messages.Errors.empty());
}

void checkSurfaceErrors(Checks& checks)
{
  vtkNew<vtkSolidDensity> solid;
  solid->SetResolution(8);
  const auto expect = [&](vtkPolyData* surface, const std::string& text, int line) {
    solid->SetInputData(surface);
    ErrorTest(checks, solid).Expect(text, line);
  };
  const std::vector<double> corners{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  const std::vector<vtkIdType> faces{ 3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3 };
  auto points = makePolyhedron(corners, {});
  expect(points, "The input surface has 4 points and no polygons; a solid needs a closed surface",
    __LINE__);
  vtkNew<vtkCellArray> lines;
  const vtkIdType line[2] = { 0, 1 };
  lines->InsertNextCell(2, line);
  points->SetLines(lines);
  points->SetVerts(lines);
  points->Modified();
  expect(points, "no polygons", __LINE__);
  expect(makePolyhedron(corners, { 3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3 }),
    "The input surface is not closed: it has 3 open edges and 0 non-manifold edges", __LINE__);
  // A polygon on an edge of others.
  auto fin = faces;
  fin.insert(fin.end(), { 3, 0, 1, 4 });
  auto more = corners;
  more.insert(more.end(), { 2, 2, 2 });
  expect(makePolyhedron(more, fin),
    "has 2 open edges and 1 non-manifold edge; every edge must be one of two triangles, or of "
    "another even number",
    __LINE__);
  auto twice = faces;
  twice.insert(twice.end(), { 3, 0, 1, 2, 3, 0, 3, 1, 3, 1, 3, 2, 3, 2, 3, 0 });
  expect(makePolyhedron(corners, twice),
    "The input surface has each polygon twice, in opposite directions, so that nothing is inside",
    __LINE__);
  // Points that differ by more than rounding are two.
  auto split = corners;
  split.insert(split.end(), { 2e-8, 0, 0 });
  expect(makePolyhedron(split, { 3, 4, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3 }),
    "has 4 open edges and 0 non-manifold edges", __LINE__);
  auto wrong = corners;
  wrong[4] = nan;
  wrong[9] = -infinity;
  expect(makePolyhedron(wrong, faces),
    "The input surface has 2 points that are NaN or infinite, the first at index 1", __LINE__);
  expect(makePolyhedron(corners, { 3, 0, 2, 1, 3, 0, 1, 17 }),
    "of the input surface has the point 17; there are points 0 to 3", __LINE__);
  expect(makePolyhedron(corners, { 3, 0, 2, 1, 3, 0, 1, 4 }),
    "has the point 4; there are points 0 to 3", __LINE__);
  expect(makePolyhedron(corners, { 4, 0, 1, -2, 1 }), "has the point -2", __LINE__);
  expect(makePolyhedron({ 1, 1, 1, 1, 1, 1, 2, 2, 2 }, { 3, 0, 1, 2, 3, 0, 2, 1 }),
    "The input surface has 3 points and no polygon of three different ones", __LINE__);
  expect(makePolyhedron(corners, { 2, 0, 1 }), "no polygon of three different ones", __LINE__);
  expect(makePolyhedron({ 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 1.5, 0, 0 }, { 5, 0, 1, 2, 3, 4 }),
    "has 5 open edges", __LINE__);
  expect(makeBox(1e15, 1e15 + 2, 0, 1, 0, 1), "makes cells of 0.275 for coordinates of up to 1e+15",
    __LINE__);
  auto large = corners;
  large[3] = 1e308;
  large[6] = -1e308;
  large[0] = -1e308;
  expect(makePolyhedron(large, faces), "the box around it must have finite sides", __LINE__);
}

// A surface of one side, that passes through itself.
void checkKleinBottle(Checks& checks)
{
  constexpr int around = 24;
  constexpr int across = 20;
  const double turn = 2.0 * std::acos(-1.0);
  std::vector<double> points;
  std::vector<vtkIdType> faces;
  for (int i = 0; i < around; ++i)
  {
    for (int j = 0; j < across; ++j)
    {
      const double u = turn * i / around;
      const double v = turn * j / across;
      const double r =
        3.0 + std::cos(0.5 * u) * std::sin(v) - std::sin(0.5 * u) * std::sin(2.0 * v);
      points.insert(points.end(),
        { r * std::cos(u), r * std::sin(u),
          std::sin(0.5 * u) * std::sin(v) + std::cos(0.5 * u) * std::sin(2.0 * v) });
      const int next = i + 1 == around ? 0 : (i + 1) * across;
      const auto column = [i](
                            int k) { return i + 1 == around ? (across - k) % across : k % across; };
      faces.insert(faces.end(),
        { 4, i * across + j, next + column(j), next + column(j + 1),
          i * across + (j + 1) % across });
    }
  }
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(makePolyhedron(points, faces));
  ErrorTest(checks, solid).Expect("The input surface is not orientable", __LINE__);
}

void checkEmpty(Checks& checks)
{
  vtkNew<vtkSolidDensity> solid;
  Messages messages(solid);
  solid->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  solid->Update();
  CHECK(checks, solid->GetOutput() && solid->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(checks, messages.Errors.empty());
}

} // namespace

int TestSolidRun(int, char*[])
{
  return runChecks({ checkPipeline, checkNoSurface, checkBlocks, checkThreads, checkAborts,
    checkAbortAmongPolygons, checkPropertyErrors, checkSurfaceErrors, checkKleinBottle,
    checkEmpty });
}
