// SPDX-License-Identifier: BSD-3-Clause
// At its steps, vtkTransportTemporalInterpolator gives the input to the last bit; which times it
// announces, and what it makes of times that are not those of a series.
#include "TemporalTest.h"

#include "vtkFloatArray.h"
#include "vtkUnsignedCharArray.h"

#include <limits>

namespace
{

template <class ArrayT>
vtkSmartPointer<vtkImageData> copyOf(vtkImageData* image)
{
  const Values values = imageValues(image, "Density");
  return makeImage<ArrayT>(blobSide + 1, blobSide + 1, 1, true,
    [&](vtkIdType i) { return 150.0 * values[static_cast<std::size_t>(i)]; });
}

template <class ArrayT>
void checkBits(Checks& checks)
{
  Images steps;
  for (const auto& blob : movingBlobs())
  {
    steps.push_back(copyOf<ArrayT>(blob));
  }
  ImageSeries series(steps, blobTimes);
  for (const int method : temporalMethods)
  {
    auto filter = makeInterpolator(series, method);
    for (const std::size_t step : { 0, 1, 2, 0 })
    {
      const Values wanted = imageValues(steps[step], "Density");
      CHECK(checks, densityAt(filter, blobTimes[step]) == wanted);
      CHECK(checks, densityOf(filter->GetDensity())->GetDataType() == VTK_DOUBLE);
      // The particles are those of this step alone.
      const Values masses = particleValues(filter, "Mass");
      const auto cells =
        std::count_if(wanted.begin(), wanted.end(), [](double v) { return v > 0; });
      CHECK(checks, static_cast<std::ptrdiff_t>(masses.size()) == cells);
      CHECK_NEAR(checks, sumOf(masses) / sumOf(wanted), 1.0, 1e-12);
      for (vtkDataObject* output : { static_cast<vtkDataObject*>(filter->GetDensity()),
             static_cast<vtkDataObject*>(filter->GetParticles()) })
      {
        CHECK(checks,
          output->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()) == blobTimes[step]);
      }
    }
  }
}

void checkPoints(Checks& checks)
{
  const Images steps = { makeBlob(12, 14, 5.0, 1.0, false), makeBlob(28, 22, 5.0, 1.0, false) };
  ImageSeries series(steps, { 0.0, 1.0 });
  auto filter = makeInterpolator(series);
  for (const std::size_t step : { 1, 0 })
  {
    CHECK(
      checks, densityAt(filter, static_cast<double>(step)) == imageValues(steps[step], "Density"));
    CHECK(checks, filter->GetDensity()->GetPointData()->GetScalars() != nullptr);
  }
}

// The output is continuous at a step, and a time outside of the series is its end.
void checkNearSteps(Checks& checks)
{
  const Images steps = movingBlobs();
  ImageSeries series(steps, blobTimes);
  auto filter = makeInterpolator(series);
  for (std::size_t step = 0; step < 3; ++step)
  {
    const Values wanted = imageValues(steps[step], "Density");
    for (const double time : { blobTimes[step] - 1e-9, blobTimes[step] + 1e-9 })
    {
      CHECK_NEAR(checks, largestDifference(densityAt(filter, time), wanted), 0.0, 1e-6);
    }
  }
  CHECK(checks, densityAt(filter, -7.0) == imageValues(steps[0], "Density"));
  CHECK(checks, densityAt(filter, 99.0) == imageValues(steps[2], "Density"));
}

void expectTimes(Checks& checks, vtkAlgorithm* filter, const Times& steps, int line)
{
  filter->UpdateInformation();
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* output = filter->GetOutputInformation(port);
    Times found(static_cast<std::size_t>(output->Length(Pipeline::TIME_STEPS())));
    if (!found.empty())
    {
      output->Get(Pipeline::TIME_STEPS(), found.data());
    }
    checks.That(found == steps, "time steps", line);
    const double* range = output->Get(Pipeline::TIME_RANGE());
    checks.That(range && range[0] == 0.0 && range[1] == 3.0, "time range", line);
  }
}

void checkAnnouncedTimes(Checks& checks)
{
  ImageSeries series(movingBlobs(), { 0.0, 1.0, 3.0 });
  auto filter = makeInterpolator(series);
  expectTimes(checks, filter, {}, __LINE__);
  filter->SetResampleFactor(1);
  expectTimes(checks, filter, { 0.0, 1.0, 3.0 }, __LINE__);
  filter->SetResampleFactor(4);
  expectTimes(checks, filter, { 0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0 }, __LINE__);
  // What is announced does not bind: other times may be requested.
  const Values between = densityAt(filter, 0.3);
  filter->SetResampleFactor(0);
  expectTimes(checks, filter, {}, __LINE__);
  CHECK(checks, densityAt(filter, 0.3) == between);
}

// Times that are not in order, repeated or not finite.
void checkUnorderedTimes(Checks& checks)
{
  const Images steps = movingBlobs();
  ImageSeries plain(steps, { 0.0, 1.0, 3.0 });
  ImageSeries series({ steps[2], steps[0], steps[0], steps[1], steps[1] },
    { 3.0, 0.0, 0.0, 1.0, std::numeric_limits<double>::infinity() });
  auto filter = makeInterpolator(series);
  filter->SetResampleFactor(2);
  expectTimes(checks, filter, { 0.0, 0.5, 1.0, 2.0, 3.0 }, __LINE__);
  auto same = makeInterpolator(plain);
  for (const double time : { 0.0, 0.5, 2.0, 3.0 })
  {
    CHECK(checks, outputsAt(filter, time) == outputsAt(same, time));
  }
}

// The density comes out as it is, with one warning.
void checkOneStep(Checks& checks)
{
  const Values wanted = imageValues(makeBlob(12, 14), "Density");
  for (const Times& times : { Times{ 5.0 }, Times{} })
  {
    ImageSeries series({ makeBlob(12, 14) }, times);
    auto filter = makeInterpolator(series);
    Messages messages(filter);
    for (const double time : { 5.0, 3.0, 8.0 })
    {
      CHECK(checks, densityAt(filter, time) == wanted);
      CHECK(checks,
        largestDifference(particleValues(filter, "Velocity"),
          Values(particleValues(filter, "Velocity").size(), 0.0)) == 0.0);
    }
    CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 1);
    CHECK(checks,
      contains(messages.Warnings[0],
        times.empty() ? "The input has no time steps: no mass moves"
                      : "The input has one time step: no mass moves"));
  }
}

} // namespace

int TestTemporalSteps(int, char*[])
{
  return runChecks(
    { checkBits<vtkDoubleArray>, checkBits<vtkFloatArray>, checkBits<vtkUnsignedCharArray>,
      checkPoints, checkNearSteps, checkAnnouncedTimes, checkUnorderedTimes, checkOneStep });
}
