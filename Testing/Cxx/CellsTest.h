// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkEqualMassCells share.
#ifndef CellsTest_h
#define CellsTest_h

#include "WarpTest.h"

#include "vtkEqualMassCells.h"

#include <array>

// An image of one cell that has a box; flat axes have one point.
inline vtkSmartPointer<vtkImageData> makeDomain(const std::array<double, 6>& bounds)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  int dimensions[3];
  double spacing[3];
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double length = bounds[2 * a + 1] - bounds[2 * a];
    dimensions[a] = length > 0.0 ? 2 : 1;
    spacing[a] = length > 0.0 ? length : 1.0;
  }
  image->SetDimensions(dimensions);
  image->SetSpacing(spacing);
  image->SetOrigin(bounds[0], bounds[2], bounds[4]);
  return image;
}

// Sites at random in a box.
inline vtkSmartPointer<vtkPolyData> makeSites(const std::array<double, 6>& bounds, int count)
{
  return makePoints(randomCoordinates(bounds.data(), count));
}

inline std::vector<vtkIdType> labelsOf(vtkDataObject* output)
{
  auto* data = vtkDataSet::SafeDownCast(output);
  vtkDataArray* array = data ? data->GetCellData()->GetArray("SiteId") : nullptr;
  std::vector<vtkIdType> labels;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    labels.push_back(static_cast<vtkIdType>(array->GetTuple1(i)));
  }
  return labels;
}

inline std::vector<vtkIdType> runCells(vtkEqualMassCells* cells)
{
  cells->Update();
  return labelsOf(cells->GetLabels());
}

// The area of each site's polygons about axis z, which must have the data of the sites.
inline std::vector<double> areasOfPolygons(Checks& checks, vtkEqualMassCells* cells)
{
  vtkPolyData* polygons = cells->GetPolygons();
  vtkPointSet* sites = cells->GetSites();
  const std::vector<vtkIdType> ids = labelsOf(polygons);
  std::vector<double> areas(static_cast<std::size_t>(sites->GetNumberOfPoints()), 0.0);
  vtkCellData* data = polygons->GetCellData();
  CHECK(checks, polygons->GetNumberOfPolys() == polygons->GetNumberOfCells());
  CHECK(checks, ids.size() == static_cast<std::size_t>(polygons->GetNumberOfCells()));
  CHECK(checks, std::is_sorted(ids.begin(), ids.end()));
  CHECK(checks, data->GetScalars() && data->GetScalars() == data->GetArray("SiteId"));
  CHECK(checks, polygons->GetPoints()->GetDataType() == VTK_DOUBLE);
  for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i)
  {
    const vtkIdType site = ids[static_cast<std::size_t>(i)];
    for (int k = 0; k < sites->GetPointData()->GetNumberOfArrays(); ++k)
    {
      vtkDataArray* array = sites->GetPointData()->GetArray(k);
      vtkDataArray* copy = array ? data->GetArray(array->GetName()) : nullptr;
      CHECK(checks, !array || (copy && copy->GetComponent(i, 0) == array->GetComponent(site, 0)));
    }
    vtkNew<vtkIdList> corners;
    polygons->GetCellPoints(i, corners);
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
    {
      double a[3];
      double b[3];
      polygons->GetPoint(corners->GetId(k), a);
      polygons->GetPoint(corners->GetId((k + 1) % corners->GetNumberOfIds()), b);
      areas.at(static_cast<std::size_t>(site)) += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
  }
  return areas;
}

inline std::vector<int> countLabels(const std::vector<vtkIdType>& labels, vtkIdType sites)
{
  std::vector<int> counts(static_cast<std::size_t>(sites), 0);
  for (const vtkIdType label : labels)
  {
    ++counts.at(static_cast<std::size_t>(label));
  }
  return counts;
}

inline double siteValue(vtkEqualMassCells* cells, const char* name, vtkIdType site, int part = 0)
{
  vtkDataArray* array = cells->GetSites()->GetPointData()->GetArray(name);
  return array ? array->GetComponent(site, part) : std::nan("");
}

// Updates a filter. Returns whether that made labels that were not there after the last call.
class NewLabels
{
public:
  explicit NewLabels(vtkEqualMassCells* cells)
    : Cells(cells)
  {
  }
  bool operator()()
  {
    this->Cells->Update();
    vtkDataArray* array = this->Cells->GetLabels()->GetCellData()->GetArray("SiteId");
    const bool made = array != this->Last;
    this->Last = array;
    return made;
  }

private:
  vtkEqualMassCells* const Cells;
  vtkSmartPointer<vtkDataArray> Last;
};

#endif
