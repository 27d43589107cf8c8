// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Lattices/JoinedImages.h"

#include "Bridge/Image/DefaultArray.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Run/Memory.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Extent = std::array<int, 6>;

struct Part
{
  vtkImageData* Image;
  std::string Name;
  vtkDataArray* Array;              // none: an image without mass
  Extent Place;                     // in the lattice of the first image
  std::vector<unsigned char> Flags; // of the cells, where points of theirs may be hidden
};

// Of a density on cells.
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
  withMemory("the flags of the cells of the " + name, static_cast<double>(cells),
    [&]() { flags.resize(static_cast<std::size_t>(cells)); });
  blankCellsOfHiddenPoints(dimensions, points, ghostFlags(image, vtkDataObject::CELL, name.c_str()),
    0, cells / std::max(1, dimensions[0] - 1), flags.data());
  return flags;
}

// Where an image lies in the lattice of another one.
std::optional<Extent> placeIn(const ImageGrid& lattice, const ImageGrid& grid)
{
  constexpr double rounding = 1e-6; // of a spacing: of origins in single precision
  constexpr double largest = std::numeric_limits<int>::max() / 2;
  const Eigen::Vector3d offset = grid.Origin() - lattice.Origin();
  const bool sameAxes = (grid.Direction() - lattice.Direction()).cwiseAbs().maxCoeff() <= rounding;
  Extent place{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    const double spacing = lattice.Spacing()[axis];
    const double along = lattice.Direction().col(axis).dot(offset) / spacing;
    const double steps = std::round(along);
    const double points = std::max(1, grid.NumberOfPoints()[a]);
    if (!sameAxes || grid.IsAxis(a) != lattice.IsAxis(a) || !(std::abs(steps) < largest) ||
      std::abs(along - steps) > rounding ||
      std::abs(grid.Spacing()[axis] - spacing) * points > rounding * std::abs(spacing))
    {
      return std::nullopt;
    }
    for (std::size_t end = 2 * a; end < 2 * a + 2; ++end)
    {
      const double at = grid.Extent()[end] + steps;
      if (!(std::abs(at) < largest))
      {
        return std::nullopt;
      }
      place[end] = static_cast<int>(at);
    }
  }
  return place;
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
    first = first ? first : block.Array;
    if (!image || (block.Array && !areOfOneKind(block.Array, first)))
    {
      return std::nullopt;
    }
    const ImageGrid grid = gridOf(image, onPoints);
    if (parts.empty())
    {
      lattice = grid;
    }
    const std::optional<Extent> place = placeIn(lattice, grid);
    if (!place)
    {
      return std::nullopt;
    }
    parts.push_back({ image, block.Name, block.Array, *place,
      onPoints ? std::vector<unsigned char>() : flagsOfCells(image, block.Name) });
  }
  return parts;
}

// The numbers of values along the axes of an extent, and of a place among them.
struct Lattice
{
  Lattice(const Extent& extent, const ImageGrid& like)
    : First{ extent[0], extent[2], extent[4] }
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      const std::int64_t points = std::int64_t{ extent[2 * a + 1] } - extent[2 * a] + 1;
      this->Size[a] = like.IsOnPoints() || !like.IsAxis(a) ? points : points - 1;
    }
  }
  double Count() const
  {
    return static_cast<double>(this->Size[0]) * static_cast<double>(this->Size[1]) *
      static_cast<double>(this->Size[2]);
  }
  std::int64_t IndexOf(const std::array<std::int64_t, 3>& place) const
  {
    return place[0] - this->First[0] +
      this->Size[0] * (place[1] - this->First[1] + this->Size[1] * (place[2] - this->First[2]));
  }

  std::array<std::int64_t, 3> First;
  std::array<std::int64_t, 3> Size;
};

// Calls visit(from, to, count) for runs of values of a part with mass that are no ghosts, until it
// returns false. Returns whether it never did.
template <class Visit>
bool visitRuns(const Part& part, const Lattice& all, const ImageGrid& like, const Visit& visit)
{
  if (!part.Array)
  {
    return true;
  }
  const bool onPoints = like.IsOnPoints();
  const Lattice own(part.Place, like);
  const unsigned char* flags = !onPoints && !part.Flags.empty()
    ? part.Flags.data()
    : ghostFlags(
        part.Image, onPoints ? vtkDataObject::POINT : vtkDataObject::CELL, part.Name.c_str());
  const unsigned char mask = onPoints ? ghostPoint : ghostCell;
  for (std::int64_t k = 0; k < own.Size[2]; ++k)
  {
    for (std::int64_t j = 0; j < own.Size[1]; ++j)
    {
      const std::int64_t from = own.Size[0] * (j + own.Size[1] * k);
      const std::int64_t to = all.IndexOf({ own.First[0], own.First[1] + j, own.First[2] + k });
      for (std::int64_t i = 0; i < own.Size[0];)
      {
        const bool isGhost = flags && (flags[from + i] & mask);
        std::int64_t end = i + 1;
        while (end < own.Size[0] && isGhost == (flags && (flags[from + end] & mask)))
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
bool findGiven(const std::vector<Part>& parts, const Lattice& all, const ImageGrid& like,
  std::vector<vtkIdType>& given, std::vector<std::int32_t>& giver)
{
  for (std::size_t t = 0; t < parts.size(); ++t)
  {
    const Part& part = parts[t];
    const bool apart =
      visitRuns(part, all, like, [&](std::int64_t from, std::int64_t to, std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i)
        {
          std::int32_t& owner = giver[static_cast<std::size_t>(to + i)];
          vtkIdType& source = given[static_cast<std::size_t>(to + i)];
          if (owner < 0)
          {
            owner = static_cast<std::int32_t>(t);
            source = static_cast<vtkIdType>(from + i);
            continue;
          }
          const vtkDataArray* other = parts[static_cast<std::size_t>(owner)].Array;
          for (int c = 0; like.IsOnPoints() && c < other->GetNumberOfComponents(); ++c)
          {
            const double a = const_cast<vtkDataArray*>(other)->GetComponent(source, c);
            const double b = part.Array->GetComponent(static_cast<vtkIdType>(from + i), c);
            if (!(a == b) && !(std::isnan(a) && std::isnan(b)))
            {
              return false;
            }
          }
          if (!like.IsOnPoints())
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

// Zero where no part has a value.
void joinArray(const std::vector<Part>& parts, int owner, vtkDataArray* like, const Lattice& all,
  const ImageGrid& grid, vtkDataSetAttributes* output)
{
  const double bytes = all.Count() * like->GetNumberOfComponents() * like->GetDataTypeSize();
  const std::string purpose =
    "the array " + std::string(like->GetName()) + " of images that are joined";
  requireMemory(purpose, bytes);
  const auto joined = vtkSmartPointer<vtkDataArray>::Take(like->NewInstance());
  joined->SetName(like->GetName());
  joined->SetNumberOfComponents(like->GetNumberOfComponents());
  withMemory(
    purpose, bytes, [&]() { joined->SetNumberOfTuples(static_cast<vtkIdType>(all.Count())); });
  joined->Fill(0.0);
  // The first image that has a value gives it.
  for (auto part = parts.rbegin(); part != parts.rend(); ++part)
  {
    vtkDataArray* from = part->Image->GetAttributes(owner)->GetArray(like->GetName());
    visitRuns(*part, all, grid, [&](std::int64_t first, std::int64_t to, std::int64_t count) {
      joined->InsertTuples(static_cast<vtkIdType>(to), static_cast<vtkIdType>(count),
        static_cast<vtkIdType>(first), from);
      return true;
    });
  }
  output->AddArray(joined);
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
  Extent whole = parts->front().Place;
  double values = 0.0;
  for (const Part& part : *parts)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      whole[2 * a] = std::min(whole[2 * a], part.Place[2 * a]);
      whole[2 * a + 1] = std::max(whole[2 * a + 1], part.Place[2 * a + 1]);
    }
    values += Lattice(part.Place, lattice).Count();
  }
  constexpr double mostEmpty = 8.0;
  const Lattice all(whole, lattice);
  if (all.Count() > mostEmpty * values)
  {
    return nullptr;
  }
  std::vector<vtkIdType> given;
  std::vector<std::int32_t> giver;
  withMemory("the lattice of images that are joined",
    all.Count() * (sizeof(vtkIdType) + sizeof(std::int32_t)), [&]() {
      given.resize(static_cast<std::size_t>(all.Count()));
      giver.assign(static_cast<std::size_t>(all.Count()), -1);
    });
  if (!findGiven(*parts, all, lattice, given, giver))
  {
    return nullptr;
  }
  auto joined = vtkSmartPointer<vtkImageData>::New();
  applyGrid({ whole, lattice.Origin(), lattice.Spacing(), lattice.Direction(), onPoints }, joined);
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    const ImageGrid grid = lattice.WithValuesOn(owner == vtkDataObject::POINT);
    const auto first = std::find_if(
      parts->begin(), parts->end(), [](const Part& part) { return part.Array != nullptr; });
    vtkDataSetAttributes* from = first->Image->GetAttributes(owner);
    for (int i = 0; i < from->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = from->GetArray(i);
      if (array && array->GetName() &&
        array != from->GetArray(vtkDataSetAttributes::GhostArrayName()) &&
        allHave(*parts, owner, array))
      {
        joinArray(*parts, owner, array, Lattice(whole, grid), grid, joined->GetAttributes(owner));
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
    attributesOf(joined, onPoints)->AddArray(flags);
  }
  return joined;
}

} // namespace RectifiedTransport
