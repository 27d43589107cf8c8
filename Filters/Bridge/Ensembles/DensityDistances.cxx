// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ensembles/DensityDistances.h"

#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Core/Distance/ClassicalScaling.h"
#include "Core/Geometry/Boxes/CommonGrid.h"

#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cmath>
#include <set>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// The symmetric matrix d(i, j) of inputs x inputs distances, by rows, from the pairs i < j in the
// order (0, 1), (0, 2) ... (1, 2) ...
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

// Values are hashed once here: the hash identifies maps and pairs of earlier runs, even if a source
// made the same density again.
DistanceInput readDistanceInput(InputDensity& density, Progress& progress)
{
  DistanceInput input;
  input.Reading = density.HowRead();
  input.Grid = density.Grid();
  input.Values = wholeValues(density, "Density", progress);
  // The copy above is all that is needed: what ranks gathered for it would double the memory.
  density.ReleaseGathered();
  const DensityArray<1, double> values(input.Values->GetPointer(0), { input.Grid.NumberOfCells() });
  input.Mass = requireMass(density, values, progress);
  input.Identity.AddArray(input.Values);
  input.Identity.Hash(progress);
  return input;
}

// A filter calls Begin in each run; distances of densities that come again are not computed again.
void DensityDistances::Begin(DistanceMethod method)
{
  this->Method = method;
  this->Entries.clear();
  this->Distances.Begin(method);
}

void DensityDistances::Add(DistanceInput input, Progress& progress)
{
  if (!this->Entries.empty())
  {
    const DistanceInput& first = this->Entries.front();
    // Distances are between measures in one box. Grids in it may differ.
    requireSameBox({ first.Grid, first.Title }, { input.Grid, input.Title });
    // The potentials that certify a distance need both densities on the same cells. Linearized
    // compares maps from one reference, which takes any grids in the same box.
    if (this->Method == DistanceMethod::Certified &&
      input.Grid.NumberOfValues() != first.Grid.NumberOfValues())
    {
      fail("Method Certified needs densities with the same number of cells along each axis; ",
        first.Title, " has ", describeValues(first.Grid), ", ", input.Title, " ",
        describeValues(input.Grid), " (Linearized takes both)");
    }
  }
  // The deleter owns the array, so that the values end with the last one who needs them, and the
  // entry keeps none: memory holds the values of few densities at a time.
  const std::shared_ptr<const double> values(
    input.Values->GetPointer(0), [kept = input.Values](const double*) {});
  input.Values = nullptr;
  this->Entries.push_back(std::move(input));
  const DistanceInput& added = this->Entries.back();
  // The content of the identity names the values: known distances are found by it. The answer is
  // true when so many maps are missing that all threads have work.
  if (this->Distances.Add(added.Identity.Content(), added.Grid, values, progress))
  {
    this->MakeMaps(progress);
  }
}

// Makes the maps of all densities that wait, several at a time, and releases their values.
void DensityDistances::MakeMaps(Progress& progress)
{
  const std::string cells =
    std::to_string(static_cast<std::int64_t>(this->Distances.CellsOfMaps()));
  withRequiredMemory(
    { "the optimal map to a density of " + cells + " cells (a coarser image takes less)",
      this->Distances.MemoryForMaps() },
    [&]() { this->Distances.MakeMaps(progress); });
}

std::vector<DistancePair> DensityDistances::Find(Progress& progress)
{
  // Making a map costs far more than comparing two of them.
  const bool lacksMaps = this->Distances.LacksMaps();
  Stages stages(progress, { { "maps", lacksMaps ? 9.0 : 0.0 }, { "pairs", 1 } });
  if (lacksMaps)
  {
    this->MakeMaps(stages["maps"]);
  }
  return withRequiredMemory(
    { "the bounds of a distance (Method Linearized takes less)", this->Distances.MemoryForPairs() },
    [&]() { return this->Distances.Find(stages["pairs"]); });
}

void writeDistances(
  const std::vector<DistanceInput>& inputs, const std::vector<DistancePair>& pairs, vtkTable* table)
{
  const std::size_t count = inputs.size();
  const std::vector<std::string> names = columnNames(inputs);
  // The matrix is symmetric, so that columns and rows are the same.
  const std::vector<double> matrix = matrixOf(count, pairs);
  for (std::size_t i = 0; i < count; ++i)
  {
    addColumn(table, names[i], count, [&](std::size_t row) { return matrix[i * count + row]; });
  }
}

void writeBounds(std::size_t inputs, const std::vector<DistancePair>& pairs, vtkTable* table)
{
  // The numbers of both inputs for each pair, in the order of DistanceSet::Find.
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
  // Classical scaling (Torgerson 1952) places the inputs in `dimensions` axes, so that their
  // Euclidean distances come near those of the matrix. Stress is the part that this loses.
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
  // Either all inputs are steps of one series and have times, or none has.
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
