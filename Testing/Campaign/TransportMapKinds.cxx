// SPDX-License-Identifier: BSD-3-Clause
// Transport Map, with and without a target.
#include "DrawnInputs.h"
#include "Kinds.h"
#include "OutputChecks.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkTransportMap.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace Campaign
{

namespace
{

using Map = vtkTransportMap;

void drawMap(Settings& settings)
{
  settings.Draw<Map, int>("Direction", &Map::SetDirection, { 0, 1 }, { -1, 2 });
  settings.Draw<Map, vtkTypeBool>("EqualizeAreas", &Map::SetEqualizeAreas, { 0, 1 }, {}, 0.3);
  drawEmptySettings<Map>(settings);
  RandomSource& random = settings.GetRandom();
  if (random.Chance(0.3))
  {
    const int x = random.Of({ 0, 0, 0, 2, 9, 30, random.Of({ 1, -1, 2147483647 }) });
    const int y = random.Of({ 0, 0, 0, 2, 9, 30 });
    const int z = random.Of({ 0, 0, 0, 0, 2, 9 });
    settings.Add("SampleDimensions",
      std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z),
      [=](vtkAlgorithm* filter) { static_cast<Map*>(filter)->SetSampleDimensions(x, y, z); });
  }
  drawFlowSettings<vtkTransportAlgorithm>(settings);
  drawTables<Map>(settings);
  drawDevice<Map>(settings);
  drawMethod<Map>(settings);
  drawDensitySettings(settings);
}

Inputs drawMapInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(2);
  inputs[0] = { drawDensityOn(random, settings, 0) };
  if (random.Chance(0.3))
  {
    inputs[1] = { drawPartner(random, inputs[0][0], settings) };
    drawChoice(random, settings, 1, 1, inputs[1][0]);
  }
  return inputs;
}

State expectMap(vtkAlgorithm* filter, const Inputs& inputs)
{
  const int* asked = Map::SafeDownCast(filter)->GetSampleDimensions();
  const bool any = asked[0] != 0 || asked[1] != 0 || asked[2] != 0;
  State state = worse(densityState(filter, inputs[0][0]), any ? State::Odd : State::Sound);
  if (!inputs[1].empty())
  {
    state = worse(state, densityState(filter, inputs[1][0]));
  }
  return state;
}

void checkMap(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* map = Map::SafeDownCast(filter);
  vtkImageData* output = map->GetOutput();
  const bool isToTarget = !inputs[1].empty();
  const bool isBack = map->GetDirection() == Map::DENSITY_TO_UNIFORM;
  const Input& input = inputs[isToTarget && isBack ? 1 : 0][0];
  auto* image = vtkImageData::SafeDownCast(input.Data);
  const vtkIdType count = input.OnPoints ? output->GetNumberOfPoints() : output->GetNumberOfCells();
  vtkDataSetAttributes* data =
    output->GetAttributes(input.OnPoints ? vtkDataObject::POINT : vtkDataObject::CELL);
  if (!data->GetArray("JacobianDeterminant"))
  {
    return; // an odd choice of the array took one of the other kind
  }
  vtkDataArray* displacements = requireArray(data, "Displacement", 3, count, findings);
  requireArray(data, "Divergence", 1, count, findings);
  requireArray(data, "JacobianDeterminant", 1, count, findings);
  vtkDataArray* costs =
    isToTarget ? requireArray(data, "CostDensity", 1, count, findings) : nullptr;
  const double total = requireField(output, "TotalMass", findings);
  const double cost = requireField(output, "TransportCost", findings);
  checkBound(map, output, true, cost, findings);
  const State state = densityState(filter, input);
  if (state == State::Sound)
  {
    findings.Near(total, massOf(filter, input), 1e-9, "TotalMass");
  }
  const int* asked = map->GetSampleDimensions();
  if (asked[0] == 0 && asked[1] == 0 && asked[2] == 0)
  {
    findings.That(std::equal(output->GetExtent(), output->GetExtent() + 6, image->GetExtent()),
      "the extent is the input's");
    requirePassed(image->GetPointData(), output->GetPointData(),
      { "Displacement", "Divergence", "JacobianDeterminant", "CostDensity" }, findings);
  }
  if (costs && state == State::Sound)
  {
    findings.That(std::abs(cost - sumOf(costs)) <= 1e-9 * cost + 1e-18,
      "TransportCost is the sum of CostDensity");
  }
  double sum = 0.0;
  for (vtkIdType i = 0; displacements && i < count; ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      sum += displacements->GetComponent(i, a) * displacements->GetComponent(i, a);
    }
  }
  if (state == State::Sound && !isToTarget && !isBack)
  {
    findings.That(std::abs(cost - sum / static_cast<double>(count)) <= 1e-9 * cost + 1e-18,
      "TransportCost is the mean square of Displacement");
  }
}

void quickMap(RandomSource& random, vtkAlgorithm* filter)
{
  Map::SafeDownCast(filter)->SetDirection(static_cast<int>(random.Whole(0, 1)));
}

} // namespace

void addTransportMapKinds(std::vector<FilterKind>& kinds)
{
  kinds.push_back({ "Map", make<Map>, drawMap, drawMapInputs, expectMap, checkMap, quickMap });
}

} // namespace Campaign
