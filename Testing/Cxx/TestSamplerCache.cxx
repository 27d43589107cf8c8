// SPDX-License-Identifier: BSD-3-Clause
// Tables are built when the density changes, and only then.
#include "ProgressTest.h"

#include "vtkDataSetAttributes.h"
#include "vtkUniformSeedSource.h"
#include "vtkUnsignedCharArray.h"

namespace
{

class CacheTest
{
public:
  explicit CacheTest(Checks& checks)
    : Check(checks)
  {
    this->Sampler->SetNumberOfParticles(200);
  }

  void Expect(bool built, const char* what, int line)
  {
    this->Sampler->Update();
    const vtkMTimeType time = this->Sampler->GetTableBuildTime();
    this->Check.That((time > this->Last) == built, what, line);
    this->Last = time;
  }

  vtkNew<vtkTransportSampler> Sampler;

private:
  Checks& Check;
  vtkMTimeType Last = 0;
};

} // namespace

int TestSamplerCache(int, char*[])
{
  Checks checks;
  CacheTest test(checks);
  vtkTransportSampler* s = test.Sampler;
  CHECK(checks, s->GetTableBuildTime() == 0);
  auto image = makeImage(12, 9, 1, true, bumpy);
  s->SetInputData(image);
  test.Expect(true, "the first run builds", __LINE__);

  s->Modified();
  test.Expect(false, "nothing changed", __LINE__);
  s->SetNumberOfParticles(300);
  test.Expect(false, "NumberOfParticles", __LINE__);
  s->SetFlowTime(0.25);
  test.Expect(false, "FlowTime", __LINE__);
  s->SetSeedPatternToLattice();
  test.Expect(false, "SeedPattern", __LINE__);
  s->SetSamplesPerCell(2);
  test.Expect(false, "SamplesPerCell", __LINE__);
  s->SetRandomSeed(9);
  test.Expect(false, "RandomSeed", __LINE__);
  s->SetIntegratorToAdaptive();
  s->SetTolerance(0.1);
  test.Expect(false, "Integrator and Tolerance", __LINE__);
  s->SetIntegratorToRungeKutta4();
  s->SetNumberOfSteps(5);
  test.Expect(false, "NumberOfSteps", __LINE__);
  s->SetTableLookupToNearest();
  test.Expect(false, "TableLookup", __LINE__);
  s->SetThreadingToSerial();
  test.Expect(false, "Threading", __LINE__);
  s->OutputPathsOn();
  test.Expect(false, "OutputPaths", __LINE__);
  vtkNew<vtkUniformSeedSource> seeds;
  seeds->SetBounds(0, 11, 0, 8, 0, 0);
  s->SetSeedsConnection(seeds->GetOutputPort());
  test.Expect(false, "Seeds", __LINE__);
  seeds->SetNumberOfPoints(77);
  test.Expect(false, "changed Seeds", __LINE__);
  s->SetFlowTime(7.0);
  {
    Messages quiet(s);
    test.Expect(false, "an error of another property", __LINE__);
  }
  s->SetFlowTime(1.0);
  test.Expect(false, "after that error", __LINE__);

  s->InvertDensityOn();
  test.Expect(true, "InvertDensity", __LINE__);
  s->SetNegativeValuesToClamp();
  test.Expect(true, "NegativeValues", __LINE__);
  s->SetComponent(0);
  test.Expect(true, "Component", __LINE__);
  auto* values = vtkDoubleArray::SafeDownCast(image->GetCellData()->GetScalars());
  values->SetValue(3, 50.0);
  values->Modified();
  test.Expect(true, "the array", __LINE__);
  values->SetValue(4, 50.0);
  image->Modified(); // says so to the image alone
  test.Expect(true, "the image", __LINE__);
  image->Modified();
  test.Expect(false, "the image, but none of its values", __LINE__);
  const double mass = fieldValue(s->GetOutput(), "TotalMass");
  image->SetSpacing(2.0, 1.0, 1.0);
  test.Expect(true, "the spacing", __LINE__);
  CHECK_NEAR(checks, fieldValue(s->GetOutput(), "TotalMass"), 2.0 * mass, 1e-9 * mass);
  vtkNew<vtkImageData> around; // as ParaView makes one at every run
  around->ShallowCopy(image);
  s->SetInputData(around);
  test.Expect(false, "another image around the same array", __LINE__);
  s->SetInputData(image);
  test.Expect(false, "and the first again", __LINE__);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(image->GetNumberOfCells());
  ghosts->Fill(0);
  image->GetCellData()->AddArray(ghosts);
  test.Expect(true, "a ghost array", __LINE__);
  ghosts->SetValue(0, vtkDataSetAttributes::HIDDENCELL);
  ghosts->Modified();
  test.Expect(true, "the ghost array", __LINE__);
  ghosts->SetValue(1, vtkDataSetAttributes::HIDDENCELL);
  image->Modified();
  {
    const ProgressTest progress(s);
    test.Expect(true, "the ghost array, said to the image alone", __LINE__);
    CHECK(checks, std::is_sorted(progress.Heard.begin(), progress.Heard.end()));
  }
  vtkNew<vtkDoubleArray> other;
  other->SetName("Other");
  other->SetNumberOfTuples(image->GetNumberOfCells());
  for (vtkIdType i = 0; i < other->GetNumberOfTuples(); ++i)
  {
    other->SetValue(i, 2.0 * bumpy(i));
  }
  image->GetCellData()->AddArray(other);
  test.Expect(false, "another array", __LINE__);
  s->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Other");
  test.Expect(true, "the choice of the array", __LINE__);
  s->SetInputData(makeImage(12, 9, 1, true, bumpy));
  s->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  test.Expect(true, "another image", __LINE__);

  // Kept tables give what new ones give.
  s->SetSeedsConnection(nullptr);
  const std::vector<double> kept = sampleCoordinates(s);
  image = vtkImageData::SafeDownCast(s->GetInputDataObject(0, 0));
  image->GetCellData()->GetArray("Density")->Modified();
  CHECK(checks, sampleCoordinates(s) == kept);
  return checks.Result();
}
