// SPDX-License-Identifier: BSD-3-Clause
// Transport Distance.
#include "DrawnInputs.h"
#include "Kinds.h"
#include "OutputChecks.h"

#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkTable.h"
#include "vtkTransportDistance.h"

#include <algorithm>
#include <vector>

namespace Campaign
{

namespace
{

using Distance = vtkTransportDistance;

void drawDistance(Settings& settings)
{
  settings.Draw<Distance, int>("Method", &Distance::SetMethod, { 0, 1 }, { -1, 2 }, 0.6);
  settings.Draw<Distance, int>(
    "MassDifference", &Distance::SetMassDifference, { 0, 1 }, { -1, 2 }, 0.1);
  settings.Draw<Distance, int>("NumberOfCoordinates", &Distance::SetNumberOfCoordinates,
    { 1, 2, 3, 100 }, { 0, -1, 101 }, 0.5);
  settings.Draw<Distance, vtkTypeBool>("OverTime", &Distance::SetOverTime, { 0, 1 }, {}, 0.05);
  if (settings.GetRandom().Chance(0.2))
  {
    settings.Add("InputNames", "'' 'other'",
      [](vtkAlgorithm* filter) { Distance::SafeDownCast(filter)->SetInputName(1, "other"); });
  }
  drawThreading<Distance>(settings);
  drawDensitySettings(settings);
}

Inputs drawDistanceInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(1);
  inputs[0] = { drawDensityOn(random, settings, 0) };
  const std::int64_t others = random.Chance(0.03) ? 0 : random.Whole(1, 3);
  for (std::int64_t i = 0; i < others; ++i)
  {
    inputs[0].push_back(drawPartner(random, inputs[0][0], settings));
  }
  return inputs;
}

State expectDistance(vtkAlgorithm* filter, const Inputs& inputs)
{
  State state = inputs[0].size() < 2 ? State::Odd : State::Sound;
  for (const Input& input : inputs[0])
  {
    state = worse(state, densityState(filter, input));
  }
  auto* distance = Distance::SafeDownCast(filter);
  const bool mayRefuse =
    distance->GetMassDifference() != Distance::MASS_DIFFERENCE_NORMALIZE || distance->GetOverTime();
  return worse(state, mayRefuse ? State::Odd : State::Sound);
}

void checkDistance(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* distance = Distance::SafeDownCast(filter);
  const auto count = static_cast<vtkIdType>(inputs[0].size());
  vtkTable* matrix = distance->GetDistances();
  findings.That(
    matrix->GetNumberOfColumns() == count && matrix->GetNumberOfRows() == count, "N by N");
  vtkDataSetAttributes* bounds = distance->GetBounds()->GetRowData();
  const vtkIdType pairs = count * (count - 1) / 2;
  vtkDataArray* lower = requireArray(bounds, "LowerBound", 1, pairs, findings);
  vtkDataArray* upper = requireArray(bounds, "UpperBound", 1, pairs, findings);
  vtkIdType pair = 0;
  for (vtkIdType i = 0; lower && upper && i < count; ++i)
  {
    findings.That(matrix->GetValue(i, i).ToDouble() == 0.0, "0 on the diagonal");
    for (vtkIdType j = i + 1; j < count; ++j, ++pair)
    {
      const double found = matrix->GetValue(i, j).ToDouble();
      findings.That(found >= 0.0 && found == matrix->GetValue(j, i).ToDouble(), "symmetric");
      findings.That(lower->GetComponent(pair, 0) >= 0.0 &&
          lower->GetComponent(pair, 0) <= upper->GetComponent(pair, 0),
        "LowerBound <= UpperBound");
    }
  }
  vtkTable* coordinates = distance->GetCoordinates();
  for (int axis = 0; axis < distance->GetNumberOfCoordinates(); ++axis)
  {
    const std::string name = "Coordinate" + std::to_string(axis);
    requireArray(coordinates->GetRowData(), name.c_str(), 1, count, findings);
  }
  findings.That(requireField(coordinates, "Stress", findings) >= 0.0, "Stress is not negative");
  for (vtkIdType i = 0; i < count; ++i)
  {
    const Input& input = inputs[0][static_cast<std::size_t>(i)];
    if (densityState(filter, input) == State::Sound)
    {
      findings.Near(coordinates->GetValueByName(i, "TotalMass").ToDouble(), massOf(filter, input),
        1e-9, "TotalMass");
    }
  }
}

void quickDistance(RandomSource&, vtkAlgorithm* filter)
{
  Distance::SafeDownCast(filter)->SetNumberOfCoordinates(2);
  Distance::SafeDownCast(filter)->OverTimeOff();
}

} // namespace

void addDistanceKinds(std::vector<FilterKind>& kinds)
{
  kinds.push_back({ "Distance", make<Distance>, drawDistance, drawDistanceInputs, expectDistance,
    checkDistance, quickDistance });
}

} // namespace Campaign
