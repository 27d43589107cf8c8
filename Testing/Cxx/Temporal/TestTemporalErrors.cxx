// SPDX-License-Identifier: BSD-3-Clause
// What vtkTransportTemporalInterpolator refuses is one error that names the step; both outputs are
// then empty, and other times come out.
#include "TemporalTest.h"

#include <limits>

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void checkProperties(Checks& checks)
{
  ImageSeries series(movingBlobs(), blobTimes);
  auto filter = makeInterpolator(series);
  requestTime(filter, 0.5);
  ErrorTest test(checks, filter);
  test.ExpectNone(__LINE__);
  filter->SetMethod(2);
  test.Expect("Method is 2; it must be 0 (RectifiedFlow) or 1 (Optimal)", __LINE__);
  filter->SetMethodToOptimal();
  for (const int wrong : { -1, 1000001, std::numeric_limits<int>::max() })
  {
    filter->SetResampleFactor(wrong);
    test.Expect(
      "ResampleFactor is " + std::to_string(wrong) + "; it must be from 0 (any time) to 1000000",
      __LINE__);
  }
  filter->SetResampleFactor(1000000);
  test.ExpectNone(__LINE__);
  filter->SetResampleFactor(0);
  for (const int wrong : { -1, 0 })
  {
    filter->SetParticlesPerCell(wrong);
    test.Expect(
      "ParticlesPerCell is " + std::to_string(wrong) + "; it must be at least 1", __LINE__);
  }
  filter->SetParticlesPerCell(1);
  filter->SetKernel(4);
  test.Expect("Kernel is 4; it must be 0 (CloudInCell), 1 (NearestCell)", __LINE__);
  filter->SetKernelToGaussian();
  for (const double wrong : { 0.0, -1.0, 10001.0, nan })
  {
    filter->SetRadius(wrong);
    std::ostringstream text;
    text << "Radius is " << wrong << "; it must be above 0";
    test.Expect(text.str(), __LINE__);
  }
  filter->SetRadius(1.0);
  filter->SetThreading(9);
  test.Expect("Threading is 9; it must be 0 (Auto)", __LINE__);
  filter->SetThreadingToAuto();
  test.ExpectNone(__LINE__);
}

// As many announced steps as no list should have.
void checkManySteps(Checks& checks)
{
  Images steps;
  Times times;
  for (int i = 0; i < 11; ++i)
  {
    steps.push_back(makeBlob(12 + i, 14));
    times.push_back(i);
  }
  ImageSeries series(steps, times);
  auto filter = makeInterpolator(series);
  filter->SetResampleFactor(1000000);
  requestTime(filter, 0.5);
  CHECK(checks, !filter->GetOutputInformation(0)->Has(Pipeline::TIME_STEPS()));
  ErrorTest test(checks, filter);
  test.Expect(
    "ResampleFactor is 1000000, which would make about 1.1e+07 time steps; it must make at "
    "most 10000000",
    __LINE__);
  filter->SetResampleFactor(10);
  test.ExpectNone(__LINE__);
}

// One step of a series is wrong: where it is not needed there is no error.
void checkSteps(Checks& checks)
{
  const auto refused = [&](const std::function<void(vtkImageData*)>& change,
                         const std::string& part, int line) {
    Images steps = movingBlobs();
    change(steps[2]);
    ImageSeries series(steps, blobTimes);
    auto filter = makeInterpolator(series);
    requestTime(filter, 1.5);
    ErrorTest test(checks, filter);
    test.Expect({ "Time step 3 of 3 (t = 2)", part }, line);
    requestTime(filter, 0.5);
    test.ExpectNone(line);
    checks.That(!isEmpty(filter), "outputs", line);
  };
  refused([](vtkImageData* image) { densityOf(image)->SetComponent(5, 0, nan); },
    ": The density array 'Density' has 1 value that is NaN or infinite", __LINE__);
  refused([](vtkImageData* image) { densityOf(image)->SetComponent(5, 0, -1.0); },
    ": The density array 'Density' has 1 negative value", __LINE__);
  refused([](vtkImageData* image) { densityOf(image)->Fill(1e308); },
    "has a total mass past the largest double", __LINE__);
  refused(
    [](vtkImageData* image) {
      const double turned[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
      image->SetDirectionMatrix(turned);
    },
    "different direction matrices", __LINE__);
  refused([](vtkImageData* image) { image->SetOrigin(0.0, 0.0, 2.0); },
    "images that are flat along an axis must lie in one plane", __LINE__);
  refused([](vtkImageData* image) { image->ShallowCopy(unitCells(4, 4, 4)); }, "axes", __LINE__);
}

void checkArrays(Checks& checks)
{
  Images steps = movingBlobs();
  densityOf(steps[1])->SetName("Other");
  ImageSeries series(steps, blobTimes);
  auto filter = makeInterpolator(series);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  requestTime(filter, 0.5);
  ErrorTest test(checks, filter);
  test.Expect("Time step 2 of 3 (t = 1): The input image has no density array 'Density'; it has no "
              "point arrays and Other (cell)",
    __LINE__);
}

void checkTimes(Checks& checks)
{
  ImageSeries series({ makeBlob(12, 14), makeBlob(30, 22) }, { 0.0, 1e-307 });
  auto filter = makeInterpolator(series);
  requestTime(filter, 0.0);
  ErrorTest test(checks, filter);
  test.Expect("Time step 1 of 2 (t = 0) and the next one are 1e-307 apart in time, so that "
              "velocities pass the largest double; the steps must be further apart",
    __LINE__);
  series.StepTimes = { 0.0, 1e-300 };
  series.Modified();
  requestTime(filter, 5e-301);
  test.ExpectNone(__LINE__);
  for (const double value : particleValues(filter, "Velocity"))
  {
    CHECK(checks, std::isfinite(value));
  }
  requestTime(filter, nan);
  test.Expect("The pipeline's time is nan; it must be a number", __LINE__);
}

// Mass may appear and disappear; a series without any is one without mass.
void checkNoMass(Checks& checks)
{
  const auto nothing = makeBlob(12, 14, 5.0, 0.0);
  ImageSeries series({ nothing, makeBlob(12, 14), nothing, nothing }, { 0.0, 1.0, 2.0, 3.0 });
  auto filter = makeInterpolator(series);
  Messages messages(filter);
  const Values truth = imageValues(makeBlob(12, 14), "Density");
  for (const auto& [time, factor] : { std::pair(0.0, 0.0), std::pair(0.25, 0.25),
         std::pair(1.0, 1.0), std::pair(1.5, 0.5), std::pair(2.0, 0.0), std::pair(2.5, 0.0) })
  {
    Values wanted = truth;
    for (double& value : wanted)
    {
      value *= factor;
    }
    CHECK_NEAR(checks, largestDifference(densityAt(filter, time), wanted), 0.0, 1e-12);
  }
  CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 3);
  CHECK(checks,
    contains(messages.Warnings[0],
      "Time step 1 of 4 (t = 0) has no mass: that of the next step appears where it is"));
  CHECK(checks,
    contains(messages.Warnings[1],
      "Time step 3 of 4 (t = 2) has no mass: that of the step before disappears where it is"));
  CHECK(checks, contains(messages.Warnings[2], "and the next one have no mass"));

  ImageSeries one({ nothing }, { 0.0 });
  ErrorTest(checks, makeInterpolator(one))
    .Expect("The density array 'Density' has a total mass of zero", __LINE__);
}

} // namespace

int TestTemporalErrors(int, char*[])
{
  return runChecks(
    { checkProperties, checkManySteps, checkSteps, checkArrays, checkTimes, checkNoMass });
}
