// SPDX-License-Identifier: BSD-3-Clause
#include "DrawnInputs.h"

#include "vtkDataSetAttributes.h"

#include <array>
#include <cstdlib>
#include <string>

namespace Campaign
{

bool isOnProcessor()
{
  const char* const processor = std::getenv("RT_CAMPAIGN_PROCESSOR");
  return processor && std::string(processor) == "1";
}

void drawDensitySettings(Settings& settings)
{
  using T = vtkDensityAlgorithm;
  settings.Draw<T, int>(
    "Component", &T::SetComponent, { -1, -1, 0, 1, 3, -3, -2, 100, -4 }, {}, 0.3);
  settings.Draw<T, vtkTypeBool>("InvertDensity", &T::SetInvertDensity, { 0, 1 }, {}, 0.2);
  settings.Draw<T, int>("NegativeValues", &T::SetNegativeValues, { 0, 1 }, { -1, 2 }, 0.3);
  settings.Draw<T, int>("NaNValues", &T::SetNaNValues, { 0, 1 }, { -1, 2 }, 0.2);
  drawValidRange(settings, true);
  settings.Draw<T, int>(
    "DensityResolution", &T::SetDensityResolution, { 1, 9, 16, 40 }, { 0, -1 }, 0.2);
}

void drawValidRange(Settings& settings, bool mayBeOut)
{
  RandomSource& random = settings.GetRandom();
  using Range = std::array<double, 2>;
  constexpr double all = 1e299;
  if (!random.Chance(0.2))
  {
    return;
  }
  const bool inRange = !mayBeOut || !random.Chance(0.03);
  const Range range = inRange
    ? random.Of({ Range{ -all, all }, Range{ 0.0, all }, Range{ -all, 1.0 }, Range{ -3.0, 1e20 } })
    : random.Of({ Range{ 2.0, 1.0 }, Range{ NaN, 1.0 }, Range{ 0.0, NaN } });
  settings.Add(
    "ValidRange", std::to_string(range[0]) + " " + std::to_string(range[1]),
    [range](vtkAlgorithm* filter) {
      vtkDensityAlgorithm::SafeDownCast(filter)->SetValidRange(range[0], range[1]);
    },
    inRange);
}

void drawChoice(RandomSource& random, Settings& settings, int port, int index, Input& input)
{
  const bool named = random.Chance(0.3);
  if (!named)
  {
    if (input.Texts)
    {
      input.Worsen(State::Odd); // another array may be the only one of numbers
    }
    settings.Add("Array", "scalars", [=](vtkAlgorithm* filter) {
      filter->SetInputArrayToProcess(index, port, 0,
        vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
    });
    return;
  }
  const std::string name = random.Chance(0.95) ? "Values" : "Nothing";
  const int association = random.Chance(0.97) ? 3 : random.Of({ 0, 1, 2, 7, -1 });
  settings.Add("Array", name + " of " + std::to_string(association), [=](vtkAlgorithm* filter) {
    filter->SetInputArrayToProcess(index, port, 0, association, name.c_str());
  });
  if (name == "Nothing" || (input.Values && !input.Values->GetName()))
  {
    input.Worsen(State::Faulty);
  }
  else if (association != 3)
  {
    input.Worsen(State::Odd);
  }
}

Input drawDensityOn(RandomSource& random, Settings& settings, int port, int index)
{
  Input input = drawImage(random, rulesOf(settings));
  drawChoice(random, settings, port, index, input);
  return input;
}

Input drawPartner(RandomSource& random, const Input& first, const Settings& settings)
{
  auto* like = vtkImageData::SafeDownCast(first.Data);
  if (random.Chance(0.3))
  {
    ImageRules rules = rulesOf(settings);
    rules.OrientedLikes = random.Chance(0.8);
    rules.Dimension = like->GetDataDimension();
    Input input = drawImage(random, rules);
    input.Worsen(State::Odd);
    return input;
  }
  Input input;
  input.Condition = first.Condition;
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->CopyStructure(like);
  input.Data = image;
  input.OnPoints = first.OnPoints;
  std::string text;
  const vtkIdType tuples = input.OnPoints ? image->GetNumberOfPoints() : image->GetNumberOfCells();
  input.Values = drawArray(random, tuples, 1, text);
  input.Values->SetName("Values");
  image->GetAttributes(input.OnPoints ? vtkDataObject::POINT : vtkDataObject::CELL)
    ->SetScalars(input.Values);
  input.Describe("like the first, " + text);
  return input;
}

} // namespace Campaign
