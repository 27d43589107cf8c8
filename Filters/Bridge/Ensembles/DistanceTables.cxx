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

vtkSmartPointer<vtkDoubleArray> addColumn(
  vtkTable* table, const std::string& name, std::size_t rows)
{
  auto column = newArray<vtkDoubleArray>(name, 1, static_cast<vtkIdType>(rows));
  table->AddColumn(column);
  return column;
}

} // namespace

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

void writeDistances(
  const std::vector<DistanceInput>& inputs, const std::vector<DistancePair>& pairs, vtkTable* table)
{
  const std::vector<std::string> names = columnNames(inputs);
  const std::vector<double> matrix = matrixOf(inputs.size(), pairs);
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    const auto column = addColumn(table, names[i], inputs.size());
    std::copy_n(matrix.data() + i * inputs.size(), inputs.size(), column->GetPointer(0));
  }
}

void writeBounds(std::size_t inputs, const std::vector<DistancePair>& pairs, vtkTable* table)
{
  const auto rows = static_cast<vtkIdType>(pairs.size());
  const auto first = newArray<vtkIdTypeArray>("First", 1, rows);
  const auto second = newArray<vtkIdTypeArray>("Second", 1, rows);
  table->AddColumn(first);
  table->AddColumn(second);
  const auto lower = addColumn(table, "LowerBound", pairs.size());
  const auto upper = addColumn(table, "UpperBound", pairs.size());
  vtkIdType row = 0;
  for (std::size_t i = 0; i < inputs; ++i)
  {
    for (std::size_t j = i + 1; j < inputs; ++j, ++row)
    {
      first->SetValue(row, static_cast<vtkIdType>(i));
      second->SetValue(row, static_cast<vtkIdType>(j));
      lower->SetValue(row, pairs[static_cast<std::size_t>(row)].Lower);
      upper->SetValue(row, pairs[static_cast<std::size_t>(row)].Upper);
    }
  }
}

void writeCoordinates(const std::vector<DistanceInput>& inputs,
  const std::vector<DistancePair>& pairs, int dimensions, Progress& progress, vtkTable* table)
{
  const std::size_t count = inputs.size();
  const ScaledPoints points = scaleClassically(
    matrixOf(count, pairs), static_cast<std::int64_t>(count), dimensions, progress);
  vtkNew<vtkStringArray> names;
  names->SetName("Name");
  for (const std::string& name : columnNames(inputs))
  {
    names->InsertNextValue(name);
  }
  const auto axes = static_cast<std::size_t>(dimensions);
  for (std::size_t k = 0; k < axes; ++k)
  {
    const auto column = addColumn(table, "Coordinate" + std::to_string(k), count);
    for (std::size_t i = 0; i < count; ++i)
    {
      column->SetValue(static_cast<vtkIdType>(i), points.Coordinates[i * axes + k]);
    }
  }
  table->AddColumn(names);
  if (!std::isnan(inputs.front().Time))
  {
    const auto times = addColumn(table, "Time", count);
    for (std::size_t i = 0; i < count; ++i)
    {
      times->SetValue(static_cast<vtkIdType>(i), inputs[i].Time);
    }
  }
  const auto masses = addColumn(table, "TotalMass", count);
  for (std::size_t i = 0; i < count; ++i)
  {
    masses->SetValue(static_cast<vtkIdType>(i), inputs[i].Mass);
  }
  addFieldValue(table, "Stress", points.Stress);
  std::vector<DensityReading> readings;
  for (const DistanceInput& input : inputs)
  {
    readings.push_back(input.Reading);
  }
  addReadings(table, readings);
}

} // namespace RectifiedTransport::Bridge
