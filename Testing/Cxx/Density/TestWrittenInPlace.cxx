// SPDX-License-Identifier: BSD-3-Clause
// Values written into an array with Modified() of the data set only: nothing computed from the
// values before remains, in the filters' caches or in VTK's.
#include "CellsTest.h"
#include "ParameterizationTest.h"
#include "SolidTest.h"
#include "SplatTest.h"
#include "SurfaceSamplerTest.h"

#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkSOADataArrayTemplate.h"

namespace
{

// New values in the array of a density, with Modified() of the image only.
template <class ArrayT>
void checkDensity(Checks& checks, int line)
{
  auto image = makeImage<ArrayT>(12, 9, 1, true, [](vtkIdType i) { return i % 3 == 0 ? 1 : 0; });
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(100);
  const std::vector<double> before = sampleCoordinates(sampler);
  vtkDataArray* values = image->GetCellData()->GetScalars();
  const vtkMTimeType time = values->GetMTime();
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    values->SetComponent(i, 0, i % 3 == 1 ? 1 : 0);
  }
  image->Modified();
  checks.That(values->GetMTime() == time, "the array is not modified", line);
  const std::vector<double> after = sampleCoordinates(sampler);
  checks.That(after != before && after == samplePoints(image, 100), "new particles", line);

  image->Modified();
  const vtkMTimeType built = sampler->GetTableBuildTime();
  checks.That(sampleCoordinates(sampler) == after, "the same values", line);
  const bool isInMemory = values->HasStandardMemoryLayout();
  checks.That((sampler->GetTableBuildTime() == built) == isInMemory, "no new tables", line);
}

// With Modified() of the data set only, not of its points.
void writePoint(vtkPointSet* set, vtkIdType point, const std::vector<double>& x)
{
  auto* coordinates = vtkDoubleArray::SafeDownCast(set->GetPoints()->GetData());
  std::copy(x.begin(), x.end(), coordinates->GetPointer(3 * point));
  set->Modified();
}

void checkSites(Checks& checks)
{
  const std::array<double, 6> square = { 0.0, 1.0, 0.0, 1.0, 0.0, 0.0 };
  vtkNew<vtkEqualMassCells> cells;
  auto sites = makeSites(square, 9);
  cells->SetInputData(sites);
  cells->SetResolution(30);
  for (const bool hasDomain : { true, false })
  {
    cells->SetDomainData(hasDomain ? makeDomain(square).Get() : nullptr);
    const std::vector<vtkIdType> before = runCells(cells);
    writePoint(sites, 4, { hasDomain ? 0.01 : 1.7, 0.99, 0.0 });
    const std::vector<vtkIdType> after = runCells(cells);
    CHECK(checks, !after.empty() && after != before);
    vtkNew<vtkEqualMassCells> fresh;
    auto copy = vtkSmartPointer<vtkPolyData>::New();
    copy->DeepCopy(sites);
    copy->GetPoints()->Modified();
    fresh->SetInputData(copy);
    fresh->SetDomainData(hasDomain ? makeDomain(square).Get() : nullptr);
    fresh->SetResolution(30);
    CHECK(checks, runCells(fresh) == after);
  }
  // Nothing written, or a new data set with the same points, as ParaView makes one at every update.
  vtkDataArray* labels = cells->GetLabels()->GetCellData()->GetArray("SiteId");
  sites->Modified();
  cells->Update();
  CHECK(checks, cells->GetLabels()->GetCellData()->GetArray("SiteId") == labels);
  vtkNew<vtkPolyData> around;
  around->ShallowCopy(sites);
  cells->SetInputData(around);
  cells->Update();
  CHECK(checks, cells->GetLabels()->GetCellData()->GetArray("SiteId") == labels);
}

void checkSplat(Checks& checks)
{
  auto points = makePoints({ 0, 0, 0, 1, 1, 0, 2, 3, 0 });
  vtkNew<vtkMassSplatter> splatter;
  Messages messages(splatter);
  splatter->SetInputData(points);
  splatter->SetDimensions(8, 8, 8);
  splatter->SetAssociationToCells();
  splatter->Update();
  writePoint(points, 2, { 8, 3, 0 });
  CHECK(checks, splatValues(splatter).size() == 64);
  CHECK(checks, splatter->GetOutput()->GetBounds()[1] == 8.0);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

void checkSurface(Checks& checks)
{
  auto box = makeBox(0, 1, 0, 1, 0, 1);
  vtkNew<vtkSolidDensity> solid;
  Messages messages(solid);
  solid->SetInputData(box);
  solid->SetResolution(8);
  solid->SetPadding(0.0);
  solid->Update();
  CHECK_NEAR(checks, massOf(solid), 1.0, 1e-9);
  for (const vtkIdType point : { 1, 2, 5, 6 })
  {
    double x[3];
    box->GetPoint(point, x);
    writePoint(box, point, { 2.0, x[1], x[2] });
  }
  solid->Update();
  CHECK_NEAR(checks, massOf(solid), 2.0, 1e-9);
  CHECK(checks, messages.Errors.empty());

  box->GetPolys()->GetConnectivityArray()->SetComponent(3, 0, 8.0);
  box->Modified();
  solid->Update();
  CHECK(checks, messages.IsOneError("has the point 8; there are points 0 to 7"));
}

void checkDisk(Checks& checks)
{
  auto sheet = makeFlatSheet(3, 3);
  auto filter = makeParameterization(sheet);
  Messages messages(filter);
  const Values before = runSquare(filter);
  writePoint(sheet, 5, { 0.6, 0.7, 0.3 });
  const Values after = runSquare(filter);
  CHECK(checks, largestDifference(before, after) > 0.01);
  CHECK(checks, messages.Errors.empty());
  sheet->GetPolys()->GetConnectivityArray()->SetComponent(3, 0, 16.0);
  sheet->Modified();
  filter->Update();
  CHECK(checks, messages.IsOneError("has the point 16; there are points 0 to 15"));
}

void checkSampledSurface(Checks& checks)
{
  auto hill = makeHill();
  auto density = makeArray("Density", hill->GetNumberOfPoints(), bumpy);
  hill->GetPointData()->AddArray(density);
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetInputData(hill);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  sampler->SetNumberOfParticles(100);
  sampler->SetResolution(50);
  const Values before = coordinates(runSampler(sampler));
  density->SetValue(5, 1e5);
  hill->Modified();
  const Values after = coordinates(runSampler(sampler));
  CHECK(checks, largestDifference(before, after) > 0.1);
  writePoint(hill, 60, { 11.0, 2.0, 30.0 });
  CHECK(checks, largestDifference(after, coordinates(runSampler(sampler))) > 0.1);
}

} // namespace

int TestWrittenInPlace(int, char*[])
{
  Checks checks;
  checkDensity<vtkDoubleArray>(checks, __LINE__);
  checkDensity<vtkBitArray>(checks, __LINE__);
  checkDensity<vtkSOADataArrayTemplate<float>>(checks, __LINE__);
  checkSites(checks);
  checkSplat(checks);
  checkSurface(checks);
  checkDisk(checks);
  checkSampledSurface(checks);
  return checks.Result();
}
