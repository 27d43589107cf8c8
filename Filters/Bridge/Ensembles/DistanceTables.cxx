// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ensembles/DistanceTables.h"

#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Core/Distance/ClassicalScaling.h"
#include "Core/Parallel/Progress.h"

#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

std::vector<double> matrixOf(std::size_t inputs, const std::vector<DistancePair>& pairs)
{
  std::vector<double> matrix(inputs * inputs, 0.0);
  auto pair = pairs.begin();
  for (std::size_t i = 0; i < inputs; ++i)
  {
    for (std::size_t j = i + 1; j < inputs; ++j, ++pair)
    {
      matrix[i * inputs + j] = matrix[j * inputs + i] = pair->Distance;
    }
  }
  return matrix;
}

// Adds a column with valueOf(row) in each row.
template <class ArrayT = vtkDoubleArray, class ValueOf>
void addColumn(vtkTable* table, const std::string& name, std::size_t rows, const ValueOf& valueOf)
{
  const auto column = newArray<ArrayT>(name, 1, static_cast<vtkIdType>(rows));
  for (std::size_t row = 0; row < rows; ++row)
  {
    column->SetValue(static_cast<vtkIdType>(row), valueOf(row));
  }
  table->AddColumn(column);
}

// The name of a column for each input; names that occur more than once get a number.
std::vector<std::string> columnNames(const std::vector<DistanceInput>& inputs)
{
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const DistanceInput& input : inputs)
  {
    std::string name = input.Name;
    for (int number = 2; !taken.insert(name).second; ++number)
    {
      name = input.Name + " (" + std::to_string(number) + ")";
    }
    names.push_back(name);
  }
  return names;
}

} // namespace

void writeDistances(
  const std::vector<DistanceInput>& inputs, const std::vector<DistancePair>& pairs, vtkTable* table)
{
  const std::size_t count = inputs.size();
  const std::vector<std::string> names = columnNames(inputs);
  const std::vector<double> matrix = matrixOf(count, pairs);
  for (std::size_t i = 0; i < count; ++i)
  {
    addColumn(table, names[i], count, [&](std::size_t row) { return matrix[i * count + row]; });
  }
}

void writeBounds(std::size_t inputs, const std::vector<DistancePair>& pairs, vtkTable* table)
{
  std::vector<std::pair<vtkIdType, vtkIdType>> numbers;
  for (std::size_t i = 0; i < inputs; ++i)
  {
    for (std::size_t j = i + 1; j < inputs; ++j)
    {
      numbers.emplace_back(i, j);
    }
  }
  const std::size_t rows = pairs.size();
  addColumn<vtkIdTypeArray>(table, "First", rows, [&](std::size_t i) { return numbers[i].first; });
  addColumn<vtkIdTypeArray>(
    table, "Second", rows, [&](std::size_t i) { return numbers[i].second; });
  addColumn(table, "LowerBound", rows, [&](std::size_t i) { return pairs[i].Lower; });
  addColumn(table, "UpperBound", rows, [&](std::size_t i) { return pairs[i].Upper; });
}

void writeCoordinates(const std::vector<DistanceInput>& inputs,
  const std::vector<DistancePair>& pairs, int dimensions, Progress& progress, vtkTable* table)
{
  const std::size_t count = inputs.size();
  const ScaledPoints points = scaleClassically(
    matrixOf(count, pairs), static_cast<std::int64_t>(count), dimensions, progress);
  const auto axes = static_cast<std::size_t>(dimensions);
  for (std::size_t k = 0; k < axes; ++k)
  {
    addColumn(table, "Coordinate" + std::to_string(k), count,
      [&](std::size_t i) { return points.Coordinates[i * axes + k]; });
  }
  vtkNew<vtkStringArray> names;
  names->SetName("Name");
  for (const std::string& name : columnNames(inputs))
  {
    names->InsertNextValue(name);
  }
  table->AddColumn(names);
  if (!std::isnan(inputs.front().Time))
  {
    addColumn(table, "Time", count, [&](std::size_t i) { return inputs[i].Time; });
  }
  addColumn(table, "TotalMass", count, [&](std::size_t i) { return inputs[i].Mass; });
  addFieldValue(table, "Stress", points.Stress);
  std::vector<DensityReading> readings;
  for (const DistanceInput& input : inputs)
  {
    readings.push_back(input.Reading);
  }
  addReadings(table, readings);
}

} // namespace RectifiedTransport::Bridge
