// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cartogram/RegionCells.h"

#include "Bridge/Cartogram/RegionBlocks.h"
#include "Bridge/Data/DefaultArray.h"
#include "Bridge/Data/TupleValues.h"
#include "Bridge/Run/TextToNumbers.h"
#include "Core/Cartogram/RegionList.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/Stages.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// Whether an array's name says that it has names, such as NAME, name_en or CountryName.
bool isName(const char* name)
{
  std::string lower = name ? name : "";
  for (char& letter : lower)
  {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return lower.find("name") != std::string::npos;
}

// A closed line ends where it begins, by index or by coordinates, as readers of files repeat the
// first point. The shortest is a triangle, with 4 ids.
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
  return std::equal(begin, begin + 3, end);
}

// Finds the region of each cell and its mass. A region is all cells with one value of RegionArray;
// without it, a block of a composite of several, or else a cell by itself.
class RegionReading
{
public:
  RegionReading(
    const std::vector<DensityBlock>& blocks, const RegionArrays& arrays, Progress& progress)
    : Blocks(blocks)
    , Arrays(arrays)
    , Work(progress, { { "blocks", 3 }, { "regions", 1 } })
  {
    // All blocks become one vtkPolyData, whose cells have one numbering. The arrays below belong to
    // it.
    this->Joined = joinRegionBlocks(blocks, this->Work["blocks"]);
    this->Found.Data = this->Joined.Data;
    this->ByBlock = std::any_of(blocks.begin(), blocks.end(),
      [&](const DensityBlock& block) { return block.Whole != blocks.front().Whole; });
    vtkCellData* cells = this->Found.Data->GetCellData();
    this->Key = this->HasKey() ? cells->GetAbstractArray(arrays.Region.c_str()) : nullptr;
    this->Name = this->Key ? this->Key : FindNames(cells);
  }

  RegionCells Read()
  {
    // The order decides which error is reported: an input without regions needs no array of masses.
    this->FindOpenLines();
    Progress& progress = this->Work["regions"];
    progress.Check();
    this->FindMass();
    this->FindRegions(progress);
    return std::move(this->Found);
  }

private:
  // What does not end where it begins bounds no region.
  void FindOpenLines()
  {
    vtkPolyData* data = this->Found.Data;
    // Lines follow the vertices in the numbering of a vtkPolyData; one flag a cell says which are
    // open.
    const vtkIdType vertices = data->GetNumberOfVerts();
    vtkNew<vtkIdList> ids;
    vtkCellArray* lines = data->GetLines();
    this->IsOpen.assign(static_cast<std::size_t>(data->GetNumberOfCells()), 0);
    std::int64_t open = 0;
    std::string first;
    for (vtkIdType line = 0; line < lines->GetNumberOfCells(); ++line)
    {
      lines->GetCellAtId(line, ids);
      if (!isClosed(data, ids))
      {
        first = open++ == 0 ? this->TitleOf(vertices + line) : first;
        this->IsOpen[static_cast<std::size_t>(vertices + line)] = 1;
      }
    }
    const std::int64_t all = lines->GetNumberOfCells();
    const std::string text = std::to_string(open) + " of " + std::to_string(all) +
      " lines of the input do not close (the first is " + first + ")";
    // Without any region this is an error, else a warning: maps often have rivers, or graticules.
    if (open == all && data->GetNumberOfPolys() == 0)
    {
      fail(all == 0 ? "The input has no regions; they must be polygons or closed lines"
                    : text + "; the outline of a region must end at the point where it begins");
    }
    this->Found.OpenLines = open == 0 ? ""
                                      : text +
        "; they move along and have no share of the area, as the outline of a region ends at the "
        "point where it begins";
  }

  // A cell of the input, by its number there.
  std::string TitleOf(vtkIdType cell) const
  {
    const auto at = static_cast<std::size_t>(cell);
    return "cell " + std::to_string(this->Joined.Numbers[at]) +
      (this->Blocks.size() > 1 ? " of " + this->Blocks[this->Joined.Blocks[at]].Name : "");
  }

  // The first block that lacks a cell array, if any.
  std::string OfInput(const std::string& array) const
  {
    // Joining leaves out arrays that a block lacks, so messages name such a block. Blocks without
    // cells lack nothing.
    const auto lacking =
      std::find_if(this->Blocks.begin(), this->Blocks.end(), [&](const DensityBlock& block) {
        return block.Data->GetNumberOfCells() > 0 &&
          !block.Data->GetCellData()->HasArray(array.c_str());
      });
    return this->Blocks.size() == 1 ? "of the input"
                                    : "of all blocks of the input" +
        (lacking == this->Blocks.end() ? "" : " (the " + lacking->Name + " has none)");
  }

  // Finds the array of masses, with one value a cell of the joined data: the chosen one, or the
  // default. ParaView's list of arrays says "None" where none is chosen.
  void FindMass()
  {
    vtkCellData* cells = this->Found.Data->GetCellData();
    const std::string& chosen = this->Arrays.Mass;
    if (!chosen.empty() && chosen != "None")
    {
      // Rivers and other cells that are no regions may have an empty text.
      const TextToNumbers numbers = parseNumbers(cells->GetAbstractArray(chosen.c_str()), true,
        [this](vtkIdType cell) { return "of the region " + this->NameOf(cell); });
      this->Mass = numbers.Array;
      if (!this->Mass)
      {
        fail("MassArray '", chosen, "' is no numeric cell array ", this->OfInput(chosen),
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
    // How messages call the array from here on.
    const char* name = this->Mass->GetName();
    this->MassTitle = name ? "'" + std::string(name) + "'" : "the scalars, which have no name,";
    if (this->Mass->GetNumberOfComponents() != 1)
    {
      fail("MassArray ", this->MassTitle, " has ", this->Mass->GetNumberOfComponents(),
        " components; it must have one");
    }
  }

  // The active scalars, or else the only numeric array of one component; ids are no masses.
  vtkDataArray* DefaultMass(vtkCellData* cells)
  {
    const auto mayBeMass = [cells](vtkDataArray* array) {
      return array && array->GetNumberOfComponents() == 1 && !isIds(cells, array);
    };
    if (mayBeMass(cells->GetScalars()))
    {
      return cells->GetScalars();
    }
    // With two candidates a guess could be wrong without anybody noticing, so there must be one.
    vtkDataArray* only = nullptr;
    int count = 0;
    for (int i = 0; i < cells->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = cells->GetArray(i);
      if (mayBeMass(array) && array->GetName())
      {
        only = array;
        ++count;
      }
    }
    if (count != 1)
    {
      fail("MassArray is not set, and the input has ", count,
        " numeric cell arrays of one component; set it to the one that has the mass of each "
        "region");
    }
    return only;
  }

  // Numbers the regions from 0, in the order of their first cells, and gives each cell its number.
  // The mass of a region is the value that all of its cells have, not their sum: files repeat the
  // attributes of a country for each of its islands. RegionList throws Failure where values differ.
  void FindRegions(Progress& progress)
  {
    if (this->HasKey() && !this->Key)
    {
      fail("RegionArray '", this->Arrays.Region, "' is no cell array ",
        this->OfInput(this->Arrays.Region));
    }
    RegionList regions(this->MassTitle);
    vtkPolyData* data = this->Found.Data;
    const vtkIdType count = data->GetNumberOfCells();
    // Vertices and open lines keep -1.
    this->Found.Regions.assign(static_cast<std::size_t>(count), -1);
    constexpr std::int64_t work = 8; // units, of a value
    std::string key;
    progress.Expect(work * count);
    for (vtkIdType cell = data->GetNumberOfVerts(); cell < count; ++cell)
    {
      progress.Add(work);
      if (this->IsOpen[static_cast<std::size_t>(cell)] != 0)
      {
        continue;
      }
      const std::size_t block = this->Joined.Blocks[static_cast<std::size_t>(cell)];
      // Two cells belong to one region exactly if their keys are equal: the bytes of the tuple of
      // the region array, else the number of the block or of the cell.
      key.clear();
      if (this->Key)
      {
        appendTupleKey(this->Key, cell, key);
      }
      else
      {
        key = std::to_string(
          this->ByBlock ? this->Blocks[block].Whole : static_cast<std::int64_t>(cell));
      }
      this->Found.Regions[static_cast<std::size_t>(cell)] =
        regions.Add(key, this->Mass->GetComponent(cell, 0), [&]() {
          return this->ByBlock && !this->Name ? "of " + this->Blocks[block].Name
                                              : this->NameOf(cell);
        });
    }
    // The sum of the masses is a divisor of all shares.
    regions.RequireMass();
    this->Found.Names = std::move(regions.Names);
    this->Found.Masses = std::move(regions.Masses);
  }

  // Whether a region array is chosen; "None" as for masses.
  bool HasKey() const { return !this->Arrays.Region.empty() && this->Arrays.Region != "None"; }

  // What messages call the region of a cell: its name, if there are names, or else the cell.
  std::string NameOf(vtkIdType cell) const
  {
    return this->Name ? "'" + tupleText(this->Name, cell) + "'" : "of " + this->TitleOf(cell);
  }

  // The first array of texts that is called a name; nullptr if there is none.
  static vtkAbstractArray* FindNames(vtkCellData* cells)
  {
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
  Stages Work;
  bool ByBlock = false;
  RegionBlocks Joined;
  vtkAbstractArray* Key = nullptr;   // whose values tell regions apart, if one is chosen
  vtkAbstractArray* Name = nullptr;  // names for messages, if there are some
  std::vector<unsigned char> IsOpen; // one flag a cell
  vtkSmartPointer<vtkDataArray> Mass;
  std::string MassTitle;
  RegionCells Found;
};

} // namespace

RegionCells readRegions(
  const std::vector<DensityBlock>& blocks, const RegionArrays& arrays, Progress& progress)
{
  return RegionReading(blocks, arrays, progress).Read();
}

} // namespace RectifiedTransport::Bridge
