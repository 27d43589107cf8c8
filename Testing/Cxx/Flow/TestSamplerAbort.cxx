// SPDX-License-Identifier: BSD-3-Clause
// Progress by stages, and an abort in the middle of a large run: soon over, an empty output, and
// the next run succeeds.
#include "ProgressTest.h"

#include "vtkCompositeDataPipeline.h"
#include "vtkUnsignedCharArray.h"

namespace
{

void checkProgress(Checks& checks, vtkTransportSampler* sampler)
{
  ProgressTest test(sampler);
  sampler->Modified();
  sampler->Update();
  test.ExpectRising(checks, 11, __LINE__);
  double step = 0.0;
  for (std::size_t i = 1; i < test.Recorded.size(); ++i)
  {
    step = std::max(step, test.Recorded[i] - test.Recorded[i - 1]);
  }
  CHECK_NEAR(checks, step, 0.0, 0.5);
}

void checkAbort(Checks& checks, vtkTransportSampler* sampler, double from, int line)
{
  checkAbort(
    checks, sampler, from, [&]() { changeDensity(sampler->GetInputDataObject(0, 0)); }, line);
}

} // namespace

int TestSamplerAbort(int, char*[])
{
  Checks checks;
  constexpr int size = 256;
  vtkNew<vtkImageData> image;
  image->SetDimensions(size, size, size);
  vtkNew<vtkUnsignedCharArray> values;
  values->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
  {
    values->SetValue(i, static_cast<unsigned char>(1 + i % size));
  }
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputData(image);
  sampler->SetSeedPatternToRandom();
  // Tables, flow and writing each have their share of progress at their particles.
  sampler->SetNumberOfParticles(1000000);
  checkAbort(checks, sampler, 0.01, __LINE__);
  checkAbort(checks, sampler, 0.5, __LINE__);
  sampler->SetFlowTime(0.0);
  sampler->SetNumberOfParticles(4000000);
  checkAbort(checks, sampler, 0.999, __LINE__);
  sampler->SetFlowTime(1.0);
  CHECK(checks, messages.Errors.empty());

  sampler->SetNumberOfParticles(20000);
  changeDensity(image);
  checkProgress(checks, sampler);
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 20000);
  CHECK(checks, fieldValue(sampler->GetOutput(), "TotalMass") > 0.0);
  CHECK(checks, messages.Errors.empty());

  // The optimal map takes most of the progress.
  auto plane = makeImage<vtkUnsignedCharArray>(
    900, 800, 1, false, [](vtkIdType i) { return static_cast<double>(1 + i % 900 / 4); });
  sampler->SetInputData(plane);
  sampler->SetMethodToOptimal();
  for (const double from : { 0.1, 0.3, 0.5, 0.7, 0.9 })
  {
    checkAbort(checks, sampler, from, __LINE__);
  }
  changeDensity(plane);
  checkProgress(checks, sampler);
  CHECK(checks, fieldValue(sampler->GetOutput(), "OptimalityGap") < 0.01);
  CHECK(checks, messages.Errors.empty());
  return checks.Result();
}
