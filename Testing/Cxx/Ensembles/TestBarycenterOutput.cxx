// SPDX-License-Identifier: BSD-3-Clause
// vtkTransportBarycenter: what weights do, and that of two densities it is the morph.
#include "BlendTest.h"

#include <limits>

namespace
{

// Three densities of one geometry.
struct Inputs
{
  vtkSmartPointer<vtkImageData> A = makeDensity({ 24, 18, 1 }, true, smoothDensity(24, 18));
  vtkSmartPointer<vtkImageData> B = makeDensity({ 24, 18, 1 }, true, otherDensity(24, 18));
  vtkSmartPointer<vtkImageData> C = makeDensity({ 24, 18, 1 }, true, bumpy);
};

void checkMorph(Checks& checks)
{
  const Inputs in;
  auto elsewhere = makeDensity({ 30, 10, 1 }, false, bumpy);
  elsewhere->SetOrigin(7.0, 9.0, 0.0);
  for (vtkImageData* target : { in.B.Get(), elsewhere.Get() })
  {
    auto morph = makeMorph(in.A, target);
    auto barycenter = makeBarycenter({ in.A, target });
    for (int mode = 0; mode < 4; ++mode)
    {
      morph->SetMassMode(mode);
      barycenter->SetMassMode(mode);
      for (const double t : { 0.0, 0.1, 0.25, 0.3, 0.5, 0.7, 0.9, 1.0 / 3.0, 1.0 })
      {
        morph->SetParameter(t);
        barycenter->SetWeight(0, 1.0 - t);
        barycenter->SetWeight(1, t);
        const Values expected = runDensity(morph);
        CHECK(checks, !expected.empty() && runDensity(barycenter) == expected);
        CHECK(checks, particlePlaces(barycenter) == particlePlaces(morph));
        CHECK(checks, particleValues(barycenter, "Mass") == particleValues(morph, "Mass"));
      }
    }
  }
}

void checkWeights(Checks& checks)
{
  const Inputs in;
  const std::vector<vtkImageData*> all = { in.A, in.B, in.C };
  // (1, 0, 0) is the first, and so on.
  const Values first = runDensity(makeMorph(in.A, in.B, 0.0));
  CHECK(checks, !first.empty() && runDensity(makeBarycenter(all, { 1, 0, 0 })) == first);
  CHECK(
    checks, runDensity(makeBarycenter(all, { 0, 5, 0 })) == runDensity(makeMorph(in.A, in.B, 1.0)));
  CHECK(checks,
    runDensity(makeBarycenter(all, { 0, 0, 0.3 })) == runDensity(makeMorph(in.A, in.C, 1.0)));
  CHECK(checks, runDensity(makeBarycenter({ in.A })) == first);

  // None are equal ones; they are divided by their sum.
  const Values equal = runDensity(makeBarycenter(all));
  CHECK(checks, runDensity(makeBarycenter(all, { 1, 1, 1 })) == equal);
  CHECK(checks, runDensity(makeBarycenter(all, { 8, 8, 8 })) == equal);
  const Values uneven = runDensity(makeBarycenter(all, { 0.25, 0.25, 0.5 }));
  CHECK(checks, uneven != equal && runDensity(makeBarycenter(all, { 2, 2, 4 })) == uneven);
  constexpr double most = std::numeric_limits<double>::max();
  CHECK(checks, runDensity(makeBarycenter(all, { most / 2, most / 2, most })) == uneven);
  constexpr double least = std::numeric_limits<double>::denorm_min();
  CHECK(checks, runDensity(makeBarycenter(all, { least, least, 2 * least })) == uneven);

  // Places are the weighted means of those of the inputs alone.
  auto barycenter = makeBarycenter(all, { 1, 2, 3 });
  barycenter->Update();
  Values mean(particlePlaces(barycenter).size(), 0.0);
  for (std::size_t i = 0; i < 3; ++i)
  {
    Values weights(3, 0.0);
    weights[i] = 1.0;
    auto alone = makeBarycenter(all, weights);
    alone->Update();
    const Values places = particlePlaces(alone);
    for (std::size_t k = 0; k < mean.size(); ++k)
    {
      mean[k] += static_cast<double>(i + 1) / 6.0 * places[k];
    }
  }
  CHECK_NEAR(checks, largestDifference(particlePlaces(barycenter), mean), 0.0, 1e-12);

  // The order of inputs, with their weights, counts to rounding.
  auto turned = makeBarycenter({ in.C, in.A, in.B }, { 3, 1, 2 });
  turned->Update();
  CHECK_NEAR(checks, largestDifference(particlePlaces(turned), mean), 0.0, 1e-12);
}

void checkMass(Checks& checks)
{
  const Inputs in;
  const double a = massOf(in.A);
  const double b = massOf(in.B);
  const double c = massOf(in.C);
  auto barycenter = makeBarycenter({ in.A, in.B, in.C }, { 1, 2, 5 });
  const double expected[] = { (a + 2 * b + 5 * c) / 8,
    std::exp((std::log(a) + 2 * std::log(b) + 5 * std::log(c)) / 8), a, 1.0 };
  for (int mode = 0; mode < 4; ++mode)
  {
    barycenter->SetMassMode(mode);
    for (int kernel = 0; kernel < 4; ++kernel)
    {
      barycenter->SetKernel(kernel);
      barycenter->Update();
      const double total = fieldValue(barycenter->GetDensity(), "TotalMass");
      CHECK_NEAR(checks, total, expected[mode], 1e-12 * total);
      CHECK_NEAR(checks, massOf(barycenter->GetDensity()), total, 1e-12 * total);
      CHECK_NEAR(checks, sumOf(particleValues(barycenter, "Mass")), total, 1e-12 * total);
    }
  }
  CHECK(checks, barycenter->GetParticles()->GetPointData()->GetNumberOfArrays() == 1);
}

// The list of weights itself.
void checkList(Checks& checks)
{
  vtkNew<vtkTransportBarycenter> barycenter;
  setSimplest(barycenter);
  Messages messages(barycenter);
  CHECK(checks, barycenter->GetNumberOfWeights() == 0 && barycenter->GetWeight(0) == 0.0);
  barycenter->SetWeight(2, 4.0);
  CHECK(checks, barycenter->GetNumberOfWeights() == 3);
  CHECK(checks, barycenter->GetWeight(0) == 0.0 && barycenter->GetWeight(2) == 4.0);
  vtkMTimeType time = barycenter->GetMTime();
  barycenter->SetWeight(2, 4.0);
  barycenter->SetNumberOfWeights(3);
  CHECK(checks, barycenter->GetMTime() == time);
  barycenter->SetWeight(1, 2.0);
  CHECK(checks, barycenter->GetMTime() > time);
  time = barycenter->GetMTime();
  barycenter->SetNumberOfWeights(2);
  CHECK(checks, barycenter->GetMTime() > time && barycenter->GetNumberOfWeights() == 2);
  CHECK(checks, barycenter->GetWeight(2) == 0.0 && barycenter->GetWeight(-1) == 0.0);
  CHECK(checks, messages.Errors.empty());
  barycenter->SetWeight(-1, 2.0);
  CHECK(checks, messages.IsOneError("weight is -1; it must be from 0 to 999999"));
  barycenter->SetNumberOfWeights(-4);
  CHECK(checks,
    messages.Errors.size() == 2 &&
      contains(messages.Errors[1], "weights is -4; it must be from 0 to 1000000"));
  // As many as an int counts, and past it.
  constexpr int most = std::numeric_limits<int>::max();
  for (const int index : { most, most - 1, 1000000 })
  {
    messages.Clear();
    barycenter->SetWeight(index, 1.0);
    CHECK(checks, messages.IsOneError("weight is " + std::to_string(index)));
  }
  messages.Clear();
  barycenter->SetNumberOfWeights(most);
  CHECK(checks, messages.IsOneError("weights is 2147483647"));
  CHECK(checks, barycenter->GetNumberOfWeights() == 2);
  barycenter->SetWeight(999999, 0.5);
  CHECK(checks, barycenter->GetNumberOfWeights() == 1000000);
}

} // namespace

int TestBarycenterOutput(int, char*[])
{
  return runChecks({ checkMorph, checkWeights, checkMass, checkList });
}
