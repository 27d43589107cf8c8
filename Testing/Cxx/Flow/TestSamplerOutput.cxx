// SPDX-License-Identifier: BSD-3-Clause
// The sampler's output: counts, arrays, types, mass and cost, one vertex a particle.
#include "../../SeedPatterns.h"
#include "TestData.h"

#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntegrateAttributes.h"
#include "vtkStringArray.h"

#include <initializer_list>

namespace
{

void checkArrays(Checks& checks, vtkPolyData* output, double mass)
{
  const vtkIdType count = output->GetNumberOfPoints();
  CHECK(checks, output->GetPoints()->GetDataType() == VTK_DOUBLE);
  CHECK(checks, output->GetNumberOfVerts() == count);
  CHECK(checks, output->GetNumberOfCells() == count);
  auto* ids = vtkIdTypeArray::SafeDownCast(pointArray(output, "SeedId"));
  auto* seeds = vtkDoubleArray::SafeDownCast(pointArray(output, "SeedPosition"));
  auto* displacements = vtkDoubleArray::SafeDownCast(pointArray(output, "Displacement"));
  auto* masses = vtkDoubleArray::SafeDownCast(pointArray(output, "Mass"));
  const bool all = ids && seeds && displacements && masses;
  CHECK(checks, all);
  if (!all)
  {
    return;
  }
  for (vtkDataArray* array :
    std::initializer_list<vtkDataArray*>{ ids, seeds, displacements, masses })
  {
    CHECK(checks, array->GetNumberOfTuples() == count);
    if (array->GetNumberOfTuples() != count)
    {
      return;
    }
  }
  CHECK(checks, output->GetPointData()->GetNumberOfArrays() == 5); // with the image's
  CHECK(checks, output->GetPointData()->GetVectors() == displacements);
  CHECK(checks, seeds->GetNumberOfComponents() == 3);
  CHECK(checks, displacements->GetNumberOfComponents() == 3);

  bool idsHold = true;
  bool positionsHold = true;
  bool cellsHold = true;
  double sum = 0.0;
  double cost = 0.0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    idsHold = idsHold && ids->GetValue(i) == i;
    const double* x = output->GetPoint(i);
    for (int c = 0; c < 3; ++c)
    {
      const double d = displacements->GetComponent(i, c);
      positionsHold = positionsHold && std::abs(seeds->GetComponent(i, c) + d - x[c]) <= 1e-12;
      cost += d * d;
    }
    sum += masses->GetValue(i);
    vtkIdType size;
    const vtkIdType* points;
    output->GetVerts()->GetCellAtId(i, size, points);
    cellsHold = cellsHold && size == 1 && points[0] == i;
  }
  CHECK(checks, idsHold);
  CHECK(checks, positionsHold);
  CHECK(checks, cellsHold);
  CHECK_NEAR(checks, sum / mass, 1.0, 1e-12);
  CHECK(checks, masses->GetRange()[0] == masses->GetRange()[1]);
  CHECK_NEAR(checks, fieldValue(output, "TotalMass") / mass, 1.0, 1e-14);
  const double mean = cost / static_cast<double>(count);
  CHECK_NEAR(checks, fieldValue(output, "TransportCost") / mean, 1.0, 1e-12);
}

void checkCounts(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(makeImage(13, 7, 1, true, bumpy));
  for (const auto pattern : RectifiedTransport::scatteredPatterns)
  {
    sampler->SetSeedPattern(static_cast<int>(pattern));
    for (const vtkIdType count : { 1, 2, 7, 100, 1237 })
    {
      sampler->SetNumberOfParticles(count);
      sampler->Update();
      CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == count);
    }
  }
  // 12 x 6 cells: a lattice of the same aspect is exact.
  sampler->SetSeedPatternToLattice();
  sampler->SetNumberOfParticles(24 * 12);
  sampler->Update();
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 24 * 12);
  sampler->SetSamplesPerCell(3);
  sampler->SetNumberOfParticles(0); // not used
  sampler->Update();
  vtkDataArray* seeds = pointArray(sampler->GetOutput(), "SeedPosition");
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 36 * 18);
  const bool hasSeeds = seeds && seeds->GetNumberOfTuples() == 36 * 18;
  CHECK(checks, hasSeeds);
  if (hasSeeds)
  {
    CHECK_NEAR(checks, seeds->GetComponent(0, 0), 1.0 / 6.0, 1e-15);
    CHECK_NEAR(checks, seeds->GetComponent(1, 0), 0.5, 1e-15);
    CHECK_NEAR(checks, seeds->GetComponent(36, 1), 0.5, 1e-15);
  }
  sampler->SetSeedPatternToJittered();
  sampler->Update();
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 36 * 18);
  sampler->SetSeedPatternToBlueNoise(); // does not use SamplesPerCell
  sampler->SetNumberOfParticles(55);
  sampler->Update();
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 55);
}

// Other random seeds give other particles, the same one the same.
void checkRandomSeed(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(makeImage(13, 7, 1, true, bumpy));
  sampler->SetNumberOfParticles(300);
  for (const int pattern : { 0, 2, 3, 4 })
  {
    sampler->SetSeedPattern(pattern);
    sampler->SetRandomSeed(1);
    const std::vector<double> first = sampleCoordinates(sampler);
    sampler->SetRandomSeed(-5);
    CHECK(checks, sampleCoordinates(sampler) != first);
    sampler->SetRandomSeed(1);
    CHECK(checks, sampleCoordinates(sampler) == first);
  }
}

// The input's field data stays; an array of the same name as one of the output is replaced.
void checkFieldData(Checks& checks)
{
  auto image = makeImage(9, 9, 1, true, bumpy);
  vtkNew<vtkStringArray> note;
  note->SetName("Note");
  note->InsertNextValue("kept");
  image->GetFieldData()->AddArray(note);
  vtkNew<vtkDoubleArray> old;
  old->SetName("TotalMass");
  old->InsertNextValue(-1.0);
  image->GetFieldData()->AddArray(old);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->Update();
  vtkFieldData* fields = sampler->GetOutput()->GetFieldData();
  CHECK(checks, fields->GetNumberOfArrays() == 11);
  CHECK(checks, fields->GetAbstractArray("Note") == note);
  CHECK(checks, fieldValue(sampler->GetOutput(), "TotalMass") > 0.0);
  CHECK(checks, old->GetValue(0) == -1.0);
}

// VTK's own integral of the density.
void checkIntegral(Checks& checks)
{
  const int sizes[][3] = { { 30, 1, 1 }, { 1, 12, 1 }, { 13, 7, 1 }, { 9, 1, 8 }, { 5, 6, 7 } };
  for (const auto& n : sizes)
  {
    auto image = makeImage(n[0], n[1], n[2], true, bumpy);
    image->SetSpacing(0.5, 2.0, 0.3);
    vtkNew<vtkIntegrateAttributes> integrate;
    integrate->SetInputData(image);
    integrate->Update();
    auto* integral = vtkDataSet::SafeDownCast(integrate->GetOutputDataObject(0));
    const double mass = integral->GetCellData()->GetArray("Density")->GetComponent(0, 0);
    vtkNew<vtkTransportSampler> sampler;
    sampler->SetInputData(image);
    sampler->Update();
    CHECK_NEAR(checks, fieldValue(sampler->GetOutput(), "TotalMass") / mass, 1.0, 1e-12);
  }
}

} // namespace

int TestSamplerOutput(int, char*[])
{
  Checks checks;
  for (const int depth : { 1, 5 })
  {
    auto image = makeImage(12, 8, depth, false, bumpy);
    image->SetSpacing(0.5, 2.0, 3.0);
    image->SetOrigin(-4.0, 7.0, 1.0);
    double sum = 0.0;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      sum += bumpy(i);
    }
    vtkNew<vtkTransportSampler> sampler;
    sampler->SetInputData(image);
    sampler->SetNumberOfParticles(3000);
    sampler->Update();
    CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 3000);
    checkArrays(checks, sampler->GetOutput(), sum * (depth == 1 ? 1.0 : 3.0));
  }
  checkCounts(checks);
  checkRandomSeed(checks);
  checkFieldData(checks);
  checkIntegral(checks);
  return checks.Result();
}
