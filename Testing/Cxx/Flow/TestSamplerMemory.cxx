// SPDX-License-Identifier: BSD-3-Clause
// Memory that cannot be had: an error that says how much was asked for, and nothing is lost.
#include "../../MemoryLimit.h"
#include "../../SeedPatterns.h"
#include "TestData.h"

#include "vtkUniformSeedSource.h"
#include "vtkUnsignedCharArray.h"

#include <limits>

namespace
{

void expectError(Checks& checks, vtkAlgorithm* algorithm, const char* what, int line)
{
  ErrorTest(checks, algorithm).Expect({ "Not enough memory for", what, "were asked for" }, line);
}

void checkAbsurdNumbers(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  auto image = makeImage(12, 9, 1, true, bumpy);
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(100);
  sampler->Update();
  const vtkMTimeType built = sampler->GetTableBuildTime();

  sampler->SetNumberOfParticles(1000000000000);
  ErrorTest test(checks, sampler);
  test.Expect(
    { "Not enough memory for", "1000000000000 particles", "TB were asked for" }, __LINE__);
  // A particle of a volume takes the bytes of its arrays: three of 3 doubles, Mass, SeedId, and its
  // vertex of two ids.
  sampler->SetInputData(makeImage(12, 9, 5, true, bumpy));
  test.Expect(": 104 TB were asked for", __LINE__);
  sampler->SetInputData(image);
  for (int pattern = 0; pattern < RectifiedTransport::numberOfSeedPatterns; ++pattern)
  {
    sampler->SetSeedPattern(pattern);
    sampler->SetNumberOfParticles(std::numeric_limits<vtkIdType>::max());
    expectError(checks, sampler, "particles", __LINE__);
  }
  sampler->SetNumberOfParticles(100);
  sampler->SetSeedPatternToLattice();
  sampler->SetSamplesPerCell(std::numeric_limits<int>::max());
  expectError(checks, sampler, "SamplesPerCell", __LINE__);
  sampler->SetSamplesPerCell(0);
  sampler->SetSeedPatternToBlueNoise();
  sampler->OutputPathsOn();
  sampler->SetNumberOfSteps(10000);
  sampler->SetNumberOfParticles(1000000000);
  expectError(checks, sampler, "the paths of 1000000000 particles", __LINE__);
  sampler->OutputPathsOff();
  sampler->SetNumberOfParticles(100);
  test.ExpectNone(__LINE__);
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 100);
  CHECK(checks, sampler->GetTableBuildTime() == built);

  vtkNew<vtkUniformSeedSource> source;
  for (const int dimension : { 2, 3 })
  {
    source->SetDimension(dimension);
    source->SetNumberOfPoints(1000000000000000);
    expectError(checks, source, "NumberOfPoints", __LINE__);
  }
  source->SetNumberOfPoints(10);
  ErrorTest(checks, source).ExpectNone(__LINE__);
  CHECK(checks, source->GetOutput()->GetNumberOfPoints() == 10);
}

#ifdef HAS_MEMORY_LIMIT
void checkLimits(Checks& checks)
{
  auto small = makeImage(12, 9, 1, true, bumpy);
  auto large = makeImage<vtkUnsignedCharArray>(
    160, 160, 160, false, [](vtkIdType i) { return static_cast<double>(1 + i % 200); });
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetThreadingToSerial(); // new threads need memory of their own
  sampler->SetNumberOfParticles(1000);
  sampler->SetInputData(small);
  sampler->Update();
  {
    const MemoryLimit limit(64 << 20);
    sampler->SetInputData(large);
    expectError(checks, sampler, "the tables of a density of 160 x 160 x 160 cells", __LINE__);
    sampler->SetInputData(small);
    sampler->SetNumberOfParticles(2000000);
    expectError(checks, sampler, "2000000 particles", __LINE__);
  }
  sampler->SetInputData(large);
  sampler->SetNumberOfParticles(1000);
  ErrorTest(checks, sampler).ExpectNone(__LINE__);
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 1000);
  {
    sampler->SetFlowMapsToOff();
    ErrorTest(checks, sampler).ExpectNone(__LINE__);
    const MemoryLimit limit(8 << 20);
    sampler->SetFlowMapsToOn();
    expectError(checks, sampler, "a flow map (FlowMaps Off needs none)", __LINE__);
    sampler->SetFlowMapsToOff();
    ErrorTest(checks, sampler).ExpectNone(__LINE__);
  }
  sampler->SetFlowMapsToOn();
  ErrorTest(checks, sampler).ExpectNone(__LINE__);
  {
    const MemoryLimit limit(64 << 20);
    sampler->SetMethodToOptimal();
    expectError(checks, sampler,
      "the optimal map of a density of 160 x 160 x 160 cells (Method RectifiedFlow needs none)",
      __LINE__);
    sampler->SetMethodToRectifiedFlow();
    sampler->CertifyOn();
    expectError(checks, sampler, "160 x 160 x 160 cells (Certify Off needs none)", __LINE__);
    sampler->CertifyOff();
  }
  ErrorTest(checks, sampler).ExpectNone(__LINE__);
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
