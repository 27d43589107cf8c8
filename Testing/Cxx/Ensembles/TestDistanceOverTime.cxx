// SPDX-License-Identifier: BSD-3-Clause
// With OverTime, vtkTransportDistance takes the time steps of one input, each once.
#include "DistanceTest.h"
#include "ProgressTest.h"

namespace
{

const Times stepTimes = { 0.0, 0.5, 1.0, 2.0, 4.0 };

// A bell that moves by 4 cells, of a width of 0.5, in a unit of time.
Images movingBells()
{
  Images images;
  for (const double time : stepTimes)
  {
    images.push_back(makeBell(10.0 + 4.0 * time, 20.0));
  }
  return images;
}

vtkSmartPointer<vtkTransportDistance> makeOver(ImageSeries& series, int method = 0)
{
  auto distance = makeDistance({}, method);
  distance->SetInputConnection(series.Port());
  distance->OverTimeOn();
  return distance;
}

void checkSteps(Checks& checks)
{
  for (const int method : distanceMethods)
  {
    ImageSeries series(movingBells(), stepTimes);
    auto distance = makeOver(series, method);
    ProgressTest progress(distance);
    const Matrix found = distancesOf(distance);
    progress.ExpectRising(checks, stepTimes.size(), __LINE__);
    CHECK(checks, series.Requested == stepTimes);
    CHECK(checks,
      columnNames(distance->GetDistances()) ==
        std::vector<std::string>({ "t = 0", "t = 0.5", "t = 1", "t = 2", "t = 4" }));
    CHECK(checks, columnValues(distance->GetCoordinates(), "Time") == stepTimes);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      CHECK_NEAR(checks, found[0][i], 2.0 * stepTimes[i], 0.1);
    }
    // The same densities as inputs.
    CHECK(checks, found == distancesOf(makeDistance(movingBells(), method)));
  }
}

// The tables are those of all times, whichever one is requested.
void checkRequests(Checks& checks)
{
  ImageSeries series(movingBells(), stepTimes);
  auto distance = makeOver(series);
  for (const double time : { 0.0, 2.0, 1.0 })
  {
    distance->UpdateTimeStep(time);
  }
  CHECK(checks, series.Requested == stepTimes);
  for (int port = 0; port < 3; ++port)
  {
    vtkInformation* output = distance->GetOutputInformation(port);
    CHECK(checks, !output->Has(Pipeline::TIME_STEPS()) && !output->Has(Pipeline::TIME_RANGE()));
  }
  series.Requested.clear();
  series.Modified();
  distance->Update();
  CHECK(checks, series.Requested == stepTimes);
  CHECK(checks, distance->GetNumberOfSolutions() == 5);
}

void checkErrors(Checks& checks)
{
  ImageSeries series(movingBells(), stepTimes);
  densityOf(series.Steps[2])->SetComponent(3, 0, -1.0);
  auto distance = makeOver(series);
  ErrorTest test(checks, distance);
  test.Expect(
    { "Time step 3 of 5 (t = 1): The density array 'Density' has 1 negative value" }, __LINE__);
  series.Steps = movingBells();
  series.Requested.clear();
  series.Modified();
  test.ExpectNone(__LINE__);
  CHECK(checks, series.Requested == stepTimes);
  CHECK(checks, distance->GetDistances()->GetNumberOfRows() == 5);

  distance->OverTimeOff();
  test.Expect("There is one density", __LINE__);
  distance->OverTimeOn();
  series.StepTimes = { 3.0 };
  series.Modified();
  test.Expect("OverTime is on, and the input has one time step; distances need two or more "
              "(OverTime Off takes several inputs)",
    __LINE__);
  series.StepTimes = {};
  series.Modified();
  test.Expect("OverTime is on, and the input has no time steps; distances need", __LINE__);
  distance->AddInputDataObject(makeBell(12, 20));
  test.Expect("OverTime is on, and there are 2 inputs; it takes the time steps of one", __LINE__);
}

// An abort in the middle of the steps leaves nothing behind that the next run would continue.
void checkAbort(Checks& checks)
{
  for (const double from : { 0.1, 0.5, 0.9 })
  {
    ImageSeries series(movingBells(), stepTimes);
    auto distance = makeOver(series);
    ::checkAbort(
      checks, distance, from, [&]() { distance->Modified(); }, __LINE__);
    series.Requested.clear();
    distance->Modified();
    CHECK(checks, distancesOf(distance) == distancesOf(makeDistance(movingBells())));
  }
}

} // namespace

int TestDistanceOverTime(int, char*[])
{
  return runChecks({ checkSteps, checkRequests, checkErrors, checkAbort });
}
