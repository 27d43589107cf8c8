// SPDX-License-Identifier: BSD-3-Clause
// Progress by stages, and an abort in the middle of a large run: soon over, an empty output, and
// the next run succeeds.
#include "SamplerTest.h"

#include "vtkCompositeDataPipeline.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <chrono>

namespace
{

using Clock = std::chrono::steady_clock;

// Listens to progress, and aborts from a chosen one on.
class ProgressTest
{
public:
  explicit ProgressTest(vtkTransportSampler* sampler)
    : Sampler(sampler)
  {
    this->Ear->SetClientData(this);
    this->Ear->SetCallback([](vtkObject* caller, unsigned long, void* self, void* data) {
      static_cast<ProgressTest*>(self)->Hear(
        static_cast<vtkAlgorithm*>(caller), *static_cast<double*>(data));
    });
    sampler->AddObserver(vtkCommand::ProgressEvent, this->Ear);
  }
  ~ProgressTest() { this->Sampler->RemoveObserver(this->Ear); }
  ProgressTest(const ProgressTest&) = delete;
  ProgressTest& operator=(const ProgressTest&) = delete;

  double AbortFrom = 2.0;
  std::vector<double> Heard;
  Clock::time_point AbortTime;

private:
  void Hear(vtkAlgorithm* algorithm, double progress)
  {
    this->Heard.push_back(progress);
    if (progress >= this->AbortFrom && !algorithm->GetAbortExecute())
    {
      this->AbortTime = Clock::now();
      algorithm->SetAbortExecute(1);
    }
  }

  vtkTransportSampler* Sampler;
  vtkNew<vtkCallbackCommand> Ear;
};

void checkProgress(Checks& checks, vtkTransportSampler* sampler)
{
  ProgressTest test(sampler);
  sampler->Modified();
  sampler->Update();
  CHECK(checks, test.Heard.size() > 10);
  CHECK(checks, std::is_sorted(test.Heard.begin(), test.Heard.end()));
  CHECK(checks, test.Heard.front() >= 0.0 && test.Heard.back() == 1.0);
  double step = 0.0;
  for (std::size_t i = 1; i < test.Heard.size(); ++i)
  {
    step = std::max(step, test.Heard[i] - test.Heard[i - 1]);
  }
  CHECK_NEAR(checks, step, 0.0, 0.5);
}

// How long it takes from the abort to the end of the run; the shortest of some, because other
// processes may hold this one up.
void checkAbort(Checks& checks, vtkTransportSampler* sampler, double from, int line)
{
  double seconds = HUGE_VAL;
  for (int attempt = 0; attempt < 4 && seconds > 0.1; ++attempt)
  {
    ProgressTest test(sampler);
    test.AbortFrom = from;
    sampler->GetInputDataObject(0, 0)->Modified();
    sampler->Update();
    const Clock::time_point end = Clock::now();
    checks.That(!test.Heard.empty() && sampler->GetAbortExecute() != 0, "aborted", line);
    checks.That(sampler->GetOutput() && sampler->GetOutput()->GetNumberOfPoints() == 0 &&
        sampler->GetOutput()->GetNumberOfCells() == 0 &&
        sampler->GetOutput()->GetPointData()->GetNumberOfArrays() == 0,
      "empty output", line);
    seconds = std::min(seconds, std::chrono::duration<double>(end - test.AbortTime).count());
    sampler->SetAbortExecute(0);
  }
  checks.That(seconds <= 0.1, "abort within 0.1 s", line, std::to_string(seconds));
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
  image->Modified();
  checkProgress(checks, sampler);
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 20000);
  CHECK(checks, fieldValue(sampler->GetOutput(), "TotalMass") > 0.0);
  CHECK(checks, messages.Errors.empty());
  return checks.Result();
}
