// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cells/DensityInput.h"

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Blocks/OptionalArray.h"
#include "Bridge/Data/Cells/CellCheck.h"
#include "Bridge/Data/Cells/MeshCells.h"
#include "Bridge/Data/DefaultArray.h"
#include "Bridge/Density/ArrayReader.h"
#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/PartitionedDensity.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Ranks/RankConsistency.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/TextToNumbers.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Resampling/CellFrame.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// Whether a data object, which may be nullptr, holds anything. Composite data sets count those of
// their blocks.
bool hasElements(vtkDataObject* data)
{
  return data &&
    (data->GetNumberOfElements(vtkDataObject::POINT) > 0 ||
      data->GetNumberOfElements(vtkDataObject::CELL) > 0);
}

// What a data set has, for messages.
std::string describeArrays(vtkDataSet* data)
{
  return "; it has " + listArrays(data->GetPointData(), "point") + " and " +
    listArrays(data->GetCellData(), "cell");
}

// The array as numbers; nullptr for nullptr. `what` names the data set.
vtkSmartPointer<vtkDataArray> numbersIn(
  vtkAbstractArray* array, const DensityChoice& choice, vtkDataSet* data, const std::string& what)
{
  // An empty text is a missing value if NaN marks missing values, else no number.
  const TextToNumbers numbers = parseNumbers(array, choice.Rules.Missing.AreNaN);
  if (array && !numbers.Array)
  {
    const char* name = array->GetName();
    throw Failure("The density array '" + std::string(name ? name : "") + "' is not numeric (" +
      what + ": " + numbers.Wrong + ")" + describeArrays(data));
  }
  return numbers.Array;
}

// The density array of a data set, as numbers, and its association. Throws Failure if there is
// none, with a list of the arrays to choose from: most often the name is misspelt or of another
// association.
vtkSmartPointer<vtkDataArray> requireArray(
  const DensityChoice& choice, vtkDataSet* data, const std::string& what, int& association)
{
  const auto array = numbersIn(choice.FindArray(data, association), choice, data, what);
  if (!array)
  {
    const bool isNamed = !choice.ArrayName.empty();
    throw Failure("The " + what +
      (isNamed ? " has no density array '" + choice.ArrayName + "'"
               : " has no active scalars for a density") +
      describeArrays(data) +
      (isNamed || !hasIds(data) ? "" : " (ids and flags are a density only where they are named)"));
  }
  return array;
}

// A data set whose array of text is replaced by the numbers that it holds; others as they are.
template <class Data>
vtkSmartPointer<Data> withNumbers(Data* data, vtkDataArray* array, bool onPoints)
{
  const char* name = array ? array->GetName() : nullptr;
  if (!name || attributesOf(data, onPoints)->GetArray(name))
  {
    return data;
  }
  // The input stays as it is: a shallow copy shares its arrays, and the one of numbers takes the
  // place of that of texts, so that all that reads the data set by names finds numbers.
  const auto made = vtkSmartPointer<Data>::Take(data->NewInstance());
  made->ShallowCopy(data);
  attributesOf(made, onPoints)->AddArray(array);
  return made;
}

// A density on several ranks needs one.
void requireName(vtkDataArray* array)
{
  if (!array->GetName())
  {
    throw Failure("The density array has no name; on several ranks it must have one");
  }
}

constexpr const char* inputImage = "input image";

// An image on a single process is the density as it is: cells, or dual cells around its points. The
// values are not copied.
std::unique_ptr<InputDensity> readImage(const DensityChoice& choice, vtkImageData* image)
{
  int association = 0;
  const auto array = requireArray(choice, image, inputImage, association);
  const bool onPoints = association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  return std::make_unique<DensityImage>(
    withNumbers(image, array, onPoints), array, onPoints, choice.Rules);
}

// Each rank has a piece of one image, or nothing. nullptr if no rank has points.
std::unique_ptr<InputDensity> readPieces(
  const DensityChoice& choice, vtkImageData* image, const Ranks& ranks)
{
  // The array, by its association and its name; empty on ranks without points.
  std::string chosen;
  vtkSmartPointer<vtkImageData> own = image;
  if (image && image->GetNumberOfPoints() > 0)
  {
    int association = 0;
    const auto array = requireArray(choice, image, inputImage, association);
    const bool onPoints = association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
    requireTuples(array, image, onPoints, inputImage);
    requireName(array);
    chosen = (onPoints ? "the point array " : "the cell array ") + std::string(array->GetName());
    own = withNumbers(image, array, onPoints);
  }
  // From here on calls are collective, for ranks without points, too.
  auto pieces = std::make_unique<const ImagePieces>(own, ranks);
  if (isEmpty(pieces->Whole()))
  {
    return nullptr;
  }
  const std::string common =
    requireSameOnRanks(ranks, chosen, "The density is ", "it must be the same array on all");
  // Ranks without points learn association and name from the text that the others gave.
  const bool onPoints = common.rfind("the point", 0) == 0;
  const std::string name = common.substr(common.find("array ") + 6);
  return std::make_unique<PartitionedDensity>(std::move(pieces), name, onPoints, choice.Rules);
}

// Leaves such as tables carry no mass. That is an error if the input has nothing else, and a
// warning otherwise. Counts are those of all ranks, so that all of them fail or none does.
void reportOthers(const DensityChoice& choice, const SkippedLeaves& others, const Ranks& ranks)
{
  const auto count = sumOverRanks(ranks, others.Count);
  const auto sets = sumOverRanks(ranks, others.DataSets);
  if (count > 0 && sets == 0)
  {
    failSkipped("The density has", count, others);
  }
  if (count > 0)
  {
    choice.Warn(blocksText(count) + " of the input without cells of a data set" +
      others.FirstText() + " passed over");
  }
}

// The array that makes the density, the block in which it was found, and its association there.
struct FoundArray
{
  vtkSmartPointer<vtkDataArray> Array;
  std::size_t Block = 0;
  int Association = 0;
};

// In the first block of the most dimensions that has one. Without one, throws the Failure of the
// first block of the most dimensions.
FoundArray findArray(const DensityChoice& choice, const std::vector<DensityBlock>& blocks,
  const std::vector<int>& dimensions)
{
  const auto findIn = [&](std::size_t b) {
    FoundArray found;
    found.Array = requireArray(choice, blocks[b].Data, blocks[b].Name, found.Association);
    found.Block = b;
    return found;
  };
  std::vector<std::size_t> order; // the blocks with cells, those of the most dimensions first
  // A mesh often comes with its surface or its edges as further blocks. The volume is what has
  // mass, so that blocks of higher dimension are asked first.
  for (int dimension = 3; dimension > 0; --dimension)
  {
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      if (dimensions[b] == dimension)
      {
        order.push_back(b);
      }
    }
  }
  for (const std::size_t b : order)
  {
    try
    {
      return findIn(b);
    }
    catch (const Failure&)
    {
      // Blocks may lack an array that is named; others may have no array to choose from.
      int association = 0;
      if (choice.ArrayName.empty() ? hasArrays(blocks[b].Data)
                                   : choice.FindArray(blocks[b].Data, association) != nullptr)
      {
        throw;
      }
    }
  }
  // No block has the array: this throws the Failure of the first one, which lists its arrays.
  return findIn(order.front());
}

// That of another block, by its name or, if it has none, by how the first one was chosen.
// Arrays of different names or associations in two blocks are different quantities, even if both
// are active scalars. nullptr if the block has no such array.
vtkSmartPointer<vtkDataArray> arrayLike(
  const FoundArray& found, const DensityChoice& choice, const DensityBlock& block)
{
  const bool onPoints = found.Association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  if (const char* name = found.Array->GetName())
  {
    return numbersIn(
      attributesOf(block.Data, onPoints)->GetAbstractArray(name), choice, block.Data, block.Name);
  }
  int association = 0;
  auto* array = vtkDataArray::SafeDownCast(choice.FindArray(block.Data, association));
  return array && !array->GetName() && association == found.Association ? array : nullptr;
}

// Whether all points of a surface lie in a plane, those of no polygon as well.
bool isFlat(vtkPolyData* surface)
{
  return areInPlane(surface->GetNumberOfPoints(),
    [surface](std::int64_t i, double* position) { surface->GetPoint(i, position); });
}

// Whether the largest cells of the blocks are polygons that lie in no plane. Throws Failure for
// points that are not finite, and Cancelled.
bool areCurved(const std::vector<DensityBlock>& blocks, Progress& progress)
{
  if (blocks.size() == 1 && isFlat(vtkPolyData::SafeDownCast(blocks.front().Data)))
  {
    return false;
  }
  try
  {
    const CellSets sets = cellSetsOf(blocks);
    CellFrame::Of(sets, massCells(sets, 2, progress), progress);
    return false;
  }
  catch (const NotFlat&)
  {
    return true;
  }
}

// Sets the arrays of the blocks and leaves out those that cannot carry mass: those of fewer
// dimensions than the blocks with the array, and those of more dimensions without it.
DensityBlocks chooseArrays(
  const DensityChoice& choice, const std::vector<DensityBlock>& blocks, Progress& progress)
{
  // Damaged cells are found here, before anything reads them. Vertices have the dimension 0.
  std::vector<int> dimensions;
  bool arePolygons = true; // or lines
  for (const DensityBlock& block : blocks)
  {
    requireReadableCells(block.Data, block.Name);
    dimensions.push_back(largestCellDimension(block.Data));
    arePolygons = arePolygons && vtkPolyData::SafeDownCast(block.Data);
  }
  const int largest = *std::max_element(dimensions.begin(), dimensions.end());
  if (largest == 2 && arePolygons && areCurved(blocks, progress))
  {
    return { blocks, false, 3, true };
  }
  if (largest == 0)
  {
    throw Failure("The input has no cells of a length, area or volume, so that it has no density; "
                  "Splat Mass makes one of points");
  }
  const FoundArray found = findArray(choice, blocks, dimensions);
  // Blocks are matched by names here, as the blocks of another rank have other arrays in memory.
  if (progress.Group().AreSeveral())
  {
    requireName(found.Array);
  }
  DensityBlocks chosen{ {}, found.Association == vtkDataObject::FIELD_ASSOCIATION_POINTS,
    dimensions[found.Block] };
  std::int64_t all = 0;     // blocks of as many dimensions or more
  std::int64_t without = 0; // those among them that lack the array
  std::string first;        // the name of the first block without the array
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    // Faces of a volume, for example, have no volume and thus no mass.
    if (dimensions[b] < chosen.Dimension)
    {
      continue;
    }
    DensityBlock block = blocks[b];
    block.Array = b == found.Block ? found.Array : arrayLike(found, choice, block);
    block.Data = withNumbers(block.Data.Get(), block.Array, chosen.OnPoints);
    ++all;
    // Blocks of more dimensions lack the array, else the search would have taken theirs. They are
    // left out as well, and the warning counts them.
    first = !block.Array && without == 0 ? block.Name : first;
    without += block.Array ? 0 : 1;
    if (dimensions[b] == chosen.Dimension)
    {
      chosen.All.push_back(block);
    }
  }
  // Lengths are checked once it is clear which arrays are read.
  for (const DensityBlock& block : chosen.All)
  {
    if (block.Array)
    {
      requireTuples(block.Array, block.Data, chosen.OnPoints, block.Name);
    }
  }
  if (without > 0)
  {
    const char* name = found.Array->GetName();
    choice.Warn(std::to_string(without) + " of " + std::to_string(all) +
      " blocks of the input have no " + (chosen.OnPoints ? "point" : "cell") + " array " +
      (name ? std::string("'") + name + "'" : "without a name") +
      " and carry no mass (the first is " + first + ")");
  }
  return chosen;
}

// The kind of the data, the same on all ranks; empty if none has data. Collective.
std::string kindOf(vtkDataObject* input, const Ranks& ranks)
{
  // On a single process, data that are no image are read even if they are empty, for the message
  // about what they lack. On several ranks empty data mean that this rank has no part.
  const bool isImage = vtkImageData::SafeDownCast(input) != nullptr;
  const bool hasData = isImage || ranks.AreSeveral() ? hasElements(input) : input != nullptr;
  // Ranks without data take part.
  const char* kind = !hasData ? "" : isImage ? "an image" : "no image";
  return requireSameOnRanks(ranks, kind, "The density is ");
}

// Several values a point need not be a vector, but times or bands.
void warnOfAuto(const DensityChoice& choice, const DensityReading& reading)
{
  const int count = reading.Components;
  const bool isVector = count <= 3 || count == 6 || count == 9; // a tensor
  if (choice.Rules.Component == AutoComponent && reading.Component == Magnitude && !isVector)
  {
    choice.Warn("Component -1 (Auto) takes the magnitude of the " + std::to_string(count) +
      " components of the density array '" + reading.ArrayName +
      "'; if they are no vector, set Component");
  }
}

} // namespace

bool isAroundSolid(vtkDataObject* input)
{
  auto* surface = vtkPolyData::SafeDownCast(input);
  return hasElements(surface) && surface->GetNumberOfPolys() + surface->GetNumberOfStrips() > 0 &&
    !isFlat(surface);
}

std::unique_ptr<InputDensity> DensityInput::Read(
  const DensityChoice& choice, vtkDataObject* input, Progress& progress)
{
  const Ranks& ranks = progress.Group();
  const std::string kind = kindOf(input, ranks);
  if (kind.empty())
  {
    return nullptr;
  }
  requireArrayAssociation(choice.Association, "density array");
  std::unique_ptr<InputDensity> density;
  if (kind == "an image")
  {
    // What the last run made of other data is of no use and may take much memory.
    this->Resampled = ResampledDensity();
    this->Gathered = GatheredBlocks();
    auto* image = vtkImageData::SafeDownCast(input);
    density = ranks.AreSeveral() ? readPieces(choice, image, ranks) : readImage(choice, image);
  }
  else
  {
    density = this->ReadBlocks(choice, input, progress);
  }
  if (density)
  {
    warnOfAuto(choice, density->HowRead());
    // Once for each change of a density: what does not change it may run the filter, too.
    density->SetListener([this, warn = choice.Warn](
                           const std::vector<std::string>& lines, const DataIdentity& content) {
      const DataIdentity before = std::exchange(this->Warned, content);
      if (!content.HasHash() || !content.IsByContent(before))
      {
        std::for_each(lines.begin(), lines.end(), warn);
      }
    });
  }
  return density;
}

std::unique_ptr<InputDensity> DensityInput::ReadBlocks(
  const DensityChoice& choice, vtkDataObject* input, Progress& progress)
{
  // Collective: ranks without blocks take part with none, and after Gather every rank has all
  // blocks, so that all of them resample the same density.
  SkippedLeaves others;
  const Ranks& ranks = progress.Group();
  std::vector<DensityBlock> blocks = densityBlocks(input, &others, &progress, ranks);
  if (ranks.AreSeveral())
  {
    blocks = this->Gathered.Gather(blocks, ranks, progress);
  }
  reportOthers(choice, others, ranks);
  if (blocks.empty())
  {
    return nullptr;
  }
  auto density = this->Resampled.Read(
    chooseArrays(choice, blocks, progress), choice.Resolution, choice.Rules, progress);
  for (const std::string& warning : this->Resampled.Warnings())
  {
    choice.Warn(warning);
  }
  return density;
}

} // namespace RectifiedTransport::Bridge
