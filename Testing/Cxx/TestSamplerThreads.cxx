// SPDX-License-Identifier: BSD-3-Clause
// The same bits whoever runs the loops, with whatever number of threads.
#include "SamplerTest.h"

#include "vtkSMPTools.h"

namespace
{

struct Result
{
  std::vector<double> Points;
  double Mass = 0.0;
  double Cost = 0.0;

  bool operator==(const Result& other) const
  {
    return this->Points == other.Points && this->Mass == other.Mass && this->Cost == other.Cost;
  }
};

Result sampleWith(vtkTransportSampler* sampler, vtkImageData* image)
{
  forgetTables(sampler, image);
  Result result;
  result.Points = sampleCoordinates(sampler);
  result.Mass = fieldValue(sampler->GetOutput(), "TotalMass");
  result.Cost = fieldValue(sampler->GetOutput(), "TransportCost");
  return result;
}

void checkImage(Checks& checks, vtkImageData* image)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(20000);
  sampler->SetThreadingToSerial();
  const Result serial = sampleWith(sampler, image);
  for (const int threading : { vtkTransportSampler::THREADING_AUTO,
         vtkTransportSampler::THREADING_VTK, vtkTransportSampler::THREADING_OPENMP })
  {
    sampler->SetThreading(threading);
    for (const char* backend : { "Sequential", "STDThread", "TBB", "OpenMP" })
    {
      if (!vtkSMPTools::SetBackend(backend))
      {
        continue;
      }
      for (const int threads : { 1, 2, 3 })
      {
        vtkSMPTools::Initialize(threads);
        checks.That(sampleWith(sampler, image) == serial, "same bits", __LINE__,
          std::string(backend) + ", " + sampler->GetThreadingAsString() + ", " +
            std::to_string(threads) + " threads");
      }
    }
  }
}

} // namespace

int TestSamplerThreads(int, char*[])
{
  Checks checks;
  checkImage(checks, makeImage(211, 173, 1, false, bumpy));
  checkImage(checks, makeImage(40, 31, 29, true, [](vtkIdType i) { return bumpy(i) - 3.0 > 0.0; }));
  return checks.Result();
}
