// SPDX-License-Identifier: BSD-3-Clause
// What vtkEqualMassCells gives: labels of all pixels in equal numbers, figures that follow from
// them, closed outlines, and the data of the sites.
#include "CellsTest.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkUnstructuredGrid.h"

#include <limits>
#include <map>

namespace
{

constexpr std::array<double, 6> box = { 1.0, 4.0, -1.0, 1.0, 0.5, 0.5 };

double norm(const double* d, double p)
{
  if (std::isinf(p))
  {
    return std::max({ std::abs(d[0]), std::abs(d[1]), std::abs(d[2]) });
  }
  double sum = 0.0;
  for (int r = 0; r < 3; ++r)
  {
    sum += std::pow(std::abs(d[r]), p);
  }
  return std::pow(sum, 1.0 / p);
}

// The figures again, from the labels, the pixels' centres and the sites alone.
void checkFigures(Checks& checks, vtkEqualMassCells* cells, double p, double q)
{
  cells->SetNormExponent(p);
  cells->SetCostExponent(q);
  const std::vector<vtkIdType> labels = runCells(cells);
  vtkImageData* image = cells->GetLabels();
  vtkPointSet* sites = cells->GetSites();
  const auto count = static_cast<std::size_t>(sites->GetNumberOfPoints());
  std::vector<double> mass(count);
  std::vector<double> cost(count);
  std::vector<double> centroid(3 * count);
  double spacing[3];
  image->GetSpacing(spacing);
  double all = 0.0;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    const auto label = static_cast<std::size_t>(labels[i]);
    double bounds[6];
    image->GetCellBounds(static_cast<vtkIdType>(i), bounds);
    double site[3];
    sites->GetPoint(labels[i], site);
    double d[3];
    for (std::size_t r = 0; r < 3; ++r)
    {
      const double centre = 0.5 * (bounds[2 * r] + bounds[2 * r + 1]);
      d[r] = centre - site[r];
      centroid[3 * label + r] += centre;
    }
    mass[label] += 1.0;
    const double part = std::pow(norm(d, p), q) / static_cast<double>(labels.size());
    cost[label] += part;
    all += part;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto site = static_cast<vtkIdType>(i);
    CHECK_NEAR(
      checks, siteValue(cells, "CellMass", site), mass[i] * spacing[0] * spacing[1], 1e-12);
    CHECK_NEAR(checks, siteValue(cells, "CellCost", site), cost[i], 1e-11 * all);
    for (int r = 0; r < 3; ++r)
    {
      CHECK_NEAR(
        checks, siteValue(cells, "CellCentroid", site, r), centroid[3 * i + r] / mass[i], 1e-11);
    }
  }
  for (vtkDataObject* output :
    { static_cast<vtkDataObject*>(image), static_cast<vtkDataObject*>(sites) })
  {
    vtkDataArray* total = output->GetFieldData()->GetArray("TransportCost");
    CHECK(checks, total && total->GetNumberOfTuples() == 1);
    CHECK_NEAR(checks, total ? total->GetComponent(0, 0) : 0.0, all, 1e-11 * all);
  }
}

void checkLabels(Checks& checks, vtkEqualMassCells* cells)
{
  const std::vector<vtkIdType> labels = runCells(cells);
  vtkImageData* image = cells->GetLabels();
  int dimensions[3];
  image->GetDimensions(dimensions);
  CHECK(checks, dimensions[0] == 97 && dimensions[1] == 65 && dimensions[2] == 1);
  const double* bounds = image->GetBounds();
  for (std::size_t i = 0; i < 6; ++i)
  {
    CHECK_NEAR(checks, bounds[i], box[i], 1e-12);
  }
  CHECK(checks, labels.size() == 96u * 64);
  CHECK(checks, image->GetCellData()->GetScalars() == image->GetCellData()->GetArray("SiteId"));
  const std::vector<int> counts = countLabels(labels, 30); // 204.8 pixels a site
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  CHECK(checks, *least == 204 && *most == 205);
}

// Every pixel's sides that lie between cells or on the border, as pairs of a label and a length
// along each axis, counted from the labels alone.
void checkOutlines(Checks& checks, vtkEqualMassCells* cells)
{
  const std::vector<vtkIdType> labels = runCells(cells);
  std::map<vtkIdType, int> expected;
  const auto at = [&](int x, int y) -> vtkIdType {
    return x < 0 || y < 0 || x > 95 || y > 63 ? -1 : labels[static_cast<std::size_t>(96 * y + x)];
  };
  for (int y = 0; y < 64; ++y)
  {
    for (int x = 0; x < 96; ++x)
    {
      for (const vtkIdType other : { at(x - 1, y), at(x + 1, y), at(x, y - 1), at(x, y + 1) })
      {
        expected[at(x, y)] += other != at(x, y) ? 1 : 0;
      }
    }
  }
  vtkPolyData* outlines = cells->GetOutlines();
  vtkDataArray* ids = outlines->GetCellData()->GetScalars();
  CHECK(checks, ids && ids->GetName() == std::string("SiteId"));
  if (!ids)
  {
    return;
  }
  CHECK(checks, outlines->GetNumberOfLines() == outlines->GetNumberOfCells());
  CHECK(checks, outlines->GetPoints()->GetDataType() == VTK_DOUBLE);
  std::map<vtkIdType, int> found;
  std::map<std::pair<vtkIdType, vtkIdType>, int> ends; // of a cell's lines at a point
  double area = 0.0;
  std::map<vtkIdType, double> areas;
  for (vtkIdType i = 0; i < outlines->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> line;
    outlines->GetCellPoints(i, line);
    CHECK(checks, line->GetNumberOfIds() == 2);
    const auto label = static_cast<vtkIdType>(ids->GetTuple1(i));
    ++found[label];
    ++ends[{ label, line->GetId(0) }];
    --ends[{ label, line->GetId(1) }];
    double a[3];
    double b[3];
    outlines->GetPoint(line->GetId(0), a);
    outlines->GetPoint(line->GetId(1), b);
    areas[label] += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  CHECK(checks, found == expected);
  // Closed loops against the clock, around what the cell weighs.
  CHECK(
    checks, std::all_of(ends.begin(), ends.end(), [](const auto& end) { return end.second == 0; }));
  for (const auto& [label, inside] : areas)
  {
    CHECK_NEAR(checks, inside, siteValue(cells, "CellMass", label), 1e-12);
    area += inside;
  }
  CHECK_NEAR(checks, area, 6.0, 1e-12);
}

void checkPolygons(Checks& checks, vtkEqualMassCells* cells)
{
  cells->Update();
  const std::vector<double> areas = areasOfPolygons(checks, cells);
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    CHECK_NEAR(checks, areas[i], siteValue(cells, "CellMass", static_cast<vtkIdType>(i)), 1e-12);
  }
  // In corners alone do their points differ from those of the lines.
  vtkPolyData* polygons = cells->GetPolygons();
  CHECK(checks, polygons->GetNumberOfPoints() < cells->GetOutlines()->GetNumberOfPoints());
  vtkDataArray* colors = polygons->GetCellData()->GetArray("SiteColor");
  vtkDataArray* pixels = cells->GetLabels()->GetCellData()->GetArray("SiteColor");
  const std::vector<vtkIdType> labels = labelsOf(cells->GetLabels());
  const std::vector<vtkIdType> ids = labelsOf(polygons);
  CHECK(checks, colors && colors->GetDataType() == VTK_UNSIGNED_CHAR);
  for (std::size_t i = 0; colors && i < ids.size(); ++i)
  {
    const auto pixel = std::find(labels.begin(), labels.end(), ids[i]) - labels.begin();
    CHECK(checks, colors->GetTuple1(static_cast<vtkIdType>(i)) == pixels->GetTuple1(pixel));
  }
}

// There are none in space.
void checkNoPolygons(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  cells->SetInputData(makeSites({ 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 }, 7));
  cells->SetResolution(9);
  cells->Update();
  CHECK(checks, cells->GetOutlines()->GetNumberOfPolys() > 0);
  CHECK(checks, cells->GetPolygons() && cells->GetPolygons()->GetNumberOfCells() == 0);
}

void checkData(Checks& checks)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points; // single precision
  vtkNew<vtkFloatArray> heat;
  heat->SetName("Heat");
  for (int i = 0; i < 4; ++i)
  {
    points->InsertNextPoint(0.3 * i, 0.1 * i * i, 0.0);
    heat->InsertNextValue(static_cast<float>(i));
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(heat);
  const vtkIdType ends[2] = { 2, 0 };
  grid->InsertNextCell(VTK_LINE, 2, ends);
  vtkNew<vtkIdTypeArray> note;
  note->SetName("Note");
  note->InsertNextValue(5);
  grid->GetCellData()->AddArray(note);
  grid->GetFieldData()->AddArray(note);

  vtkNew<vtkEqualMassCells> cells;
  cells->SetInputData(grid);
  cells->SetResolution(20);
  cells->Update();
  vtkPointSet* sites = cells->GetSites();
  CHECK(checks, sites->IsA("vtkUnstructuredGrid") && sites->GetNumberOfCells() == 1);
  CHECK(checks, sites->GetCell(0)->GetPointId(0) == 2);
  CHECK(checks, sites->GetPoints()->GetDataType() == VTK_DOUBLE);
  CHECK(checks, grid->GetPoints()->GetDataType() == VTK_FLOAT);
  for (vtkIdType i = 0; i < 4; ++i)
  {
    double x[3];
    sites->GetPoint(i, x);
    CHECK(checks, x[0] == grid->GetPoint(i)[0] && x[1] == grid->GetPoint(i)[1]);
  }
  CHECK(checks, sites->GetPointData()->GetScalars() == heat);
  CHECK(checks, sites->GetCellData()->GetArray("Note") == note);
  for (int port = 0; port < 4; ++port)
  {
    CHECK(checks, cells->GetOutputDataObject(port)->GetFieldData()->GetArray("Note") != nullptr);
  }
  CHECK(checks, grid->GetPointData()->GetArray("CellMass") == nullptr);
  CHECK(checks, cells->GetPolygons()->GetCellData()->GetArray("Heat") != nullptr);
  areasOfPolygons(checks, cells);
  // What has no value for a site cannot be a polygon's.
  Messages messages(cells);
  heat->SetNumberOfTuples(3);
  auto corners = makePoints({ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 });
  corners->GetPointData()->AddArray(heat);
  cells->SetInputData(corners);
  cells->Update();
  CHECK(checks, messages.Errors.size() == 1);
  CHECK(checks, cells->GetPolygons()->GetNumberOfCells() == 0);
  // Another type of sites makes another type of output.
  cells->SetInputData(makeSites(box, 5));
  cells->Update();
  CHECK(checks, cells->GetSites()->IsA("vtkPolyData"));
}

// More accurate labels than pixels allow are not there: two sites halve a square.
void checkHalves(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  cells->SetDomainData(makeDomain({ 0.0, 1.0, 0.0, 1.0, 0.0, 0.0 }));
  cells->SetInputData(makePoints({ 0.7, 0.51, 0, 0.3, 0.51, 0 }));
  cells->SetResolution(64);
  const std::vector<vtkIdType> labels = runCells(cells);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    checks.That(labels[i] == (i % 64 < 32 ? 1 : 0), "the left half", __LINE__, std::to_string(i));
  }
}

} // namespace

int TestCellsOutput(int, char*[])
{
  Checks checks;
  vtkNew<vtkEqualMassCells> cells;
  Messages messages(cells);
  cells->SetInputData(makeSites(box, 30));
  cells->SetDomainData(makeDomain(box));
  cells->SetResolution(96);
  checkLabels(checks, cells);
  checkOutlines(checks, cells);
  checkPolygons(checks, cells);
  checkNoPolygons(checks);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const double exponents[][2] = { { 2, 2 }, { 2, 4 }, { 4, 4 }, { 4, 1.6 }, { 1, 1 }, { 2, 0.5 },
    { infinite, 2 } };
  for (const auto& [p, q] : exponents)
  {
    checkFigures(checks, cells, p, q);
  }
  checkData(checks);
  checkHalves(checks);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
  return checks.Result();
}
