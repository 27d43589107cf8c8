// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cartogram/RegionCells.h"

#include "Bridge/Image/DefaultArray.h"
#include "Bridge/Points/CellCheck.h"
#include "Bridge/Points/CopiedTuples.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/NumbersOfText.h"

#include "vtkAbstractArray.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <numeric>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr const char* blockNumbers = "vtkCartogramBlock"; // a cell array, while blocks become one

vtkPolyData* polyDataOf(const DensityBlock& block)
{
  auto* data = vtkPolyData::SafeDownCast(block.Data);
  if (!data)
  {
    fail("The ", block.Name, " is a ", block.Data->GetClassName(),
      "; regions must be polygons or closed lines of a vtkPolyData, as Extract Surface makes of "
      "it");
  }
  if (data->GetNumberOfStrips() > 0)
  {
    fail("The ", block.Name,
      " has triangle strips; regions must be polygons or closed lines, as Triangulate makes of "
      "them");
  }
  requireReadableCells(data, block.Name);
  requireTuples(data, block.Name);
  return data;
}

vtkSmartPointer<vtkPolyData> numberedBlock(const DensityBlock& block, std::size_t i)
{
  vtkPolyData* data = polyDataOf(block);
  const auto numbered = vtkSmartPointer<vtkPolyData>::New();
  numbered->ShallowCopy(data);
  vtkNew<vtkIdTypeArray> number;
  number->SetName(blockNumbers);
  number->SetNumberOfTuples(data->GetNumberOfCells());
  number->FillValue(static_cast<vtkIdType>(i));
  numbered->GetCellData()->AddArray(number);
  return numbered;
}

// Group by group, and these again, as vtkAppendPolyData cannot be aborted.
vtkSmartPointer<vtkPolyData> joinBlocks(const std::vector<DensityBlock>& blocks, Progress& progress)
{
  constexpr std::size_t most = 64;
  std::vector<vtkSmartPointer<vtkPolyData>> parts;
  progress.BeginStage(0.015, 2 * static_cast<std::int64_t>(blocks.size()));
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    progress.EndSlice(1);
    parts.push_back(numberedBlock(blocks[i], i));
  }
  do
  {
    std::vector<vtkSmartPointer<vtkPolyData>> joined;
    for (std::size_t first = 0; first < parts.size(); first += most)
    {
      vtkNew<vtkAppendPolyData> append;
      append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
      for (std::size_t i = first; i < std::min(parts.size(), first + most); ++i)
      {
        append->AddInputData(parts[i]);
      }
      append->Update();
      joined.emplace_back(append->GetOutput());
      progress.EndSlice(append->GetNumberOfInputConnections(0));
    }
    parts = std::move(joined);
  } while (parts.size() > 1);
  return parts.front();
}

std::string textOf(vtkAbstractArray* array, vtkIdType cell)
{
  return array->GetVariantValue(cell * array->GetNumberOfComponents()).ToString();
}

bool isName(const char* name)
{
  std::string lower = name ? name : "";
  for (char& letter : lower)
  {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return lower.find("name") != std::string::npos;
}

bool isClosed(vtkPolyData* data, vtkIdList* line)
{
  const vtkIdType last = line->GetNumberOfIds() - 1;
  if (last < 3) // it may have no points at all
  {
    return false;
  }
  double begin[3];
  double end[3];
  data->GetPoint(line->GetId(0), begin);
  data->GetPoint(line->GetId(last), end);
  return std::memcmp(begin, end, sizeof(begin)) == 0;
}

class RegionReading
{
public:
  RegionReading(const std::vector<DensityBlock>& blocks, bool isComposite,
    const RegionArrays& arrays, Progress& progress)
    : Blocks(blocks)
    , Arrays(arrays)
    , Work(progress)
  {
    this->Found.Data = joinBlocks(blocks, progress);
    this->ByBlock = isComposite && blocks.size() > 1;
  }

  RegionCells Read()
  {
    this->RequireClosedLines();
    this->Work.Check();
    this->FindMass();
    this->FindRegions();
    this->Found.Data->GetCellData()->RemoveArray(blockNumbers);
    return std::move(this->Found);
  }

private:
  void RequireClosedLines()
  {
    vtkPolyData* data = this->Found.Data;
    const vtkIdType vertices = data->GetNumberOfVerts();
    std::int64_t open = 0;
    vtkIdType first = -1;
    vtkNew<vtkIdList> ids;
    vtkCellArray* lines = data->GetLines();
    for (vtkIdType line = 0; line < lines->GetNumberOfCells(); ++line)
    {
      lines->GetCellAtId(line, ids);
      if (!isClosed(data, ids))
      {
        first = open++ == 0 ? vertices + line : first;
      }
    }
    if (open > 0)
    {
      fail(open, " of ", lines->GetNumberOfCells(),
        " lines of the input do not close (the first is cell ", first,
        "); the outline of a region must end at the point where it begins");
    }
    if (lines->GetNumberOfCells() + data->GetNumberOfPolys() == 0)
    {
      fail("The input has no regions; they must be polygons or closed lines");
    }
  }

  void FindMass()
  {
    vtkCellData* cells = this->Found.Data->GetCellData();
    const std::string& chosen = this->Arrays.Mass;
    if (!chosen.empty() && chosen != "None")
    {
      const NumbersOfText numbers = numbersOf(cells->GetAbstractArray(chosen.c_str()), false,
        [this](vtkIdType cell) { return "of the region " + this->NameOf(cell); });
      this->Mass = numbers.Array;
      if (!this->Mass)
      {
        fail("MassArray '", chosen, "' is no numeric cell array ",
          this->Blocks.size() > 1 ? "of all blocks of the input" : "of the input",
          !numbers.Wrong.empty() ? " (" + numbers.Wrong + ")" : "",
          this->Found.Data->GetPointData()->HasArray(chosen.c_str())
            ? " but a point array; Point Data to Cell Data makes a cell array of it"
            : "; choose one that has the mass of each region");
      }
    }
    else
    {
      this->Mass = this->DefaultMass(cells);
    }
    const char* name = this->Mass->GetName();
    this->MassTitle = name ? "'" + std::string(name) + "'" : "the scalars, which have no name,";
    if (this->Mass->GetNumberOfComponents() != 1)
    {
      fail("MassArray ", this->MassTitle, " has ", this->Mass->GetNumberOfComponents(),
        " components; it must have one");
    }
  }

  vtkDataArray* DefaultMass(vtkCellData* cells)
  {
    if (cells->GetScalars() && !isIds(cells, cells->GetScalars()))
    {
      return cells->GetScalars();
    }
    vtkDataArray* only = nullptr;
    int count = 0;
    for (int i = 0; i < cells->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = cells->GetArray(i);
      if (array && array->GetName() && !isIds(cells, array) &&
        std::strcmp(array->GetName(), blockNumbers) != 0)
      {
        only = array;
        ++count;
      }
    }
    if (count != 1)
    {
      fail("MassArray is not set, and the input has ", count,
        " numeric cell arrays; set it to the one that has the mass of each region");
    }
    return only;
  }

  void FindRegions()
  {
    vtkPolyData* data = this->Found.Data;
    vtkCellData* cells = data->GetCellData();
    const bool isGiven = !this->Arrays.Region.empty() && this->Arrays.Region != "None";
    vtkAbstractArray* key =
      isGiven ? cells->GetAbstractArray(this->Arrays.Region.c_str()) : nullptr;
    if (isGiven && !key)
    {
      fail("RegionArray '", this->Arrays.Region, "' is no cell array ",
        this->Blocks.size() > 1 ? "of all blocks of the input" : "of the input");
    }
    vtkAbstractArray* name = key ? key : this->NameArray();
    vtkDataArray* block = cells->GetArray(blockNumbers);
    std::map<std::string, std::int32_t> numbers;
    const vtkIdType count = data->GetNumberOfCells();
    this->Found.Regions.assign(static_cast<std::size_t>(count), -1);
    constexpr std::int64_t work = 8; // units, of a text
    this->Work.BeginStage(0.02, work * count);
    for (vtkIdType cell = data->GetNumberOfVerts(); cell < count; ++cell)
    {
      this->Work.Add(work);
      const auto blockOfCell = static_cast<std::size_t>(block->GetComponent(cell, 0));
      std::string text = key ? textOf(key, cell)
        : this->ByBlock      ? std::to_string(blockOfCell)
                             : std::to_string(cell);
      const auto [found, isNew] =
        numbers.insert({ text, static_cast<std::int32_t>(this->Found.Names.size()) });
      this->Found.Regions[static_cast<std::size_t>(cell)] = found->second;
      const double mass = this->Mass->GetComponent(cell, 0);
      if (isNew)
      {
        this->Found.Names.push_back(name ? "'" + textOf(name, cell) + "'"
            : this->ByBlock              ? "of " + this->Blocks[blockOfCell].Name
                                         : "of cell " + text);
        this->Found.Masses.push_back(mass);
        this->Require(mass, this->Found.Names.back());
      }
      else
      {
        const double before = this->Found.Masses[static_cast<std::size_t>(found->second)];
        if (!(mass == before))
        {
          fail("The region ", this->Found.Names[static_cast<std::size_t>(found->second)],
            " has cells of mass ", before, " and ", mass, " in ", this->MassTitle,
            "; all cells of a region must have its mass, which counts once");
        }
      }
    }
    double total = 0.0;
    for (const double mass : this->Found.Masses)
    {
      total += mass;
    }
    if (!(total > 0.0) || !std::isfinite(total))
    {
      fail("The masses in ", this->MassTitle, " sum to ", total,
        "; they must sum to a number above 0");
    }
  }

  void Require(double mass, const std::string& region)
  {
    if (!(mass >= 0.0) || !std::isfinite(mass))
    {
      fail("The mass of the region ", region, " in ", this->MassTitle, " is ", mass,
        "; masses must be at least 0 and finite");
    }
  }

  std::string NameOf(vtkIdType cell)
  {
    vtkAbstractArray* key =
      this->Found.Data->GetCellData()->GetAbstractArray(this->Arrays.Region.c_str());
    vtkAbstractArray* name = key ? key : this->NameArray();
    return name ? "'" + textOf(name, cell) + "'" : "of cell " + std::to_string(cell);
  }

  // Names for messages.
  vtkAbstractArray* NameArray()
  {
    vtkCellData* cells = this->Found.Data->GetCellData();
    for (int i = 0; i < cells->GetNumberOfArrays(); ++i)
    {
      auto* array = vtkStringArray::SafeDownCast(cells->GetAbstractArray(i));
      if (array && isName(array->GetName()))
      {
        return array;
      }
    }
    return nullptr;
  }

  const std::vector<DensityBlock>& Blocks;
  const RegionArrays& Arrays;
  Progress& Work;
  bool ByBlock = false;
  vtkSmartPointer<vtkDataArray> Mass;
  std::string MassTitle;
  RegionCells Found;
};

} // namespace

RegionCells readRegions(const std::vector<DensityBlock>& blocks, bool isComposite,
  const RegionArrays& arrays, Progress& progress)
{
  return RegionReading(blocks, isComposite, arrays, progress).Read();
}

} // namespace RectifiedTransport
