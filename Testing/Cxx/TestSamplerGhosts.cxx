// SPDX-License-Identifier: BSD-3-Clause
// Ghost cells and points that are duplicate or hidden carry no mass, whatever their values are.
#include "SamplerTest.h"

#include "vtkDataSetAttributes.h"
#include "vtkUnsignedCharArray.h"

#include <limits>

namespace
{

constexpr unsigned char duplicateCell = vtkDataSetAttributes::DUPLICATECELL;
constexpr unsigned char hiddenCell = vtkDataSetAttributes::HIDDENCELL;
constexpr unsigned char duplicatePoint = vtkDataSetAttributes::DUPLICATEPOINT;
constexpr unsigned char hiddenPoint = vtkDataSetAttributes::HIDDENPOINT;

void mark(
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
}

// A density that is worthless where it is blank.
double hostile(vtkIdType i, bool blank)
{
  const double worst[] = { std::numeric_limits<double>::quiet_NaN(), -7.0,
    std::numeric_limits<double>::infinity(), 1e300 };
  return blank ? worst[i % 4] : bumpy(i);
}

void checkSame(Checks& checks, vtkImageData* marked, vtkImageData* expected, bool invert, int line)
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
    return i % 5 == 1 ? duplicateCell : i % 7 == 2 ? hiddenCell : static_cast<unsigned char>(0);
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
}

// vtkImageData itself says which cells a hidden point blanks.
void checkCellsOfHiddenPoints(Checks& checks, int ny, int nz)
{
  const auto flag = [](vtkIdType i) {
    return i % 17 == 3 ? hiddenPoint : i % 11 == 5 ? duplicatePoint : static_cast<unsigned char>(0);
  };
  auto marked = makeImage(14, ny, nz, true, bumpy);
  mark(marked->GetPointData(), marked->GetNumberOfPoints(), flag);
  mark(marked->GetCellData(), marked->GetNumberOfCells(),
    [](vtkIdType i) { return i % 13 == 4 ? hiddenCell : static_cast<unsigned char>(0); });
  int blanked = 0;
  auto expected = makeImage(14, ny, nz, true, [&](vtkIdType i) {
    const bool visible = marked->IsCellVisible(i) != 0;
    blanked += visible ? 0 : 1;
    return visible ? bumpy(i) : 0.0;
  });
  CHECK(checks, blanked > 0 && blanked < marked->GetNumberOfCells());
  checkSame(checks, marked, expected, false, __LINE__);
}

// Nothing is left.
void checkAllBlank(Checks& checks)
{
  auto image = makeImage(6, 5, 1, true, bumpy);
  mark(image->GetCellData(), image->GetNumberOfCells(), [](vtkIdType) { return hiddenCell; });
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputData(image);
  sampler->Update();
  CHECK(checks, messages.Errors.size() == 1 && contains(messages.Errors[0], "total mass of zero"));
  CHECK(checks, contains(messages.Errors[0], "ghosts"));
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
  checkAllBlank(checks);
  return checks.Result();
}
