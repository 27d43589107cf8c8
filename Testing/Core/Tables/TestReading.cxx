// SPDX-License-Identifier: BSD-3-Clause
// How the values of an array become a density: components, missing and negative values, white,
// empty cells, findings about values.
#include "Core/Messages/Failure.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/Reading/DensityFailure.h"
#include "Core/Tables/Reading/DensityReader.h"
#include "Core/Tables/Reading/IdNames.h"
#include "Core/Tables/Reading/OccupiedCells.h"
#include "Core/Tables/Reading/PaddedValues.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

struct Table
{
  std::vector<double> Values;
  int Components;
};

class TableTuples
{
public:
  explicit TableTuples(const Table* table)
    : Own(table)
  {
  }
  template <class Visit>
  void VisitTuples(std::int64_t first, std::int64_t, const Visit& visit) const
  {
    const int n = this->Own->Components;
    const double* values = this->Own->Values.data() + n * first;
    visit([=](std::int64_t i, int c) { return values[n * i + c]; }, n);
  }

private:
  const Table* Own;
};

DensityRules rulesOf(int component)
{
  DensityRules rules;
  rules.Component = component;
  return rules;
}

std::vector<double> read(const DensityValues& values, std::int64_t first, std::int64_t count)
{
  std::vector<double> found(static_cast<std::size_t>(count));
  values.Read(first, count, found.data());
  return found;
}

using Reader = TupleReader<TableTuples>;
using Doubles = std::vector<double>;

TEST(Reading, TakesAComponent)
{
  const Table table{ { 3.0, 4.0, 1e200, 0.0 }, 2 };
  EXPECT_EQ(read(Reader(&table, rulesOf(1)), 0, 2), (Doubles{ 4.0, 0.0 }));
  EXPECT_EQ(read(Reader(&table, rulesOf(Magnitude)), 0, 2), (Doubles{ 5.0, 1e200 }));
  EXPECT_EQ(resolveComponent("density array 'a'", AutoComponent, Magnitude, 2), Magnitude);
  EXPECT_THROW(resolveComponent("density array 'a'", 2, Magnitude, 2), Failure);
}

TEST(Reading, GreyHasItsOwnLuminance)
{
  for (int grey = 0; grey < 256; ++grey)
  {
    const auto byte = static_cast<unsigned char>(grey);
    EXPECT_EQ(luminance(byte, byte, byte), grey);
    EXPECT_EQ(luminance<std::int64_t>(grey, grey, grey), grey);
  }
}

TEST(Reading, MissingAndBlankCellsAreEmpty)
{
  const Table table{ { 1.0, 9.0, 2.0, std::nan("") }, 1 };
  DensityRules rules = rulesOf(0);
  rules.Missing.High = 5.0;
  rules.Missing.AreNaN = true;
  Reader reader(&table, rules);
  const unsigned char flags[] = { 2, 0, 1, 0 };
  reader.SetBlanks(flags, 2);
  reader.SetEmpty(0.5);
  EXPECT_EQ(read(reader, 0, 4), (Doubles{ 0.5, 0.5, 2.0, 0.5 }));
  std::vector<unsigned char> empty(4);
  reader.FindEmpty(0, 4, empty.data());
  EXPECT_EQ(empty, (std::vector<unsigned char>{ 1, 1, 0, 1 }));
}

TEST(Reading, FindsWhiteAndTheLowestValue)
{
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  const Table table{ { -2.0, 7.0, -3.0, 7.0, 4.0 }, 1 };
  DensityRules rules = rulesOf(0);
  rules.ClampNegative = true;
  const Reader reader(&table, rules);
  const LargestValue white = findWhite(reader, false, 5, progress);
  EXPECT_EQ(white.Value, 7.0);
  EXPECT_EQ(white.Count, 2);
  EXPECT_EQ(white.First, 1);
  EXPECT_EQ(white.Next, 4.0);
  EXPECT_EQ(findWhite(reader, true, 5, progress).Value, 255.0);
  const LowestValue lowest = findLowest(reader, 5, progress);
  EXPECT_EQ(lowest.Value, -3.0);
  EXPECT_EQ(lowest.First, 2);
  EXPECT_EQ(lowest.Negative, -5.0);
  EXPECT_EQ(lowest.Largest, 7.0);
  EXPECT_EQ(read(reader, 0, 3), (Doubles{ 0.0, 7.0, 0.0 }));
}

TEST(Reading, EmptyCellsCountAsTheRuleSays)
{
  const double values[] = { 1.0, 3.0, 8.0, -1.0 };
  const unsigned char empty[] = { 0, 0, 1, 0 };
  OccupiedCells filled;
  filled.Add(values, empty, 4);
  EXPECT_EQ(densityOfEmptyCells({ EmptyCells::Zero, 0.0 }, filled), 0.0);
  EXPECT_EQ(densityOfEmptyCells({ EmptyCells::Mean, 0.0 }, filled), 2.0);
  EXPECT_EQ(densityOfEmptyCells({ EmptyCells::Minimum, 0.0 }, filled), 1.0);
  EXPECT_EQ(densityOfEmptyCells({ EmptyCells::Value, 5.0 }, filled), 5.0);
  EXPECT_EQ(densityOfEmptyCells({ EmptyCells::Value, 5.0 }, OccupiedCells()), 0.0);
}

TEST(Reading, PaddedValuesSurroundABox)
{
  const double inner[] = { 1.0, 2.0, 3.0, 4.0 };
  const auto values =
    std::make_shared<const DensityArray<3, double>>(inner, GridSize<3>{ 2, 2, 1 });
  const PaddedValues grown(values, { { 1, 1, 0 }, { 2, 2, 1 } }, { 4, 4, 1 }, 0.5);
  const Doubles expected{ 0.5, 0.5, 0.5, 0.5, 0.5, 1.0, 2.0, 0.5, 0.5, 3.0, 4.0, 0.5, 0.5, 0.5, 0.5,
    0.5 };
  EXPECT_EQ(read(grown, 0, 16), expected);
  for (std::int64_t first = 0; first < 16; ++first)
  {
    EXPECT_EQ(read(grown, first, 1), Doubles{ expected[static_cast<std::size_t>(first)] });
  }
}

TEST(Reading, TellsOfAValueThatCarriesMostOfTheMass)
{
  SuspectValues values;
  values.Found.Maximum = 9999.0;
  values.Found.Maxima = 1;
  values.Found.FirstMaximum = 4;
  values.Found.BelowMaximum = 3.0;
  values.Found.Minimum = 1.0;
  values.Found.Total = 10017.0;
  const std::string name = "density array 'a'";
  const std::vector<std::string> lines =
    describeSuspect(values, { name, name, name, "cells", 10, false, false, {} });
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0],
    "The value 9999 of the density array 'a', in 1 of 10 cells (index 4), carries 99.8 % of the "
    "mass; if it marks missing data, ValidRange = -1e+299 3 leaves it out");
  values.Found.Maximum = 4.0;
  values.Found.Total = 20.0;
  EXPECT_TRUE(describeSuspect(values, { name, name, name, "cells", 10, false, false, {} }).empty());
}

TEST(Reading, NamesOfIdsAreNoDensities)
{
  for (const char* name : { "ids", "GlobalNodeId", "cell_id", "objectid_1", "vtkGhostType" })
  {
    EXPECT_TRUE(isIdName(name)) << name;
  }
  for (const char* name : { "Solid", "FLUID", "vtk", "Density" })
  {
    EXPECT_FALSE(isIdName(name)) << name;
  }
}

} // namespace
} // namespace RectifiedTransport
