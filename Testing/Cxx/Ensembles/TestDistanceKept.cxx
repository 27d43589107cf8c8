// SPDX-License-Identifier: BSD-3-Clause
// vtkTransportDistance keeps maps and pairs by the content of the densities: what it was given
// before is not solved again.
#include "DistanceTest.h"

namespace
{

const std::vector<std::array<double, 2>> places = { { 10, 20 }, { 14, 28 }, { 22, 14 },
  { 25, 25 } };

// The rows and columns of a matrix in the opposite order.
Matrix reversed(Matrix matrix)
{
  std::reverse(matrix.begin(), matrix.end());
  for (Values& column : matrix)
  {
    std::reverse(column.begin(), column.end());
  }
  return matrix;
}

// The first rows and columns.
Matrix corner(const Matrix& matrix, std::size_t size)
{
  Matrix part(matrix.begin(), matrix.begin() + static_cast<std::ptrdiff_t>(size));
  for (Values& column : part)
  {
    column.resize(size);
  }
  return part;
}

void checkKept(Checks& checks, int method, vtkIdType first, vtkIdType oneMore)
{
  const Images images = makeBells(places);
  auto distance = makeDistance(images, method);
  const Matrix before = distancesOf(distance);
  CHECK(checks, distance->GetNumberOfSolutions() == first);

  connect(distance, { images.rbegin(), images.rend() });
  CHECK(checks, distancesOf(distance) == reversed(before));
  connect(distance, makeBells(places));
  CHECK(checks, distancesOf(distance) == before);
  distance->SetNumberOfCoordinates(3);
  distance->SetInputName(0, "first");
  CHECK(checks, distancesOf(distance) == before);
  CHECK(checks, distance->GetNumberOfSolutions() == first);

  Images more = images;
  more.push_back(makeBell(18, 20));
  connect(distance, more);
  CHECK(checks, corner(distancesOf(distance), 4) == before);
  CHECK(checks, distance->GetNumberOfSolutions() == first + oneMore);
  connect(distance, { images[0], images[1] });
  CHECK(checks, distancesOf(distance) == corner(before, 2));
  CHECK(checks, distance->GetNumberOfSolutions() == first + oneMore);
  // What the last run did not need is released.
  connect(distance, images);
  CHECK(checks, distancesOf(distance) == before);
  CHECK(checks, distance->GetNumberOfSolutions() > first + oneMore);
}

// A map for each of four inputs, or a solution for each of their six pairs.
void checkMethods(Checks& checks)
{
  checkKept(checks, vtkTransportDistance::LINEARIZED, 4, 1);
  checkKept(checks, vtkTransportDistance::CERTIFIED, 6, 4);
}

void checkBothMethods(Checks& checks)
{
  auto distance = makeDistance(makeBells({ { 10, 20 }, { 14, 28 }, { 22, 14 } }));
  const Matrix linearized = distancesOf(distance);
  distance->SetMethodToCertified();
  const Matrix certified = distancesOf(distance);
  CHECK(checks, certified != linearized && distance->GetNumberOfSolutions() == 6);
  distance->SetMethodToLinearized();
  CHECK(checks, distancesOf(distance) == linearized);
  distance->SetMethodToCertified();
  CHECK(checks, distancesOf(distance) == certified);
  CHECK(checks, distance->GetNumberOfSolutions() == 6);
}

void checkSameTwice(Checks& checks)
{
  auto distance = makeDistance(makeBells({ { 10, 20 }, { 10, 20 }, { 22, 14 } }));
  const Matrix found = distancesOf(distance);
  CHECK(checks, distance->GetNumberOfSolutions() == 2);
  CHECK(checks, found[0][1] == 0.0 && found[0][2] == found[1][2] && found[0][2] > 0.0);
}

// Another value, another length and another reading are other densities.
void checkChanges(Checks& checks)
{
  const Images images = makeBells({ { 10, 20 }, { 14, 28 } });
  auto distance = makeDistance(images);
  Matrix before = distancesOf(distance);
  vtkIdType solutions = distance->GetNumberOfSolutions();
  const auto solvesAnew = [&](vtkIdType count) {
    const Matrix now = distancesOf(distance);
    const bool isNew = now != before && distance->GetNumberOfSolutions() == solutions + count;
    before = now;
    solutions = distance->GetNumberOfSolutions();
    return isNew;
  };
  changeDensity(images[0]);
  CHECK(checks, solvesAnew(1));
  distance->InvertDensityOn();
  CHECK(checks, solvesAnew(2));
  for (const auto& image : images)
  {
    image->SetSpacing(0.5, 3.0, 1.0);
  }
  CHECK(checks, solvesAnew(2));
  CHECK(checks, !solvesAnew(0));
}

} // namespace

int TestDistanceKept(int, char*[])
{
  return runChecks({ checkMethods, checkBothMethods, checkSameTwice, checkChanges });
}
