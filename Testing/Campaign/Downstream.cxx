// SPDX-License-Identifier: BSD-3-Clause
#include "Downstream.h"

#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkContourFilter.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkElevationFilter.h"
#include "vtkImageData.h"
#include "vtkImageExtractComponents.h"
#include "vtkImageShrink3D.h"
#include "vtkMassSplatter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTransportMap.h"
#include "vtkTransportSampler.h"

namespace Campaign
{

namespace
{

bool areComplete(vtkDataSetAttributes* attributes, vtkIdType tuples)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    if (attributes->GetAbstractArray(i)->GetNumberOfTuples() != tuples)
    {
      return false;
    }
  }
  return true;
}

// A filter with other properties than the default ones.
template <class Filter, class Set>
vtkSmartPointer<vtkAlgorithm> makeSet(const Set& set)
{
  const auto filter = vtkSmartPointer<Filter>::New();
  set(filter.Get());
  return filter;
}

vtkSmartPointer<vtkAlgorithm> drawDownstreamImage(RandomSource& random, vtkImageData* image)
{
  // VTK's image filters do not look whether there are scalars, or points enough to shrink.
  const bool hasScalars = vtkDoubleArray::SafeDownCast(image->GetPointData()->GetScalars()) &&
    image->GetDimensions()[0] > 2;
  std::int64_t kind = random.Whole(hasScalars ? 0 : 2, 4);
  // Of tuples the contour filter interpolates the first component alone, and reads past the end of
  // other arrays.
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (kind == 2 && scalars && scalars->GetNumberOfComponents() > 1)
  {
    kind = 3;
  }
  switch (kind)
  {
    case 0:
      return makeSet<vtkImageShrink3D>([](auto* shrink) { shrink->SetShrinkFactors(2, 1, 1); });
    case 1:
      return vtkSmartPointer<vtkImageExtractComponents>::New();
    case 2:
      return makeSet<vtkContourFilter>([](auto* contour) { contour->SetValue(0, 0.5); });
    case 3:
      return makeSet<vtkTransportSampler>(
        [](auto* sampler) { sampler->SetNumberOfParticles(200); });
    default:
      return vtkSmartPointer<vtkTransportMap>::New();
  }
}

vtkSmartPointer<vtkAlgorithm> drawDownstreamPoints(RandomSource& random)
{
  switch (random.Whole(0, 2))
  {
    case 0:
      return makeSet<vtkMassSplatter>([](auto* splatter) { splatter->SetDimensions(9, 8, 7); });
    case 1:
      return vtkSmartPointer<vtkCleanPolyData>::New();
    default:
      return vtkSmartPointer<vtkElevationFilter>::New();
  }
}

} // namespace

vtkSmartPointer<vtkAlgorithm> drawDownstream(RandomSource& random, vtkAlgorithm* filter)
{
  vtkDataObject* output = filter->GetOutputDataObject(0);
  auto* set = vtkDataSet::SafeDownCast(output);
  if (set &&
    !(areComplete(set->GetPointData(), set->GetNumberOfPoints()) &&
      areComplete(set->GetCellData(), set->GetNumberOfCells())))
  {
    return nullptr; // VTK's own read past the end of an array that an input had too short
  }
  vtkSmartPointer<vtkAlgorithm> downstream;
  if (auto* image = vtkImageData::SafeDownCast(output))
  {
    downstream = drawDownstreamImage(random, image);
  }
  else if (vtkPolyData::SafeDownCast(output))
  {
    downstream = drawDownstreamPoints(random);
  }
  if (downstream)
  {
    downstream->SetInputConnection(0, filter->GetOutputPort(0));
  }
  return downstream;
}

} // namespace Campaign
