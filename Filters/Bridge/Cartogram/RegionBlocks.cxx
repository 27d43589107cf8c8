// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cartogram/RegionBlocks.h"

#include "Bridge/Data/Cells/CellCheck.h"
#include "Bridge/Data/TupleCopy.h"
#include "Bridge/Data/TupleValues.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/Stages.h"

#include "vtkAbstractArray.h"
#include "vtkAppendPolyData.h"
#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <numeric>
#include <set>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

// The forms that an array of one component has in the blocks that have cells.
struct ArrayForms
{
  std::set<int> Types;
  std::size_t Blocks = 0;
};

// A type that holds all values of arrays of some types.
int commonType(const std::set<int>& types)
{
  const auto has = [&](std::initializer_list<int> some) {
    return std::any_of(some.begin(), some.end(), [&](int type) { return types.count(type) > 0; });
  };
  const bool hasReal = has({ VTK_FLOAT, VTK_DOUBLE });
  const bool hasUnsigned = has({ VTK_UNSIGNED_LONG, VTK_UNSIGNED_LONG_LONG });
  const bool hasLong = hasUnsigned || has({ VTK_LONG, VTK_LONG_LONG, VTK_ID_TYPE });
  const bool isText = has({ VTK_STRING, VTK_VARIANT }) || hasUnsigned || (hasReal && hasLong);
  return isText ? VTK_STRING : hasReal ? VTK_DOUBLE : VTK_LONG_LONG;
}

vtkSmartPointer<vtkAbstractArray> converted(vtkAbstractArray* array, int type)
{
  auto made = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(type));
  made->SetName(array->GetName());
  if (auto* texts = vtkStringArray::SafeDownCast(made))
  {
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      texts->InsertNextValue(tupleText(array, i));
    }
  }
  else
  {
    made->DeepCopy(array);
  }
  return made;
}

// A reader may give whole numbers for one file and real numbers or text for another. Arrays of one
// component that all parts with cells have get one type, which holds their values exactly: text
// where no type of numbers does. vtkAppendPolyData would leave them out.
void unifyTypes(const std::vector<vtkSmartPointer<vtkPolyData>>& parts)
{
  std::map<std::string, ArrayForms> arrays;
  std::size_t withCells = 0;
  const auto visit = [&](const auto& use) {
    for (const auto& part : parts)
    {
      vtkCellData* cells = part->GetCellData();
      for (int i = 0; part->GetNumberOfCells() > 0 && i < cells->GetNumberOfArrays(); ++i)
      {
        vtkAbstractArray* array = cells->GetAbstractArray(i);
        if (array->GetName() && array->GetNumberOfComponents() == 1)
        {
          use(cells, array, arrays[array->GetName()]);
        }
      }
    }
  };
  for (const auto& part : parts)
  {
    withCells += part->GetNumberOfCells() > 0 ? 1 : 0;
  }
  visit([](vtkCellData*, vtkAbstractArray* array, ArrayForms& forms) {
    forms.Types.insert(array->GetDataType());
    ++forms.Blocks;
  });
  visit([&](vtkCellData* cells, vtkAbstractArray* array, const ArrayForms& forms) {
    const int type = commonType(forms.Types);
    if (forms.Types.size() > 1 && forms.Blocks == withCells && array->GetDataType() != type)
    {
      cells->AddArray(converted(array, type));
    }
  });
}

// Cell arrays, while blocks become one.
// vtkAppendPolyData orders cells by kind and block. Numbers that travel as cell data tell where
// each cell comes from; afterwards the arrays are removed.
constexpr const char* blockNumbers = "vtkCartogramBlock";
constexpr const char* cellNumbers = "vtkCartogramCell";

// Where vtkCells of a type stand in a vtkPolyData: 0 vertices, 1 lines, 2 polygons; -1 nowhere.
// Other types, such as volumes and Lagrange cells, have no place there. An empty cell counts as a
// vertex: both are no region.
int kindOf(int type)
{
  switch (type)
  {
    case VTK_EMPTY_CELL:
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
      return 0;
    case VTK_LINE:
    case VTK_POLY_LINE:
      return 1;
    case VTK_TRIANGLE:
    case VTK_PIXEL:
    case VTK_QUAD:
    case VTK_POLYGON:
    case VTK_TRIANGLE_STRIP:
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_BIQUADRATIC_TRIANGLE:
    case VTK_QUADRATIC_QUAD:
    case VTK_BIQUADRATIC_QUAD:
    case VTK_QUADRATIC_POLYGON:
      return 2;
    default:
      return -1;
  }
}

// From the points of a triangle strip, or of another two-dimensional vtkCell, to its outline.
// Quadratic ones have the points on their edges, in order, behind the corners.
void makeOutline(int type, vtkIdList* ids)
{
  const vtkIdType count = ids->GetNumberOfIds();
  std::vector<vtkIdType> outline;
  const auto add = [&](vtkIdType i) { outline.push_back(ids->GetId(i)); };
  if (type == VTK_TRIANGLE_STRIP || type == VTK_PIXEL) // two lines of points that take turns
  {
    // The outline runs up one line of points, those of odd numbers, and down the other one.
    for (vtkIdType i = 1; i < count; i += 2)
    {
      add(i);
    }
    for (vtkIdType i = (count - 1) / 2 * 2; i >= 0; i -= 2)
    {
      add(i);
    }
  }
  else
  {
    // A corner and the node of the edge behind it take turns. Nodes within the face are left out,
    // and edges become two straight segments.
    const bool isTriangle = type == VTK_QUADRATIC_TRIANGLE || type == VTK_BIQUADRATIC_TRIANGLE;
    const vtkIdType corners = isTriangle ? 3 : type == VTK_QUADRATIC_POLYGON ? count / 2 : 4;
    for (vtkIdType i = 0; i < corners; ++i)
    {
      add(i);
      add(corners + i);
    }
  }
  ids->SetNumberOfIds(static_cast<vtkIdType>(outline.size()));
  std::copy(outline.begin(), outline.end(), ids->GetPointer(0));
}

// Whether the points of a two-dimensional cell are its outline as they are.
bool isOutline(int type)
{
  return type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_POLYGON;
}

// Strips behind the polygons, as their cell data are.
void makePolygonsOfStrips(vtkPolyData* data)
{
  // The polygons are copied, as the input shares them. Each strip becomes one polygon, so that
  // neither the number nor the order of the cells changes.
  vtkNew<vtkCellArray> polygons;
  polygons->DeepCopy(data->GetPolys());
  vtkNew<vtkIdList> ids;
  for (vtkIdType strip = 0; strip < data->GetNumberOfStrips(); ++strip)
  {
    data->GetStrips()->GetCellAtId(strip, ids);
    makeOutline(VTK_TRIANGLE_STRIP, ids);
    polygons->InsertNextCell(ids);
  }
  data->SetPolys(polygons);
  data->SetStrips(nullptr);
}

// The cells of an unstructured grid as a vtkPolyData: Threshold, Append Datasets, Merge Blocks and
// others make such grids of polygons and lines. `numbers` gets the cells' ids in the grid.
vtkSmartPointer<vtkPolyData> polyDataOf(const DensityBlock& block, vtkUnstructuredGrid* grid,
  std::vector<vtkIdType>& numbers, Progress& progress)
{
  // The three kinds in the order in which a vtkPolyData numbers them, and the ids that the cells of
  // each kind have in the grid.
  constexpr vtkIdType betweenPolls = vtkIdType{ 1 } << 16;
  std::array<vtkNew<vtkCellArray>, 3> cells;
  std::array<std::vector<vtkIdType>, 3> numbersOfKinds;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    if (cell % betweenPolls == 0)
    {
      progress.Check();
    }
    const int type = grid->GetCellType(cell);
    const int kind = kindOf(type);
    if (kind < 0)
    {
      // VTK makes the cell only for the message, which names its class.
      vtkCell* const made = grid->GetCell(cell);
      fail("Cell ", cell, " of the ", block.Name, " is a ", made->GetClassName(),
        "; regions must be polygons or closed lines, ",
        made->GetCellDimension() == 3
          ? "as Slice makes of cells of a volume"
          : "as Generate Ids, for the RegionArray, and then Extract Surface make of it");
    }
    grid->GetCellPoints(cell, ids);
    if (kind == 2 && !isOutline(type))
    {
      makeOutline(type, ids);
    }
    cells[static_cast<std::size_t>(kind)]->InsertNextCell(ids);
    numbersOfKinds[static_cast<std::size_t>(kind)].push_back(cell);
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  // Points and their arrays are shared. Cell arrays are copied in the new order of the cells.
  data->SetPoints(grid->GetPoints());
  data->GetPointData()->PassData(grid->GetPointData());
  data->SetVerts(cells[0]);
  data->SetLines(cells[1]);
  data->SetPolys(cells[2]);
  for (const std::vector<vtkIdType>& ofKind : numbersOfKinds)
  {
    numbers.insert(numbers.end(), ofKind.begin(), ofKind.end());
  }
  data->GetCellData()->CopyAllOn();
  copyTuples(
    { grid->GetCellData(), grid->GetNumberOfCells(), "cell", block.Name.c_str() },
    static_cast<std::int64_t>(numbers.size()),
    [&](vtkIdType i) { return numbers[static_cast<std::size_t>(i)]; }, data->GetCellData(),
    progress);
  return data;
}

vtkSmartPointer<vtkPolyData> polyDataOf(
  const DensityBlock& block, std::vector<vtkIdType>& numbers, Progress& progress)
{
  // The block as a vtkPolyData of its own, which the caller may change: it shares arrays with the
  // input, but neither cells that are converted nor the list of its arrays.
  auto* const grid = vtkUnstructuredGrid::SafeDownCast(block.Data);
  auto* const data = vtkPolyData::SafeDownCast(block.Data);
  if (!grid && !data)
  {
    fail("The ", block.Name, " is a ", block.Data->GetClassName(),
      "; regions must be polygons or closed lines, as Extract Surface makes of it");
  }
  // VTK reads without checks what follows: ids of points beyond the last one, and arrays with too
  // few tuples, must not get there.
  requireReadableCells(block.Data, block.Name);
  requireTuples(block.Data, block.Name);
  if (grid)
  {
    return polyDataOf(block, grid, numbers, progress);
  }
  const auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(data);
  if (data->GetNumberOfStrips() > 0)
  {
    makePolygonsOfStrips(copy);
  }
  numbers.resize(static_cast<std::size_t>(data->GetNumberOfCells()));
  std::iota(numbers.begin(), numbers.end(), vtkIdType{ 0 });
  return copy;
}

// Block number i with the two arrays that say so for each cell.
vtkSmartPointer<vtkPolyData> numberedBlock(
  const DensityBlock& block, std::size_t i, Progress& progress)
{
  std::vector<vtkIdType> numbers;
  vtkSmartPointer<vtkPolyData> data = polyDataOf(block, numbers, progress);
  const auto count = static_cast<vtkIdType>(numbers.size());
  for (const char* name : { blockNumbers, cellNumbers })
  {
    vtkNew<vtkIdTypeArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(count);
    for (vtkIdType cell = 0; cell < count; ++cell)
    {
      array->SetValue(cell,
        name == blockNumbers ? static_cast<vtkIdType>(i) : numbers[static_cast<std::size_t>(cell)]);
    }
    data->GetCellData()->AddArray(array);
  }
  return data;
}

// Group by group, and these again, as vtkAppendPolyData cannot be aborted.
vtkSmartPointer<vtkPolyData> joinedData(const std::vector<DensityBlock>& blocks, Progress& progress)
{
  // An append of 64 blocks is short, and with groups of this size a map of a million blocks, as of
  // a composite with one for each region, is copied only four times.
  constexpr std::size_t most = 64;
  const auto count = static_cast<std::int64_t>(blocks.size());
  Stages stages(progress, { { "blocks", 2 }, { "append", 1 } });
  std::vector<vtkSmartPointer<vtkPolyData>> parts;
  Parts each(stages["blocks"], count);
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    parts.push_back(numberedBlock(blocks[i], i, each[static_cast<std::int64_t>(i)]));
  }
  // An append keeps only arrays that all parts have with one type, so types are made equal before.
  unifyTypes(parts);
  Progress& appended = stages["append"].Expect(count);
  do
  {
    std::vector<vtkSmartPointer<vtkPolyData>> joined;
    for (std::size_t first = 0; first < parts.size(); first += most)
    {
      vtkNew<vtkAppendPolyData> append;
      // Single precision would round a map's coordinates in metres to whole metres far from the
      // origin.
      append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
      for (std::size_t i = first; i < std::min(parts.size(), first + most); ++i)
      {
        append->AddInputData(parts[i]);
      }
      append->Update();
      joined.emplace_back(append->GetOutput());
      appended.EndSlice(append->GetNumberOfInputConnections(0));
    }
    parts = std::move(joined);
  } while (parts.size() > 1);
  return parts.front();
}

} // namespace

RegionBlocks joinRegionBlocks(const std::vector<DensityBlock>& blocks, Progress& progress)
{
  // There is at least one block: the filter reports an error where the input has none.
  RegionBlocks joined;
  joined.Data = joinedData(blocks, progress);
  vtkCellData* cells = joined.Data->GetCellData();
  auto* const numbersOfBlocks = vtkIdTypeArray::SafeDownCast(cells->GetArray(blockNumbers));
  auto* const numbers = vtkIdTypeArray::SafeDownCast(cells->GetArray(cellNumbers));
  for (vtkIdType cell = 0; cell < joined.Data->GetNumberOfCells(); ++cell)
  {
    joined.Blocks.push_back(static_cast<std::size_t>(numbersOfBlocks->GetValue(cell)));
    joined.Numbers.push_back(numbers->GetValue(cell));
  }
  cells->RemoveArray(blockNumbers);
  cells->RemoveArray(cellNumbers);
  return joined;
}

} // namespace RectifiedTransport::Bridge
