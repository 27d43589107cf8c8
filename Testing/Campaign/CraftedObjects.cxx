// SPDX-License-Identifier: BSD-3-Clause
// Small data objects of every type, without a defect.
#include "Crafted.h"

#include "../AmrBlocks.h"

#include "vtkAMRBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkOverlappingAMR.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRandomHyperTreeGridSource.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredData.h"
#include "vtkStructuredGrid.h"
#include "vtkUniformGrid.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <cmath>

namespace Campaign
{

namespace
{

vtkSmartPointer<vtkDataArray> drawValues(RandomSource& random, vtkIdType tuples, int components)
{
  const int type = random.Of({ VTK_DOUBLE, VTK_DOUBLE, VTK_DOUBLE, VTK_FLOAT, VTK_UNSIGNED_CHAR,
    VTK_CHAR, VTK_SHORT, VTK_INT, VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG, VTK_ID_TYPE, VTK_BIT });
  const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      array->SetComponent(i, c, type == VTK_BIT ? 1.0 : static_cast<double>(1 + i * 7 % 5));
    }
  }
  return array;
}

void drawDimensions(RandomSource& random, int (&dimensions)[3])
{
  const std::int64_t flat = random.Of({ -1, -1, 2, 2, 0, 1 });
  for (int a = 0; a < 3; ++a)
  {
    dimensions[a] = a == flat ? 1 : static_cast<int>(random.Whole(2, 6));
  }
}

vtkSmartPointer<vtkImageData> drawSoundImage(RandomSource& random)
{
  const auto image = vtkSmartPointer<vtkImageData>::New();
  int dimensions[3];
  drawDimensions(random, dimensions);
  const auto first = static_cast<int>(random.Of({ 0, 0, -2, 3 }));
  image->SetExtent(first, first + dimensions[0] - 1, 0, dimensions[1] - 1, 0, dimensions[2] - 1);
  image->SetSpacing(random.Of({ 1.0, 0.5 }), 1.0, random.Of({ 1.0, 2.0 }));
  image->SetOrigin(random.Of({ 0.0, 10.0 }), 0.0, 0.0);
  addValues(random, image);
  return image;
}

vtkSmartPointer<vtkDataSet> drawRectilinear(RandomSource& random)
{
  const auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  int dimensions[3];
  drawDimensions(random, dimensions);
  grid->SetDimensions(dimensions);
  for (int a = 0; a < 3; ++a)
  {
    vtkNew<vtkDoubleArray> places;
    double at = 0.0;
    for (int i = 0; i < dimensions[a]; ++i)
    {
      places->InsertNextValue(at);
      at += random.Real(0.5, 2.0);
    }
    a == 0     ? grid->SetXCoordinates(places)
      : a == 1 ? grid->SetYCoordinates(places)
               : grid->SetZCoordinates(places);
  }
  addValues(random, grid);
  return grid;
}

vtkSmartPointer<vtkPoints> newPoints(RandomSource& random)
{
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(random.Of({ VTK_DOUBLE, VTK_DOUBLE, VTK_FLOAT }));
  return points;
}

vtkSmartPointer<vtkDataSet> drawStructured(RandomSource& random)
{
  const auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  int n[3];
  drawDimensions(random, n);
  grid->SetDimensions(n);
  const auto points = newPoints(random);
  for (int z = 0; z < n[2]; ++z)
  {
    for (int y = 0; y < n[1]; ++y)
    {
      for (int x = 0; x < n[0]; ++x)
      {
        // Of a plane, whichever, all stays in it.
        points->InsertNextPoint(x * 1.5 + (n[1] > 1 && n[0] > 1 ? 0.25 * y : 0.0), y, z);
      }
    }
  }
  grid->SetPoints(points);
  addValues(random, grid);
  return grid;
}

// The corners of a cube of which x is fastest that a cell of a type has.
std::vector<vtkIdType> cornersOf(int type)
{
  switch (type)
  {
    case VTK_VERTEX:
      return { 0 };
    case VTK_LINE:
      return { 0, 1 };
    case VTK_POLY_LINE:
    case VTK_TRIANGLE:
      return { 0, 1, 3 };
    case VTK_PIXEL:
    case VTK_TRIANGLE_STRIP:
      return { 0, 1, 2, 3 };
    case VTK_QUAD:
    case VTK_POLYGON:
      return { 0, 1, 3, 2 };
    case VTK_TETRA:
      return { 0, 1, 2, 4 };
    case VTK_PYRAMID:
      return { 0, 1, 3, 2, 4 };
    case VTK_WEDGE:
      return { 0, 2, 1, 4, 6, 5 };
    case VTK_HEXAHEDRON:
      return { 0, 1, 3, 2, 4, 5, 7, 6 };
    case VTK_VOXEL:
    case VTK_CONVEX_POINT_SET:
      return { 0, 1, 2, 3, 4, 5, 6, 7 };
    case VTK_QUADRATIC_EDGE:
      return { 0, 3, 1 };
    case VTK_QUADRATIC_TRIANGLE:
      return { 0, 1, 2, 3, 4, 5 };
    default:
      return {};
  }
}

void addPolyhedron(vtkUnstructuredGrid* grid, vtkIdType first)
{
  const vtkIdType faces[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
    { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
  vtkNew<vtkIdList> stream;
  stream->InsertNextId(6);
  for (const auto& face : faces)
  {
    stream->InsertNextId(4);
    for (const vtkIdType corner : face)
    {
      stream->InsertNextId(first + corner);
    }
  }
  grid->InsertNextCell(VTK_POLYHEDRON, stream);
}

// Cells side by side, each with points of its own.
vtkSmartPointer<vtkDataSet> drawMesh(RandomSource& random)
{
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const auto points = newPoints(random);
  grid->SetPoints(points);
  grid->Allocate(8);
  const bool flat = random.Chance(0.3);
  const std::int64_t count = random.Whole(1, 6);
  for (std::int64_t i = 0; i < count; ++i)
  {
    const vtkIdType first = points->GetNumberOfPoints();
    for (int k = 0; k < 8; ++k)
    {
      points->InsertNextPoint(
        static_cast<double>(i + (k & 1)), (k >> 1) & 1, flat ? 0.0 : static_cast<double>(k >> 2));
    }
    const int type = flat
      ? random.Of({ VTK_TRIANGLE, VTK_QUAD, VTK_PIXEL, VTK_POLYGON, VTK_TRIANGLE_STRIP })
      : random.Of({ VTK_TETRA, VTK_HEXAHEDRON, VTK_VOXEL, VTK_WEDGE, VTK_PYRAMID, VTK_POLYHEDRON,
          VTK_TETRA, VTK_HEXAHEDRON, VTK_QUAD, VTK_LINE, VTK_VERTEX });
    if (type == VTK_POLYHEDRON)
    {
      addPolyhedron(grid, first);
      continue;
    }
    std::vector<vtkIdType> ids = cornersOf(type);
    for (vtkIdType& id : ids)
    {
      id += first;
    }
    grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
  }
  addValues(random, grid);
  return grid;
}

// A closed box, one that is open at the top, a sheet, outlines, or points alone.
vtkSmartPointer<vtkDataSet> drawPolyData(RandomSource& random)
{
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  const auto points = newPoints(random);
  data->SetPoints(points);
  vtkNew<vtkCellArray> cells;
  const std::int64_t kind = random.Whole(0, 4);
  if (kind <= 1)
  {
    const vtkIdType faces[6][4] = { { 0, 2, 3, 1 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 },
      { 1, 3, 7, 5 }, { 4, 5, 7, 6 } };
    for (int k = 0; k < 8; ++k)
    {
      points->InsertNextPoint(k & 1, (k >> 1) & 1, k >> 2);
    }
    for (int i = 0; i < (kind == 0 ? 6 : 5); ++i)
    {
      const vtkIdType(&f)[4] = faces[i];
      const vtkIdType halves[2][3] = { { f[0], f[1], f[2] }, { f[0], f[2], f[3] } };
      cells->InsertNextCell(3, halves[0]);
      cells->InsertNextCell(3, halves[1]);
    }
    data->SetPolys(cells);
  }
  else if (kind <= 3)
  {
    const std::int64_t count = random.Whole(1, 4);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const vtkIdType first = points->GetNumberOfPoints();
      const auto sides = static_cast<vtkIdType>(random.Whole(3, 7));
      for (vtkIdType k = 0; k < sides; ++k)
      {
        const double turn = static_cast<double>(k) * 6.28 / static_cast<double>(sides);
        points->InsertNextPoint(3.0 * static_cast<double>(i) + std::cos(turn), std::sin(turn), 0.0);
      }
      cells->InsertNextCell(static_cast<int>(sides + (kind == 3 ? 1 : 0)));
      for (vtkIdType k = 0; k < sides; ++k)
      {
        cells->InsertCellPoint(first + k);
      }
      if (kind == 3)
      {
        cells->InsertCellPoint(first);
      }
    }
    kind == 2 ? data->SetPolys(cells) : data->SetLines(cells);
  }
  else
  {
    const std::int64_t count = random.Whole(1, 30);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const vtkIdType id = points->InsertNextPoint(random.Unit(), random.Unit(), random.Unit());
      cells->InsertNextCell(1, &id);
    }
    data->SetVerts(cells);
  }
  addValues(random, data);
  return data;
}

vtkSmartPointer<vtkDataObject> drawAdaptive(RandomSource& random)
{
  const bool flat = random.Chance(0.5);
  std::array<int, 3> points{ 5, 5, flat ? 1 : 5 };
  const int description = vtkStructuredData::GetDataDescription(points.data());
  const auto grids = vtkSmartPointer<vtkOverlappingAMR>::New();
  const double zero[3] = { 0.0, 0.0, 0.0 };
  setBlocksPerLevel(grids.GetPointer(), { 1, 1 });
  grids->SetOrigin(zero);
  grids->SetGridDescription(description);
  for (unsigned int level = 0; level < 2; ++level)
  {
    const double step = level == 0 ? 1.0 : 0.5;
    const double spacing[3] = { step, step, step };
    const double corner = level; // in the middle of the coarse one
    const double origin[3] = { corner, corner, flat ? 0.0 : corner };
    vtkNew<vtkUniformGrid> grid;
    grid->SetOrigin(origin);
    grid->SetSpacing(spacing);
    grid->SetDimensions(points.data());
    addValues(random, grid);
    grids->SetSpacing(level, spacing);
    grids->SetAMRBox(
      level, 0, vtkAMRBox(origin, grid->GetDimensions(), spacing, zero, description));
    grids->SetDataSet(level, 0, grid);
  }
  grids->SetRefinementRatio(0, 2);
  return grids;
}

vtkSmartPointer<vtkDataObject> drawTrees(RandomSource& random)
{
  vtkNew<vtkRandomHyperTreeGridSource> source;
  source->SetDimensions(3, 3, random.Chance(0.5) ? 1 : 3);
  source->SetMaxDepth(3);
  source->SetSeed(static_cast<unsigned int>(random.Whole(0, 1000)));
  source->Update();
  return source->GetOutputDataObject(0);
}

vtkSmartPointer<vtkDataSet> drawDataSet(RandomSource& random)
{
  switch (random.Whole(0, 5))
  {
    case 0:
      return drawSoundImage(random);
    case 1:
      return drawRectilinear(random);
    case 2:
      return drawStructured(random);
    case 3:
      return drawPolyData(random);
    default:
      return drawMesh(random);
  }
}

vtkSmartPointer<vtkDataObject> drawBlocks(RandomSource& random)
{
  const std::int64_t count = random.Whole(1, 3);
  if (random.Chance(0.3))
  {
    const auto parts = vtkSmartPointer<vtkPartitionedDataSet>::New();
    for (std::int64_t i = 0; i < count; ++i)
    {
      parts->SetPartition(static_cast<unsigned int>(i), drawMesh(random));
    }
    return parts;
  }
  const auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::int64_t i = 0; i < count; ++i)
  {
    blocks->SetBlock(static_cast<unsigned int>(i), drawDataSet(random));
  }
  return blocks;
}

} // namespace

void addValues(RandomSource& random, vtkDataSet* data)
{
  const int components = random.Of({ 1, 1, 1, 1, 3 });
  const auto cells = drawValues(random, data->GetNumberOfCells(), components);
  cells->SetName("v");
  data->GetCellData()->SetScalars(cells);
  const auto points = drawValues(random, data->GetNumberOfPoints(), 1);
  points->SetName("p");
  data->GetPointData()->AddArray(points);
}

vtkSmartPointer<vtkDataObject> drawSoundObject(RandomSource& random, std::string& text)
{
  vtkSmartPointer<vtkDataObject> object;
  switch (random.Whole(0, 11))
  {
    case 0:
    case 1:
      object = drawSoundImage(random);
      break;
    case 2:
      object = drawRectilinear(random);
      break;
    case 3:
      object = drawStructured(random);
      break;
    case 4:
    case 5:
    case 6:
      object = drawPolyData(random);
      break;
    case 7:
      object = drawBlocks(random);
      break;
    case 8:
      object = random.Chance(0.5) ? drawAdaptive(random) : drawTrees(random);
      break;
    default:
      object = drawMesh(random);
  }
  text += object->GetClassName();
  return object;
}

} // namespace Campaign
