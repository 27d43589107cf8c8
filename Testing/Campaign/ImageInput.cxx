// SPDX-License-Identifier: BSD-3-Clause
#include "Input.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <array>
#include <limits>

namespace Campaign
{

namespace
{

void drawExtent(RandomSource& random, const ImageRules& rules, vtkImageData* image, Input& input)
{
  const int dimension = rules.Dimension > 0 ? rules.Dimension : random.Of({ 1, 2, 2, 2, 2, 3, 3 });
  const int most = dimension == 1 ? rules.LargestAxis * rules.LargestAxis / 4
    : dimension == 2              ? rules.LargestAxis
                                  : 2 + rules.LargestAxis / 4;
  // Which axes are flat: of a plane the one across, of a line the two others.
  const auto odd = static_cast<std::size_t>(dimension == 3 ? 0 : random.Of({ 2, 2, 0, 1 }));
  int extent[6];
  for (std::size_t a = 0; a < 3; ++a)
  {
    const bool real = dimension == 3 || (dimension == 2 ? a != odd : a == odd);
    const auto start = static_cast<int>(random.Chance(0.6) ? 0
        : random.Chance(0.97)                              ? random.Whole(-20, 20)
                              : random.Of({ -2000000000, 2000000000 }));
    const auto points = static_cast<int>(real ? random.Whole(2, most) : 1);
    extent[2 * a] = start;
    extent[2 * a + 1] = start + points - 1;
    if (std::abs(start) > 20)
    {
      input.Worsen(State::Odd);
    }
  }
  if (rules.Dimension == 0 && random.Chance(0.02))
  {
    const bool point = random.Chance(0.5);
    for (int a = 0; a < 3; ++a)
    {
      extent[2 * a + 1] = extent[2 * a] - (point || a > 0 ? 0 : 1);
    }
    input.Worsen(point ? State::Faulty : State::Empty);
  }
  image->SetExtent(extent);
  std::string text = "extent";
  for (const int end : extent)
  {
    text += " " + std::to_string(end);
  }
  input.Describe(text);
}

double drawSpacing(RandomSource& random, Input& input)
{
  if (random.Chance(0.9))
  {
    return random.Of({ 1.0, 1.0, 0.1, random.Real(0.2, 3.0) });
  }
  input.Worsen(State::Odd);
  if (random.Chance(0.5))
  {
    return random.Of({ -1.0, -random.Real(0.2, 3.0), 1e-5, 1e6 });
  }
  return random.Of({ 1e-103, 1e-160, 1e-300, 5e-324, 1e100, 1e160, 1e300, 0.0,
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() });
}

void drawDirection(RandomSource& random, vtkImageData* image, Input& input)
{
  // Rational rotations, so that no library's sine decides.
  const auto matrix = random.Of<std::array<double, 9>>({
    { 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1 },
    { 1, 0, 0, 0, 0.28, -0.96, 0, 0.96, 0.28 },
    { 0, 0, 1, 1, 0, 0, 0, 1, 0 },
    { -1, 0, 0, 0, 1, 0, 0, 0, 1 },
    { 2.0 / 3, -1.0 / 3, 2.0 / 3, 2.0 / 3, 2.0 / 3, -1.0 / 3, -1.0 / 3, 2.0 / 3, 2.0 / 3 },
  });
  image->SetDirectionMatrix(matrix.data());
  if (random.Chance(0.05))
  {
    const double singular[9] = { 1, 1, 0, 1, 1, 0, 0, 0, random.Of({ 0.0, 1.0 }) };
    image->SetDirectionMatrix(singular);
    input.Worsen(State::Odd);
  }
  input.Describe("direction " + textOf(image->GetDirectionMatrix()->GetElement(0, 0)));
}

void drawPlace(RandomSource& random, const ImageRules& rules, vtkImageData* image, Input& input)
{
  if (random.Chance(0.6))
  {
    const double same = drawSpacing(random, input);
    const bool even = random.Chance(0.5);
    const double y = even ? same : drawSpacing(random, input);
    const double z = even ? same : drawSpacing(random, input);
    image->SetSpacing(same, y, z);
    input.Describe("spacing " + textOf(same) + " " + textOf(y) + " " + textOf(z));
  }
  if (random.Chance(0.4))
  {
    double origin[3];
    for (double& x : origin)
    {
      x = random.Real(-10.0, 10.0);
      if (random.Chance(0.03))
      {
        x = random.Of({ 1e9, 1e16, -1e300, std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::quiet_NaN() });
        input.Worsen(State::Odd);
      }
    }
    image->SetOrigin(origin);
    input.Describe(
      "origin " + textOf(origin[0]) + " " + textOf(origin[1]) + " " + textOf(origin[2]));
  }
  if (!rules.OrientedLikes && random.Chance(0.15))
  {
    drawDirection(random, image, input);
  }
}

// The values as text, which must be named.
void drawTexts(RandomSource& random, vtkDataSetAttributes* attributes, Input& input)
{
  vtkNew<vtkDoubleArray> numbers;
  numbers->DeepCopy(input.Values);
  input.Values = numbers;
  input.Texts = vtkSmartPointer<vtkStringArray>::New();
  input.Texts->SetName(numbers->GetName());
  input.Texts->SetNumberOfComponents(numbers->GetNumberOfComponents());
  for (vtkIdType i = 0; i < numbers->GetNumberOfValues(); ++i)
  {
    const std::string blank = random.Of({ "", "", "", " ", "\t" });
    input.Texts->InsertNextValue(blank + textOf(numbers->GetValue(i)) + blank);
  }
  input.Describe("as text");
  if (random.Chance(0.1) && numbers->GetNumberOfValues() > 0)
  {
    input.Texts->SetValue(random.Whole(0, numbers->GetNumberOfValues() - 1),
      random.Of({ "n/a", "1,5", "0x1", "1_0", "-", "+-1", "1e" }));
    input.Worsen(State::Faulty);
  }
  attributes->AddArray(input.Texts);
}

void drawDensity(RandomSource& random, vtkImageData* image, Input& input)
{
  input.OnPoints = random.Chance(0.5);
  vtkDataSetAttributes* attributes =
    image->GetAttributes(input.OnPoints ? vtkDataObject::POINT : vtkDataObject::CELL);
  vtkIdType tuples = input.OnPoints ? image->GetNumberOfPoints() : image->GetNumberOfCells();
  if (random.Chance(0.01) && tuples > 0)
  {
    tuples = random.Of<vtkIdType>({ 0, tuples - 1, tuples + 1, 2 * tuples });
    input.Worsen(State::Faulty);
  }
  const int components = random.Of({ 1, 1, 1, 1, 1, 1, 2, 3, 4, 5 });
  std::string text;
  const vtkSmartPointer<vtkDataArray> array = drawArray(random, tuples, components, text);
  input.Describe((input.OnPoints ? "points " : "cells ") + text);
  if (!random.Chance(0.02))
  {
    array->SetName("Values");
  }
  input.Values = array;
  if (random.Chance(0.04))
  {
    array->SetName("Values");
    drawTexts(random, attributes, input);
    return;
  }
  attributes->SetScalars(array);
}

// Arrays that nobody asked for, of names that an output may have.
void drawOthers(RandomSource& random, vtkImageData* image)
{
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    if (!random.Chance(0.15))
    {
      continue;
    }
    const vtkIdType tuples =
      owner == vtkDataObject::POINT ? image->GetNumberOfPoints() : image->GetNumberOfCells();
    std::string text;
    const vtkSmartPointer<vtkDataArray> array =
      drawArray(random, tuples, static_cast<int>(random.Whole(1, 3)), text);
    array->SetName(random.Of(
      { "Other", "Displacement", "Density", "Mass", "SiteId", "TotalMass", "Divergence" }));
    image->GetAttributes(owner)->AddArray(array);
    if (random.Chance(0.2))
    {
      vtkNew<vtkStringArray> words;
      words->SetName("Words");
      words->SetNumberOfValues(tuples);
      image->GetAttributes(owner)->AddArray(words);
    }
  }
}

} // namespace

Input drawImage(RandomSource& random, const ImageRules& rules)
{
  Input input;
  const auto image = vtkSmartPointer<vtkImageData>::New();
  input.Data = image;
  drawExtent(random, rules, image, input);
  drawPlace(random, rules, image, input);
  drawDensity(random, image, input);
  drawOthers(random, image);
  if (random.Chance(0.06))
  {
    drawGhosts(random, image->GetPointData(), image->GetNumberOfPoints(), true, input);
  }
  if (random.Chance(0.06))
  {
    drawGhosts(random, image->GetCellData(), image->GetNumberOfCells(), true, input);
  }
  return input;
}

} // namespace Campaign
