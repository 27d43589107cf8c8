// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Inputs/DensityInput.h"

#include "Bridge/Blocks/BlockArrays.h"
#include "Bridge/Density/DensityFailure.h"
#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/PiecesDensity.h"
#include "Bridge/Image/DefaultArray.h"
#include "Bridge/Points/CellCheck.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Ranks/SameOnRanks.h"
#include "Bridge/Resampling/MeshInput.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/Failure.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

namespace
{

bool hasElements(vtkDataObject* data)
{
  return data &&
    (data->GetNumberOfElements(vtkDataObject::POINT) > 0 ||
      data->GetNumberOfElements(vtkDataObject::CELL) > 0);
}

// `what` names the data set.
vtkDataArray* requireArray(
  const DensityChoice& choice, vtkDataSet* data, const std::string& what, int& association)
{
  vtkAbstractArray* chosen = choice.FindArray(data, association);
  vtkDataArray* array = vtkDataArray::SafeDownCast(chosen);
  if (!array)
  {
    const bool isNamed = !choice.ArrayName.empty();
    throw Failure((chosen       ? "The density array '" + choice.ArrayName + "' is not numeric"
                      : isNamed ? "The " + what + " has no density array '" + choice.ArrayName + "'"
                                : "The " + what + " has no active scalars for a density") +
      "; it has " + listArrays(data->GetPointData(), "point") + " and " +
      listArrays(data->GetCellData(), "cell") +
      (isNamed || !hasIds(data) ? "" : " (ids and flags are a density only where they are named)"));
  }
  return array;
}

constexpr const char* inputImage = "input image";

std::unique_ptr<InputDensity> readImage(const DensityChoice& choice, vtkImageData* image)
{
  int association = 0;
  vtkDataArray* array = requireArray(choice, image, inputImage, association);
  return std::make_unique<DensityImage>(
    image, array, association == vtkDataObject::FIELD_ASSOCIATION_POINTS, choice.Rules);
}

std::unique_ptr<InputDensity> readPieces(
  const DensityChoice& choice, vtkImageData* image, const Ranks& ranks)
{
  auto pieces = std::make_unique<const ImagePieces>(image, ranks);
  if (isEmpty(pieces->Whole()))
  {
    return nullptr;
  }
  // The array, by its association and its name; empty on ranks without points.
  std::string chosen;
  if (image && image->GetNumberOfPoints() > 0)
  {
    int association = 0;
    vtkDataArray* array = requireArray(choice, image, inputImage, association);
    const bool onPoints = association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
    requireTuples(array, image, onPoints, inputImage);
    if (!array->GetName())
    {
      throw Failure("The density array has no name; on several ranks it must have one");
    }
    chosen = (onPoints ? "the point array " : "the cell array ") + std::string(array->GetName());
  }
  const std::string common =
    requireSameOnRanks(ranks, chosen, "The density is ", "it must be the same array on all");
  const bool onPoints = common.rfind("the point", 0) == 0;
  const std::string name = common.substr(common.find("array ") + 6);
  return std::make_unique<PiecesDensity>(std::move(pieces), name, onPoints, choice.Rules);
}

void reportOthers(const DensityChoice& choice, const OtherLeaves& others, const Ranks& ranks)
{
  const auto count = sumOverRanks(ranks, others.Count);
  const auto sets = sumOverRanks(ranks, others.DataSets);
  const std::string first = others.First.empty() ? "" : " (the first a " + others.First + ")";
  if (count > 0 && sets == 0)
  {
    throw Failure("The density has no image, mesh or grid, but " + std::to_string(count) +
      (count == 1 ? " block" : " blocks") + " of another type" + first);
  }
  if (count > 0)
  {
    choice.Warn(std::to_string(count) + (count == 1 ? " block" : " blocks") +
      " of the input without cells of a data set" + first + " passed over");
  }
}

// Sets the arrays of blocks, and warns of those that have none.
BlockArrays chooseArrays(const DensityChoice& choice, std::vector<DensityBlock>& blocks)
{
  for (const DensityBlock& block : blocks)
  {
    requireReadableCells(block.Data, block.Name);
  }
  const bool isNamed = !choice.ArrayName.empty();
  const BlockArrays arrays = BlockArrays::Set(
    [&](const DensityBlock& block, int& association) {
      return requireArray(choice, block.Data, block.Name, association);
    },
    [&](vtkDataSet* data) { return isNamed || !hasArrays(data); }, blocks);
  for (const DensityBlock& block : blocks)
  {
    if (block.Array)
    {
      requireTuples(block.Array, block.Data, arrays.OnPoints, block.Name);
    }
  }
  if (arrays.Without > 0)
  {
    const DensityBlock& first = *std::find_if(
      blocks.begin(), blocks.end(), [](const DensityBlock& block) { return block.Array; });
    const char* found = first.Array->GetName();
    choice.Warn(std::to_string(arrays.Without) + " of " + std::to_string(arrays.All) +
      " blocks of the input have no " + (arrays.OnPoints ? "point" : "cell") + " array '" +
      (found ? found : "") + "' and carry no mass");
  }
  return arrays;
}

} // namespace

std::unique_ptr<InputDensity> DensityInput::Read(
  const DensityChoice& choice, vtkDataObject* input, Progress& progress)
{
  auto density = this->ReadAny(choice, input, progress);
  if (density)
  {
    density->SetListener(
      [this, &choice](const std::vector<std::string>& lines, const InputDensity::Content& content) {
        this->Tell(choice, lines, content);
      });
  }
  return density;
}

// Once for each change of a density: what does not change it may run the filter, too.
void DensityInput::Tell(const DensityChoice& choice, const std::vector<std::string>& lines,
  const InputDensity::Content& content)
{
  const InputDensity::Content before = std::exchange(this->Told, content);
  if (content != before || content[0] == 0)
  {
    std::for_each(lines.begin(), lines.end(), choice.WarnOfValues);
  }
}

std::unique_ptr<InputDensity> DensityInput::ReadAny(
  const DensityChoice& choice, vtkDataObject* input, Progress& progress)
{
  const Ranks& ranks = progress.Group();
  auto* image = vtkImageData::SafeDownCast(input);
  const bool hasData = image || ranks.AreSeveral() ? hasElements(input) : input != nullptr;
  // Ranks without data take part.
  const std::string kind = requireSameOnRanks(ranks,
    !hasData  ? ""
      : image ? "an image"
              : "no image",
    "The density is ");
  if (kind.empty())
  {
    return nullptr;
  }
  if (!isDensityAssociation(choice.Association))
  {
    throw Failure("The field association of the density array is " +
      std::to_string(choice.Association) +
      "; it must be 0 (points), 1 (cells) or 3 (points, then cells)");
  }
  if (kind != "an image")
  {
    return this->ReadBlocks(choice, input, progress);
  }
  this->Resampled = ResampledDensity();
  this->Gathered = GatheredBlocks();
  return ranks.AreSeveral() ? readPieces(choice, image, ranks) : readImage(choice, image);
}

std::unique_ptr<InputDensity> DensityInput::ReadBlocks(
  const DensityChoice& choice, vtkDataObject* input, Progress& progress)
{
  OtherLeaves others;
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
  const BlockArrays arrays = chooseArrays(choice, blocks);
  this->Resampled.Update(
    blocks, arrays.OnPoints, arrays.Dimension, choice.Resolution, choice.Rules, progress);
  for (const std::string& warning : this->Resampled.Warnings())
  {
    choice.Warn(warning);
  }
  return std::make_unique<MeshInput>(this->Resampled, choice.Rules);
}

bool isDensityAssociation(int association)
{
  return association == vtkDataObject::FIELD_ASSOCIATION_POINTS ||
    association == vtkDataObject::FIELD_ASSOCIATION_CELLS ||
    association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
}

} // namespace RectifiedTransport
