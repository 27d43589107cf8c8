// SPDX-License-Identifier: BSD-3-Clause
#include "Input.h"

#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkTypeTraits.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <vector>

namespace Campaign
{

namespace
{

vtkSmartPointer<vtkDataArray> newArray(RandomSource& random)
{
  const int type = random.Of({ VTK_DOUBLE, VTK_DOUBLE, VTK_DOUBLE, VTK_FLOAT, VTK_FLOAT,
    VTK_UNSIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_CHAR, VTK_SIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT,
    VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG,
    VTK_ID_TYPE, VTK_BIT });
  if (random.Chance(0.05))
  {
    if (type == VTK_FLOAT)
    {
      return vtkSmartPointer<vtkSOADataArrayTemplate<float>>::New();
    }
    return vtkSmartPointer<vtkSOADataArrayTemplate<double>>::New();
  }
  return vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
}

// One value of a kind; `at` is in [0,1).
double drawValue(RandomSource& random, int kind, double at)
{
  switch (kind)
  {
    case 0:
      return 1.0;
    case 1:
      return static_cast<double>(random.Whole(0, 100));
    case 2:
      return random.Unit();
    case 3: // a bump
      return 1.0 + 100.0 * at * (1.0 - at);
    case 4: // mostly empty
      return random.Chance(0.1) ? static_cast<double>(random.Whole(1, 100)) : 0.0;
    case 5: // steep
      return random.Magnitude(-40, 40);
    case 6: // half empty
      return at < 0.5 ? 0.0 : static_cast<double>(random.Whole(1, 9));
    case 7:
      return random.Magnitude(1000, 1010);
    case 8: // denormal
      return std::ldexp(random.Unit(), -1030);
    default:
      return random.Magnitude(-990, -960);
  }
}

// Values of any size become ones that a type holds.
double inRangeOf(vtkDataArray* array, double value)
{
  const int type = array->GetDataType();
  if (type == VTK_DOUBLE)
  {
    return value;
  }
  if (type == VTK_BIT)
  {
    return value > 0.5 && value < 1e3 ? 1.0 : 0.0;
  }
  // The largest integers of 64 bits are no doubles.
  const double high = std::min(array->GetDataTypeMax(), type == VTK_FLOAT ? 3e38 : 9e18);
  const double low = std::max(array->GetDataTypeMin(), -high);
  if (type == VTK_FLOAT)
  {
    return std::isfinite(value) ? std::clamp(value, low, high) : value;
  }
  return std::isnan(value) ? 0.0 : std::clamp(std::floor(value), low, high);
}

} // namespace

std::string textOf(double value)
{
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

double drawExceptional(RandomSource& random)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return random.Of({ std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, -1.0, -1e-300,
    1e308, -1e308, -0.0, 5e-324, 1e160, -1e9 });
}

vtkSmartPointer<vtkDataArray> drawArray(
  RandomSource& random, vtkIdType tuples, int components, std::string& text)
{
  const vtkSmartPointer<vtkDataArray> array = newArray(random);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  const auto kind = static_cast<int>(random.Chance(0.85) ? random.Whole(0, 6) : random.Whole(4, 9));
  const bool one = random.Chance(0.04); // all in one place
  const vtkIdType place = tuples > 0 ? random.Whole(0, tuples - 1) : 0;
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    const double at = static_cast<double>(i) / static_cast<double>(tuples);
    for (int c = 0; c < components; ++c)
    {
      const double value = drawValue(random, kind, at);
      array->SetComponent(i, c, inRangeOf(array, one && i != place ? 0.0 : value));
    }
  }
  const std::int64_t exceptional = random.Chance(0.06) && tuples > 0 ? random.Whole(1, 3) : 0;
  for (std::int64_t i = 0; i < exceptional; ++i)
  {
    const double value = inRangeOf(array, drawExceptional(random));
    array->SetComponent(
      random.Whole(0, tuples - 1), static_cast<int>(random.Whole(0, components - 1)), value);
  }
  if (random.Chance(0.01))
  {
    array->Fill(0.0);
  }
  text = std::string(array->GetClassName()) + " of " + std::to_string(components) + " x " +
    std::to_string(tuples) + ", values of kind " + std::to_string(kind) + (one ? " in one" : "") +
    (exceptional > 0 ? " and exceptional ones" : "");
  return array;
}

void drawGhosts(RandomSource& random, vtkDataSetAttributes* attributes, vtkIdType tuples,
  bool anyLength, Input& input)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  // One of the wrong length is none.
  const vtkIdType marked = random.Chance(0.1) && anyLength ? tuples / 2 : tuples;
  ghosts->SetNumberOfTuples(marked);
  const double share = random.Of({ 0.02, 0.3, 1.0 });
  for (vtkIdType i = 0; i < marked; ++i)
  {
    const auto flags = static_cast<unsigned char>(random.Of({ 1, 2, 8, 32, 33, 255 }));
    ghosts->SetValue(i, random.Chance(share) ? flags : static_cast<unsigned char>(0));
  }
  attributes->AddArray(ghosts);
  input.Worsen(State::Odd);
  input.Describe("ghosts");
}

} // namespace Campaign
