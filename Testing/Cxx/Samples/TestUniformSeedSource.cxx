// SPDX-License-Identifier: BSD-3-Clause
// The source of uniform seeds: counts, bounds, the plane, evenness, errors.
#include "../../SeedPatterns.h"
#include "ProgressTest.h"

#include "vtkUniformSeedSource.h"

#include <algorithm>
#include <limits>

namespace
{

std::vector<double> seedCoordinates(vtkUniformSeedSource* source)
{
  source->Update();
  return coordinates(source->GetOutput());
}

void checkPattern(Checks& checks, vtkUniformSeedSource* source, vtkIdType count)
{
  const double* bounds = source->GetBounds();
  source->SetNumberOfPoints(count);
  const std::vector<double> points = seedCoordinates(source);
  vtkPolyData* output = source->GetOutput();
  CHECK(checks, output->GetNumberOfPoints() == count);
  CHECK(checks, output->GetNumberOfVerts() == count && output->GetNumberOfCells() == count);
  CHECK(checks, output->GetPoints()->GetDataType() == VTK_DOUBLE);
  double mean[3] = { 0.0, 0.0, 0.0 };
  bool inside = true;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::size_t a = i % 3;
    inside = inside && points[i] >= bounds[2 * a] && points[i] <= bounds[2 * a + 1];
    mean[a] += points[i] / static_cast<double>(count);
  }
  CHECK(checks, inside);
  if (count > 1000)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      const bool flat = a == 2 && source->GetDimension() == 2;
      const double centre = flat ? bounds[4] : 0.5 * (bounds[2 * a] + bounds[2 * a + 1]);
      CHECK_NEAR(checks, mean[a], centre, 0.05 * (bounds[2 * a + 1] - bounds[2 * a]));
    }
  }
  CHECK(checks, seedCoordinates(source) == points);
}

void checkPatterns(Checks& checks)
{
  vtkNew<vtkUniformSeedSource> source;
  source->SetBounds(-3.0, 5.0, 10.0, 12.0, -7.0, -6.0);
  for (const int dimension : { 2, 3 })
  {
    source->SetDimension(dimension);
    for (int pattern = 0; pattern < RectifiedTransport::numberOfSeedPatterns; ++pattern)
    {
      source->SetPattern(pattern);
      if (pattern == vtkUniformSeedSource::LATTICE)
      {
        // 8 x 2 x 1 in cells of an eighth
        checkPattern(checks, source, dimension == 2 ? 64 * 16 : 64 * 16 * 8);
        continue;
      }
      for (const vtkIdType count : { 1, 2, 9, 1234 })
      {
        checkPattern(checks, source, count);
      }
    }
  }
  source->SetPatternToBlueNoise();
  const std::vector<double> first = seedCoordinates(source);
  source->SetRandomSeed(2);
  CHECK(checks, seedCoordinates(source) != first);
}

// The same seeds as the sampler's own on the same domain.
void checkAgainstSampler(Checks& checks)
{
  vtkNew<vtkUniformSeedSource> source;
  source->SetBounds(0.0, 6.0, 0.0, 4.0, 0.0, 0.0);
  source->SetNumberOfPoints(500);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(makeImage(7, 5, 1, true, bumpy));
  sampler->SetNumberOfParticles(500);
  sampler->SetFlowTime(0.0);
  CHECK(checks, largestDifference(seedCoordinates(source), sampleCoordinates(sampler)) <= 1e-14);
}

void checkErrors(Checks& checks)
{
  vtkNew<vtkUniformSeedSource> source;
  ErrorTest test(checks, source);
  const double infinity = std::numeric_limits<double>::infinity();
  source->SetNumberOfPoints(0);
  test.Expect({ "NumberOfPoints is 0", "at least 1" }, __LINE__);
  source->SetNumberOfPoints(-8);
  test.Expect({ "NumberOfPoints is -8", "at least 1" }, __LINE__);
  source->SetNumberOfPoints(100);
  for (const int dimension : { 1, 4 })
  {
    source->SetDimension(dimension);
    test.Expect({ dimension == 1 ? "Dimension is 1" : "Dimension is 4", "2 or 3" }, __LINE__);
  }
  source->SetDimension(2);
  source->SetPattern(-1);
  test.Expect({ "Pattern is -1", "0 (BlueNoise)" }, __LINE__);
  source->SetPatternToRandom();
  source->SetThreading(-1);
  test.Expect("Threading is -1; it must be 0 (Auto)", __LINE__);
  source->SetThreadingToAuto();
  source->SetBounds(0, 1, 2, 1, 0, 1);
  test.Expect({ "Bounds are 2 to 1 in y", "the second greater" }, __LINE__);
  source->SetBounds(0, 0, 0, 1, 0, 1);
  test.Expect({ "Bounds are 0 to 0 in x", "the second greater" }, __LINE__);
  source->SetBounds(0, infinity, 0, 1, 0, 1);
  test.Expect({ "Bounds are 0 to inf in x", "finite" }, __LINE__);
  source->SetBounds(0, 1, 0, 1, 1, 0);
  test.Expect({ "Bounds are 1 to 0 in z", "the second greater" }, __LINE__);
  source->SetBounds(0, 1, 0, 1, 3, 3);
  test.ExpectNone(__LINE__);
  CHECK(checks, coordinates(source->GetOutput())[2] == 3.0);
  source->SetDimension(3);
  test.Expect({ "Bounds are 3 to 3 in z", "the second greater" }, __LINE__);
}

// Pieces have together the points of one, in their order; there are no more than those asked for.
void checkPieces(Checks& checks)
{
  for (const int dimension : { 2, 3 })
  {
    for (int pattern = 0; pattern < RectifiedTransport::numberOfSeedPatterns; ++pattern)
    {
      vtkNew<vtkUniformSeedSource> source;
      source->SetPattern(pattern);
      source->SetDimension(dimension);
      source->SetNumberOfPoints(1000);
      source->Update();
      vtkNew<vtkPoints> whole;
      whole->SetDataTypeToDouble();
      whole->DeepCopy(source->GetOutput()->GetPoints());
      vtkIdType next = 0;
      for (int piece = 0; piece < 4; ++piece)
      {
        source->UpdatePiece(piece, 3, 0);
        vtkPolyData* part = source->GetOutput();
        CHECK(checks, part->GetNumberOfVerts() == part->GetNumberOfPoints());
        CHECK(checks, (part->GetNumberOfPoints() > 0) == (piece < 3));
        for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i, ++next)
        {
          double x[3];
          double expected[3];
          part->GetPoint(i, x);
          whole->GetPoint(next, expected);
          CHECK(checks, std::equal(x, x + 3, expected));
        }
      }
      CHECK(checks, next == whole->GetNumberOfPoints());
    }
  }
}

// While the pattern is made.
void checkAbort(Checks& checks)
{
  vtkNew<vtkUniformSeedSource> source;
  source->SetDimension(3);
  source->SetNumberOfPoints(8000000);
  checkAbort(
    checks, source, 1e-9, [&]() { source->Modified(); }, __LINE__);
}

} // namespace

int TestUniformSeedSource(int, char*[])
{
  return runChecks({ checkPatterns, checkAgainstSampler, checkErrors, checkPieces, checkAbort });
}
