// SPDX-License-Identifier: BSD-3-Clause
// The maps of vtkTransportInterpolator and vtkTransportBarycenter are made once for each density,
// and anew for what has changed alone.
#include "BlendTest.h"
#include "ProgressTest.h"

namespace
{

using Array = vtkSmartPointer<vtkDoubleArray>;

Array positionsOf(vtkTransportBlend* blend, const char* name)
{
  return vtkDoubleArray::SafeDownCast(pointArray(blend->GetParticles(), name));
}

bool sameMemory(const Array& a, const Array& b)
{
  return a && b && a->GetPointer(0) == b->GetPointer(0);
}

vtkSmartPointer<vtkImageData> anew(vtkImageData* image)
{
  auto copy = vtkSmartPointer<vtkImageData>::New();
  copy->ShallowCopy(image);
  return copy;
}

class MorphTest
{
public:
  MorphTest()
    : Source(makeDensity({ 30, 20, 1 }, true, smoothDensity(30, 20)))
    , Target(makeDensity({ 30, 20, 1 }, true, otherDensity(30, 20)))
    , Morph(makeMorph(this->Source, this->Target))
  {
    this->Remember();
  }

  // Takes the maps of now for those before.
  void Remember()
  {
    this->Morph->Update();
    this->From = positionsOf(this->Morph, "SourcePosition");
    this->To = positionsOf(this->Morph, "TargetPosition");
  }

  void Connect()
  {
    this->Morph->SetInputData(this->Source);
    this->Morph->SetTargetData(this->Target);
  }

  // The other way round, and the maps with the images.
  void Swap()
  {
    std::swap(this->Source, this->Target);
    std::swap(this->From, this->To);
    this->Connect();
  }

  // As ParaView, which passes on shallow copies at every update.
  void Renew()
  {
    this->Source = anew(this->Source);
    this->Target = anew(this->Target);
    this->Connect();
  }

  void Abort(Checks& checks, double from)
  {
    {
      ProgressTest abort(this->Morph);
      abort.AbortFrom = from;
      this->Morph->Update();
      CHECK(checks, this->Morph->GetAbortExecute() != 0 && isEmpty(this->Morph));
      this->Morph->SetAbortExecute(0);
    }
    this->Morph->Modified();
    this->Remember();
  }

  // Updates: which of the maps are made anew, and what comes out is what a new filter gives.
  void Expect(Checks& checks, bool newSource, bool newTarget, int line)
  {
    const Array from = this->From;
    const Array to = this->To;
    const bool built = builds(this->Morph);
    this->Remember();
    checks.That(built == (newSource || newTarget), "tables", line);
    checks.That(sameMemory(from, this->From) != newSource, "the source's map", line);
    checks.That(sameMemory(to, this->To) != newTarget, "the target's map", line);

    auto fresh = makeMorph(this->Source, this->Target, this->Morph->GetParameter());
    fresh->SetMassMode(this->Morph->GetMassMode());
    fresh->SetKernel(this->Morph->GetKernel());
    fresh->SetRadius(this->Morph->GetRadius());
    fresh->SetParticlesPerCell(this->Morph->GetParticlesPerCell());
    fresh->SetDimensions(this->Morph->GetDimensions());
    fresh->SetIntegrator(this->Morph->GetIntegrator());
    fresh->SetNumberOfSteps(this->Morph->GetNumberOfSteps());
    fresh->SetTableLookup(this->Morph->GetTableLookup());
    fresh->SetFlowMaps(this->Morph->GetFlowMaps());
    fresh->SetInvertDensity(this->Morph->GetInvertDensity());
    const Values expected = runDensity(fresh);
    checks.That(!expected.empty() && densityValues(this->Morph) == expected, "as anew", line);
    checks.That(particlePlaces(this->Morph) == particlePlaces(fresh), "places as anew", line);
    vtkPolyData* particles = this->Morph->GetParticles();
    checks.That(particles->GetNumberOfVerts() == particles->GetNumberOfPoints() &&
        particles->GetNumberOfCells() == particles->GetNumberOfPoints(),
      "a vertex each", line);
  }

  vtkSmartPointer<vtkImageData> Source;
  vtkSmartPointer<vtkImageData> Target;
  vtkSmartPointer<vtkTransportInterpolator> Morph;
  // Held, so that no new map takes their place in memory.
  Array From;
  Array To;
};

#define EXPECT_MAPS(test, newSource, newTarget)                                                    \
  (test).Expect(checks, newSource, newTarget, __LINE__)

void checkProperties(Checks& checks)
{
  MorphTest test;
  vtkTransportInterpolator* morph = test.Morph;
  CHECK(checks, test.From && test.To && !sameMemory(test.From, test.To));
  morph->SetParameter(0.25);
  EXPECT_MAPS(test, false, false);
  morph->SetMassModeToGeometric();
  EXPECT_MAPS(test, false, false);
  morph->SetKernelToGaussian();
  EXPECT_MAPS(test, false, false);
  morph->SetRadius(2.5);
  EXPECT_MAPS(test, false, false);
  morph->SetThreadingToSerial();
  EXPECT_MAPS(test, false, false);

  morph->SetParticlesPerCell(2);
  EXPECT_MAPS(test, true, true);
  morph->SetNumberOfSteps(16);
  EXPECT_MAPS(test, true, true);
  morph->SetIntegratorToEuler();
  EXPECT_MAPS(test, true, true);
  morph->SetFlowMapsToOn();
  EXPECT_MAPS(test, true, true);
  morph->SetTableLookupToNearest();
  EXPECT_MAPS(test, true, true);
  morph->SetDimensions(17, 0, 0);
  EXPECT_MAPS(test, true, true);
  morph->InvertDensityOn();
  EXPECT_MAPS(test, true, true);
}

void setValue(vtkImageData* image, double value)
{
  vtkDataArray* array = image->GetCellData()->GetScalars();
  array->SetComponent(7, 0, value);
  array->Modified();
  image->Modified();
}

void checkInputs(Checks& checks)
{
  MorphTest test;
  setValue(test.Source, 3.0);
  EXPECT_MAPS(test, true, false);
  setValue(test.Target, 4.0);
  EXPECT_MAPS(test, false, true);
  test.Target = makeDensity({ 30, 20, 1 }, true, bumpy);
  test.Morph->SetTargetData(test.Target);
  EXPECT_MAPS(test, false, true);

  test.Source = anew(test.Source);
  test.Morph->SetInputData(test.Source);
  EXPECT_MAPS(test, false, false);
  test.Renew();
  EXPECT_MAPS(test, false, false);
  test.Source->Modified();
  EXPECT_MAPS(test, false, false);

  test.Swap();
  EXPECT_MAPS(test, false, false);

  // Written into, without Modified() of the array.
  test.Source->GetCellData()->GetScalars()->SetComponent(9, 0, 11.0);
  test.Source->Modified();
  EXPECT_MAPS(test, true, false);
}

// The particles are in physical space: the same values elsewhere are other positions.
void checkPlaces(Checks& checks)
{
  MorphTest test;
  test.Target->SetOrigin(0.0, 3.0, 0.0);
  test.Morph->SetDimensions(30, 20, 1);
  EXPECT_MAPS(test, false, true);
  test.Source->SetOrigin(-2.0, 0.0, 0.0);
  EXPECT_MAPS(test, true, false);
  // Of the same area.
  test.Source->SetSpacing(2.0, 0.5, 1.0);
  EXPECT_MAPS(test, true, false);
  const double turned[9] = { 0, 1, 0, -1, 0, 0, 0, 0, 1 };
  test.Source->SetDirectionMatrix(turned);
  test.Target->SetDirectionMatrix(turned);
  EXPECT_MAPS(test, true, true);

  // One array in two places.
  test.Target = anew(test.Source);
  test.Target->SetOrigin(10.0, 5.0, 0.0);
  test.Morph->SetTargetData(test.Target);
  EXPECT_MAPS(test, false, true);
  test.Renew();
  EXPECT_MAPS(test, false, false);
  test.Swap();
  EXPECT_MAPS(test, false, false);
}

// One density as both inputs has one map.
void checkOneDensity(Checks& checks)
{
  auto image = makeDensity({ 30, 20, 1 }, true, bumpy);
  auto morph = makeMorph(image, image);
  CHECK(checks, builds(morph));
  CHECK(
    checks, sameMemory(positionsOf(morph, "SourcePosition"), positionsOf(morph, "TargetPosition")));
  auto copy = anew(image);
  morph->SetTargetData(copy);
  CHECK(checks, !builds(morph));
  setValue(image, 5.0);
  auto fresh = makeMorph(image, copy);
  CHECK(checks, runDensity(morph) == runDensity(fresh));
}

// Neither an error nor an abort leaves a map that is not of its density.
void checkFailures(Checks& checks)
{
  MorphTest test;
  Messages messages(test.Morph);
  vtkDataArray* array = test.Target->GetCellData()->GetScalars();
  const double before = array->GetComponent(7, 0);
  setValue(test.Target, -1.0);
  test.Morph->Update();
  CHECK(checks, messages.Errors.size() == 1 && isEmpty(test.Morph));
  setValue(test.Target, before);
  test.Remember();
  test.Morph->SetParameter(0.75);
  EXPECT_MAPS(test, false, false);

  for (const double from : { 0.0, 0.2, 0.5, 0.9 })
  {
    setValue(test.Source, 5.0 + from);
    setValue(test.Target, 6.0 + from);
    test.Abort(checks, from);
    test.Morph->SetParameter(0.5 - 0.1 * from);
    EXPECT_MAPS(test, false, false);
  }

  // Of new settings for the same densities.
  int steps = 64;
  for (const double from : { 0.0, 0.2, 0.5 })
  {
    steps /= 2;
    test.Morph->SetNumberOfSteps(steps);
    test.Abort(checks, from);
    test.Morph->SetParameter(0.2 + 0.1 * from);
    EXPECT_MAPS(test, false, false);
  }
  CHECK(checks, messages.Errors.size() == 1);
}

// Maps follow their densities through the list.
void checkBarycenter(Checks& checks)
{
  auto a = makeDensity({ 30, 20, 1 }, true, smoothDensity(30, 20));
  auto b = makeDensity({ 30, 20, 1 }, true, otherDensity(30, 20));
  auto c = makeDensity({ 30, 20, 1 }, true, bumpy);
  auto barycenter = makeBarycenter({ a, b, c }, { 1, 2, 3 });
  CHECK(checks, builds(barycenter));
  const auto give = [&](const std::vector<vtkImageData*>& images, const Values& weights) {
    barycenter->RemoveAllInputs();
    for (vtkImageData* image : images)
    {
      barycenter->AddInputDataObject(image);
    }
    barycenter->SetNumberOfWeights(0);
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      barycenter->SetWeight(static_cast<int>(i), weights[i]);
    }
    const bool built = builds(barycenter);
    checks.That(densityValues(barycenter) == runDensity(makeBarycenter(images, weights)), "as anew",
      __LINE__);
    return built;
  };
  CHECK(checks, !give({ a, b, c }, { 3, 2, 1 }));
  CHECK(checks, !give({ a, b, c }, {}));
  CHECK(checks, !give({ c, a, b }, { 1, 0, 4 }));
  CHECK(checks, !give({ c, a, b, a }, {}));
  CHECK(checks, !give({ b, a }, { 1, 3 }));
  auto again = anew(a);
  CHECK(checks, !give({ again, b }, { 1, 3 }));
  CHECK(checks, give({ again, b, c }, { 1, 3, 2 }));
  setValue(b, 9.0);
  CHECK(checks, give({ again, b, c }, { 1, 3, 2 }));
  barycenter->SetKernelToNearestCell();
  barycenter->SetMassModeToNormalize();
  CHECK(checks, !builds(barycenter));
  barycenter->SetNumberOfSteps(8);
  CHECK(checks, builds(barycenter));
}

} // namespace

int TestMorphCache(int, char*[])
{
  return runChecks(
    { checkProperties, checkInputs, checkPlaces, checkOneDensity, checkFailures, checkBarycenter });
}
