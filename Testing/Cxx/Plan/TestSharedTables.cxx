// SPDX-License-Identifier: BSD-3-Clause
// Filters that read the same density share its tables, whoever built them, for as long as one of
// them is there; the results of each are those that it has alone.
#include "BlendTest.h"
#include "ProgressTest.h"
#include "QualityTest.h"
#include "WarpTest.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkSetGet.h"
#include "vtkTransportMap.h"
#include "vtkUnsignedCharArray.h"

#include <utility>

namespace
{

// Counts how often its values are hashed. Tables are filled through the type of an array, without a
// pointer to void.
class HashedArray : public vtkDoubleArray
{
public:
  vtkTypeMacro(HashedArray, vtkDoubleArray);
  static HashedArray* New() { VTK_STANDARD_NEW_BODY(HashedArray); }

  void* GetVoidPointer(vtkIdType value) override
  {
    ++this->Hashes;
    return this->Superclass::GetVoidPointer(value);
  }

  int Hashes = 0;
};

using Image = vtkSmartPointer<vtkImageData>;

template <class ArrayT = vtkDoubleArray>
Image makeBumpy()
{
  return makeImage<ArrayT>(13, 10, 1, true, bumpy);
}

Image makeOther()
{
  return makeImage(13, 10, 1, true, [](vtkIdType i) { return bumpy(3 * i + 1); });
}

vtkSmartPointer<vtkTransportSampler> makeSampler(vtkImageData* image)
{
  auto sampler = vtkSmartPointer<vtkTransportSampler>::New();
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(200);
  return sampler;
}

// That has run.
vtkSmartPointer<vtkTransportSampler> runSampler(vtkImageData* image)
{
  auto sampler = makeSampler(image);
  sampler->Update();
  return sampler;
}

// A filter that reads a density, and what it makes of it at its next update.
struct Reader
{
  vtkSmartPointer<vtkDensityAlgorithm> Filter;
  std::function<Values()> Result;
};

// One of each kind; none has run.
std::vector<Reader> makeReaders(vtkImageData* image)
{
  const double bounds[6] = { 0, 12, 0, 9, 0, 0 };
  auto points = makePoints(randomCoordinates(bounds, 50));
  auto sampler = makeSampler(image);
  auto map = vtkSmartPointer<vtkTransportMap>::New();
  map->SetInputData(image);
  auto quality = vtkSmartPointer<vtkTransportQuality>::New();
  quality->SetInputData(points);
  quality->SetDensityData(image);
  auto warp = vtkSmartPointer<vtkDensityEqualizingWarp>::New();
  warp->SetInputData(points);
  warp->SetDensityData(image);
  auto relaxation = vtkSmartPointer<vtkBlueNoiseRelaxation>::New();
  relaxation->SetInputData(points);
  relaxation->SetDensityData(image);
  relaxation->SetMaximumIterations(2);
  const auto mapped = [map]() {
    map->Update();
    return imageValues(map->GetOutput(), "Displacement");
  };
  return { { sampler, [sampler]() { return sampleCoordinates(sampler); } }, { map, mapped },
    { quality, [quality]() { return runQuality(quality); } },
    { warp, [warp]() { return displacements(warp); } },
    { relaxation, [relaxation]() { return coordinates(relaxation->GetOutput()); } } };
}

// What they make, each of them executed again.
std::vector<Values> resultsOf(const std::vector<Reader>& readers)
{
  std::vector<Values> results;
  for (const Reader& reader : readers)
  {
    reader.Filter->Modified();
    reader.Filter->Update();
    results.push_back(reader.Result());
  }
  return results;
}

// What each makes where no other one has run.
std::vector<Values> resultsAlone(vtkImageData* image)
{
  std::vector<Values> results;
  for (std::size_t kind = 0; kind < makeReaders(image).size(); ++kind)
  {
    const Reader reader = makeReaders(image)[kind];
    reader.Filter->Update();
    results.push_back(reader.Result());
  }
  return results;
}

// Whether all use the tables that were built at a time.
void expectBuildTime(
  Checks& checks, const std::vector<Reader>& readers, vtkMTimeType time, int line)
{
  for (const Reader& reader : readers)
  {
    checks.That(reader.Filter->GetTableBuildTime() == time, "the shared tables", line,
      reader.Filter->GetClassName());
  }
}

// The filters of an image build its tables once; after the last of them has gone, they are built
// anew.
void checkOneImage(Checks& checks)
{
  auto image = makeBumpy();
  const std::vector<Values> alone = resultsAlone(image);
  for (const Values& values : alone)
  {
    CHECK(checks, !values.empty());
  }
  vtkMTimeType last = 0;
  {
    std::vector<Reader> readers = makeReaders(image);
    CHECK(checks, resultsOf(readers) == alone);
    last = readers.front().Filter->GetTableBuildTime();
    CHECK(checks, last > 0);
    expectBuildTime(checks, readers, last, __LINE__);
    readers.erase(readers.begin()); // who built them
    CHECK(checks, runSampler(image)->GetTableBuildTime() == last);
    readers.erase(readers.begin() + 1, readers.end());
    CHECK(checks, runSampler(image)->GetTableBuildTime() == last);
  }
  auto late = runSampler(image);
  CHECK(checks, late->GetTableBuildTime() > last);
  CHECK(checks, coordinates(late->GetOutput()) == alone.front());
}

// A filter that turns to another density, fails or is aborted leaves the tables to the others; its
// own are those of its new density.
void checkLeaving(Checks& checks)
{
  auto image = makeBumpy();
  auto negative = makeImage(13, 10, 1, true, [](vtkIdType i) { return bumpy(i) - 2.0; });
  const std::vector<Values> alone = resultsAlone(image);
  const std::vector<Values> othersAlone = resultsAlone(makeOther());
  CHECK(checks, alone != othersAlone);
  const std::vector<Reader> staying = makeReaders(image);
  std::vector<Reader> leaving = makeReaders(image);
  CHECK(checks, resultsOf(staying) == alone && resultsOf(leaving) == alone);
  const vtkMTimeType built = staying.front().Filter->GetTableBuildTime();
  expectBuildTime(checks, leaving, built, __LINE__);

  const auto turnTo = [&leaving](vtkImageData* density) {
    for (std::size_t kind = 0; kind < leaving.size(); ++kind)
    {
      leaving[kind].Filter->SetInputDataObject(kind < 2 ? 0 : 1, density);
    }
  };
  const auto expectStaying = [&](int line) {
    checks.That(resultsOf(staying) == alone, "the others' results", line);
    expectBuildTime(checks, staying, built, line);
  };
  auto other = makeOther();
  turnTo(other);
  CHECK(checks, resultsOf(leaving) == othersAlone);
  const vtkMTimeType later = leaving.front().Filter->GetTableBuildTime();
  CHECK(checks, later > built);
  expectBuildTime(checks, leaving, later, __LINE__);
  expectStaying(__LINE__);

  turnTo(image); // and back
  CHECK(checks, resultsOf(leaving) == alone);
  expectBuildTime(checks, leaving, later, __LINE__);
  expectStaying(__LINE__);

  turnTo(negative);
  for (const Reader& reader : leaving)
  {
    ErrorTest(checks, reader.Filter).Expect("negative value", __LINE__);
  }
  expectStaying(__LINE__);

  turnTo(other);
  for (const Reader& reader : leaving)
  {
    ProgressTest abort(reader.Filter);
    abort.AbortFrom = 0.0;
    reader.Filter->Update();
    CHECK(checks, isEmpty(reader.Filter));
    reader.Filter->SetAbortExecute(0);
  }
  expectStaying(__LINE__);
  turnTo(image);
  CHECK(checks, resultsOf(leaving) == alone);
  expectStaying(__LINE__);

  // Values that are written into the image of all are the density of all.
  changeDensity(image);
  const std::vector<Values> changed = resultsOf(staying);
  CHECK(checks, changed != alone && resultsOf(leaving) == changed);
  const vtkMTimeType again = staying.front().Filter->GetTableBuildTime();
  CHECK(checks, again > later);
  expectBuildTime(checks, staying, again, __LINE__);
  expectBuildTime(checks, leaving, again, __LINE__);
}

// Equal values are one density, wherever they are; all else that the tables depend on has to be
// equal, too.
void checkWhatIsEqual(Checks& checks)
{
  auto image = makeBumpy();
  auto first = runSampler(image);
  const vtkMTimeType built = first->GetTableBuildTime();
  const auto shares = [&](const Image& other, int component = -1) {
    auto sampler = makeSampler(other);
    sampler->SetComponent(component);
    sampler->Update();
    checks.That(sampler->GetOutput()->GetNumberOfPoints() == 200, "particles", __LINE__);
    return sampler->GetTableBuildTime() == built;
  };
  CHECK(checks, shares(image));
  CHECK(checks, shares(makeBumpy()));
  auto elsewhere = makeBumpy();
  elsewhere->SetOrigin(5.0, -3.0, 2.0);
  elsewhere->GetCellData()->GetScalars()->SetName("Other");
  CHECK(checks, shares(elsewhere));
  CHECK(checks, coordinates(runSampler(elsewhere)->GetOutput()) != coordinates(first->GetOutput()));

  CHECK(checks, !shares(makeOther()));
  CHECK(checks, !shares(makeBumpy<vtkFloatArray>()));
  CHECK(checks, shares(image, 0)); // what Auto takes
  CHECK(checks, !shares(image, -3));
  CHECK(checks, !shares(makeImage(13, 10, 1, true, bumpy, 2), 0));
  CHECK(checks, !shares(makeImage(10, 13, 1, true, bumpy))); // as many cells
  CHECK(checks, !shares(makeImage(12, 9, 1, false, bumpy))); // the same cells, about points
  auto wide = makeBumpy();
  wide->SetSpacing(2.0, 1.0, 1.0);
  CHECK(checks, !shares(wide));
  auto inverted = makeSampler(image);
  inverted->InvertDensityOn();
  inverted->Update();
  CHECK(checks, inverted->GetTableBuildTime() > built);
  auto clamped = makeSampler(image);
  clamped->SetNegativeValuesToClamp();
  clamped->Update();
  CHECK(checks, clamped->GetTableBuildTime() > built);

  auto hidden = makeBumpy();
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(hidden->GetNumberOfCells());
  ghosts->Fill(0);
  ghosts->SetValue(0, vtkDataSetAttributes::HIDDENCELL);
  hidden->GetCellData()->AddArray(ghosts);
  CHECK(checks, !shares(hidden));

  // The two components of one array.
  auto two = makeImage(
    13, 10, 1, true, [](vtkIdType i) { return bumpy(i * i); }, 2);
  auto one = makeSampler(two);
  one->SetComponent(0);
  auto next = makeSampler(two);
  next->SetComponent(1);
  CHECK(checks, sampleCoordinates(one) != sampleCoordinates(next));
  CHECK(checks, one->GetTableBuildTime() != next->GetTableBuildTime());
}

// Values that are not contiguous have no hash, and tables of their own.
void checkWithoutHash(Checks& checks)
{
  auto image = makeBumpy<vtkSOADataArrayTemplate<double>>();
  auto first = runSampler(image);
  auto second = runSampler(image);
  CHECK(checks, second->GetTableBuildTime() > first->GetTableBuildTime());
  CHECK(checks, coordinates(first->GetOutput()) == samplePoints(makeBumpy(), 200));
  CHECK(checks, coordinates(second->GetOutput()) == coordinates(first->GetOutput()));
}

// A blend builds no tables where other filters have those of its densities, and gives back its own.
void checkBlend(Checks& checks)
{
  auto source = makeBumpy();
  auto target = makeOther();
  const Values alone = runDensity(makeMorph(source, target));
  auto first = runSampler(source);
  auto second = runSampler(target);
  auto morph = makeMorph(source, target);
  CHECK(checks, runDensity(morph) == alone);
  CHECK(checks, morph->GetTableBuildTime() == second->GetTableBuildTime());
  first = second = nullptr;
  CHECK(checks, runSampler(source)->GetTableBuildTime() > morph->GetTableBuildTime());
}

// The values are hashed once where a density is new or has changed, else not at all.
void checkHashes(Checks& checks)
{
  auto source = makeBumpy<HashedArray>();
  auto target = makeBumpy<HashedArray>();
  changeDensity(target);
  const auto hashes = [](const Image& image) {
    return std::exchange(HashedArray::SafeDownCast(densityOf(image))->Hashes, 0);
  };
  hashes(source);
  hashes(target);
  const auto expect = [&](vtkAlgorithm* filter, int ofSource, int ofTarget, int line) {
    filter->Modified();
    filter->Update();
    const int found[2] = { hashes(source), hashes(target) };
    checks.That(found[0] == ofSource && found[1] == ofTarget, "hashes", line,
      std::to_string(found[0]) + " and " + std::to_string(found[1]));
  };
  for (const Reader& reader : makeReaders(source))
  {
    expect(reader.Filter, 1, 0, __LINE__);
    expect(reader.Filter, 0, 0, __LINE__);
    changeDensity(source);
    expect(reader.Filter, 1, 0, __LINE__);
  }
  auto morph = makeMorph(source, target);
  expect(morph, 1, 1, __LINE__);
  expect(morph, 0, 0, __LINE__);
  changeDensity(source);
  expect(morph, 1, 0, __LINE__);
  changeDensity(target);
  expect(morph, 0, 1, __LINE__);
  auto barycenter = makeBarycenter({ source, target });
  expect(barycenter, 1, 1, __LINE__);
  expect(barycenter, 0, 0, __LINE__);
}

} // namespace

int TestSharedTables(int, char*[])
{
  return runChecks(
    { checkOneImage, checkLeaving, checkWhatIsEqual, checkWithoutHash, checkBlend, checkHashes });
}
