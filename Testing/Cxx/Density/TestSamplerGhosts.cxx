// SPDX-License-Identifier: BSD-3-Clause
// Ghost cells and points that are duplicate or hidden carry no mass, whatever their values are.
#include "BlocksTest.h"
#include "WarpTest.h"

#include "vtkDataSetAttributes.h"
#include "vtkEqualMassCells.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace
{

constexpr unsigned char duplicateCell = vtkDataSetAttributes::DUPLICATECELL;
constexpr unsigned char hiddenCell = vtkDataSetAttributes::HIDDENCELL;
constexpr unsigned char refinedCell = vtkDataSetAttributes::REFINEDCELL;
constexpr unsigned char duplicatePoint = vtkDataSetAttributes::DUPLICATEPOINT;
constexpr unsigned char hiddenPoint = vtkDataSetAttributes::HIDDENPOINT;

vtkUnsignedCharArray* mark(
  vtkDataSetAttributes* data, vtkIdType count, const std::function<unsigned char(vtkIdType)>& flag)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    ghosts->SetValue(i, flag(i));
  }
  data->AddArray(ghosts);
  return ghosts;
}

// A density with invalid values where it is blank.
double hostile(vtkIdType i, bool blank)
{
  const double worst[] = { std::numeric_limits<double>::quiet_NaN(), -7.0,
    std::numeric_limits<double>::infinity(), 1e300 };
  return blank ? worst[i % 4] : bumpy(i);
}

void checkSame(Checks& checks, vtkDataObject* marked, vtkImageData* expected, bool invert, int line)
{
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetNumberOfParticles(400);
  sampler->SetInvertDensity(invert);
  sampler->SetInputData(marked);
  const std::vector<double> points = sampleCoordinates(sampler);
  const double mass = fieldValue(sampler->GetOutput(), "TotalMass");
  checks.That(
    messages.Errors.empty(), "no error", line, messages.Errors.empty() ? "" : messages.Errors[0]);
  sampler->SetInputData(expected);
  checks.That(sampleCoordinates(sampler) == points, "same particles", line);
  checks.That(fieldValue(sampler->GetOutput(), "TotalMass") == mass, "same mass", line);
}

void checkCells(Checks& checks, int depth)
{
  const auto flag = [](vtkIdType i) {
    return i % 5 == 1 ? duplicateCell
      : i % 7 == 2    ? hiddenCell
      : i % 11 == 3   ? refinedCell
                      : static_cast<unsigned char>(0);
  };
  const auto blank = [&](vtkIdType i) { return flag(i) != 0; };
  auto marked = makeImage(14, 9, depth, true, [&](vtkIdType i) { return hostile(i, blank(i)); });
  mark(marked->GetCellData(), marked->GetNumberOfCells(), flag);
  auto expected =
    makeImage(14, 9, depth, true, [&](vtkIdType i) { return blank(i) ? 0.0 : bumpy(i); });
  checkSame(checks, marked, expected, false, __LINE__);
  // Inverted, the largest value is that of the cells that count: 23.
  auto inverted =
    makeImage(14, 9, depth, true, [&](vtkIdType i) { return blank(i) ? 23.0 : bumpy(i); });
  checkSame(checks, marked, inverted, true, __LINE__);
}

void checkPoints(Checks& checks)
{
  const auto flag = [](vtkIdType i) {
    return i % 5 == 1 ? duplicatePoint : i % 7 == 2 ? hiddenPoint : static_cast<unsigned char>(0);
  };
  const auto blank = [&](vtkIdType i) { return flag(i) != 0; };
  auto marked = makeImage(14, 9, 1, false, [&](vtkIdType i) { return hostile(i, blank(i)); });
  mark(marked->GetPointData(), marked->GetNumberOfPoints(), flag);
  auto expected =
    makeImage(14, 9, 1, false, [&](vtkIdType i) { return blank(i) ? 0.0 : bumpy(i); });
  checkSame(checks, marked, expected, false, __LINE__);
  auto inverted =
    makeImage(14, 9, 1, false, [&](vtkIdType i) { return blank(i) ? 23.0 : bumpy(i); });
  checkSame(checks, marked, inverted, true, __LINE__);
}

// The cells that a hidden point blanks are those of vtkImageData.
void checkCellsOfHiddenPoints(Checks& checks, int ny, int nz)
{
  const auto flag = [](vtkIdType i) {
    return i % 17 == 3 ? hiddenPoint : i % 11 == 5 ? duplicatePoint : static_cast<unsigned char>(0);
  };
  const auto markBoth = [&](vtkImageData* image) {
    mark(image->GetPointData(), image->GetNumberOfPoints(), flag);
    mark(image->GetCellData(), image->GetNumberOfCells(),
      [](vtkIdType i) { return i % 13 == 4 ? hiddenCell : static_cast<unsigned char>(0); });
  };
  auto visible = makeImage(14, ny, nz, true, bumpy);
  markBoth(visible);
  const auto blank = [&](vtkIdType i) { return visible->IsCellVisible(i) == 0; };
  int blanked = 0;
  double white = 0.0; // of the others
  for (vtkIdType i = 0; i < visible->GetNumberOfCells(); ++i)
  {
    blanked += blank(i) ? 1 : 0;
    white = blank(i) ? white : std::max(white, bumpy(i));
  }
  CHECK(checks, blanked > 0 && blanked < visible->GetNumberOfCells());
  auto marked = makeImage(14, ny, nz, true, [&](vtkIdType i) { return hostile(i, blank(i)); });
  markBoth(marked);
  for (const bool invert : { false, true })
  {
    const auto expected = makeImage(14, ny, nz, true, [&](vtkIdType i) {
      return !blank(i) ? bumpy(i) : invert ? white : 0.0;
    });
    checkSame(checks, marked, expected, invert, __LINE__);
    checkSame(checks, makeTiles(marked, 5), expected, invert, __LINE__);
  }
}

// What was read before does not count: tables that are kept, or that another filter has.
void checkKeptTables(Checks& checks)
{
  auto image = makeImage(14, 9, 1, true, [](vtkIdType i) { return i == 40 ? 5000.0 : bumpy(i); });
  mark(image->GetPointData(), image->GetNumberOfPoints(),
    [](vtkIdType i) { return i == 43 ? hiddenPoint : static_cast<unsigned char>(0); });
  CHECK(checks, image->IsCellVisible(40) == 0);
  const double box[6] = { 0.5, 12.5, 0.5, 7.5, 0.0, 0.0 };
  const auto sites = makePoints(randomCoordinates(box, 12));
  const auto masses = [&](int shape, bool keepsTables, bool runsTwice) {
    vtkNew<vtkTransportSampler> other;
    other->SetInputData(image);
    other->SetInvertDensity(true);
    if (keepsTables)
    {
      other->Update();
    }
    vtkNew<vtkEqualMassCells> cells;
    cells->SetInputData(sites);
    cells->SetDomainData(image);
    cells->SetMeasure(vtkEqualMassCells::DENSITY);
    cells->SetShape(shape);
    cells->SetInvertDensity(true);
    cells->SetResolution(64);
    cells->Update();
    if (runsTwice)
    {
      cells->SetResolution(32);
      cells->Update();
      cells->SetResolution(64);
      cells->Update();
    }
    return arrayValues(cells->GetSites()->GetPointData()->GetArray("CellMass"));
  };
  for (const int shape : { vtkEqualMassCells::SHAPE_FLOW, vtkEqualMassCells::SHAPE_POWER })
  {
    const Values alone = masses(shape, false, false);
    CHECK(checks, alone.size() == 12);
    const double sum = std::accumulate(alone.begin(), alone.end(), 0.0);
    // 23 - value, in the cells that are visible.
    double expected = 0.0;
    for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
    {
      expected += image->IsCellVisible(i) ? 23.0 - bumpy(i) : 0.0;
    }
    CHECK_NEAR(checks, sum, expected, 1e-9 * expected);
    CHECK(checks, masses(shape, true, false) == alone);
    CHECK(checks, masses(shape, false, true) == alone);
  }
}

// The flags that blank a cell are those of vtkImageData: at the border of a level of refinement,
// and at the outside of the whole, cells have their mass.
void checkEveryFlag(Checks& checks)
{
  for (int bit = 1; bit < 8; ++bit) // the first is that of duplicates, which are visible
  {
    const auto flag = static_cast<unsigned char>(1 << bit);
    auto marked = makeImage(14, 9, 1, true, bumpy);
    mark(marked->GetCellData(), marked->GetNumberOfCells(),
      [=](vtkIdType i) { return i % 4 == 1 ? flag : static_cast<unsigned char>(0); });
    auto expected = makeImage(
      14, 9, 1, true, [&](vtkIdType i) { return marked->IsCellVisible(i) ? bumpy(i) : 0.0; });
    checkSame(checks, marked, expected, false, __LINE__);
  }
}

// Ghosts that are edited in place count at the next update, also where only the ghost
// array is modified.
void checkEditedInPlace(Checks& checks, bool cells, bool ofCells, unsigned char flag, int line)
{
  auto image = makeImage(14, 9, 1, cells, bumpy);
  vtkDataSetAttributes* data =
    image->GetAttributes(ofCells ? vtkDataObject::CELL : vtkDataObject::POINT);
  vtkUnsignedCharArray* ghosts =
    mark(data, ofCells ? image->GetNumberOfCells() : image->GetNumberOfPoints(),
      [](vtkIdType) { return static_cast<unsigned char>(0); });
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(400);
  std::vector<double> before = sampleCoordinates(sampler);
  for (const bool tellImage : { false, true })
  {
    ghosts->SetValue(tellImage ? 40 : 70, flag);
    tellImage ? image->Modified() : ghosts->Modified();
    const std::vector<double> now = sampleCoordinates(sampler);
    checks.That(now != before, "other particles", line);
    checks.That(now == samplePoints(image, 400), "as anew", line);
    before = now;
  }
}

// Nothing is left.
void checkAllBlank(Checks& checks)
{
  auto image = makeImage(6, 5, 1, true, bumpy);
  mark(image->GetCellData(), image->GetNumberOfCells(), [](vtkIdType) { return hiddenCell; });
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  ErrorTest(checks, sampler).Expect({ "total mass of zero", "empty cells carry none" }, __LINE__);
}

} // namespace

int TestSamplerGhosts(int, char*[])
{
  Checks checks;
  checkCells(checks, 1);
  checkCells(checks, 4);
  checkPoints(checks);
  checkCellsOfHiddenPoints(checks, 1, 1);
  checkCellsOfHiddenPoints(checks, 9, 1);
  checkCellsOfHiddenPoints(checks, 1, 9);
  checkCellsOfHiddenPoints(checks, 6, 5);
  checkKeptTables(checks);
  checkEveryFlag(checks);
  checkEditedInPlace(checks, true, true, hiddenCell, __LINE__);
  checkEditedInPlace(checks, true, false, hiddenPoint, __LINE__);
  checkEditedInPlace(checks, false, false, hiddenPoint, __LINE__);
  checkAllBlank(checks);
  return checks.Result();
}
