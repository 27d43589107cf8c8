// SPDX-License-Identifier: BSD-3-Clause
// How vtkTransportTemporalInterpolator runs: the same bits on any number of threads, progress over
// the steps that it requests, an abort.
#include "ProgressTest.h"
#include "TemporalTest.h"
#include "ThreadsTest.h"

namespace
{

void checkThreads(Checks& checks)
{
  ImageSeries series(movingBlobs(), blobTimes);
  for (const bool tracks : { false, true })
  {
    const auto run = [&](int threading) {
      auto filter = makeInterpolator(series);
      filter->SetThreading(threading);
      filter->SetTrackParticles(tracks);
      return outputsAt(filter, 0.3);
    };
    CHECK(checks, expectSameBits(checks, run, __LINE__).size() > 3 * blobSide);
  }
}

// A run of several requests for data has one progress.
void checkProgress(Checks& checks)
{
  for (const bool tracks : { false, true })
  {
    ImageSeries series(movingBlobs(), blobTimes);
    auto filter = makeInterpolator(series);
    filter->SetTrackParticles(tracks);
    ProgressTest progress(filter);
    filter->UpdateTimeStep(1.5);
    progress.ExpectRising(checks, 4, __LINE__);
  }
}

// While the first and the second step are read, in the map, and while particles are spread; then
// the same comes out as without.
void checkAborts(Checks& checks)
{
  for (const bool tracks : { false, true })
  {
    ImageSeries whole(movingBlobs(), blobTimes);
    auto other = makeInterpolator(whole);
    other->SetTrackParticles(tracks);
    const Values wanted = outputsAt(other, 1.5);
    ImageSeries series(movingBlobs(), blobTimes);
    auto filter = makeInterpolator(series);
    filter->SetTrackParticles(tracks);
    Messages messages(filter);
    for (const double from : { 0.02, 0.3, 0.6, 0.8, 0.92 })
    {
      requestTime(filter, 1.5);
      checkAbort(
        checks, filter, from,
        [&]() {
          // Else nothing is left to do: another series, and back.
          series.Steps[1] = makeBlob(20.0 + 5.0 * from, 30.0);
          series.Modified();
          requestTime(filter, 1.5);
        },
        __LINE__);
    }
    series.Steps = movingBlobs();
    series.Modified();
    CHECK(checks, outputsAt(filter, 1.5) == wanted);
    CHECK(checks, messages.Errors.empty());
  }
}

} // namespace

int TestTemporalRun(int, char*[])
{
  return runChecks({ checkThreads, checkProgress, checkAborts });
}
