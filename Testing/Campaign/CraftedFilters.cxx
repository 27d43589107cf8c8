// SPDX-License-Identifier: BSD-3-Clause
#include "CraftedFilters.h"

#include "vtkAreaPreservingParameterization.h"
#include "vtkBlueNoiseRelaxation.h"
#include "vtkDensityEqualizingWarp.h"
#include "vtkDoubleArray.h"
#include "vtkEqualMassCells.h"
#include "vtkImageData.h"
#include "vtkMassSplatter.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSolidDensity.h"
#include "vtkSurfaceSampler.h"
#include "vtkTransportBarycenter.h"
#include "vtkTransportInterpolator.h"
#include "vtkTransportMap.h"
#include "vtkTransportQuality.h"
#include "vtkTransportSampler.h"

namespace Campaign
{

namespace
{

vtkSmartPointer<vtkImageData> soundDensity()
{
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(5, 4, 3);
  image->AllocateScalars(VTK_DOUBLE, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    image->GetPointData()->GetScalars()->SetComponent(i, 0, static_cast<double>(1 + i % 3));
  }
  return image;
}

vtkSmartPointer<vtkPolyData> soundPoints()
{
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 24; ++i)
  {
    points->InsertNextPoint(i % 4 + 0.1 * (i % 5), i % 3 + 0.07 * (i % 7), i % 2 + 0.03 * i);
  }
  data->SetPoints(points);
  return data;
}

// The density on a port: by name, on points or cells, or the default.
template <class Filter>
void chooseDensity(RandomSource& random, Filter* filter, int port, int index = 0)
{
  filter->SetDensityResolution(random.Of({ 1, 9, 9, 16 }));
  filter->SetNegativeValues(random.Of({ 0, 0, 1 }));
  filter->SetInvertDensity(random.Chance(0.1) ? 1 : 0);
  const std::int64_t kind = random.Whole(0, 3);
  if (kind > 0)
  {
    filter->SetInputArrayToProcess(index, port, 0,
      kind == 1 ? vtkDataObject::FIELD_ASSOCIATION_POINTS : vtkDataObject::FIELD_ASSOCIATION_CELLS,
      kind == 1 ? "p" : "v");
  }
}

vtkSmartPointer<vtkAlgorithm> newSampler(RandomSource& random, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkTransportSampler>::New();
  filter->SetNumberOfParticles(30);
  filter->SetInputDataObject(0, crafted);
  chooseDensity(random, filter.Get(), 0);
  return filter;
}

vtkSmartPointer<vtkAlgorithm> newSeeded(RandomSource&, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkTransportSampler>::New();
  filter->SetInputDataObject(0, soundDensity());
  filter->SetInputDataObject(1, crafted);
  return filter;
}

vtkSmartPointer<vtkAlgorithm> newMap(RandomSource& random, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkTransportMap>::New();
  filter->SetInputDataObject(0, crafted);
  filter->SetDirection(static_cast<int>(random.Whole(0, 1)));
  chooseDensity(random, filter.Get(), 0);
  return filter;
}

// Filters of points on port 0 and a density on port 1.
template <class Filter>
vtkSmartPointer<vtkAlgorithm> newOfPoints(RandomSource&, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<Filter>::New();
  filter->SetInputDataObject(0, crafted);
  filter->SetInputDataObject(1, soundDensity());
  if (auto* relaxation = vtkBlueNoiseRelaxation::SafeDownCast(filter))
  {
    relaxation->SetMaximumIterations(2);
  }
  return filter;
}

template <class Filter>
vtkSmartPointer<vtkAlgorithm> newOfDensity(RandomSource& random, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<Filter>::New();
  filter->SetInputDataObject(0, soundPoints());
  filter->SetInputDataObject(1, crafted);
  if (auto* relaxation = vtkBlueNoiseRelaxation::SafeDownCast(filter))
  {
    relaxation->SetMaximumIterations(2);
    relaxation->SetMethod(static_cast<int>(random.Whole(0, 1)));
  }
  chooseDensity(random, filter.Get(), 1);
  return filter;
}

vtkSmartPointer<vtkAlgorithm> newMorph(RandomSource& random, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkTransportInterpolator>::New();
  filter->SetInputDataObject(0, crafted);
  filter->SetInputDataObject(1, random.Chance(0.5) ? crafted : soundDensity().Get());
  filter->SetParticlesPerCell(1);
  filter->SetDimensions(4, 4, 4);
  chooseDensity(random, filter.Get(), 0);
  return filter;
}

vtkSmartPointer<vtkAlgorithm> newBarycenter(RandomSource& random, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkTransportBarycenter>::New();
  filter->AddInputDataObject(0, crafted);
  filter->AddInputDataObject(0, crafted);
  filter->SetParticlesPerCell(1);
  filter->SetDimensions(4, 4, 4);
  chooseDensity(random, filter.Get(), 0);
  return filter;
}

vtkSmartPointer<vtkAlgorithm> newCells(RandomSource& random, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkEqualMassCells>::New();
  filter->SetInputDataObject(0, crafted);
  filter->SetResolution(8);
  filter->SetNumberOfSteps(8);
  filter->SetShape(random.Chance(0.1) ? 1 : 0); // power cells of one far site take seconds
  return filter;
}

vtkSmartPointer<vtkAlgorithm> newCellsOfDomain(RandomSource& random, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkEqualMassCells>::New();
  filter->SetInputDataObject(0, soundPoints());
  filter->SetInputDataObject(1, crafted);
  filter->SetResolution(8);
  filter->SetNumberOfSteps(8);
  filter->SetShape(random.Chance(0.1) ? 1 : 0);
  filter->SetMeasure(static_cast<int>(random.Whole(0, 1)));
  chooseDensity(random, filter.Get(), 1);
  return filter;
}

vtkSmartPointer<vtkAlgorithm> newSplatter(RandomSource& random, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkMassSplatter>::New();
  filter->SetInputDataObject(0, crafted);
  filter->SetDimensions(5, 6, 4);
  filter->SetKernel(static_cast<int>(random.Whole(0, 3)));
  if (random.Chance(0.5))
  {
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "p");
  }
  return filter;
}

vtkSmartPointer<vtkAlgorithm> newSplatterOn(RandomSource&, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkMassSplatter>::New();
  filter->SetInputDataObject(0, soundPoints());
  filter->SetInputDataObject(1, crafted);
  return filter;
}

vtkSmartPointer<vtkAlgorithm> newSolid(RandomSource&, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkSolidDensity>::New();
  filter->SetInputDataObject(0, crafted);
  filter->SetResolution(8);
  return filter;
}

vtkSmartPointer<vtkAlgorithm> newParameterization(RandomSource&, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkAreaPreservingParameterization>::New();
  filter->SetInputDataObject(0, crafted);
  filter->SetResolution(8);
  return filter;
}

vtkSmartPointer<vtkAlgorithm> newSurfaceSampler(RandomSource& random, vtkDataObject* crafted)
{
  const auto filter = vtkSmartPointer<vtkSurfaceSampler>::New();
  filter->SetInputDataObject(0, crafted);
  filter->SetNumberOfParticles(20);
  filter->SetResolution(8);
  if (random.Chance(0.5))
  {
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "v");
  }
  return filter;
}

} // namespace

const std::vector<CraftedFilter>& craftedFilters()
{
  static const std::vector<CraftedFilter> filters = {
    { "Sampler", "vtkDataObject", newSampler },
    { "Sampler of seeds", "vtkPointSet", newSeeded },
    { "Map", "vtkDataObject", newMap },
    { "Warp", "vtkPointSet", newOfPoints<vtkDensityEqualizingWarp> },
    { "Warp of a density", "vtkDataObject", newOfDensity<vtkDensityEqualizingWarp> },
    { "Quality", "vtkPointSet", newOfPoints<vtkTransportQuality> },
    { "Quality of a density", "vtkDataObject", newOfDensity<vtkTransportQuality> },
    { "Relaxation", "vtkPointSet", newOfPoints<vtkBlueNoiseRelaxation> },
    { "Relaxation of a density", "vtkDataObject", newOfDensity<vtkBlueNoiseRelaxation> },
    { "Morph", "vtkDataObject", newMorph },
    { "Barycenter", "vtkDataObject", newBarycenter },
    { "Cells", "vtkPointSet", newCells },
    { "Cells of a domain", "vtkDataObject", newCellsOfDomain },
    { "Splatter", "vtkPointSet", newSplatter },
    { "Splatter on an image", "vtkImageData", newSplatterOn },
    { "Solid", "vtkPolyData", newSolid },
    { "Parameterization", "vtkPolyData", newParameterization },
    { "SurfaceSampler", "vtkPolyData", newSurfaceSampler },
  };
  return filters;
}

} // namespace Campaign
