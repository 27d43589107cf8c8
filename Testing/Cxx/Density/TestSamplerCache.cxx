// SPDX-License-Identifier: BSD-3-Clause
// Tables are built when the density changes, and only then.
#include "ProgressTest.h"

#include "vtkDataSetAttributes.h"
#include "vtkUniformSeedSource.h"
#include "vtkUnsignedCharArray.h"

int TestSamplerCache(int, char*[])
{
  Checks checks;
  vtkNew<vtkTransportSampler> s;
  CHECK(checks, s->GetTableBuildTime() == 0);
  auto image = makeImage(12, 9, 1, true, bumpy);
  s->SetInputData(image);
  s->SetNumberOfParticles(200);
  const auto build = [&]() { return builds(s); };
  CHECK(checks, build());

  const auto setTolerance = [&]() {
    s->SetIntegratorToAdaptive();
    s->SetTolerance(0.1);
  };
  const auto setNumberOfSteps = [&]() {
    s->SetIntegratorToRungeKutta4();
    s->SetNumberOfSteps(5);
  };
  vtkNew<vtkUniformSeedSource> seeds;
  seeds->SetBounds(0, 11, 0, 8, 0, 0);
  expectAfterEach(checks, build, false,
    { { "nothing changed", [&]() { s->Modified(); } },
      { "NumberOfParticles", [&]() { s->SetNumberOfParticles(300); } },
      { "FlowTime", [&]() { s->SetFlowTime(0.25); } },
      { "SeedPattern", [&]() { s->SetSeedPatternToLattice(); } },
      { "SamplesPerCell", [&]() { s->SetSamplesPerCell(2); } },
      { "RandomSeed", [&]() { s->SetRandomSeed(9); } },
      { "Integrator and Tolerance", setTolerance }, { "NumberOfSteps", setNumberOfSteps },
      { "FlowMaps", [&]() { s->SetFlowMapsToOn(); } },
      { "TableLookup", [&]() { s->SetTableLookupToNearest(); } },
      { "Certify", [&]() { s->CertifyOn(); } }, { "Method", [&]() { s->SetMethodToOptimal(); } },
      { "OptimalityTolerance", [&]() { s->SetOptimalityTolerance(0.1); } },
      { "Method again", [&]() { s->SetMethodToRectifiedFlow(); } },
      { "Threading", [&]() { s->SetThreadingToSerial(); } },
      { "Device", [&]() { s->SetDeviceToOpenCL(); } },
      { "DeviceName", [&]() { s->SetDeviceName("none"); } },
      { "Device again", [&]() { s->SetDeviceToCPU(); } },
      { "OutputPaths", [&]() { s->OutputPathsOn(); } },
      { "Seeds", [&]() { s->SetSeedsConnection(seeds->GetOutputPort()); } },
      { "changed Seeds", [&]() { seeds->SetNumberOfPoints(77); } } },
    __LINE__);
  // An error of another property.
  s->SetFlowTime(7.0);
  {
    Messages messages(s);
    CHECK(checks, !build());
  }
  s->SetFlowTime(1.0);
  CHECK(checks, !build());

  expectAfterEach(checks, build, true,
    { { "InvertDensity", [&]() { s->InvertDensityOn(); } },
      { "NegativeValues", [&]() { s->SetNegativeValuesToClamp(); } },
      { "Component", [&]() { s->SetComponent(-3); } } },
    __LINE__);
  auto* values = vtkDoubleArray::SafeDownCast(image->GetCellData()->GetScalars());
  values->SetValue(3, 50.0);
  values->Modified();
  CHECK(checks, build());
  values->SetValue(4, 50.0);
  image->Modified(); // the image, not the array
  CHECK(checks, build());
  image->Modified(); // but none of its values is new
  CHECK(checks, !build());
  const double mass = fieldValue(s->GetOutput(), "TotalMass");
  image->SetSpacing(2.0, 1.0, 1.0);
  CHECK(checks, build());
  CHECK_NEAR(checks, fieldValue(s->GetOutput(), "TotalMass"), 2.0 * mass, 1e-9 * mass);
  vtkNew<vtkImageData> around; // as ParaView makes one at every run
  around->ShallowCopy(image);
  s->SetInputData(around);
  CHECK(checks, !build());
  s->SetInputData(image); // and the first again
  CHECK(checks, !build());
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(image->GetNumberOfCells());
  ghosts->Fill(0);
  image->GetCellData()->AddArray(ghosts);
  CHECK(checks, build());
  ghosts->SetValue(0, vtkDataSetAttributes::HIDDENCELL);
  ghosts->Modified();
  CHECK(checks, build());
  ghosts->SetValue(1, vtkDataSetAttributes::HIDDENCELL);
  image->Modified(); // the image, not the array
  {
    const ProgressTest progress(s);
    CHECK(checks, build());
    progress.ExpectRising(checks, 2, __LINE__);
  }
  vtkNew<vtkDoubleArray> other;
  other->SetName("Other");
  other->SetNumberOfTuples(image->GetNumberOfCells());
  for (vtkIdType i = 0; i < other->GetNumberOfTuples(); ++i)
  {
    other->SetValue(i, 2.0 * bumpy(i));
  }
  image->GetCellData()->AddArray(other); // which is not the density
  CHECK(checks, !build());
  s->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Other");
  CHECK(checks, build());
  s->SetInputData(makeImage(12, 9, 1, true, bumpy));
  s->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  CHECK(checks, build());

  // Kept tables give what new ones give.
  s->SetSeedsConnection(nullptr);
  const std::vector<double> kept = sampleCoordinates(s);
  image = vtkImageData::SafeDownCast(s->GetInputDataObject(0, 0));
  image->GetCellData()->GetArray("Density")->Modified();
  CHECK(checks, sampleCoordinates(s) == kept);
  return checks.Result();
}
