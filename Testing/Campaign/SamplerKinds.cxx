// SPDX-License-Identifier: BSD-3-Clause
// Sample Density.
#include "DrawnInputs.h"
#include "Kinds.h"
#include "OutputChecks.h"

#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkTransportSampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Campaign
{

namespace
{

using Sampler = vtkTransportSampler;

// The slack of each particle.
void checkSlack(Sampler* sampler, Findings& findings)
{
  vtkPolyData* output = sampler->GetOutput();
  const bool isBounded = output->GetFieldData()->GetArray("OptimalityGap") != nullptr;
  vtkDataArray* found = output->GetPointData()->GetArray("Slack");
  findings.That(isBounded == (found != nullptr), "Slack is there with a bound");
  if (isBounded && found)
  {
    requireArray(output->GetPointData(), "Slack", 1, output->GetNumberOfPoints(), findings);
    findings.That(found->GetRange(0)[0] >= 0.0, "Slack is not negative");
  }
}

void drawSampler(Settings& settings)
{
  settings.Draw<Sampler, vtkIdType>("NumberOfParticles", &Sampler::SetNumberOfParticles,
    { 1, 2, 10, 100, 500, 500, 1000, 1500 }, {}, 1.0);
  if (settings.GetRandom().Chance(0.03))
  {
    settings.Draw<Sampler, vtkIdType>("NumberOfParticles", &Sampler::SetNumberOfParticles,
      { 0, -1, 1000000000000, std::numeric_limits<vtkIdType>::max() }, {}, 1.0);
  }
  if (settings.IsLarge())
  {
    settings.Add("NumberOfParticles", "20000",
      [](vtkAlgorithm* filter) { Sampler::SafeDownCast(filter)->SetNumberOfParticles(20000); });
  }
  settings.Draw<Sampler, int>(
    "SeedPattern", &Sampler::SetSeedPattern, { 0, 1, 2, 3, 4 }, { -1, 5 });
  settings.Draw<Sampler, int>("RandomSeed", &Sampler::SetRandomSeed,
    { 0, 1, -1, 77, std::numeric_limits<int>::max(), std::numeric_limits<int>::min() }, {}, 0.3);
  settings.Draw<Sampler, int>(
    "SamplesPerCell", &Sampler::SetSamplesPerCell, { 0, 1, 2 }, { -1 }, 0.2);
  settings.Draw<Sampler, double>(
    "FlowTime", &Sampler::SetFlowTime, { 0.0, 0.25, 0.999, 1.0, 5e-324 }, { -0.1, 1.1, NaN }, 0.4);
  settings.Draw<Sampler, vtkTypeBool>(
    "OutputPaths", &Sampler::SetOutputPaths, { 0, 1 }, {}, settings.IsLarge() ? 0.0 : 0.15);
  settings.Draw<Sampler, vtkTypeBool>("SampleArrays", &Sampler::SetSampleArrays, { 0, 1 }, {});
  drawFlowSettings<vtkTransportAlgorithm>(settings);
  drawTables<Sampler>(settings);
  drawDevice<Sampler>(settings);
  drawMethod<Sampler>(settings);
  drawDensitySettings(settings);
}

Inputs drawSamplerInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(2);
  inputs[0] = { drawDensityOn(random, settings, 0) };
  if (random.Chance(0.3))
  {
    inputs[1] = { drawPoints(
      random, vtkImageData::SafeDownCast(inputs[0][0].Data), settings.IsLarge() ? 20000 : 500) };
  }
  return inputs;
}

bool usesGrid(Sampler* sampler)
{
  return sampler->GetSamplesPerCell() > 0 &&
    (sampler->GetSeedPattern() == Sampler::LATTICE ||
      sampler->GetSeedPattern() == Sampler::JITTERED);
}

State expectSampler(vtkAlgorithm* filter, const Inputs& inputs)
{
  auto* sampler = Sampler::SafeDownCast(filter);
  State state = densityState(filter, inputs[0][0]);
  if (!inputs[1].empty())
  {
    return worse(state, inputs[1][0].Condition);
  }
  const vtkIdType count = sampler->GetNumberOfParticles();
  if (!usesGrid(sampler) && (count < 1 || count > 1000000))
  {
    state = worse(state, State::Faulty);
  }
  return state;
}

void checkPaths(Sampler* sampler, Findings& findings)
{
  vtkPolyData* output = sampler->GetOutput();
  const vtkIdType points = output->GetNumberOfPoints();
  const vtkIdType paths = output->GetNumberOfCells();
  const int asked = sampler->GetNumberOfSteps();
  const int times = (asked > 0 ? asked : 32) + 1;
  findings.That(points == paths * times, "a point for each time of each path");
  requireArray(output->GetPointData(), "SeedId", 1, points, findings);
  requireArray(output->GetPointData(), "Time", 1, points, findings);
  vtkDataArray* mass = requireArray(output->GetPointData(), "Mass", 1, points, findings);
  findings.Near(
    sumOf(mass), requireField(output, "TotalMass", findings) * times, 1e-9, "mass of paths");
}

void checkSampler(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* sampler = Sampler::SafeDownCast(filter);
  vtkPolyData* output = sampler->GetOutput();
  requireFinitePoints(output, findings);
  const double total = requireField(output, "TotalMass", findings);
  const double cost = requireField(output, "TransportCost", findings);
  findings.That(cost >= 0.0, "TransportCost >= 0");
  checkBound(sampler, output, sampler->GetFlowTime() == 1.0, cost, findings);
  const bool sound = densityState(filter, inputs[0][0]) == State::Sound;
  if (sound)
  {
    findings.Near(total, massOf(filter, inputs[0][0]), 1e-9, "TotalMass");
    requireInside(output, inputs[0][0], findings);
  }
  if (sampler->GetOutputPaths())
  {
    checkPaths(sampler, findings);
    return;
  }
  const vtkIdType count = output->GetNumberOfPoints();
  requireVertices(output, findings);
  checkSlack(sampler, findings);
  vtkPointData* data = output->GetPointData();
  vtkDataArray* ids = requireArray(data, "SeedId", 1, count, findings);
  for (vtkIdType i = 0; ids && i < count; ++i)
  {
    if (ids->GetComponent(i, 0) != static_cast<double>(i))
    {
      findings.That(false, "SeedId of " + std::to_string(i));
      break;
    }
  }
  vtkDataArray* seeds = requireArray(data, "SeedPosition", 3, count, findings);
  vtkDataArray* displacements = requireArray(data, "Displacement", 3, count, findings);
  vtkDataArray* mass = requireArray(data, "Mass", 1, count, findings);
  findings.Near(sumOf(mass), total, 1e-9, "sum of Mass");
  if (!inputs[1].empty())
  {
    auto* given = vtkPointSet::SafeDownCast(inputs[1][0].Data);
    findings.That(count == given->GetNumberOfPoints(), "a particle for each seed");
    requirePassed(given->GetPointData(), data,
      { "SeedId", "SeedPosition", "Displacement", "Mass", "Slack" }, findings);
  }
  else if (!usesGrid(sampler) && sampler->GetSeedPattern() != Sampler::LATTICE)
  {
    findings.That(count == sampler->GetNumberOfParticles(), "NumberOfParticles");
  }
  double way = 0.0;
  for (vtkIdType i = 0; seeds && displacements && sound && i < count; ++i)
  {
    double x[3];
    output->GetPoint(i, x);
    for (int a = 0; a < 3; ++a)
    {
      way = std::max(
        way, std::abs(x[a] - seeds->GetComponent(i, a) - displacements->GetComponent(i, a)));
    }
  }
  findings.That(way <= 1e-9, "Displacement is off by " + textOf(way));
}

void quickSampler(RandomSource&, vtkAlgorithm* filter)
{
  Sampler::SafeDownCast(filter)->SetNumberOfParticles(30);
}

} // namespace

void addSamplerKinds(std::vector<FilterKind>& kinds)
{
  kinds.push_back({ "Sampler", make<Sampler>, drawSampler, drawSamplerInputs, expectSampler,
    checkSampler, quickSampler });
}

} // namespace Campaign
