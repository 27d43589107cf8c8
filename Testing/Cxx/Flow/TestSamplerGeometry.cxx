// SPDX-License-Identifier: BSD-3-Clause
// Where particles lie: planes, one dimension, extents, spacings, directions, points and cells.
#include "TestData.h"

#include "vtkMath.h"
#include "vtkMatrix3x3.h"

#include <algorithm>
#include <array>

namespace
{

using Points = std::vector<double>;

// One row or rectangle of cells in every orientation gives the same particles, coordinates
// permuted.
void checkPlanes(Checks& checks)
{
  const Points flat = samplePoints(unitCells(11, 6, 0));
  const Points line = samplePoints(unitCells(17, 0, 0));
  struct Plane
  {
    std::array<int, 3> Cells;
    const Points* Expected;
    std::array<int, 3> Axes; // which coordinate of the image is x, y, z of the reference
  };
  const Plane planes[] = { { { 11, 0, 6 }, &flat, { 0, 2, 1 } },
    { { 0, 11, 6 }, &flat, { 1, 2, 0 } }, { { 0, 17, 0 }, &line, { 1, 0, 2 } },
    { { 0, 0, 17 }, &line, { 2, 1, 0 } } };
  for (const Plane& plane : planes)
  {
    auto image = unitCells(plane.Cells[0], plane.Cells[1], plane.Cells[2]);
    image->SetOrigin(3.25, -2.0, 8.5);
    const double origin[3] = { 3.25, -2.0, 8.5 };
    Points points = samplePoints(image);
    CHECK(checks, points.size() == plane.Expected->size());
    Points back(points.size());
    for (std::size_t i = 0; i < points.size(); i += 3)
    {
      for (std::size_t a = 0; a < 3; ++a)
      {
        const auto axis = static_cast<std::size_t>(plane.Axes[a]);
        back[i + a] = points[i + axis] - origin[axis];
      }
    }
    checks.That(largestDifference(back, *plane.Expected) <= 1e-13, "same particles", __LINE__);
  }
}

// Values on points are those of cells half a spacing around them.
void checkPointsAndCells(Checks& checks)
{
  const auto [cells, points] = makeCellsAndPoints();
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(cells);
  const Points ofCells = sampleCoordinates(sampler);
  const double mass = fieldValue(sampler->GetOutput(), "TotalMass");
  sampler->SetInputData(points);
  const Points ofPoints = sampleCoordinates(sampler);
  CHECK_NEAR(checks, largestDifference(ofCells, ofPoints), 0.0, 1e-12);
  CHECK_NEAR(checks, fieldValue(sampler->GetOutput(), "TotalMass") / mass, 1.0, 1e-14);
}

void checkInside(Checks& checks, vtkImageData* image, const Points& points, double margin)
{
  double bounds[6];
  image->GetBounds(bounds);
  bool inside = true;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::size_t a = i % 3;
    inside =
      inside && points[i] >= bounds[2 * a] - margin && points[i] <= bounds[2 * a + 1] + margin;
  }
  CHECK(checks, inside);
}

// Every rotation, sheer, extent and sign of the spacing is the image's own index-to-physical map of
// what the reference gives, and mass goes with the cells' measure. Even spacings keep blue noise
// the same.
void checkTransforms(Checks& checks)
{
  const double angle = 0.7;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double rotation[9] = { c, -s, 0, s * c, c * c, -s, s * s, s * c, c };
  const double sheer[9] = { 1, 0.5, 0, 0, 1, 0.25, 0, 0, 1 };
  const double flip[9] = { -1, 0, 0, 0, 0, 1, 0, 1, 0 };
  const double identity[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  const double spacings[][3] = { { 1, 1, 1 }, { 2.5, 2.5, 2.5 }, { -1, 1, 1 }, { 1, -3, 0.01 } };
  for (const int depth : { 0, 4 })
  {
    auto image = unitCells(8, 6, depth);
    vtkNew<vtkTransportSampler> sampler;
    sampler->SetInputData(image);
    sampler->SetSeedPatternToLattice();
    sampler->SetSamplesPerCell(2);
    const Points reference = sampleCoordinates(sampler);
    const double mass = fieldValue(sampler->GetOutput(), "TotalMass");
    image->SetExtent(-5, 3, 10, 16, 2, 2 + depth);
    image->SetOrigin(100.0, -20.0, 3.0);
    for (const double* direction : { rotation, sheer, flip, identity })
    {
      for (const double* spacing : spacings)
      {
        image->SetDirectionMatrix(direction);
        image->SetSpacing(spacing);
        const Points points = sampleCoordinates(sampler);
        Points expected(points.size());
        for (std::size_t i = 0; i + 2 < reference.size(); i += 3)
        {
          const double index[3] = { reference[i] - 5, reference[i + 1] + 10, reference[i + 2] + 2 };
          image->TransformContinuousIndexToPhysicalPoint(index, expected.data() + i);
        }
        CHECK_NEAR(checks, largestDifference(points, expected), 0.0, 1e-12);
        checkInside(checks, image, points, direction == identity ? 0.0 : 1e-12);
        const double u[3] = { direction[0] * spacing[0], direction[3] * spacing[0],
          direction[6] * spacing[0] };
        const double v[3] = { direction[1] * spacing[1], direction[4] * spacing[1],
          direction[7] * spacing[1] };
        const double w[3] = { direction[2] * spacing[2], direction[5] * spacing[2],
          direction[8] * spacing[2] };
        double cross[3];
        vtkMath::Cross(u, v, cross);
        const double measure = depth > 0 ? std::abs(vtkMath::Dot(cross, w)) : vtkMath::Norm(cross);
        CHECK_NEAR(
          checks, fieldValue(sampler->GetOutput(), "TotalMass") / (mass * measure), 1.0, 1e-13);
      }
    }
  }
}

// The spacing of a flat axis has no part in anything; not even 0 matters.
void checkFlatAxis(Checks& checks)
{
  auto image = unitCells(8, 6, 0);
  const Points reference = samplePoints(image);
  for (const double spacing : { 0.0, 1e9, -2.0 })
  {
    image->SetSpacing(1.0, 1.0, spacing);
    vtkNew<vtkTransportSampler> sampler;
    sampler->SetInputData(image);
    sampler->SetNumberOfParticles(500);
    CHECK_NEAR(checks, largestDifference(sampleCoordinates(sampler), reference), 0.0, 1e-14);
  }
}

// One cell between two points is an axis; one point is none.
void checkThinAxes(Checks& checks)
{
  const auto one = [](vtkIdType) { return 3.0; };
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetNumberOfParticles(1000);
  sampler->SetInputData(makeImage(2, 2, 2, true, one)); // one cell
  sampler->Update();
  double bounds[6];
  sampler->GetOutput()->GetBounds(bounds);
  for (int a = 0; a < 3; ++a)
  {
    CHECK(checks, bounds[2 * a] >= 0.0 && bounds[2 * a] < 0.1);
    CHECK(checks, bounds[2 * a + 1] <= 1.0 && bounds[2 * a + 1] > 0.9);
  }
  CHECK_NEAR(checks, fieldValue(sampler->GetOutput(), "TotalMass"), 3.0, 1e-15);
  // Uniform: the identity, but for the integrator's error.
  CHECK_NEAR(checks, fieldValue(sampler->GetOutput(), "TransportCost"), 0.0, 1e-6);

  sampler->SetInputData(makeImage(6, 2, 1, true, bumpy)); // 5 x 1 cells
  sampler->Update();
  sampler->GetOutput()->GetBounds(bounds);
  CHECK(checks, bounds[2] < 0.1 && bounds[3] > 0.9 && bounds[4] == 0.0 && bounds[5] == 0.0);

  sampler->SetInputData(makeImage(6, 1, 1, false, bumpy)); // a line of 6 dual cells
  sampler->Update();
  sampler->GetOutput()->GetBounds(bounds);
  CHECK(checks, bounds[0] >= -0.5 && bounds[0] < 0.0 && bounds[1] <= 5.5 && bounds[1] > 5.0);
  CHECK(checks, bounds[2] == 0.0 && bounds[3] == 0.0);
}

// Blue noise is even in physical lengths: on a 2 x 1 rectangle of square cells and on the same
// rectangle of stretched cells, nearest neighbours are equally far.
void checkPhysicalEvenness(Checks& checks)
{
  const auto nearest = [](vtkImageData* image) {
    vtkNew<vtkTransportSampler> sampler;
    sampler->SetInputData(image);
    sampler->SetNumberOfParticles(400);
    sampler->SetFlowTime(0.0);
    const Points p = sampleCoordinates(sampler);
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); i += 3)
    {
      double best = HUGE_VAL;
      for (std::size_t j = 0; j < p.size(); j += 3)
      {
        const double d = std::hypot(p[i] - p[j], p[i + 1] - p[j + 1]);
        best = i == j ? best : std::min(best, d);
      }
      sum += best;
    }
    return sum / 400.0;
  };
  auto stretched = unitCells(4, 40, 0);
  stretched->SetSpacing(5.0, 0.25, 1.0); // 20 x 10
  const double hexagonal = std::sqrt(2.0 / std::sqrt(3.0) * 200.0 / 400.0);
  CHECK(checks, nearest(stretched) > 0.85 * hexagonal);
  CHECK(checks, nearest(unitCells(20, 10, 0)) > 0.85 * hexagonal);
}

} // namespace

int TestSamplerGeometry(int, char*[])
{
  return runChecks({ checkPlanes, checkPointsAndCells, checkTransforms, checkFlatAxis,
    checkThinAxes, checkPhysicalEvenness });
}
