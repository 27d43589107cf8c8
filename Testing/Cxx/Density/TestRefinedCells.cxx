// SPDX-License-Identifier: BSD-3-Clause
// Overlapping grids of adaptive mesh refinement: cells that finer grids cover do not count, and
// what is wrong with boxes, spacings and grids is an error.
#include "../../AmrBlocks.h"
#include "MeshSampler.h"
#include "TestData.h"

#include "vtkAMRBox.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkNonOverlappingAMR.h"
#include "vtkOverlappingAMR.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredData.h"
#include "vtkUniformGrid.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace
{

// Values of 2 on cells 0 to 5 of length 1 along the axes, and of 7 on 6 fine cells from the coarse
// cell 2 on. Flat ones have cells in their boxes across the plane or the line, too, if asked for.
vtkSmartPointer<vtkOverlappingAMR> makeGrids(
  const std::array<bool, 3>& isFlat, int ratio, bool hasThickBoxes)
{
  std::array<int, 3> points;
  std::array<int, 3> high;
  for (std::size_t a = 0; a < 3; ++a)
  {
    points[a] = isFlat[a] ? 1 : 7;
    high[a] = isFlat[a] ? (hasThickBoxes ? 0 : -1) : 5;
  }
  const double zero[3] = { 0.0, 0.0, 0.0 };
  auto grids = vtkSmartPointer<vtkOverlappingAMR>::New();
  setBlocksPerLevel(grids.GetPointer(), { 1, 1 });
  grids->SetOrigin(zero);
  grids->SetGridDescription(vtkStructuredData::GetDataDescription(points.data()));
  for (int level = 0; level < 2; ++level)
  {
    const double step = level == 0 ? 1.0 : 1.0 / ratio;
    const double spacing[3] = { step, step, step };
    std::array<double, 3> origin{};
    std::array<int, 3> first{};
    std::array<int, 3> last = high;
    for (std::size_t a = 0; a < 3 && level > 0; ++a)
    {
      origin[a] = isFlat[a] ? 0.0 : 2.0;
      first[a] = isFlat[a] ? 0 : 2 * ratio;
      last[a] += first[a];
    }
    vtkNew<vtkUniformGrid> grid;
    grid->ShallowCopy(makeImage(points[0], points[1], points[2], true,
      [level](vtkIdType) { return level == 0 ? 2.0 : 7.0; }));
    grid->SetOrigin(origin.data());
    grid->SetSpacing(spacing);
    grids->SetSpacing(static_cast<unsigned int>(level), spacing);
    grids->SetAMRBox(static_cast<unsigned int>(level), 0, vtkAMRBox(first.data(), last.data()));
    grids->SetDataSet(static_cast<unsigned int>(level), 0, grid);
  }
  return grids;
}

void checkMass(Checks& checks)
{
  using Flat = std::array<bool, 3>;
  for (const Flat& isFlat : { Flat{ false, false, false }, Flat{ false, false, true },
         Flat{ false, true, false }, Flat{ true, false, false }, Flat{ false, true, true },
         Flat{ true, false, true }, Flat{ true, true, false } })
  {
    for (const int ratio : { 2, 3, 6 })
    {
      for (const bool hasThickBoxes : { false, true })
      {
        double all = 1.0;
        double covered = 1.0;
        for (const bool flat : isFlat)
        {
          all *= flat ? 1.0 : 6.0;
          covered *= flat ? 1.0 : std::min(6.0 / ratio, 4.0);
        }
        const auto grids = makeGrids(isFlat, ratio, hasThickBoxes);
        auto sampler = makeSampler(grids);
        CHECK_NEAR(checks, massOf(sampler), 2.0 * (all - covered) + 7.0 * covered, 1e-9);
        int low[3];
        int high[3];
        grids->GetAMRBox(1, 0).GetDimensions(low, high); // the input stays as it is
        for (int a = 0; a < 3; ++a)
        {
          CHECK(checks,
            high[a] ==
              (isFlat[static_cast<std::size_t>(a)] ? (hasThickBoxes ? 0 : -1) : 2 * ratio + 5));
        }
      }
    }
  }
}

// Later versions of VTK take any Cartesian grid as a block.
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_AMR_OF_CARTESIAN_GRIDS
void checkRectilinearBlock(Checks& checks)
{
  const auto grids = makeGrids({ false, false, false }, 2, false);
  vtkNew<vtkDoubleArray> places;
  for (int i = 0; i < 7; ++i)
  {
    places->InsertNextValue(i);
  }
  vtkNew<vtkRectilinearGrid> coarse;
  coarse->SetDimensions(7, 7, 7);
  coarse->SetXCoordinates(places);
  coarse->SetYCoordinates(places);
  coarse->SetZCoordinates(places);
  coarse->GetCellData()->ShallowCopy(imageAt(grids.GetPointer(), 0, 0)->GetCellData());
  grids->SetDataSet(0, 0, coarse);
  CHECK_NEAR(checks, massOf(makeSampler(grids)), 2.0 * (216 - 27) + 7.0 * 27, 1e-9);
}
#else
void checkRectilinearBlock(Checks&) {}
#endif

// Flags that a grid has stay, and those of the input are not written into.
void checkWithFlags(Checks& checks)
{
  const auto grids = makeGrids({ false, false, false }, 2, false);
  vtkImageData* coarse = imageAt(grids.GetPointer(), 0, 0);
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetNumberOfValues(coarse->GetNumberOfCells());
  flags->FillValue(0);
  flags->SetValue(0, vtkDataSetAttributes::DUPLICATECELL);
  coarse->GetCellData()->AddArray(flags);
  auto sampler = makeSampler(grids);
  CHECK_NEAR(checks, massOf(sampler), 2.0 * (216 - 27 - 1) + 7.0 * 27, 1e-9);
  CHECK(checks, flags->GetValue(2 + 6 * (2 + 6 * 2)) == 0);

  // Where boxes contradict the grids, the flags alone count.
  const int low[3] = { 4, 4, 4 };
  const int high[3] = { 10, 9, 9 };
  grids->SetAMRBox(1, 0, vtkAMRBox(low, high));
  grids->Modified();
  CHECK_NEAR(checks, massOf(sampler), 2.0 * (216 - 1) + 7.0 * 27, 1e-9);
}

void checkWithoutBoxes(Checks& checks)
{
  vtkNew<vtkOverlappingAMR> grids;
  auto sampler = makeSampler(grids);
  ErrorTest test(checks, sampler);
  test.ExpectNone(__LINE__); // nothing yet
  setBlocksPerLevel(grids.GetPointer(), { 1, 2 });
  test.Expect({ "overlapping AMR has no box for block 0 of level 0", "SetAMRBox" }, __LINE__);
  const int low[3] = { 0, 0, 0 };
  const int high[3] = { 3, 3, 3 };
  grids->SetAMRBox(0, 0, vtkAMRBox(low, high));
  grids->Modified();
  test.Expect("overlapping AMR has no spacing of level 0", __LINE__);
  const double spacing[3] = { 1.0, 1.0, 1.0 };
  grids->SetSpacing(0, spacing);
  grids->Modified();
  test.Expect("overlapping AMR has no box for block 0 of level 1", __LINE__);

  vtkNew<vtkNonOverlappingAMR> apart; // needs none
  setBlocksPerLevel(apart.GetPointer(), { 1, 2 });
  vtkNew<vtkUniformGrid> grid;
  grid->ShallowCopy(makeImage(4, 4, 4, true, [](vtkIdType) { return 1.0; }));
  apart->SetDataSet(1, 1, grid);
  sampler->SetInputDataObject(apart);
  test.ExpectNone(__LINE__);
  CHECK_NEAR(checks, massOf(sampler), 27.0, 1e-9);
}

void checkOtherGrids(Checks& checks)
{
  const std::array<bool, 3> isFlat{ false, false, true };
  const auto failureOf = [&](vtkOverlappingAMR* grids, const std::string& part, int line) {
    auto sampler = makeSampler(grids);
    ErrorTest test(checks, sampler);
    test.Expect(part, line);
  };
  auto grids = makeGrids(isFlat, 2, true);
  const int low[3] = { 4, 4, 0 };
  const int high[3] = { 10, 9, 0 };
  grids->SetAMRBox(1, 0, vtkAMRBox(low, high));
  failureOf(grids,
    "has 7 x 6 x 1 cells in the box of block 0 of level 1, but a grid of 7 x 7 x 1 points there",
    __LINE__);

  grids = makeGrids(isFlat, 2, true);
  imageAt(grids.GetPointer(), 0, 0)->SetDimensions(7, 1, 7);
  failureOf(grids,
    "has 6 x 6 x 1 cells in the box of block 0 of level 0, but a grid of 7 x 1 x 7 points there",
    __LINE__);

  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double step : { 0.0, -0.5, 0.4, 2.0, 1e-5, nan, 1e300 })
  {
    grids = makeGrids(isFlat, 2, false);
    const double spacing[3] = { 0.5, step, 0.5 };
    grids->SetSpacing(1, spacing);
    failureOf(grids, "The overlapping AMR has the spacing 1 of level 0, but", __LINE__);
  }
}

} // namespace

int TestRefinedCells(int, char*[])
{
  return runChecks(
    { checkMass, checkRectilinearBlock, checkWithFlags, checkWithoutBoxes, checkOtherGrids });
}
