// SPDX-License-Identifier: BSD-3-Clause
// Ghost arrays of another length than what they belong to are an error wherever ghosts count, and
// what Transport Quality measures is that of the particles that are no ghosts.
#include "QualityTest.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkDataSetAttributes.h"
#include "vtkMassSplatter.h"
#include "vtkUnsignedCharArray.h"

#include <limits>

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr unsigned char duplicate = vtkDataSetAttributes::DUPLICATEPOINT;
constexpr unsigned char hidden = vtkDataSetAttributes::HIDDENPOINT;

void setGhosts(
  vtkDataSetAttributes* data, const std::vector<unsigned char>& flags, int components = 1)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfComponents(components);
  for (const unsigned char flag : flags)
  {
    ghosts->InsertNextValue(flag);
  }
  data->AddArray(ghosts);
}

void expectError(Checks& checks, vtkAlgorithm* filter, const std::string& text, int line)
{
  filter->Modified();
  ErrorTest(checks, filter).Expect(text, line);
}

void checkLengths(Checks& checks)
{
  // Far more points than the flags' memory may have by chance.
  const double box[6] = { 0.1, 3.9, 0.1, 2.9, 0.0, 0.0 };
  auto points = makePoints(randomCoordinates(box, 100000));
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(points);
  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(points);
  auto density = makeImage(5, 4, 1, true, bumpy);
  quality->SetDensityData(density);
  vtkNew<vtkBlueNoiseRelaxation> relaxation;
  relaxation->SetInputData(points);
  relaxation->SetDensityData(density);
  const std::string tooFew =
    "The ghost array 'vtkGhostType' of the points of the input point set "
    "has 7 values, but there are 100000 points; there must be one for each";
  setGhosts(points->GetPointData(), std::vector<unsigned char>(7, 0));
  expectError(checks, splatter, tooFew, __LINE__);
  expectError(checks, quality, tooFew, __LINE__);
  expectError(checks, relaxation, tooFew, __LINE__);
  setGhosts(points->GetPointData(), std::vector<unsigned char>(200000, 0), 2);
  expectError(checks, splatter, "has 200000 values, but there are 100000 points", __LINE__);
  points->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());

  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(density);
  setGhosts(density->GetCellData(), std::vector<unsigned char>(11, 0));
  const std::string cells =
    "of the cells of the input image has 11 values, but there are 12 cells; there must be one for";
  expectError(checks, sampler, cells, __LINE__);
  expectError(checks, quality, cells, __LINE__);
  expectError(checks, relaxation, cells, __LINE__);
  density->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  setGhosts(density->GetPointData(), std::vector<unsigned char>(21, 0));
  expectError(
    checks, sampler, "of the points of the input image has 21 values, but there are 20", __LINE__);
  auto onPoints = makeImage(5, 4, 1, false, bumpy);
  setGhosts(onPoints->GetPointData(), std::vector<unsigned char>(3, 0));
  sampler->SetInputData(onPoints);
  expectError(
    checks, sampler, "of the points of the input image has 3 values, but there are 20", __LINE__);
}

struct Particle
{
  double Position[3];
  double Mass;
  double Displacement;
  unsigned char Ghost;
};

vtkSmartPointer<vtkPolyData> makeParticles(const std::vector<Particle>& all)
{
  std::vector<double> x;
  std::vector<unsigned char> flags;
  vtkNew<vtkDoubleArray> masses;
  masses->SetName("Mass");
  vtkNew<vtkDoubleArray> displacements;
  displacements->SetName("Displacement");
  displacements->SetNumberOfComponents(3);
  for (const Particle& particle : all)
  {
    x.insert(x.end(), particle.Position, particle.Position + 3);
    flags.push_back(particle.Ghost);
    masses->InsertNextValue(particle.Mass);
    displacements->InsertNextTuple3(0.0, particle.Displacement, 0.0);
  }
  auto data = makePoints(x);
  data->GetPointData()->AddArray(masses);
  data->GetPointData()->AddArray(displacements);
  setGhosts(data->GetPointData(), flags);
  return data;
}

void checkQuality(Checks& checks)
{
  std::vector<Particle> all;
  for (int i = 0; i < 12; ++i)
  {
    all.push_back({ { 0.4 + i % 4, 0.6 + i / 4, 0.0 }, 1.0 + i % 3, 0.25 * i, 0 });
  }
  vtkNew<vtkTransportQuality> quality;
  Messages messages(quality);
  quality->SetBlockSize(2);
  quality->SetDensityData(makeImage(5, 4, 1, true, [](vtkIdType i) { return i == 5 ? 0 : 1 + i; }));
  quality->SetInputData(makeParticles(all));
  const std::vector<double> expected = runQuality(quality);
  CHECK(checks, expected.size() == 9 && expected[0] == 12 && expected[2] == 1 && expected[5] > 0);

  // On others, in the empty cell, outside, with figures that are none; before, between and after.
  std::vector<Particle> more = all;
  more.insert(more.begin(), { { 0.4, 0.6, 0.0 }, 7.0, 3.0, duplicate });
  more.insert(more.begin() + 5, { { 1.5, 1.5, 0.0 }, nan, nan, hidden });
  more.push_back({ { 0.41, 0.6, 0.0 }, -1.0, 1e200, static_cast<unsigned char>(duplicate | 64) });
  more.push_back({ { 40.0, 1.0, 0.0 }, 1.0, 1.0, hidden });
  quality->SetInputData(makeParticles(more));
  CHECK(checks, runQuality(quality) == expected);
  CHECK(checks, messages.Errors.empty());

  // Errors count all points.
  more[6].Mass = -3.0;
  quality->SetInputData(makeParticles(more));
  expectError(checks, quality, "'Mass' of the particles has the value -3 at index 6", __LINE__);
  more[6].Mass = 1.0;
  more[7].Displacement = nan;
  quality->SetInputData(makeParticles(more));
  expectError(
    checks, quality, "'Displacement' of the particles has the value nan at index 7", __LINE__);

  // All points are ghosts.
  messages.Clear();
  for (Particle& particle : more)
  {
    particle.Ghost = duplicate;
  }
  quality->SetInputData(makeParticles(more));
  CHECK(checks, runQuality(quality).empty() && quality->GetOutput()->GetNumberOfColumns() == 0);
  CHECK(checks, messages.Errors.empty());
}

} // namespace

int TestGhosts(int, char*[])
{
  return runChecks({ checkLengths, checkQuality });
}
