// SPDX-License-Identifier: BSD-3-Clause
// Defects that files give to data objects, where a reader lets them pass.
#include "Crafted.h"

#include "Input.h"

#include "Bridge/Data/Cells/CellTypes.h"

#include "vtkAMRBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkOverlappingAMR.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>

namespace Campaign
{

namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

double drawBadLength(RandomSource& random)
{
  return random.Of({ 0.0, -1.0, NaN, Infinity, -Infinity, 1e300, 1e-160, 5e-324, 1e160 });
}

std::int64_t drawBadId(RandomSource& random, std::int64_t count)
{
  return random.Of<std::int64_t>({ -1, -2, count, count + 1, 1000000, std::int64_t{ 1 } << 40,
    std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min(), 0 });
}

// Whether this VTK lets an image have an extent.
bool isBearable([[maybe_unused]] const int* extent)
{
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_IMAGES_OF_ANY_EXTENT
  return true;
#else
  bool is = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t points = std::int64_t{ extent[2 * axis + 1] } - extent[2 * axis] + 1;
    is = is && points >= 0 && points <= 1000002;
  }
  return is;
#endif
}

void damageGeometry(RandomSource& random, vtkImageData* image, std::string& text)
{
  switch (random.Whole(0, 4))
  {
    case 0:
    {
      double spacing[3];
      image->GetSpacing(spacing);
      spacing[random.Whole(0, 2)] = drawBadLength(random);
      image->SetSpacing(spacing);
      text +=
        ", spacing " + textOf(spacing[0]) + " " + textOf(spacing[1]) + " " + textOf(spacing[2]);
      return;
    }
    case 1:
    {
      double origin[3] = { 0.0, 0.0, 0.0 };
      origin[random.Whole(0, 2)] = random.Of({ NaN, Infinity, 1e300, -1e16 });
      image->SetOrigin(origin);
      text += ", origin " + textOf(origin[0]) + " " + textOf(origin[1]) + " " + textOf(origin[2]);
      return;
    }
    case 2:
    {
      double matrix[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
      const std::int64_t place = random.Whole(0, 8);
      matrix[place] = random.Of({ 0.0, -1.0, NaN, Infinity, 1.0, 1e300, 1e-200 });
      image->SetDirectionMatrix(matrix);
      text += ", direction " + std::to_string(place) + " is " + textOf(matrix[place]);
      return;
    }
    default:
    {
      int extent[6];
      image->GetExtent(extent);
      const std::int64_t end = random.Whole(0, 5);
      extent[end] = random.Of({ -1, 0, 1, 7, 1000, 1000000, std::numeric_limits<int>::max(),
        std::numeric_limits<int>::min(), -2000000000 });
      if (!isBearable(extent))
      {
        return;
      }
      image->SetExtent(extent);
      text += ", end " + std::to_string(end) + " of the extent is " + std::to_string(extent[end]);
    }
  }
}

void damageCoordinates(RandomSource& random, vtkRectilinearGrid* grid, std::string& text)
{
  vtkDataArray* places = random.Of({ grid->GetXCoordinates(), grid->GetYCoordinates() });
  if (!places || places->GetNumberOfTuples() == 0)
  {
    return;
  }
  switch (random.Whole(0, 3))
  {
    case 0:
      grid->SetXCoordinates(nullptr);
      text += ", no coordinates";
      return;
    case 1:
    {
      const vtkIdType count = random.Of<vtkIdType>({ 0, 1, 2, 50 });
      vtkNew<vtkDoubleArray> other;
      for (vtkIdType i = 0; i < count; ++i)
      {
        other->InsertNextValue(static_cast<double>(i));
      }
      grid->SetYCoordinates(other);
      text += ", " + std::to_string(count) + " coordinates";
      return;
    }
    default:
      places->SetComponent(
        random.Whole(0, places->GetNumberOfTuples() - 1), 0, drawBadLength(random));
      places->Modified();
      text += ", a coordinate is wrong";
  }
}

void damagePoints(RandomSource& random, vtkPointSet* set, std::string& text)
{
  const vtkIdType count = set->GetNumberOfPoints();
  if (random.Chance(0.15) || count == 0)
  {
    // Fewer points than the cells have.
    vtkNew<vtkPoints> fewer;
    const vtkIdType kept = random.Chance(0.5) ? 0 : count / 2;
    fewer->SetNumberOfPoints(kept);
    for (vtkIdType i = 0; i < kept; ++i)
    {
      fewer->SetPoint(i, set->GetPoint(i));
    }
    set->SetPoints(random.Chance(0.2) ? nullptr : fewer.Get());
    text += ", " + std::to_string(kept) + " points";
    return;
  }
  double x[3];
  const vtkIdType point = random.Whole(0, count - 1);
  set->GetPoint(point, x);
  x[random.Whole(0, 2)] = random.Of({ NaN, Infinity, -Infinity, 1e300, -1e154, 1e20, 5e-324, 1e9 });
  set->GetPoints()->SetPoint(point, x);
  set->GetPoints()->Modified();
  text += ", point " + std::to_string(point) + " at " + textOf(x[0]) + " " + textOf(x[1]) + " " +
    textOf(x[2]);
}

void damageCells(RandomSource& random, vtkCellArray* cells, vtkIdType points, std::string& text)
{
  if (!cells || cells->GetNumberOfCells() == 0)
  {
    return;
  }
  const bool ofOffsets = random.Chance(0.35);
  vtkDataArray* array = ofOffsets ? cells->GetOffsetsArray() : cells->GetConnectivityArray();
  if (array->GetNumberOfTuples() == 0)
  {
    return;
  }
  const vtkIdType place = random.Whole(0, array->GetNumberOfTuples() - 1);
  const std::int64_t id = drawBadId(random, ofOffsets ? array->GetNumberOfTuples() : points);
  if (auto* ids = vtkTypeInt64Array::SafeDownCast(array))
  {
    ids->SetValue(place, id);
  }
  else
  {
    array->SetComponent(place, 0, static_cast<double>(static_cast<int>(id)));
  }
  array->Modified();
  cells->Modified();
  text += std::string(ofOffsets ? ", offset " : ", corner ") + std::to_string(place) + " is " +
    std::to_string(id);
}

void damageTypes(RandomSource& random, vtkUnstructuredGrid* grid, std::string& text)
{
  auto* types = vtkUnsignedCharArray::SafeDownCast(RectifiedTransport::Bridge::cellTypesOf(grid));
  if (!types || types->GetNumberOfValues() == 0)
  {
    return;
  }
  const auto type = static_cast<unsigned char>(random.Of({ 0, 2, 4, 5, 6, 7, 10, 12, 13, 14, 16, 20,
    21, 22, 24, 25, 35, 36, 41, 42, 51, 68, 70, 73, 79, 100, 200, 255 }));
  const vtkIdType cell = random.Whole(0, types->GetNumberOfValues() - 1);
  types->SetValue(cell, type);
  types->Modified();
  text += ", type " + std::to_string(type) + " of cell " + std::to_string(cell);
}

void damageArray(RandomSource& random, vtkDataSetAttributes* attributes, vtkIdType tuples,
  const char* name, std::string& text)
{
  const std::int64_t kind = random.Whole(0, 6);
  text += ", array " + std::string(name) + " of kind " + std::to_string(kind);
  vtkDataArray* array = attributes->GetArray(name);
  switch (kind)
  {
    case 0:
    case 1:
    {
      if (array && array->GetNumberOfTuples() > 0)
      {
        array->SetComponent(
          random.Whole(0, array->GetNumberOfTuples() - 1), 0, drawExceptional(random));
        array->Modified();
      }
      return;
    }
    case 2:
      if (array)
      {
        array->SetNumberOfTuples(
          random.Of<vtkIdType>({ 0, 1, tuples / 2, tuples + 1, 2 * tuples }));
        array->Fill(1.0);
      }
      return;
    case 3:
      if (array)
      {
        array->SetName(random.Of<const char*>({ nullptr, "", " ", "vtkGhostType", "Density" }));
      }
      return;
    case 4:
    {
      vtkNew<vtkStringArray> words;
      words->SetName(name);
      words->SetNumberOfValues(tuples);
      attributes->AddArray(words);
      return;
    }
    case 5:
    {
      vtkNew<vtkFloatArray> many;
      many->SetName(name);
      many->SetNumberOfComponents(random.Of({ 2, 4, 5, 9, 1000 }));
      many->SetNumberOfTuples(tuples);
      many->Fill(1.0);
      attributes->AddArray(many);
      return;
    }
    default:
      attributes->RemoveArray(name);
  }
}

// Ghosts of another type, length or number of components. VTK itself takes an array of this name
// for unsigned chars: its own data sets read no others.
void damageGhosts(
  RandomSource& random, vtkDataSetAttributes* attributes, vtkIdType tuples, std::string& text)
{
  text += ", ghosts";
  vtkSmartPointer<vtkDataArray> ghosts;
  if (random.Chance(0.5))
  {
    ghosts = vtkSmartPointer<vtkUnsignedCharArray>::New();
  }
  else if (random.Chance(0.5))
  {
    ghosts = vtkSmartPointer<vtkFloatArray>::New();
  }
  else
  {
    ghosts = vtkSmartPointer<vtkIntArray>::New();
  }
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfComponents(random.Of({ 1, 1, 1, 2 }));
  ghosts->SetNumberOfTuples(random.Of<vtkIdType>({ tuples, tuples, tuples, 0, tuples / 2 }));
  ghosts->Fill(0.0);
  for (vtkIdType i = 0; i < ghosts->GetNumberOfTuples(); ++i)
  {
    ghosts->SetComponent(i, 0, random.Of({ 0.0, 0.0, 1.0, 2.0, 8.0, 32.0, 255.0 }));
  }
  attributes->AddArray(ghosts);
}

// Another defect may have made many of them.
vtkIdType countOf(vtkDataSet* data, bool ofCells)
{
  return std::clamp<vtkIdType>(
    ofCells ? data->GetNumberOfCells() : data->GetNumberOfPoints(), 0, 1000);
}

void damageDataSet(RandomSource& random, vtkDataSet* data, std::string& text)
{
  const std::int64_t kind = random.Whole(0, 9);
  if (kind <= 2)
  {
    const bool cells = random.Chance(0.6);
    damageArray(random, data->GetAttributes(cells ? vtkDataObject::CELL : vtkDataObject::POINT),
      countOf(data, cells), cells ? "v" : "p", text);
    return;
  }
  if (kind == 3)
  {
    // VTK's structured grids read ghosts of points whatever their length is.
    const bool cells = random.Chance(0.6) || data->IsA("vtkStructuredGrid");
    damageGhosts(random, data->GetAttributes(cells ? vtkDataObject::CELL : vtkDataObject::POINT),
      countOf(data, cells), text);
    return;
  }
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    damageGeometry(random, image, text);
    return;
  }
  if (auto* grid = vtkRectilinearGrid::SafeDownCast(data))
  {
    damageCoordinates(random, grid, text);
    return;
  }
  auto* set = vtkPointSet::SafeDownCast(data);
  auto* surface = vtkPolyData::SafeDownCast(data);
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(data);
  if (kind <= 5 || (!surface && !mesh))
  {
    if (set)
    {
      damagePoints(random, set, text);
    }
    return;
  }
  if (surface)
  {
    damageCells(random,
      random.Of({ surface->GetPolys(), surface->GetPolys(), surface->GetLines() }),
      surface->GetNumberOfPoints(), text);
    return;
  }
  if (kind <= 7)
  {
    damageTypes(random, mesh, text);
    return;
  }
  damageCells(random, mesh->GetCells(), mesh->GetNumberOfPoints(), text);
}

void damageBlocks(RandomSource& random, vtkMultiBlockDataSet* blocks, std::string& text)
{
  const unsigned int count = blocks->GetNumberOfBlocks();
  switch (random.Whole(0, 3))
  {
    case 0:
      blocks->SetBlock(count, nullptr);
      text += ", a block that is missing";
      break;
    case 1:
      blocks->SetBlock(count, vtkSmartPointer<vtkPolyData>::New());
      text += ", an empty block";
      break;
    case 2:
      blocks->SetBlock(0, vtkSmartPointer<vtkTable>::New());
      text += ", a table";
      break;
    default:
      blocks->SetBlock(count, vtkSmartPointer<vtkMultiBlockDataSet>::New());
      text += ", blocks without blocks";
  }
}

void damageAdaptive(RandomSource& random, vtkOverlappingAMR* grids, std::string& text)
{
  switch (random.Whole(0, 2))
  {
    case 0:
    {
      const double step = drawBadLength(random);
      const double spacing[3] = { step, 0.5, 0.5 };
      grids->SetSpacing(1, spacing);
      text += ", spacing of a level " + textOf(step);
      break;
    }
    case 1:
    {
      // VTK asserts that a box does not end before it begins.
      const int low[3] = { random.Of({ 0, -5, 3, 1000000 }), 0, 0 };
      const int high[3] = { low[0] + random.Of({ -1, 0, 3, 7, 1000000 }), 3,
        random.Of({ 0, 3, -1 }) };
      grids->SetAMRBox(random.Chance(0.5) ? 1 : 0, 0, vtkAMRBox(low, high));
      text += ", a box from " + std::to_string(low[0]) + " to " + std::to_string(high[0]);
      break;
    }
    default:
      grids->SetDataSet(random.Chance(0.5) ? 1 : 0, 0, nullptr);
      text += ", a grid that is missing";
  }
}

} // namespace

void damage(RandomSource& random, vtkDataObject* object, std::string& text)
{
  if (auto* data = vtkDataSet::SafeDownCast(object))
  {
    damageDataSet(random, data, text);
    return;
  }
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(object);
  if (blocks && random.Chance(0.4))
  {
    damageBlocks(random, blocks, text);
    return;
  }
  auto* grids = vtkOverlappingAMR::SafeDownCast(object);
  if (grids && random.Chance(0.6))
  {
    damageAdaptive(random, grids, text);
    return;
  }
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(object))
  {
    const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      auto* leaf = vtkDataSet::SafeDownCast(leaves->GetCurrentDataObject());
      if (leaf && random.Chance(0.6))
      {
        damageDataSet(random, leaf, text);
        return;
      }
    }
  }
}

} // namespace Campaign
