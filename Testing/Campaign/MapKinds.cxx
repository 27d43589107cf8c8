// SPDX-License-Identifier: BSD-3-Clause
// Cartogram.
#include "DrawnInputs.h"
#include "Kinds.h"
#include "OutputChecks.h"

#include "vtkCartogram.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>

namespace Campaign
{

namespace
{

void drawCartogram(Settings& settings)
{
  using T = vtkCartogram;
  settings.Draw<T, int>(
    "Resolution", &T::SetResolution, { 16, 31, 64, 64 }, { 0, 15, 16385, -3 }, 1.0);
  settings.Draw<T, double>(
    "Margin", &T::SetMargin, { 0.0, 0.01, 0.1, 1.0, 10.0 }, { -0.1, 10.5, NaN, Infinity }, 0.3);
  settings.Draw<T, double>("Tolerance", &T::SetTolerance, { 0.05, 0.2, 1.0, 0.01 },
    { 0.0, -1.0, 1.5, NaN, Infinity }, 0.6);
  settings.Draw<T, int>(
    "MaximumIterations", &T::SetMaximumIterations, { 1, 2, 3 }, { 0, -1, 101 }, 1.0);
  settings.Draw<T, double>("MinimumShare", &T::SetMinimumShare, { 0.0, 0.01, 0.2, 1.0 },
    { -0.1, 1.1, NaN, Infinity }, 0.3);
  settings.Draw<T, double>(
    "Blend", &T::SetBlend, { 0.0, 0.5, 1.0, 5e-324 }, { -0.1, 1.1, NaN, Infinity }, 0.3);
  settings.Draw<T, int>("Projection", &T::SetProjection,
    { T::PROJECTION_NONE, T::PROJECTION_EQUAL_AREA }, { -1, 2 }, 0.3);
  drawEmptySettings<T>(settings);
  drawThreading<T>(settings);
}

Inputs drawCartogramInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs{ { drawMap(random) }, {} };
  Input& map = inputs[0][0];
  const std::string mass = random.Chance(0.95) ? random.Of({ "", "Mass", "Mass" }) : "Nothing";
  settings.Add("Array", mass, [mass](vtkAlgorithm* filter) {
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, mass.c_str());
  });
  const std::string land =
    random.Chance(0.95) ? random.Of({ "None", "Land", "Land", "Land" }) : "Mass";
  settings.Add("Array", land, [land](vtkAlgorithm* filter) {
    filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, land.c_str());
  });
  if (mass == "Nothing")
  {
    map.Worsen(State::Faulty);
  }
  else if (land != "Land" && !(land == "None" && map.Data->IsA("vtkCompositeDataSet")))
  {
    map.Worsen(State::Odd); // holes are regions of their own, and overlap; or regions are one
  }
  if (random.Chance(0.4))
  {
    inputs[1] = { drawPoints(random, nullptr, settings.IsLarge() ? 5000 : 200) };
  }
  return inputs;
}

bool isOnEarth(vtkDataObject* data)
{
  double bounds[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  if (auto* set = vtkPointSet::SafeDownCast(data))
  {
    set->ComputeBounds();
    set->GetBounds(bounds);
  }
  else if (auto* blocks = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      if (!isOnEarth(leaves->GetCurrentDataObject()))
      {
        return false;
      }
    }
  }
  return std::max(-bounds[0], bounds[1]) <= 360.0 && std::max(-bounds[2], bounds[3]) <= 90.0;
}

State expectCartogram(vtkAlgorithm* filter, const Inputs& inputs)
{
  State state = inputs[0][0].Condition;
  const bool isProjected = vtkCartogram::SafeDownCast(filter)->GetProjection() != 0;
  for (const std::vector<Input>& ofPort : inputs)
  {
    if (isProjected && !ofPort.empty() && !isOnEarth(ofPort[0].Data))
    {
      state = worse(state, State::Faulty);
    }
  }
  if (!inputs[1].empty() && inputs[1][0].Condition != State::Empty)
  {
    state = worse(state, inputs[1][0].Condition);
  }
  return state;
}

void checkCartogram(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* cartogram = vtkCartogram::SafeDownCast(filter);
  vtkPolyData* regions = cartogram->GetRegions();
  requireFinitePoints(regions, findings);
  requireFinitePoints(cartogram->GetGraticule(), findings);
  const vtkIdType cells = inputs[0][0].Data->GetNumberOfElements(vtkDataObject::CELL);
  findings.That(regions->GetNumberOfCells() == cells, "as many cells as before");
  vtkDataArray* errors = requireArray(regions->GetCellData(), "AreaError", 1, cells, findings);
  vtkDataArray* targets = requireArray(regions->GetCellData(), "TargetArea", 1, cells, findings);
  vtkDataArray* passes = regions->GetFieldData()->GetArray("AreaErrors");
  findings.That(passes && passes->GetNumberOfTuples() <= cartogram->GetMaximumIterations(),
    "a largest error for each pass");
  double largest = 0.0;
  for (vtkIdType i = 0; errors && targets && i < cells; ++i)
  {
    largest = std::max(largest, std::abs(errors->GetComponent(i, 0)));
    findings.That(targets->GetComponent(i, 0) >= 0.0, "a target of an area");
  }
  if (passes && passes->GetNumberOfTuples() > 0)
  {
    findings.Near(
      passes->GetComponent(passes->GetNumberOfTuples() - 1, 0), largest, 1e-9, "AreaErrors");
  }
  if (auto* map = vtkPolyData::SafeDownCast(inputs[0][0].Data))
  {
    requirePassed(
      map->GetCellData(), regions->GetCellData(), { "AreaError", "TargetArea" }, findings);
    findings.That(regions->GetNumberOfLines() == map->GetNumberOfLines(), "lines stay lines");
  }
  if (inputs[1].empty())
  {
    return;
  }
  auto* overlay = vtkPointSet::SafeDownCast(inputs[1][0].Data);
  vtkPointSet* moved = cartogram->GetOverlay();
  requireFinitePoints(moved, findings);
  findings.That(
    moved->GetNumberOfPoints() == overlay->GetNumberOfPoints(), "all points of the overlay");
  requirePassed(overlay->GetPointData(), moved->GetPointData(), {}, findings);
}

void quickCartogram(RandomSource& random, vtkAlgorithm* filter)
{
  auto* cartogram = vtkCartogram::SafeDownCast(filter);
  cartogram->SetResolution(16);
  cartogram->SetMaximumIterations(1);
  auto* map = vtkDataSet::SafeDownCast(filter->GetInputDataObject(0, 0));
  if (map && map->GetCellData()->HasArray("v") && random.Chance(0.5))
  {
    cartogram->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "v");
  }
}

} // namespace

void addMapKinds(std::vector<FilterKind>& kinds)
{
  kinds.push_back({ "Cartogram", make<vtkCartogram>, drawCartogram, drawCartogramInputs,
    expectCartogram, checkCartogram, quickCartogram });
}

} // namespace Campaign
