// SPDX-License-Identifier: BSD-3-Clause
// The filters and the calls of Core/Transport.h give the same.
#include "BlendTest.h"

#include "Core/Transport.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkEqualMassCells.h"
#include "vtkTable.h"
#include "vtkTransportDistance.h"
#include "vtkTransportMap.h"

#include <cstdint>

namespace
{

using namespace RectifiedTransport;

constexpr int nx = 28;
constexpr int ny = 20;
constexpr double rounding = 1e-10; // of lengths and densities

// Cells of sides 1/2, whose box begins at the origin.
struct Pair
{
  vtkSmartPointer<vtkImageData> A = makeDensity({ nx, ny, 1 }, true, smoothDensity(nx, ny));
  vtkSmartPointer<vtkImageData> B = makeDensity({ nx, ny, 1 }, true, otherDensity(nx, ny));
  Values ValuesA = arrayValues(densityOf(this->A));
  Values ValuesB = arrayValues(densityOf(this->B));
  BoxDensity<2> BoxA{ this->ValuesA.data(), { nx, ny }, { 0.5 * nx, 0.5 * ny } };
  BoxDensity<2> BoxB{ this->ValuesB.data(), { nx, ny }, { 0.5 * nx, 0.5 * ny } };

  Pair()
  {
    this->A->SetSpacing(0.5, 0.5, 0.5);
    this->B->SetSpacing(0.5, 0.5, 0.5);
  }
};

double largestDifference(const Values& a, const Values& b)
{
  double largest = a.size() == b.size() ? 0.0 : HUGE_VAL;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

// With a third coordinate.
Values flatOf(const std::vector<Point<2>>& points)
{
  Values flat;
  for (const Point<2>& point : points)
  {
    flat.insert(flat.end(), { point[0], point[1], 0.0 });
  }
  return flat;
}

void checkSamples(Checks& checks)
{
  const Pair pair;
  for (const int method : { 0, 1 })
  {
    vtkNew<vtkTransportSampler> sampler;
    sampler->SetInputData(pair.A);
    sampler->SetNumberOfParticles(400);
    sampler->SetMethod(method);
    sampler->Update();
    SampleOptions options;
    options.Map.Method = method == 0 ? MapMethod::RectifiedFlow : MapMethod::Optimal;
    const std::vector<Point<2>> points = sample(pair.BoxA, 400, options);
    CHECK(checks, largestDifference(coordinates(sampler->GetOutput()), flatOf(points)) < rounding);

    vtkNew<vtkBlueNoiseRelaxation> relaxation;
    relaxation->SetInputData(sampler->GetOutput());
    relaxation->SetDensityData(pair.A);
    relaxation->SetMethod(method);
    relaxation->SetMaximumIterations(3);
    relaxation->Update();
    RelaxOptions relaxed;
    relaxed.Method = method == 0 ? RelaxMethod::GaussianBlueNoise : RelaxMethod::OptimalTransport;
    relaxed.MaximumIterations = 3;
    const Values moved = flatOf(relax<2>(points, pair.BoxA, relaxed));
    CHECK(checks,
      largestDifference(
        coordinates(vtkPointSet::SafeDownCast(relaxation->GetOutputDataObject(0))), moved) < 1e-7);
  }
}

void checkMaps(Checks& checks)
{
  const Pair pair;
  for (const int backward : { 0, 1 })
  {
    vtkNew<vtkTransportMap> transport;
    transport->SetInputData(pair.A);
    transport->SetDirection(backward);
    transport->Update();
    MapOptions<2> options;
    options.Direction = backward ? FlowDirection::Backward : FlowDirection::Forward;
    const SampledMap<2> found = map(pair.BoxA, options);
    vtkImageData* image = transport->GetOutput();
    CHECK(checks,
      largestDifference(imageValues(image, "Displacement"), flatOf(found.Displacement)) < rounding);
    CHECK(checks, largestDifference(imageValues(image, "Divergence"), found.Divergence) < rounding);
    CHECK(checks,
      largestDifference(imageValues(image, "JacobianDeterminant"), found.Determinant) < rounding);
  }
}

void checkBlends(Checks& checks)
{
  const Pair pair;
  const Values times{ 0.0, 0.04, 0.3, 0.5, 0.97, 1.0 };
  for (const int method : { 0, 1 })
  {
    MorphOptions options;
    options.Method = method == 0 ? MapMethod::RectifiedFlow : MapMethod::Optimal;
    const std::vector<MadeDensity<2>> made = morph(pair.BoxA, pair.BoxB, times, options);
    vtkNew<vtkTransportInterpolator> interpolator;
    interpolator->SetInputData(pair.A);
    interpolator->SetTargetData(pair.B);
    interpolator->SetMethod(method);
    for (std::size_t i = 0; i < times.size(); ++i)
    {
      interpolator->SetParameter(times[i]);
      CHECK(checks, largestDifference(runDensity(interpolator), made[i].Values) < rounding);
    }
  }
  vtkNew<vtkTransportBarycenter> barycentric;
  barycentric->AddInputDataObject(pair.A);
  barycentric->AddInputDataObject(pair.B);
  barycentric->SetWeight(0, 2.0);
  barycentric->SetWeight(1, 3.0);
  const MadeDensity<2> mean = barycenter<2>({ pair.BoxA, pair.BoxB }, { 2.0, 3.0 });
  CHECK(checks, largestDifference(runDensity(barycentric), mean.Values) < rounding);
}

void checkDistances(Checks& checks)
{
  const Pair pair;
  vtkNew<vtkTransportDistance> transport;
  transport->SetMethod(vtkTransportDistance::CERTIFIED);
  transport->AddInputDataObject(pair.A);
  transport->AddInputDataObject(pair.B);
  transport->Update();
  const DistanceBounds found = distance(pair.BoxA, pair.BoxB);
  const auto bound = [&](const char* name) {
    return transport->GetBounds()->GetValueByName(0, name).ToDouble();
  };
  // The filter chooses the order of the two densities by their contents.
  const DistanceBounds turned = distance(pair.BoxB, pair.BoxA);
  CHECK_NEAR(
    checks, bound("LowerBound"), found.Lower, std::abs(turned.Lower - found.Lower) + rounding);
  CHECK_NEAR(
    checks, bound("UpperBound"), found.Upper, std::abs(turned.Upper - found.Upper) + rounding);
}

void checkCells(Checks& checks)
{
  const Pair pair;
  const std::vector<Point<2>> sites = sample(pair.BoxA, 9);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point<2>& site : sites)
  {
    points->InsertNextPoint(site[0], site[1], 0.0);
  }
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);
  for (const SiteCellShape shape : { SiteCellShape::Flow, SiteCellShape::Power })
  {
    vtkNew<vtkEqualMassCells> filter;
    filter->SetInputData(input);
    filter->SetDomainData(pair.A);
    filter->SetMeasureToDensity();
    filter->SetResolution(nx);
    filter->SetShape(shape == SiteCellShape::Flow ? vtkEqualMassCells::SHAPE_FLOW
                                                  : vtkEqualMassCells::SHAPE_POWER);
    filter->Update();
    CellOptions<2> options;
    options.Shape = shape;
    const EqualMassDivision<2> found = cells<2>(sites, pair.BoxA, options);
    const Values labels(found.Labels.begin(), found.Labels.end());
    CHECK(checks, imageValues(filter->GetLabels(), "SiteId") == labels);
    vtkPointData* figures = filter->GetSites()->GetPointData();
    CHECK(checks,
      largestDifference(arrayValues(figures->GetArray("CellMass")), found.Masses) < rounding);
    CHECK(checks,
      largestDifference(arrayValues(figures->GetArray("CellCentroid")), flatOf(found.Centroids)) <
        rounding);
    CHECK(checks,
      largestDifference(arrayValues(figures->GetArray("CellCost")), found.Costs) < rounding);
  }
}

} // namespace

int TestCoreCalls(int, char*[])
{
  return runChecks({ checkSamples, checkMaps, checkBlends, checkDistances, checkCells });
}
