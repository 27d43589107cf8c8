// SPDX-License-Identifier: BSD-3-Clause
// FlowTime, and the paths of particles.
#include "TestData.h"

#include "vtkCellArray.h"

namespace
{

using Points = std::vector<double>;

// Positions move with FlowTime and end where a run to the end ends.
void checkFlowTime(Checks& checks, vtkTransportSampler* sampler)
{
  sampler->SetFlowTime(1.0);
  const Points end = sampleCoordinates(sampler);
  sampler->SetFlowTime(0.0);
  const Points start = sampleCoordinates(sampler);
  vtkDataArray* seeds = pointArray(sampler->GetOutput(), "SeedPosition");
  bool atSeeds = true;
  for (std::size_t i = 0; i < start.size(); ++i)
  {
    atSeeds = atSeeds &&
      start[i] == seeds->GetComponent(static_cast<vtkIdType>(i / 3), static_cast<int>(i % 3));
  }
  CHECK(checks, atSeeds);
  CHECK(checks, pointArray(sampler->GetOutput(), "Displacement")->GetMaxNorm() == 0.0);
  CHECK(checks, fieldValue(sampler->GetOutput(), "TransportCost") == 0.0);

  const double distance = largestDifference(start, end);
  sampler->SetFlowTime(0.5);
  const Points middle = sampleCoordinates(sampler);
  CHECK(checks, largestDifference(middle, start) > 0.05 * distance);
  CHECK(checks, largestDifference(middle, end) > 0.05 * distance);
  CHECK(checks, fieldValue(sampler->GetOutput(), "TransportCost") > 0.0);
  sampler->SetFlowTime(1.0 - 1e-12);
  CHECK(checks, largestDifference(sampleCoordinates(sampler), end) < 1e-9 * distance);
}

// A path's points are where runs to their times end.
void checkPaths(Checks& checks, vtkTransportSampler* sampler, double flowTime)
{
  const int steps = sampler->GetNumberOfSteps();
  sampler->SetFlowTime(flowTime);
  sampler->OutputPathsOff();
  const Points end = sampleCoordinates(sampler);
  const double cost = fieldValue(sampler->GetOutput(), "TransportCost");
  const double mass = fieldValue(sampler->GetOutput(), "TotalMass");
  const vtkIdType count = sampler->GetOutput()->GetNumberOfPoints();

  sampler->OutputPathsOn();
  const Points paths = sampleCoordinates(sampler);
  vtkNew<vtkPolyData> output;
  output->ShallowCopy(sampler->GetOutput());
  sampler->OutputPathsOff();
  CHECK(checks, output->GetNumberOfLines() == count && output->GetNumberOfCells() == count);
  CHECK(checks, output->GetNumberOfPoints() == count * (steps + 1));
  CHECK(checks, output->GetPoints()->GetDataType() == VTK_DOUBLE);
  CHECK(checks, output->GetPointData()->GetNumberOfArrays() == 3);
  vtkDataArray* ids = pointArray(output, "SeedId");
  vtkDataArray* times = pointArray(output, "Time");
  vtkDataArray* masses = pointArray(output, "Mass");
  CHECK(checks, ids && times && masses);
  bool holds = true;
  for (vtkIdType line = 0; line < count; ++line)
  {
    vtkIdType size;
    const vtkIdType* points;
    output->GetLines()->GetCellAtId(line, size, points);
    holds = holds && size == steps + 1;
    for (vtkIdType k = 0; k < size; ++k)
    {
      holds = holds && points[k] == line * (steps + 1) + k &&
        ids->GetTuple1(points[k]) == static_cast<double>(line) &&
        std::abs(times->GetTuple1(points[k]) - flowTime * static_cast<double>(k) / steps) <=
          1e-15 &&
        masses->GetTuple1(points[k]) == mass / static_cast<double>(count);
    }
  }
  CHECK(checks, holds);
  CHECK_NEAR(checks, fieldValue(output, "TotalMass") / mass, 1.0, 1e-15);
  CHECK_NEAR(checks, fieldValue(output, "TransportCost"), cost, 1e-9 * cost);

  const auto column = [&](int k) {
    Points all;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    {
      const auto* x =
        paths.data() + 3 * (i * static_cast<std::size_t>(steps + 1) + static_cast<std::size_t>(k));
      all.insert(all.end(), x, x + 3);
    }
    return all;
  };
  CHECK(checks, largestDifference(column(steps), end) <= 1e-9);
  for (const int k : { 0, 1, steps / 2 })
  {
    sampler->SetFlowTime(flowTime * k / steps);
    CHECK_NEAR(checks, largestDifference(sampleCoordinates(sampler), column(k)), 0.0, 1e-9);
  }
}

} // namespace

int TestSamplerPaths(int, char*[])
{
  Checks checks;
  const int sizes[][3] = { { 40, 1, 1 }, { 14, 11, 1 }, { 9, 7, 6 } };
  for (const auto& n : sizes)
  {
    vtkNew<vtkTransportSampler> sampler;
    auto image =
      makeImage(n[0], n[1], n[2], false, [](vtkIdType i) { return bumpy(i) * (i > 30); });
    image->SetSpacing(0.5, 1.5, 2.0);
    sampler->SetInputData(image);
    sampler->SetNumberOfParticles(300);
    checkFlowTime(checks, sampler);
    for (int integrator = vtkTransportSampler::MULTISTEP;
         integrator <= vtkTransportSampler::ADAPTIVE; ++integrator)
    {
      sampler->SetIntegrator(integrator);
      sampler->SetNumberOfSteps(10);
      checkPaths(checks, sampler, 1.0);
      checkPaths(checks, sampler, 0.4);
    }
    sampler->SetNumberOfSteps(1);
    checkPaths(checks, sampler, 1.0);
  }
  return checks.Result();
}
