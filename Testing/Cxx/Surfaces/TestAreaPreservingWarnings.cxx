// SPDX-License-Identifier: BSD-3-Clause
// Surfaces whose areas the map does not reach, or hardly: of few triangles, with teeth, with peaks,
// nearly closed; and what is said of them.
#include "ParameterizationTest.h"

#include <algorithm>

namespace
{

// Two and three triangles, one cell of the grid, and points of single precision.
void checkSmall(Checks& checks)
{
  auto two = makePolygons({ 0, 0, 7, 3, 0, 7, 3, 1, 7, 0, 1, 7 }, { 3, 0, 1, 2, 3, 0, 2, 3 });
  auto filter = makeParameterization(two);
  Messages messages(filter);
  filter->Update();
  CHECK(checks, fieldValue(filter->GetOutput(), "AreaDistortionRMS") < 1e-12);
  CHECK(checks, fieldValue(filter->GetOutput(), "FlippedCount") == 0.0);
  expectFigures(checks, filter, __LINE__);
  filter->SetInputData(makeHills(6, 6));
  filter->SetResolution(1);
  filter->Update();
  CHECK(checks, fieldValue(filter->GetOutput(), "AreaDistortionRMS") < 0.05);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());

  messages.Clear();
  // Edges from one point: its two neighbours and the other corners.
  filter->SetInputData(makePolygons(
    { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -0.5, 0.5, 0 }, { 3, 0, 1, 2, 3, 0, 2, 3, 3, 0, 3, 4 }));
  filter->Update();
  CHECK(checks, squareValues(filter).size() == 10);
  expectFigures(checks, filter, __LINE__);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 1);
  CHECK(checks,
    contains(messages.Warnings[0], "0 of 3 triangles are flipped and 95 % of the area is within "));

  auto single = makePoints(coordinates(makeHills(6, 6)), true);
  single->SetPolys(makeHills(6, 6)->GetPolys());
  filter->SetInputData(single);
  filter->Update();
  CHECK(checks, filter->GetOutput()->GetPoints()->GetDataType() == VTK_FLOAT);
  CHECK(checks,
    vtkDoubleArray::SafeDownCast(
      filter->GetOutput()->GetPointData()->GetArray("AreaPreservingExact")));
}

// A strip with teeth, more than the square has corners: some have no area.
void checkTeeth(Checks& checks)
{
  auto filter = makeParameterization(makeTeeth());
  Messages messages(filter);
  filter->Update();
  CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 2);
  for (const char* part : { " of 24 triangles have all points on one side of the square and so no "
                            "area there; subdivide the surface, or give Corners",
         " of 24 triangles are flipped and 95 % of the area is within " })
  {
    const auto hasPart = [part](const std::string& text) { return contains(text, part); };
    CHECK(checks, std::any_of(messages.Warnings.begin(), messages.Warnings.end(), hasPart));
  }
  const Values flipped = cellValues(filter, "Flipped");
  CHECK(checks, sumOf(flipped) >= 4.0 && sumOf(flipped) < 24.0);
  expectFigures(checks, filter, __LINE__);
  // The paper's method is not expected to reach the areas, only not to flip.
  messages.Clear();
  filter->SetInputData(makeHills(4, 4));
  filter->PolishOff();
  filter->Update();
  CHECK(checks, messages.Warnings.empty());
}

// The flow alone turns one of the triangles about a peak over, and says so.
void checkPeak(Checks& checks)
{
  auto filter = makeParameterization(makeSheet(6, 6, [](double x, double y) {
    return std::array<double, 3>{ x, y, x == 2.0 && y == 1.0 ? 6.0 : 0.0 };
  }));
  Messages messages(filter);
  filter->PolishOff();
  filter->Update();
  expectFigures(checks, filter, __LINE__);
  CHECK(checks, sumOf(cellValues(filter, "Flipped")) == 1.0);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 1);
  CHECK(checks, contains(messages.Warnings[0], "1 of 72 triangles are flipped and 95 % of the "));
  CHECK(checks, contains(messages.Warnings[0], "Polish is off"));
}

// A sphere without a small cap.
void checkNearlyClosed(Checks& checks)
{
  auto filter = makeParameterization(makeCap(24, 0.97));
  filter->SetResolution(256);
  Messages messages(filter);
  CHECK(checks, isInSquare(runSquare(filter)));
  expectFigures(checks, filter, __LINE__);
  CHECK(checks, messages.Errors.empty());
  const bool reached = fieldValue(filter->GetOutput(), "FlippedCount") == 0.0 &&
    fieldValue(filter->GetOutput(), "AreaDistortionRMS") < 0.05;
  CHECK(checks, reached == messages.Warnings.empty());
  // Without the polish the flow leaves flipped triangles, and says so.
  filter->PolishOff();
  filter->SetResolution(16);
  filter->Update();
  const double flipped = fieldValue(filter->GetOutput(), "FlippedCount");
  CHECK(checks, messages.Warnings.size() == (flipped > 0.0 ? 1 : 0));
}

} // namespace

int TestAreaPreservingWarnings(int, char*[])
{
  return runChecks({ checkSmall, checkTeeth, checkPeak, checkNearlyClosed });
}
