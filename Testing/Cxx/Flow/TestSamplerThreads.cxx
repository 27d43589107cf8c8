// SPDX-License-Identifier: BSD-3-Clause
// The same bits with every executor and number of threads.
#include "TestData.h"
#include "ThreadsTest.h"

namespace
{

void checkImage(Checks& checks, vtkImageData* image)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(20000);
  const auto run = [&](int threading) {
    sampler->SetThreading(threading);
    forgetTables(sampler, image);
    Values all = sampleCoordinates(sampler);
    all.push_back(fieldValue(sampler->GetOutput(), "TotalMass"));
    all.push_back(fieldValue(sampler->GetOutput(), "TransportCost"));
    return all;
  };
  CHECK(checks, expectSameBits(checks, run, __LINE__).size() == 60002);
}

} // namespace

int TestSamplerThreads(int, char*[])
{
  Checks checks;
  checkImage(checks, makeImage(211, 173, 1, false, bumpy));
  checkImage(checks, makeImage(40, 31, 29, true, [](vtkIdType i) { return bumpy(i) - 3.0 > 0.0; }));
  return checks.Result();
}
