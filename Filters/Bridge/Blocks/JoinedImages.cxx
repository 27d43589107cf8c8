// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/JoinedImages.h"

#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Boxes/BoxUnion.h"
#include "Core/Geometry/Boxes/GridResolution.h"
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

namespace RectifiedTransport::Bridge
{

namespace
{

// One image among those that are joined. It keeps no reference: the blocks own their data.
struct Part
{
  vtkImageData* Image;
  std::string Name;
  vtkDataArray* Array;              // none: an image without mass
  Extent Place;                     // in the lattice of the first image
  std::vector<unsigned char> Flags; // for each cell, where points may be hidden
};

// For a density on cells.
// VTK treats a cell as blanked if one of its points is hidden (vtkStructuredData::IsCellVisible).
// The joined image has ghost flags of one association only, so that hidden points become flags of
// their cells here, one byte a cell; none if no point has flags.
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

// Only arrays of one type and number of components can be joined without a conversion.
bool areOfOneKind(vtkDataArray* a, vtkDataArray* b)
{
  return a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents();
}

// The images are parts of one lattice if they have the spacings and directions of the first one and
// are whole cells apart, to rounding (see extentIn).
std::optional<std::vector<Part>> partsOf(
  const std::vector<DensityBlock>& blocks, bool onPoints, ImageGrid& lattice)
{
  std::vector<Part> parts;
  vtkDataArray* first = nullptr;
  for (const DensityBlock& block : blocks)
  {
    auto* image = vtkImageData::SafeDownCast(block.Data);
    first = first ? first : block.Array.Get();
    // Blocks without the array have a place but no values: they enlarge the domain.
    if (!image || (block.Array && !areOfOneKind(block.Array, first)))
    {
      return std::nullopt;
    }
    const ImageGrid grid = gridOf(image, onPoints);
    if (parts.empty())
    {
      lattice = grid;
    }
    // Origins that differ become extents, as if all images were pieces of one vtkImageData.
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

// The values of the parts with mass.
std::vector<UnionBox> boxesOf(const std::vector<Part>& parts, int owner)
{
  const bool onPoints = owner == vtkDataObject::POINT;
  std::vector<UnionBox> boxes;
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    const Part& part = parts[p];
    if (part.Array)
    {
      // Duplicates of other pieces have no value of their own; hidden and refined cells have none
      // at all.
      const unsigned char* flags = !onPoints && !part.Flags.empty()
        ? part.Flags.data()
        : ghostFlags(part.Image, owner, part.Name.c_str());
      boxes.push_back(
        { p, tuplesOf(part.Place, owner, part.Place), flags, onPoints ? ghostPoint : ghostCell });
    }
  }
  return boxes;
}

// Whether two tuples are the same; NaN is NaN.
bool areSame(vtkDataArray* a, std::int64_t first, vtkDataArray* b, std::int64_t second)
{
  for (int c = 0; c < a->GetNumberOfComponents(); ++c)
  {
    const double one = a->GetComponent(static_cast<vtkIdType>(first), c);
    const double other = b->GetComponent(static_cast<vtkIdType>(second), c);
    if (!(one == other) && !(std::isnan(one) && std::isnan(other)))
    {
      return false;
    }
  }
  return true;
}

// An array is joined only if every image with mass has it, complete and of one kind: elsewhere its
// values would be made up.
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
  const std::string name = like->GetName() ? like->GetName() : "without a name";
  // The array of the joined image, one tuple a point or cell of the box around all images.
  const MemoryPlan memory{ "the array " + name + " of images that are joined",
    static_cast<double>(all.Count()) * like->GetNumberOfComponents() * like->GetDataTypeSize() };
  const auto joined = vtkSmartPointer<vtkDataArray>::Take(like->NewInstance());
  joined->SetName(like->GetName());
  joined->SetNumberOfComponents(like->GetNumberOfComponents());
  withRequiredMemory(memory, [&]() { joined->SetNumberOfTuples(all.Count()); });
  joined->Fill(0.0);
  // The first image that has a value gives it.
  const std::vector<UnionBox> boxes = boxesOf(parts, owner);
  for (auto box = boxes.rbegin(); box != boxes.rend(); ++box)
  {
    vtkDataArray* from = arrayOf(parts[box->Number]);
    visitRuns(*box, all, [&](std::int64_t first, std::int64_t to, std::int64_t count) {
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
  // A single image is its own union. A single block of another type gives nullptr.
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
  // The box of points of all images, in the lattice of the first one, and the number of their
  // values.
  double values = 0.0;
  TupleBox points{};
  for (const Part& part : *parts)
  {
    values += numberOfValues(gridOf(part.Image, onPoints));
    points = points.With(tuplesOf(part.Place, vtkDataObject::POINT, part.Place));
  }
  const Extent whole = extentOf(points, vtkDataObject::POINT, parts->front().Place);
  const ImageGrid grid{ whole, lattice.Origin(), lattice.Spacing(), lattice.Direction(), onPoints };
  // Bounds the memory: how many times the values of its parts the joined image may have.
  constexpr double mostEmpty = 8.0;
  if (numberOfValues(grid) > mostEmpty * values)
  {
    return nullptr;
  }
  const int ofDensity = onPoints ? vtkDataObject::POINT : vtkDataObject::CELL;
  const TupleBox all = tuplesOf(whole, ofDensity, whole);
  // Two numbers a value of the joined image: the image that gives it, and the value's index there.
  ValueOwners owners;
  withMemory({ "the lattice of images that are joined",
               numberOfValues(grid) * (sizeof(std::int64_t) + sizeof(std::int32_t)) },
    [&]() {
      owners.Values.resize(static_cast<std::size_t>(all.Count()));
      owners.Boxes.assign(static_cast<std::size_t>(all.Count()), -1);
    });
  // Neighbours share the points of their common face, with equal values. If values differ, or if
  // cells overlap, the mass of the union is not clear, and the images are not joined but resampled.
  const auto mayShare = [&](std::size_t owner, std::int64_t value, std::size_t part,
                          std::int64_t other) {
    return onPoints && areSame((*parts)[owner].Array, value, (*parts)[part].Array, other);
  };
  if (!findValueOwners(boxesOf(*parts, ofDensity), all, mayShare, owners))
  {
    return nullptr;
  }
  auto joined = vtkSmartPointer<vtkImageData>::New();
  applyGrid(grid, joined);
  // The arrays of the first image with mass decide which arrays the joined image gets.
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
  // Values without an owner are holes between the images. They are hidden, so that the density
  // reads them as empty cells, as it reads those that the input itself hides.
  if (std::any_of(
        owners.Boxes.begin(), owners.Boxes.end(), [](std::int32_t owner) { return owner < 0; }))
  {
    auto flags = newArray<vtkUnsignedCharArray>(
      vtkDataSetAttributes::GhostArrayName(), 1, static_cast<vtkIdType>(owners.Boxes.size()));
    const auto hidden =
      static_cast<unsigned char>(onPoints ? int{ vtkDataSetAttributes::HIDDENPOINT }
                                          : int{ vtkDataSetAttributes::HIDDENCELL });
    std::transform(owners.Boxes.begin(), owners.Boxes.end(), flags->GetPointer(0),
      [hidden](std::int32_t owner) { return owner < 0 ? hidden : static_cast<unsigned char>(0); });
    joined->GetAttributes(ofDensity)->AddArray(flags);
  }
  return joined;
}

} // namespace RectifiedTransport::Bridge
