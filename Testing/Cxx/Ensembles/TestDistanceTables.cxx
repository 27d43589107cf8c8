// SPDX-License-Identifier: BSD-3-Clause
// What the three tables of vtkTransportDistance hold: names, numbers of rows, points.
#include "DistanceTest.h"

#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkStringArray.h"

namespace
{

using Names = std::vector<std::string>;

// The names of the points.
Names pointNames(vtkTransportDistance* distance)
{
  auto* column = vtkStringArray::SafeDownCast(distance->GetCoordinates()->GetColumnByName("Name"));
  Names names;
  for (vtkIdType i = 0; column && i < column->GetNumberOfValues(); ++i)
  {
    names.push_back(column->GetValue(i));
  }
  return names;
}

void expectNames(Checks& checks, vtkTransportDistance* distance, const Names& names, int line)
{
  distance->Update();
  checks.That(columnNames(distance->GetDistances()) == names, "columns", line);
  checks.That(pointNames(distance) == names, "names of points", line);
}

void checkNames(Checks& checks)
{
  auto distance = makeDistance(makeBells({ { 10, 20 }, { 14, 28 }, { 22, 14 }, { 12, 12 } }));
  expectNames(checks, distance, { "Input 1", "Input 2", "Input 3", "Input 4" }, __LINE__);
  distance->SetInputName(1, "wind");
  distance->SetInputName(2, "wind");
  distance->SetInputName(3, "calm");
  CHECK(checks, distance->GetNumberOfInputNames() == 4);
  CHECK(checks, distance->GetInputName(3) == std::string("calm"));
  expectNames(checks, distance, { "Input 1", "wind", "wind (2)", "calm" }, __LINE__);
  distance->SetNumberOfInputNames(0);
  CHECK(checks, distance->GetInputName(3) == std::string());
  expectNames(checks, distance, { "Input 1", "Input 2", "Input 3", "Input 4" }, __LINE__);
}

// The name of a block comes before that of its connection.
void checkBlocks(Checks& checks)
{
  const Images images = makeBells({ { 10, 20 }, { 14, 28 }, { 22, 14 } });
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 3; ++i)
  {
    blocks->SetBlock(i, images[i]);
  }
  blocks->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "middle");
  vtkNew<vtkTransportDistance> distance;
  distance->AddInputDataObject(blocks);
  expectNames(checks, distance, { "Input 1", "middle", "Input 3" }, __LINE__);
  distance->SetInputName(0, "all");
  expectNames(checks, distance, { "all", "middle", "all (2)" }, __LINE__);
  CHECK(checks, distancesOf(distance) == distancesOf(makeDistance(images)));
}

// A row for each pair, in the order of the upper triangle of the matrix.
void checkBounds(Checks& checks)
{
  const Images images = makeBells({ { 10, 20 }, { 14, 28 }, { 22, 14 }, { 12, 12 } });
  for (const int method : distanceMethods)
  {
    auto distance = makeDistance(images, method);
    const Matrix matrix = distancesOf(distance);
    vtkTable* bounds = distance->GetBounds();
    CHECK(checks, columnNames(bounds) == Names({ "First", "Second", "LowerBound", "UpperBound" }));
    CHECK(checks, columnValues(bounds, "First") == Values({ 0, 0, 0, 1, 1, 2 }));
    CHECK(checks, columnValues(bounds, "Second") == Values({ 1, 2, 3, 2, 3, 3 }));
    const Values taken =
      columnValues(bounds, method == vtkTransportDistance::CERTIFIED ? "LowerBound" : "UpperBound");
    CHECK(checks,
      taken ==
        Values(
          { matrix[0][1], matrix[0][2], matrix[0][3], matrix[1][2], matrix[1][3], matrix[2][3] }));
  }
}

// Bells along x are points on a line, whose distances lose nothing.
void checkLine(Checks& checks)
{
  auto distance = makeDistance(
    makeBells({ { 10, 20 }, { 14, 20 }, { 22, 20 }, { 30, 20 } }), vtkTransportDistance::CERTIFIED);
  distance->Update();
  vtkTable* points = distance->GetCoordinates();
  CHECK(
    checks, columnNames(points) == Names({ "Coordinate0", "Coordinate1", "Name", "TotalMass" }));
  const Values x = columnValues(points, "Coordinate0");
  const Values y = columnValues(points, "Coordinate1");
  const Values truth = { 0.0, 2.0, 6.0, 10.0 };
  CHECK(checks, x.size() == 4 && y.size() == 4);
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    CHECK_NEAR(checks, std::abs(x[i] - x[0]), truth[i], 0.02);
    CHECK_NEAR(checks, y[i], 0.0, 0.2);
  }
  CHECK_NEAR(checks, sumOf(x), 0.0, 1e-9);
  CHECK(checks, fieldValue(points, "Stress") >= 0.0 && fieldValue(points, "Stress") < 0.01);
}

// More coordinates lose less; what the distances do not need is 0.
void checkDimensions(Checks& checks)
{
  const Images images = makeBells({ { 10, 20 }, { 14, 28 }, { 22, 14 } });
  auto distance = makeDistance(images);
  const Matrix matrix = distancesOf(distance);
  Values stress;
  for (const int dimensions : { 1, 2, 5 })
  {
    distance->SetNumberOfCoordinates(dimensions);
    distance->Update();
    vtkTable* points = distance->GetCoordinates();
    CHECK(checks, points->GetNumberOfColumns() == dimensions + 2);
    CHECK(checks, points->GetNumberOfRows() == 3);
    stress.push_back(fieldValue(points, "Stress"));
  }
  CHECK(checks, stress[0] > stress[1] && stress[2] < 1e-9);
  vtkTable* points = distance->GetCoordinates();
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      double squared = 0.0;
      for (int k = 0; k < 5; ++k)
      {
        const Values x = columnValues(points, "Coordinate" + std::to_string(k));
        squared += (x[i] - x[j]) * (x[i] - x[j]);
        CHECK(checks, k < 2 || std::abs(x[i]) < 1e-6);
      }
      CHECK_NEAR(checks, std::sqrt(squared), matrix[i][j], 1e-9);
    }
  }
}

// The mass of the input, not that by which it is divided.
void checkMasses(Checks& checks)
{
  auto distance = makeDistance({ makeBell(12, 20), makeBell(24, 20, 4.0) });
  Messages messages(distance);
  distance->Update();
  const Values masses = columnValues(distance->GetCoordinates(), "TotalMass");
  CHECK_NEAR(checks, masses[0], sumOf(imageValues(makeBell(12, 20), "Density")), 1e-9);
  CHECK_NEAR(checks, masses[1], 4.0 * masses[0], 1e-9);
  CHECK(checks, messages.Errors.empty());
}

} // namespace

int TestDistanceTables(int, char*[])
{
  return runChecks(
    { checkNames, checkBlocks, checkBounds, checkLine, checkDimensions, checkMasses });
}
