// SPDX-License-Identifier: BSD-3-Clause
// Points and a density: Density Equalizing Warp, Transport Quality and Relax Blue Noise.
#include "DrawnInputs.h"
#include "Kinds.h"
#include "OutputChecks.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkDensityEqualizingWarp.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkTable.h"
#include "vtkTransportQuality.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Campaign
{

namespace
{

using Warp = vtkDensityEqualizingWarp;

void drawWarp(Settings& settings)
{
  settings.Draw<Warp, double>("Blend", &Warp::SetBlend, { 0.0, 0.3, 1.0 }, { -0.1, 1.5, NaN });
  settings.Draw<Warp, vtkTypeBool>("EqualizeAreas", &Warp::SetEqualizeAreas, { 0, 1 }, {}, 0.3);
  drawEmptySettings<Warp>(settings);
  settings.Draw<Warp, double>(
    "Margin", &Warp::SetMargin, { 0.0, 0.05, 0.3 }, { -0.1, 10.5, NaN }, 0.3);
  drawFlowSettings<vtkTransportAlgorithm>(settings);
  drawTables<Warp>(settings);
  drawDevice<Warp>(settings);
  drawMethod<Warp>(settings);
  drawDensitySettings(settings);
}

Inputs drawPointsAndDensityInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(2);
  inputs[1] = { drawDensityOn(random, settings, 1) };
  inputs[0] = { drawPoints(
    random, vtkImageData::SafeDownCast(inputs[1][0].Data), settings.IsLarge() ? 20000 : 600) };
  return inputs;
}

State expectWarp(vtkAlgorithm* filter, const Inputs& inputs)
{
  return worse(densityState(filter, inputs[1][0]), inputs[0][0].Condition);
}

void checkWarp(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  vtkPointSet* output = Warp::SafeDownCast(filter)->GetOutput();
  auto* input = vtkPointSet::SafeDownCast(inputs[0][0].Data);
  requireFinitePoints(output, findings);
  auto* warp = Warp::SafeDownCast(filter);
  vtkDataArray* cost = output->GetFieldData()->GetArray("TransportCost");
  checkBound(warp, output, warp->GetBlend() > 0.0, cost ? cost->GetComponent(0, 0) : 0.0, findings);
  const vtkIdType count = input->GetNumberOfPoints();
  findings.That(output->GetNumberOfPoints() == count &&
      output->GetNumberOfCells() == input->GetNumberOfCells() &&
      output->GetDataObjectType() == input->GetDataObjectType(),
    "as many points and cells as before");
  vtkDataArray* displacements =
    requireArray(output->GetPointData(), "Displacement", 3, count, findings);
  requirePassed(input->GetPointData(), output->GetPointData(), { "Displacement" }, findings);
  double way = 0.0;
  for (vtkIdType i = 0; displacements && i < count; ++i)
  {
    double x[3];
    double before[3];
    output->GetPoint(i, x);
    input->GetPoint(i, before);
    for (int a = 0; a < 3; ++a)
    {
      way = std::max(way, std::abs(x[a] - before[a] - displacements->GetComponent(i, a)));
    }
  }
  findings.That(expectWarp(filter, inputs) != State::Sound || way <= 1e-9,
    "Displacement is off by " + textOf(way));
}

//------------------------------------------------------------------------------
using Quality = vtkTransportQuality;

void drawQuality(Settings& settings)
{
  settings.Draw<Quality, int>("BlockSize", &Quality::SetBlockSize,
    { 0, 1, 2, 8, 100, std::numeric_limits<int>::max() }, { -1, -3 });
  drawTables<Quality>(settings);
  drawThreading<Quality>(settings);
  drawDensitySettings(settings);
}

State expectQuality(vtkAlgorithm* filter, const Inputs& inputs)
{
  auto* set = vtkPointSet::SafeDownCast(inputs[0][0].Data);
  const bool weighed =
    set->GetPointData()->GetArray("Mass") || set->GetPointData()->GetArray("Displacement");
  return worse(expectWarp(filter, inputs), weighed ? State::Odd : State::Sound);
}

void checkQuality(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  vtkTable* table = Quality::SafeDownCast(filter)->GetOutput();
  vtkDataSetAttributes* row = table->GetRowData();
  const auto value = [&](const char* name) {
    vtkDataArray* column = requireArray(row, name, 1, 1, findings);
    return column ? column->GetComponent(0, 0) : 0.0;
  };
  const auto count =
    static_cast<double>(vtkPointSet::SafeDownCast(inputs[0][0].Data)->GetNumberOfPoints());
  const double particles = value("Particles");
  findings.That(particles >= 0.0 && particles <= count, "Particles");
  findings.That(value("Outside") >= 0.0 && value("InEmptyCells") >= 0.0 &&
      value("Outside") + value("InEmptyCells") <= particles,
    "Outside and InEmptyCells");
  findings.That(value("DensityError") >= 0.0 && value("TransportCost") >= 0.0, "no negative value");
  findings.That(value("SmallestSpacing") >= 0.0 &&
      value("SmallestSpacing") <= value("MeanSpacing") * (1.0 + 1e-12),
    "SmallestSpacing <= MeanSpacing");
  if (densityState(filter, inputs[1][0]) == State::Sound)
  {
    findings.Near(value("TotalMass"), massOf(filter, inputs[1][0]), 1e-9, "TotalMass");
  }
}

//------------------------------------------------------------------------------
using Relaxation = vtkBlueNoiseRelaxation;

void drawRelaxation(Settings& settings)
{
  settings.Draw<Relaxation, int>("Method", &Relaxation::SetMethod, { 0, 1 }, { -1, 2 }, 0.6);
  settings.Draw<Relaxation, int>("MaximumIterations", &Relaxation::SetMaximumIterations,
    { 0, 1, 2, 3 }, { -1, std::numeric_limits<int>::min() }, 1.0);
  settings.Draw<Relaxation, double>("Tolerance", &Relaxation::SetTolerance,
    { 0.0, 0.1, 0.999, 5e-324 }, { -0.1, 1.0, NaN, Infinity }, 0.4);
  drawDensitySettings(settings);
  drawThreading<Relaxation>(settings);
}

Inputs drawRelaxationInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(2);
  inputs[1] = { drawDensityOn(random, settings, 1) };
  inputs[0] = { drawPoints(
    random, vtkImageData::SafeDownCast(inputs[1][0].Data), settings.IsLarge() ? 3000 : 300) };
  return inputs;
}

// Whether one value has most of the mass.
bool isConcentrated(vtkAlgorithm* filter, const Input& density)
{
  double sum = 0.0;
  double largest = 0.0;
  for (vtkIdType i = 0; density.Values && i < density.Values->GetNumberOfTuples(); ++i)
  {
    const double value = std::max(valueAt(filter, density, i), 0.0);
    sum += value;
    largest = std::max(largest, value);
  }
  return 2.0 * largest > sum;
}

State expectRelaxation(vtkAlgorithm* filter, const Inputs& inputs)
{
  const bool byTransport =
    Relaxation::SafeDownCast(filter)->GetMethod() == Relaxation::OPTIMAL_TRANSPORT;
  const int dimension = vtkImageData::SafeDownCast(inputs[1][0].Data)->GetDataDimension();
  const bool isPossible = dimension >= 2 && dimension <= (byTransport ? 2 : 3);
  // Of points that are not where the mass is cells of equal mass may not be found.
  const bool isSound = isPossible && !(byTransport && isConcentrated(filter, inputs[1][0]));
  return worse(expectWarp(filter, inputs),
    isSound        ? State::Sound
      : isPossible ? State::Odd
                   : State::Faulty);
}

void checkRelaxation(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* relaxation = Relaxation::SafeDownCast(filter);
  vtkPointSet* output = relaxation->GetOutput();
  auto* input = vtkPointSet::SafeDownCast(inputs[0][0].Data);
  requireFinitePoints(output, findings);
  findings.That(output->GetNumberOfPoints() == input->GetNumberOfPoints() &&
      output->GetNumberOfCells() == input->GetNumberOfCells() &&
      output->GetDataObjectType() == input->GetDataObjectType(),
    "as many points and cells as before");
  requirePassed(input->GetPointData(), output->GetPointData(), {}, findings);
  if (!input->GetPointGhostArray() && densityState(filter, inputs[1][0]) == State::Sound)
  {
    requireInside(output, inputs[1][0], findings);
  }
  vtkDataArray* energy = output->GetFieldData()->GetArray("Energy");
  findings.That(energy && energy->GetNumberOfComponents() == 1 &&
      energy->GetNumberOfTuples() <= relaxation->GetMaximumIterations() + 1 &&
      (energy->GetNumberOfTuples() > 0 || input->GetPointGhostArray()),
    "the number of energies");
  for (vtkIdType i = 0; energy && i < energy->GetNumberOfTuples(); ++i)
  {
    const double value = energy->GetComponent(i, 0);
    findings.That(std::isfinite(value), "a finite energy");
    findings.That(i == 0 || value <= energy->GetComponent(i - 1, 0), "no greater energy");
  }
}

void quickRelaxation(RandomSource& random, vtkAlgorithm* filter)
{
  auto* relaxation = Relaxation::SafeDownCast(filter);
  relaxation->SetMaximumIterations(2);
  relaxation->SetMethod(static_cast<int>(random.Whole(0, 1)));
}

} // namespace

void addPointKinds(std::vector<FilterKind>& kinds)
{
  kinds.push_back({ "Warp", make<Warp>, drawWarp, drawPointsAndDensityInputs, expectWarp, checkWarp,
    leaveAsItIs });
  kinds.push_back({ "Quality", make<Quality>, drawQuality, drawPointsAndDensityInputs,
    expectQuality, checkQuality, leaveAsItIs });
  kinds.push_back({ "Relaxation", make<Relaxation>, drawRelaxation, drawRelaxationInputs,
    expectRelaxation, checkRelaxation, quickRelaxation });
}

} // namespace Campaign
