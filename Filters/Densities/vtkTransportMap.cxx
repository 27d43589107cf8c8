// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportMap.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Flow/TransportMap.h"
#include "Bridge/Ranks/RankConsistency.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Settings/MissingData.h"
#include "Bridge/Run/Settings/TargetArray.h"
#include "Bridge/Run/StepReport.h"
#include "Core/Device/DeviceUse.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Messages/Failure.h"
#include "Core/Messages/PartText.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportMap);

namespace
{
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

// The enumeration of the class indexes these.
const char* const DirectionTexts[] = { "UniformToDensity", "DensityToUniform" };

// What messages call the inputs of a map to a target.
const char* const InputNames[] = { "Source", "Target" };

// The connection decides whether the map leads to a target: its data may be missing after an abort
// upstream, and the outputs are then empty rather than those of another map.
bool hasTarget(vtkInformationVector** inputVector)
{
  return inputVector[1]->GetNumberOfInformationObjects() > 0;
}
} // namespace

//------------------------------------------------------------------------------
vtkTransportMap::vtkTransportMap()
{
  this->AddDensityPort(PORT_PARTITIONED_DENSITY);
  this->AddDensityPort(PORT_PARTITIONED_DENSITY, PORT_OPTIONAL_INPUT);
  this->AddOutputPort("vtkImageData");
  vtkTransportMap::SetInputArrayToProcess(
    1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "");
}

//------------------------------------------------------------------------------
vtkTransportMap::~vtkTransportMap() = default;

//------------------------------------------------------------------------------
const char* vtkTransportMap::GetDirectionAsString()
{
  return choiceText(DirectionTexts, this->Direction);
}

//------------------------------------------------------------------------------
const char* vtkTransportMap::GetEmptyCellsAsString()
{
  return choiceText(EmptyCellsTexts, this->EmptyCells);
}

//------------------------------------------------------------------------------
void vtkTransportMap::SetInputArrayToProcess(
  int idx, int port, int connection, int fieldAssociation, const char* name)
{
  const auto [index, arrayPort] = targetArray(idx, port);
  this->Superclass::SetInputArrayToProcess(index, arrayPort, connection, fieldAssociation, name);
}

//------------------------------------------------------------------------------
// Announces the grid of the samples before the data: image filters downstream request extents of
// it. Only images announce their grid themselves; the producers of other data are updated on all
// ranks.
int vtkTransportMap::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // The samples are those of the density that the map begins at, if it leads to another one.
  const int port = hasTarget(inputVector) && this->Direction == DENSITY_TO_UNIFORM ? 1 : 0;
  vtkInformation* inputInformation = inputVector[port]->GetInformationObject(0);
  vtkInformation* outputInformation = outputVector->GetInformationObject(0);
  if (!vtkImageData::GetData(inputInformation))
  {
    this->UpdateInputOnRanks(port, inputVector, outputVector);
  }
  announceSubExtents(outputInformation);
  const ImageGrid inputGrid = this->AnnouncedDensityGrid(inputInformation, port, port);
  // An unknown grid is announced as empty: nothing is requested downstream of it.
  announceGrid(inputGrid, outputInformation);
  if (inputGrid.IsEmpty())
  {
    return 1;
  }
  const ImageGrid grid = gridWithValues(inputGrid, this->SampleDimensions, "SampleDimensions");
  announceGrid(grid, outputInformation);
  if (grid.Extent() == inputGrid.Extent())
  {
    // The input's scalars are passed on.
    for (auto* key : { vtkDataObject::POINT_DATA_VECTOR(), vtkDataObject::CELL_DATA_VECTOR() })
    {
      if (inputInformation->Has(key))
      {
        outputInformation->CopyEntry(inputInformation, key, 1);
      }
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
// Reads the densities of both ports, on ranks collectively: the second one is read even if the
// first one has no points, because another rank might have some. Returns whether both have points.
bool vtkTransportMap::ReadPair(vtkInformationVector** inputVector,
  RectifiedTransport::Progress& progress, std::unique_ptr<InputDensity>* densities)
{
  bool haveBoth = true;
  for (int port = 0; port < 2; ++port)
  {
    vtkDataObject* data = vtkDataObject::GetData(inputVector[port], 0);
    densities[port] =
      withName(InputNames[port], [&]() { return this->ReadDensity(data, progress, port, port); });
    haveBoth = haveBoth && densities[port];
    if (haveBoth)
    {
      densities[port]->SetInputName(InputNames[port]);
    }
  }
  return haveBoth;
}

//------------------------------------------------------------------------------
int vtkTransportMap::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireChoice("Direction", this->Direction, DirectionTexts);
  // All properties are checked before anything is read, so that a wrong value is an error at once.
  TransportMap map{ this->GetTransportSettings() };
  map.Backward = this->Direction == DENSITY_TO_UNIFORM;
  map.EqualizeAreas = this->EqualizeAreas != 0;
  std::copy_n(this->SampleDimensions, 3, map.SampleDimensions.begin());
  const Ranks& ranks = this->GetRanks();
  // The device is opened before the progress, which hands it on to the loops; EndDevice warns after
  // the run if it did not serve.
  DeviceUse device = this->BeginDevice();
  AlgorithmProgress progress(this, this->Threading, ranks, &device);
  Stages stages(progress, { { "reading", 5 }, { "map", 95 } });

  // These are by port. Without a target the second one stays nullptr, and what an earlier target
  // left in memory is released.
  std::array<std::unique_ptr<InputDensity>, 2> densities;
  const bool isToTarget = hasTarget(inputVector);
  if (!isToTarget)
  {
    this->ToTarget = nullptr;
    densities[0] = this->ReadDensity(inputVector, stages["reading"]);
  }
  else if (!this->ReadPair(inputVector, stages["reading"], densities.data()))
  {
    return 1;
  }
  else if (!this->ToTarget)
  {
    this->ToTarget = std::make_unique<TargetCache>();
  }
  // DENSITY_TO_UNIFORM exchanges the ends of a map between two densities: it begins at the target.
  const int first = isToTarget && map.Backward ? 1 : 0;
  InputDensity* density = densities[first].get();
  if (!density)
  {
    return 1;
  }
  vtkImageData* output = vtkImageData::GetData(outputVector);
  vtkInformation* outputInformation = outputVector->GetInformationObject(0);
  // Each rank makes only the samples that it gives downstream.
  const Extent wanted = extentToGive(map.SampleGrid(*density).Extent(), outputInformation, ranks);
  std::optional<TargetDensity> goal;
  if (isToTarget)
  {
    goal.emplace(
      *density, InputNames[first], *densities[1 - first], InputNames[1 - first], *this->ToTarget);
  }
  const TransportMap::Report result =
    map.Run(*density, goal ? &*goal : nullptr, wanted, this->GetFlowCache(), stages["map"], output);
  std::vector<DensityReading> readings;
  for (const auto& one : densities)
  {
    if (one)
    {
      readings.push_back(one->HowRead());
    }
  }
  addReadings(output, readings);
  this->EndDevice(device);
  // The association of the density may not be known before the data.
  announceGrid(result.Grid, outputInformation);
  this->WarnOnFirstRank(result.Transport.Warning);
  // A map between two densities goes back along the flow of the one to the uniform measure and
  // forth along that of the other: the first report is of a backward flow.
  for (std::size_t i = 0; i < result.Flows.size(); ++i)
  {
    const bool isBack = isToTarget ? i == 0 : map.Backward;
    std::string warning = stepWarning(
      result.Flows[i], map.Flow, isBack ? FlowDirection::Backward : FlowDirection::Forward);
    if (isToTarget && !warning.empty())
    {
      warning.insert(0, std::string(InputNames[isBack ? first : 1 - first]) + ": ");
    }
    this->WarnOnFirstRank(warning);
  }
  if (result.IsUncorrected)
  {
    this->WarnOfAreas();
  }
  const auto samples = static_cast<std::int64_t>(result.Samples);
  // A sample that ends in an empty cell has been moved to mass; field data count these, too, where
  // they are too few for a warning.
  if (isWorthWarning(result.MovedToMass, samples))
  {
    this->WarnOnFirstRank(std::to_string(result.MovedToMass) + " of " + std::to_string(samples) +
      " samples in empty cells moved to the nearest cell with mass" +
      result.Transport.WithSteps(" (more NumberOfSteps may spare them that)"));
  }
  // A fold has a Jacobian that is not positive: there the map is no bijection, and its inverse and
  // the push-forward by it are wrong. The advice names what helps in each direction.
  if (result.ShowsFolds)
  {
    this->WarnOnFirstRank(describePart(result.Folded, samples, "samples") +
      " are folded: JacobianDeterminant is 0 or negative there" +
      result.Transport.WithSteps(map.Backward || isToTarget
          ? "; more NumberOfSteps unfold most, but not beside regions without mass, where the map "
            "tears"
          : "; more NumberOfSteps unfold some, but not at sharp edges of the density, where only a "
            "smoother one helps"));
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportMap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Direction: " << this->GetDirectionAsString() << "\n";
  os << indent << "SampleDimensions: " << this->SampleDimensions[0] << " "
     << this->SampleDimensions[1] << " " << this->SampleDimensions[2] << "\n";
  os << indent << "EmptyCells: " << this->GetEmptyCellsAsString() << "\n";
  os << indent << "EmptyValue: " << this->EmptyValue << "\n";
  os << indent << "EqualizeAreas: " << (this->EqualizeAreas ? "On" : "Off") << "\n";
}
VTK_ABI_NAMESPACE_END
