// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDensityAlgorithm.h"

#include "Bridge/Blocks/BlockArrays.h"
#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Blocks/GatheredInputs.h"
#include "Bridge/Density/DensityFailure.h"
#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/FlowCache.h"
#include "Bridge/Image/DefaultArray.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/CellCheck.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Bridge/Ranks/SameOnRanks.h"
#include "Bridge/Resampling/ResampledDensity.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/InputExtents.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

using namespace RectifiedTransport;

namespace
{
const char* const NegativeValuesTexts[] = { "Error", "Clamp" };

bool isAssociation(int association)
{
  return association == vtkDataObject::FIELD_ASSOCIATION_POINTS ||
    association == vtkDataObject::FIELD_ASSOCIATION_CELLS ||
    association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
}

bool hasElements(vtkDataObject* data)
{
  return data &&
    (data->GetNumberOfElements(vtkDataObject::POINT) > 0 ||
      data->GetNumberOfElements(vtkDataObject::CELL) > 0);
}
} // namespace

struct vtkDensityAlgorithm::vtkInternals
{
  FlowCache Cache;
  std::map<int, ResampledDensity> Resampled; // by the number of the input
  std::map<int, GatheredBlocks> Gathered;    // where it lies on several ranks
  std::map<int, DensityImage::Content> Told; // of whose unusual values a warning told
  bool IsAnnouncing = false;                 // the run that follows gives the warnings
};

//------------------------------------------------------------------------------
vtkDensityAlgorithm::vtkDensityAlgorithm(int densityPort)
  : Component(-1)
  , InvertDensity(false)
  , NegativeValues(NEGATIVE_VALUES_ERROR)
  , DensityResolution(256)
  , DensityPort(densityPort)
  , Internals(new vtkInternals)
{
  this->SetInputArrayToProcess(0, densityPort, 0,
    vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkDensityAlgorithm::~vtkDensityAlgorithm() = default;

//------------------------------------------------------------------------------
const char* vtkDensityAlgorithm::GetNegativeValuesAsString()
{
  return choiceText(NegativeValuesTexts, this->NegativeValues);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkDensityAlgorithm::GetTableBuildTime()
{
  return this->Internals->Cache.BuildTime();
}

//------------------------------------------------------------------------------
FlowCache& vtkDensityAlgorithm::GetFlowCache()
{
  return this->Internals->Cache;
}

//------------------------------------------------------------------------------
void vtkDensityAlgorithm::FillDensityPortInformation(vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  // Without this the executive would execute the filter once for each block.
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkHyperTreeGrid");
}

//------------------------------------------------------------------------------
std::unique_ptr<DensityImage> vtkDensityAlgorithm::ReadDensity(
  vtkInformationVector** inputVector, RectifiedTransport::Progress& progress)
{
  return this->ReadDensity(vtkDataObject::GetData(inputVector[this->DensityPort], 0), progress);
}

//------------------------------------------------------------------------------
std::unique_ptr<DensityImage> vtkDensityAlgorithm::ReadDensity(
  vtkDataObject* input, RectifiedTransport::Progress& progress, int arrayIndex, int number)
{
  // Warns once for each change of a density: what does not change it may run the filter, too.
  const auto listenTo = [this, number](std::unique_ptr<DensityImage> density) {
    if (density)
    {
      density->SetListener([this, number](const std::vector<std::string>& lines,
                             const DensityImage::Content& content) {
        const DensityImage::Content before = std::exchange(this->Internals->Told[number], content);
        for (std::size_t i = 0; (content != before || content[0] == 0) && i < lines.size(); ++i)
        {
          this->WarnOnFirstRank(lines[i]);
        }
      });
    }
    return density;
  };
  requireChoice("NegativeValues", this->NegativeValues, NegativeValuesTexts);
  requireResolution("DensityResolution", this->DensityResolution);
  const int association =
    this->GetInputArrayInformation(arrayIndex)->Get(vtkDataObject::FIELD_ASSOCIATION());
  auto* image = vtkImageData::SafeDownCast(input);
  const Ranks& ranks = this->GetRanks();
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
  if (!isAssociation(association))
  {
    throw Failure("The field association of the density array is " + std::to_string(association) +
      "; it must be 0 (points), 1 (cells) or 3 (points, then cells)");
  }
  if (kind != "an image")
  {
    return listenTo(this->ReadResampled(input, progress, arrayIndex, number));
  }
  this->Internals->Resampled.erase(number);
  this->Internals->Gathered.erase(number);
  if (ranks.AreSeveral())
  {
    return listenTo(this->ReadPieces(image, arrayIndex));
  }
  int found = 0;
  vtkDataArray* array = this->RequireDensityArray(image, arrayIndex, "input image", found);
  return listenTo(std::make_unique<DensityImage>(
    image, array, found == vtkDataObject::FIELD_ASSOCIATION_POINTS, this->GetDensityRules()));
}

//------------------------------------------------------------------------------
std::unique_ptr<DensityImage> vtkDensityAlgorithm::ReadPieces(vtkImageData* image, int arrayIndex)
{
  const Ranks& ranks = this->GetRanks();
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
    vtkDataArray* array = this->RequireDensityArray(image, arrayIndex, "input image", association);
    const bool onPoints = association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
    requireTuples(array, image, onPoints, "input image");
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
  return std::make_unique<DensityImage>(std::move(pieces), name, onPoints, this->GetDensityRules());
}

//------------------------------------------------------------------------------
std::unique_ptr<DensityImage> vtkDensityAlgorithm::ReadResampled(
  vtkDataObject* input, RectifiedTransport::Progress& progress, int arrayIndex, int number)
{
  OtherLeaves others;
  const Ranks& ranks = this->GetRanks();
  std::vector<DensityBlock> blocks = densityBlocks(input, &others, &progress, ranks);
  if (ranks.AreSeveral())
  {
    blocks = this->Internals->Gathered[number].Gather(blocks, ranks, progress);
  }
  this->ReportOthers(others);
  if (blocks.empty())
  {
    return nullptr;
  }
  for (const DensityBlock& block : blocks)
  {
    requireReadableCells(block.Data, block.Name);
  }
  const char* name = this->GetInputArrayInformation(arrayIndex)->Get(vtkDataObject::FIELD_NAME());
  const bool isNamed = name && *name;
  const BlockArrays arrays = BlockArrays::Set(
    [&](const DensityBlock& block, int& association) {
      return this->RequireDensityArray(block.Data, arrayIndex, block.Name, association);
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
    this->WarnOfDensity(std::to_string(arrays.Without) + " of " + std::to_string(arrays.All) +
      " blocks of the input have no " + (arrays.OnPoints ? "point" : "cell") + " array '" +
      (found ? found : "") + "' and carry no mass");
  }
  ResampledDensity& made = this->Internals->Resampled[number];
  made.Update(blocks, arrays.OnPoints, arrays.Dimension, this->DensityResolution,
    this->GetDensityRules(), progress);
  for (const std::string& warning : made.Warnings())
  {
    this->WarnOfDensity(warning);
  }
  auto density = std::make_unique<DensityImage>(made.Image(), made.Array(), made.IsOnPoints(),
    made.IsResampled() ? DensityRules() : this->GetDensityRules());
  if (made.IsResampled())
  {
    density->SetFindings(made.Findings());
  }
  return density;
}

//------------------------------------------------------------------------------
void vtkDensityAlgorithm::WarnOfDensity(const std::string& text)
{
  if (!this->Internals->IsAnnouncing)
  {
    this->WarnOnFirstRank(text);
  }
}

//------------------------------------------------------------------------------
void vtkDensityAlgorithm::ReportOthers(const OtherLeaves& others)
{
  const Ranks& ranks = this->GetRanks();
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
    this->WarnOfDensity(std::to_string(count) + (count == 1 ? " block" : " blocks") +
      " of the input without cells of a data set" + first + " passed over");
  }
}

//------------------------------------------------------------------------------
const std::vector<BlockValues>* vtkDensityAlgorithm::GetMeshes(int number) const
{
  const auto made = this->Internals->Resampled.find(number);
  return made == this->Internals->Resampled.end() || !made->second.IsResampled()
    ? nullptr
    : &made->second.Meshes();
}

//------------------------------------------------------------------------------
DensityRules vtkDensityAlgorithm::GetDensityRules()
{
  DensityRules rules;
  rules.Component = this->Component;
  rules.Invert = this->InvertDensity != 0;
  rules.ClampNegative = this->NegativeValues == NEGATIVE_VALUES_CLAMP;
  return rules;
}

//------------------------------------------------------------------------------
vtkDataArray* vtkDensityAlgorithm::RequireDensityArray(
  vtkDataSet* data, int arrayIndex, const std::string& what, int& association)
{
  const char* name = this->GetInputArrayInformation(arrayIndex)->Get(vtkDataObject::FIELD_NAME());
  const bool isNamed = name && *name;
  vtkAbstractArray* chosen = this->FindDensityArray(data, arrayIndex, association);
  vtkDataArray* array = vtkDataArray::SafeDownCast(chosen);
  if (!array)
  {
    throw Failure(
      (chosen       ? "The density array '" + std::string(name ? name : "") + "' is not numeric"
          : isNamed ? "The " + what + " has no density array '" + std::string(name) + "'"
                    : "The " + what + " has no active scalars for a density") +
      "; it has " + listArrays(data->GetPointData(), "point") + " and " +
      listArrays(data->GetCellData(), "cell") +
      (isNamed || !hasIds(data) ? "" : " (ids and flags are a density only where they are named)"));
  }
  return array;
}

//------------------------------------------------------------------------------
vtkAbstractArray* vtkDensityAlgorithm::FindDensityArray(
  vtkDataSet* data, int arrayIndex, int& association)
{
  vtkInformation* choice = this->GetInputArrayInformation(arrayIndex);
  association = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  if (!isAssociation(association))
  {
    return nullptr; // GetInputAbstractArrayToProcess would report another error
  }
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  vtkAbstractArray* chosen = this->GetInputAbstractArrayToProcess(arrayIndex, data, association);
  const bool isNamed = name && *name;
  const bool isDefault = !isNamed && chosen &&
    isIds(data->GetAttributes(association == vtkDataObject::FIELD_ASSOCIATION_CELLS
              ? vtkDataObject::CELL
              : vtkDataObject::POINT),
      chosen);
  return isNamed || (chosen && !isDefault) ? chosen : defaultArray(data, association);
}

//------------------------------------------------------------------------------
ImageGrid vtkDensityAlgorithm::AnnouncedDensityGrid(
  vtkInformation* inputInformation, int arrayIndex, int number)
{
  vtkDataObject* data = vtkDataObject::GetData(inputInformation);
  // Where ranks have data of several types, all of them read these.
  if (onAllRanks(this->GetRanks(), !data || vtkImageData::SafeDownCast(data)))
  {
    return announcedGrid(inputInformation, this->IsDensityOnPoints(inputInformation, arrayIndex));
  }
  return this->FindDensityGrid(data, arrayIndex, number);
}

//------------------------------------------------------------------------------
ImageGrid vtkDensityAlgorithm::FindDensityGrid(vtkDataObject* data, int arrayIndex, int number)
{
  AlgorithmProgress progress(this, this->Threading);
  bool& isAnnouncing = this->Internals->IsAnnouncing;
  isAnnouncing = true;
  try
  {
    requireExtents(data, "input"); // of data that come, those of all inputs are looked at
    const auto density = this->ReadDensity(data, progress, arrayIndex, number);
    isAnnouncing = false;
    return density ? density->Grid() : ImageGrid();
  }
  catch (...)
  {
    isAnnouncing = false;
    throw;
  }
}

//------------------------------------------------------------------------------
bool vtkDensityAlgorithm::IsDensityOnPoints(vtkInformation* inputInformation, int arrayIndex)
{
  int association =
    this->GetInputArrayInformation(arrayIndex)->Get(vtkDataObject::FIELD_ASSOCIATION());
  vtkImageData* image = vtkImageData::GetData(inputInformation);
  if (image && isReadable(image->GetExtent()) && image->GetNumberOfPoints() > 0)
  {
    this->FindDensityArray(image, arrayIndex, association);
  }
  if (association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS)
  {
    return announcesScalars(inputInformation, vtkDataObject::FIELD_ASSOCIATION_POINTS) ||
      !announcesScalars(inputInformation, vtkDataObject::FIELD_ASSOCIATION_CELLS);
  }
  return association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
}

//------------------------------------------------------------------------------
void vtkDensityAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Component: " << this->Component << "\n";
  os << indent << "InvertDensity: " << (this->InvertDensity ? "On" : "Off") << "\n";
  os << indent << "NegativeValues: " << this->GetNegativeValuesAsString() << "\n";
  os << indent << "DensityResolution: " << this->DensityResolution << "\n";
  os << indent << "DensityPort: " << this->DensityPort << "\n";
  os << indent << "TableBuildTime: " << this->GetTableBuildTime() << "\n";
}
VTK_ABI_NAMESPACE_END
