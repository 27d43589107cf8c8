// SPDX-License-Identifier: BSD-3-Clause
#include "CraftedFilters.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCollectiveAlgorithm.h"
#include "vtkDensityAlgorithm.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

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

// Two regions with a mass.
vtkSmartPointer<vtkPolyData> soundMap()
{
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkDoubleArray> masses;
  masses->SetName("v");
  for (int i = 0; i < 2; ++i)
  {
    const vtkIdType first = points->InsertNextPoint(i, 0, 0);
    points->InsertNextPoint(i + 1, 0, 0);
    points->InsertNextPoint(i + 1, 1, 0);
    points->InsertNextPoint(i, 1, 0);
    const vtkIdType ids[4] = { first, first + 1, first + 2, first + 3 };
    polygons->InsertNextCell(4, ids);
    masses->InsertNextValue(1.0 + i);
  }
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->GetCellData()->AddArray(masses);
  return data;
}

std::string takenBy(vtkAlgorithm* filter, int port)
{
  vtkInformation* information = filter->GetInputPortInformation(port);
  const char* type = information->Get(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), 0);
  return type ? type : "vtkDataObject";
}

bool holdsPoints(const std::string& type)
{
  return type == "vtkPointSet" || type == "vtkPolyData";
}

// The array of an input: by name, on points or cells, or the default. Masses are on points.
void chooseArray(RandomSource& random, vtkAlgorithm* filter, int port, bool onCells)
{
  // Of two densities, the second has an array of its own.
  const int index = port > 0 && !holdsPoints(takenBy(filter, 0)) ? 1 : 0;
  const std::int64_t kind = random.Whole(0, onCells ? 3 : 1);
  if (kind > 0)
  {
    filter->SetInputArrayToProcess(index, port, 0,
      kind == 1 ? vtkDataObject::FIELD_ASSOCIATION_POINTS : vtkDataObject::FIELD_ASSOCIATION_CELLS,
      kind == 1 ? "p" : "v");
  }
}

void chooseDensity(RandomSource& random, vtkDensityAlgorithm* filter)
{
  filter->SetDensityResolution(random.Of({ 1, 9, 9, 16 }));
  filter->SetNegativeValues(random.Of({ 0, 0, 1 }));
  filter->SetInvertDensity(random.Chance(0.1) ? 1 : 0);
  filter->SetNaNValues(random.Of({ 0, 0, 1 }));
  filter->SetValidRange(random.Of({ -1e299, -1e299, 0.0, 0.5 }), random.Of({ 1e299, 1e299, 1e9 }));
}

} // namespace

vtkSmartPointer<vtkAlgorithm> newCrafted(
  const CraftedFilter& crafted, RandomSource& random, vtkDataObject* data)
{
  const vtkSmartPointer<vtkAlgorithm> filter = crafted.Kind->New();
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    vtkInformation* information = filter->GetInputPortInformation(port);
    const bool isCrafted = port == crafted.Port;
    if (!isCrafted && !vtkCollectiveAlgorithm::SafeDownCast(filter)->NeedsInput(port))
    {
      continue;
    }
    const bool ofPoints = holdsPoints(takenBy(filter, port));
    // Of two densities both may be crafted.
    const bool alike = !ofPoints && !holdsPoints(crafted.Takes) && random.Chance(0.5);
    vtkSmartPointer<vtkDataObject> input = data;
    if (!isCrafted && takenBy(filter, port) == "vtkPolyData")
    {
      input = soundMap();
    }
    else if (!isCrafted && ofPoints)
    {
      input = soundPoints();
    }
    else if (!isCrafted && !alike)
    {
      input = soundDensity();
    }
    filter->SetInputDataObject(port, input);
    if (information->Has(vtkAlgorithm::INPUT_IS_REPEATABLE()))
    {
      filter->AddInputDataObject(port, input);
    }
  }
  crafted.Kind->MakeQuick(random, filter);
  auto* ofDensity = vtkDensityAlgorithm::SafeDownCast(filter);
  if (ofDensity && !holdsPoints(crafted.Takes))
  {
    chooseDensity(random, ofDensity);
  }
  // Points are read as they are but for those of filters that read no other density.
  if (!ofDensity ? crafted.Port == 0 : !holdsPoints(crafted.Takes))
  {
    chooseArray(random, filter, crafted.Port, crafted.Takes != "vtkPointSet");
  }
  return filter;
}

const std::vector<CraftedFilter>& craftedFilters()
{
  static const std::vector<CraftedFilter> filters = []() {
    std::vector<CraftedFilter> all;
    for (const FilterKind& kind : filterKinds())
    {
      const vtkSmartPointer<vtkAlgorithm> filter = kind.New();
      for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
      {
        all.push_back({ kind.Name + std::string(port > 0 ? " on its second port" : ""), &kind, port,
          takenBy(filter, port) });
      }
    }
    return all;
  }();
  return filters;
}

} // namespace Campaign
