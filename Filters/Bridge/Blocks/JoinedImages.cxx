// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/JoinedImages.h"

#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Geometry/LatticeExtent.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

struct Part
{
  vtkImageData* Image;
  std::string Name;
  vtkDataArray* Array;              // none: an image without mass
  Extent Place;                     // in the lattice of the first image
  std::vector<unsigned char> Flags; // for each cell, where points may be hidden
};

// For a density on cells.
std::vector<unsigned char> flagsOfCells(vtkImageData* image, const std::string& name)
{
  const unsigned char* points = ghostFlags(image, vtkDataObject::POINT, name.c_str());
  if (!points)
  {
    return {};
  }
  std::array<int, 3> dimensions;
  image->GetDimensions(dimensions.data());
  const std::int64_t cells = image->GetNumberOfCells();
  std::vector<unsigned char> flags;
  withMemory({ "the flags of the cells of the " + name, static_cast<double>(cells) },
    [&]() { flags.resize(static_cast<std::size_t>(cells)); });
  blankCellsOfHiddenPoints(dimensions, points, ghostFlags(image, vtkDataObject::CELL, name.c_str()),
    0, cells / std::max(1, dimensions[0] - 1), flags.data(), blankingFlags);
  return flags;
}

bool areOfOneKind(vtkDataArray* a, vtkDataArray* b)
{
  return a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents();
}

std::optional<std::vector<Part>> partsOf(
  const std::vector<DensityBlock>& blocks, bool onPoints, ImageGrid& lattice)
{
  std::vector<Part> parts;
  vtkDataArray* first = nullptr;
  for (const DensityBlock& block : blocks)
  {
    auto* image = vtkImageData::SafeDownCast(block.Data);
    first = first ? first : block.Array.Get();
    if (!image || (block.Array && !areOfOneKind(block.Array, first)))
    {
      return std::nullopt;
    }
    const ImageGrid grid = gridOf(image, onPoints);
    if (parts.empty())
    {
      lattice = grid;
    }
    const std::optional<Extent> place = extentIn(lattice, grid);
    if (!place)
    {
      return std::nullopt;
    }
    parts.push_back({ image, block.Name, block.Array, *place,
      onPoints ? std::vector<unsigned char>() : flagsOfCells(image, block.Name) });
  }
  return parts;
}

// Calls visit(from, to, count) for runs of values of a part with mass that are no ghosts, until it
// returns false. They go to the values `all`. Returns whether it never did.
template <class Visit>
bool visitRuns(const Part& part, int owner, const TupleBox& all, const Visit& visit)
{
  if (!part.Array)
  {
    return true;
  }
  const bool onPoints = owner == vtkDataObject::POINT;
  const TupleBox own = tuplesOf(part.Place, owner, part.Place);
  const unsigned char* flags = !onPoints && !part.Flags.empty()
    ? part.Flags.data()
    : ghostFlags(part.Image, owner, part.Name.c_str());
  const unsigned char mask = onPoints ? ghostPoint : ghostCell;
  for (std::int64_t k = own.Low[2]; k < own.End(2); ++k)
  {
    for (std::int64_t j = own.Low[1]; j < own.End(1); ++j)
    {
      const std::int64_t from = own.NumberOf({ own.Low[0], j, k });
      const std::int64_t to = all.NumberOf({ own.Low[0], j, k });
      for (std::int64_t i = 0; i < own.Cells[0];)
      {
        const bool isGhost = flags && (flags[from + i] & mask);
        std::int64_t end = i + 1;
        while (end < own.Cells[0] && isGhost == (flags && (flags[from + end] & mask)))
        {
          ++end;
        }
        if (!isGhost && !visit(from + i, to + i, end - i))
        {
          return false;
        }
        i = end;
      }
    }
  }
  return true;
}

// Which values of the lattice a part has given; false where cells overlap or points differ.
bool findGiven(const std::vector<Part>& parts, int owner, const TupleBox& all,
  std::vector<vtkIdType>& given, std::vector<std::int32_t>& giver)
{
  const bool onPoints = owner == vtkDataObject::POINT;
  for (std::size_t t = 0; t < parts.size(); ++t)
  {
    const Part& part = parts[t];
    const bool apart =
      visitRuns(part, owner, all, [&](std::int64_t from, std::int64_t to, std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i)
        {
          std::int32_t& first = giver[static_cast<std::size_t>(to + i)];
          vtkIdType& source = given[static_cast<std::size_t>(to + i)];
          if (first < 0)
          {
            first = static_cast<std::int32_t>(t);
            source = static_cast<vtkIdType>(from + i);
            continue;
          }
          const vtkDataArray* other = parts[static_cast<std::size_t>(first)].Array;
          for (int c = 0; onPoints && c < other->GetNumberOfComponents(); ++c)
          {
            const double a = const_cast<vtkDataArray*>(other)->GetComponent(source, c);
            const double b = part.Array->GetComponent(static_cast<vtkIdType>(from + i), c);
            if (!(a == b) && !(std::isnan(a) && std::isnan(b)))
            {
              return false;
            }
          }
          if (!onPoints)
          {
            return false;
          }
        }
        return true;
      });
    if (!apart)
    {
      return false;
    }
  }
  return true;
}

bool allHave(const std::vector<Part>& parts, int owner, vtkDataArray* array)
{
  return std::all_of(parts.begin(), parts.end(), [&](const Part& part) {
    vtkDataArray* own = part.Image->GetAttributes(owner)->GetArray(array->GetName());
    return !part.Array ||
      (own && areOfOneKind(own, array) &&
        own->GetNumberOfTuples() == part.Image->GetNumberOfElements(owner));
  });
}

// Joins the arrays arrayOf(part), which are of the kind of `like`. Zero where no part has a value.
template <class ArrayOf>
vtkSmartPointer<vtkDataArray> joinArrays(const std::vector<Part>& parts, int owner,
  vtkDataArray* like, const TupleBox& all, const ArrayOf& arrayOf)
{
  const double bytes =
    static_cast<double>(all.Count()) * like->GetNumberOfComponents() * like->GetDataTypeSize();
  const std::string name = like->GetName() ? like->GetName() : "without a name";
  const std::string purpose = "the array " + name + " of images that are joined";
  requireMemory({ purpose, bytes });
  const auto joined = vtkSmartPointer<vtkDataArray>::Take(like->NewInstance());
  joined->SetName(like->GetName());
  joined->SetNumberOfComponents(like->GetNumberOfComponents());
  withMemory({ purpose, bytes }, [&]() { joined->SetNumberOfTuples(all.Count()); });
  joined->Fill(0.0);
  // The first image that has a value gives it.
  for (auto part = parts.rbegin(); part != parts.rend(); ++part)
  {
    vtkDataArray* from = arrayOf(*part);
    visitRuns(*part, owner, all, [&](std::int64_t first, std::int64_t to, std::int64_t count) {
      joined->InsertTuples(static_cast<vtkIdType>(to), static_cast<vtkIdType>(count),
        static_cast<vtkIdType>(first), from);
      return true;
    });
  }
  return joined;
}

} // namespace

vtkSmartPointer<vtkImageData> joinImages(const std::vector<DensityBlock>& blocks, bool onPoints)
{
  if (blocks.size() == 1)
  {
    return vtkImageData::SafeDownCast(blocks.front().Data);
  }
  ImageGrid lattice;
  const auto parts = partsOf(blocks, onPoints, lattice);
  if (!parts)
  {
    return nullptr;
  }
  double values = 0.0;
  TupleBox points{};
  for (const Part& part : *parts)
  {
    values += numberOfValues(gridOf(part.Image, onPoints));
    points = points.With(tuplesOf(part.Place, vtkDataObject::POINT, part.Place));
  }
  const Extent whole = extentOf(points, vtkDataObject::POINT, parts->front().Place);
  const ImageGrid grid{ whole, lattice.Origin(), lattice.Spacing(), lattice.Direction(), onPoints };
  constexpr double mostEmpty = 8.0;
  if (numberOfValues(grid) > mostEmpty * values)
  {
    return nullptr;
  }
  const int ofDensity = onPoints ? vtkDataObject::POINT : vtkDataObject::CELL;
  const TupleBox all = tuplesOf(whole, ofDensity, whole);
  std::vector<vtkIdType> given;
  std::vector<std::int32_t> giver;
  withMemory({ "the lattice of images that are joined",
               numberOfValues(grid) * (sizeof(vtkIdType) + sizeof(std::int32_t)) },
    [&]() {
      given.resize(static_cast<std::size_t>(all.Count()));
      giver.assign(static_cast<std::size_t>(all.Count()), -1);
    });
  if (!findGiven(*parts, ofDensity, all, given, giver))
  {
    return nullptr;
  }
  auto joined = vtkSmartPointer<vtkImageData>::New();
  applyGrid(grid, joined);
  const auto first = std::find_if(
    parts->begin(), parts->end(), [](const Part& part) { return part.Array != nullptr; });
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* from = first->Image->GetAttributes(owner);
    vtkDataSetAttributes* to = joined->GetAttributes(owner);
    const TupleBox tuples = tuplesOf(whole, owner, whole);
    for (int i = 0; i < from->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = from->GetArray(i);
      if (array && array == first->Array && owner == ofDensity)
      {
        to->SetScalars(
          joinArrays(*parts, owner, array, tuples, [](const Part& part) { return part.Array; }));
      }
      else if (array && array->GetName() &&
        array != from->GetArray(vtkDataSetAttributes::GhostArrayName()) &&
        allHave(*parts, owner, array))
      {
        to->AddArray(joinArrays(*parts, owner, array, tuples, [&](const Part& part) {
          return part.Image->GetAttributes(owner)->GetArray(array->GetName());
        }));
      }
    }
  }
  if (std::any_of(giver.begin(), giver.end(), [](std::int32_t owner) { return owner < 0; }))
  {
    auto flags = newArray<vtkUnsignedCharArray>(
      vtkDataSetAttributes::GhostArrayName(), 1, static_cast<vtkIdType>(giver.size()));
    const auto hidden =
      static_cast<unsigned char>(onPoints ? int{ vtkDataSetAttributes::HIDDENPOINT }
                                          : int{ vtkDataSetAttributes::HIDDENCELL });
    std::transform(giver.begin(), giver.end(), flags->GetPointer(0),
      [hidden](std::int32_t owner) { return owner < 0 ? hidden : static_cast<unsigned char>(0); });
    joined->GetAttributes(ofDensity)->AddArray(flags);
  }
  return joined;
}

} // namespace RectifiedTransport::Bridge
