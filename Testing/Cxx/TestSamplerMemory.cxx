// SPDX-License-Identifier: BSD-3-Clause
// Memory that cannot be had: an error that says how much was asked for, and nothing is lost.
#include "../MemoryLimit.h"
#include "SamplerTest.h"

#include "vtkUniformSeedSource.h"
#include "vtkUnsignedCharArray.h"

#include <limits>

namespace
{

void expectError(
  Checks& checks, vtkAlgorithm* algorithm, Messages& messages, const char* what, int line)
{
  messages.Clear();
  algorithm->Update();
  const std::string text = messages.Errors.empty() ? "no error" : messages.Errors[0];
  checks.That(messages.Errors.size() == 1 && contains(text, "Not enough memory for") &&
      contains(text, what) && contains(text, "were asked for"),
    "one error about memory", line, text);
  auto* output = vtkPolyData::SafeDownCast(algorithm->GetOutputDataObject(0));
  checks.That(output && output->GetNumberOfPoints() == 0, "empty output", line);
}

void checkAbsurdNumbers(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  auto image = makeImage(12, 9, 1, true, bumpy);
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(100);
  sampler->Update();
  const vtkMTimeType built = sampler->GetTableBuildTime();

  sampler->SetNumberOfParticles(1000000000000);
  expectError(checks, sampler, messages, "1000000000000 particles", __LINE__);
  CHECK(checks, contains(messages.Errors[0], "TB were asked for"));
  // A particle of a volume takes the bytes of its arrays: three of 3 doubles, Mass, SeedId, and its
  // vertex of two ids.
  sampler->SetInputData(makeImage(12, 9, 5, true, bumpy));
  sampler->Update();
  CHECK(checks, contains(messages.Errors.back(), ": 104 TB were asked for"));
  sampler->SetInputData(image);
  for (int pattern = 0; pattern < 5; ++pattern)
  {
    sampler->SetSeedPattern(pattern);
    sampler->SetNumberOfParticles(std::numeric_limits<vtkIdType>::max());
    expectError(checks, sampler, messages, "particles", __LINE__);
  }
  sampler->SetNumberOfParticles(100);
  sampler->SetSeedPatternToLattice();
  sampler->SetSamplesPerCell(std::numeric_limits<int>::max());
  expectError(checks, sampler, messages, "SamplesPerCell", __LINE__);
  sampler->SetSamplesPerCell(0);
  sampler->SetSeedPatternToBlueNoise();
  sampler->OutputPathsOn();
  sampler->SetNumberOfSteps(10000);
  sampler->SetNumberOfParticles(1000000000);
  expectError(checks, sampler, messages, "the paths of 1000000000 particles", __LINE__);
  sampler->OutputPathsOff();
  sampler->SetNumberOfParticles(100);
  messages.Clear();
  sampler->Update();
  CHECK(checks, messages.Errors.empty());
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 100);
  CHECK(checks, sampler->GetTableBuildTime() == built);

  vtkNew<vtkUniformSeedSource> source;
  Messages ofSource(source);
  for (const int dimension : { 2, 3 })
  {
    source->SetDimension(dimension);
    source->SetNumberOfPoints(1000000000000000);
    expectError(checks, source, ofSource, "NumberOfPoints", __LINE__);
  }
  source->SetNumberOfPoints(10);
  ofSource.Clear();
  source->Update();
  CHECK(checks, ofSource.Errors.empty() && source->GetOutput()->GetNumberOfPoints() == 10);
}

#ifdef HAS_MEMORY_LIMIT
void checkLimits(Checks& checks)
{
  auto small = makeImage(12, 9, 1, true, bumpy);
  auto large = makeImage<vtkUnsignedCharArray>(
    160, 160, 160, false, [](vtkIdType i) { return static_cast<double>(1 + i % 200); });
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetThreadingToSerial(); // new threads need memory of their own
  sampler->SetNumberOfParticles(1000);
  sampler->SetInputData(small);
  sampler->Update();
  {
    const MemoryLimit limit(64 << 20);
    sampler->SetInputData(large);
    expectError(
      checks, sampler, messages, "the tables of a density of 160 x 160 x 160 cells", __LINE__);
    sampler->SetInputData(small);
    sampler->SetNumberOfParticles(2000000);
    expectError(checks, sampler, messages, "2000000 particles", __LINE__);
  }
  messages.Clear();
  sampler->SetInputData(large);
  sampler->SetNumberOfParticles(1000);
  sampler->Update();
  CHECK(checks, messages.Errors.empty());
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 1000);
}
#endif

} // namespace

int TestSamplerMemory(int, char*[])
{
  Checks checks;
  checkAbsurdNumbers(checks);
#ifdef HAS_MEMORY_LIMIT
  checkLimits(checks);
#endif
  return checks.Result();
}
