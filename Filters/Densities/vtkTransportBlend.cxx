// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportBlend.h"

#include "Bridge/Blocks/ConnectedInputs.h"
#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Ensembles/DensityBlend.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Settings/SplatSettings.h"
#include "Core/Device/DeviceUse.h"
#include "Core/Geometry/Boxes/CommonGrid.h"
#include "Core/Messages/Failure.h"
#include "Core/Messages/PartText.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace
{
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

// The enumeration of the class indexes these.
const char* const MassModeTexts[] = { "Linear", "Geometric", "Source", "Normalize" };

// The property Weights: one weight an input, with the sum 1; equal ones for an empty list. Throws
// Failure for a list of another length, weights that are negative or not finite, and weights that
// are all 0.
std::vector<double> normalizedWeights(const std::vector<double>& list, std::size_t inputs)
{
  if (list.empty())
  {
    return std::vector<double>(inputs, 1.0 / static_cast<double>(inputs));
  }
  std::ostringstream message;
  if (list.size() != inputs)
  {
    message << "The number of Weights is " << list.size() << " and that of inputs " << inputs
            << "; there must be one for each, or none for equal weights";
    throw Failure(message.str());
  }
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    // The negation refuses NaN, too.
    if (!(list[i] >= 0.0) || std::isinf(list[i]))
    {
      message << "Weight " << i << " of the Weights is " << list[i]
              << "; weights must be finite and at least 0";
      throw Failure(message.str());
    }
  }
  const double largest = *std::max_element(list.begin(), list.end());
  if (largest == 0.0)
  {
    throw Failure("All Weights are 0; at least one must be above 0");
  }
  // Divided by the largest first only where the sum overflows: weights of sum 1 remain unchanged.
  const bool fits = std::isfinite(std::accumulate(list.begin(), list.end(), 0.0));
  std::vector<double> weights;
  for (const double weight : list)
  {
    weights.push_back(fits ? weight : weight / largest);
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights)
  {
    weight /= sum;
  }
  return weights;
}
} // namespace

//------------------------------------------------------------------------------
vtkTransportBlend::vtkTransportBlend(bool blocksAreInputs)
  : BlocksAreInputs(blocksAreInputs)
  , Blend(new DensityBlend)
{
  this->AddOutputPort("vtkImageData");
  this->AddOutputPort("vtkPolyData");
}

//------------------------------------------------------------------------------
vtkTransportBlend::~vtkTransportBlend() = default;

//------------------------------------------------------------------------------
const char* vtkTransportBlend::GetMassModeAsString()
{
  return choiceText(MassModeTexts, this->MassMode);
}

//------------------------------------------------------------------------------
const char* vtkTransportBlend::GetKernelAsString()
{
  return choiceText(KernelTexts, this->Kernel);
}

//------------------------------------------------------------------------------
void vtkTransportBlend::SetResultArrayName(const char* name)
{
  if (this->ResultArrayName != (name ? name : ""))
  {
    this->ResultArrayName = name ? name : "";
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkTransportBlend::GetResultArrayName()
{
  return this->ResultArrayName.c_str();
}

//------------------------------------------------------------------------------
// Checks the properties before inputs are read, and gives them to the worker.
RectifiedTransport::Bridge::BlendSettings vtkTransportBlend::GetBlendSettings()
{
  requireThat(this->ParticlesPerCell >= 0, "ParticlesPerCell", this->ParticlesPerCell,
    "at least 1, or 0 for Auto");
  requireChoice("MassMode", this->MassMode, MassModeTexts);
  BlendSettings settings{ this->GetTransportSettings() };
  std::copy_n(this->Dimensions, 3, settings.Dimensions);
  // With fewer, surfaces of solids have terraces; with more, pictures are hardly better.
  constexpr int autoParticles = 4;
  settings.ParticlesPerCell = this->ParticlesPerCell > 0 ? this->ParticlesPerCell : autoParticles;
  settings.Mode = static_cast<BlendedMass>(this->MassMode);
  settings.ArrayName = this->ResultArrayName;
  settings.Splat = splatOptions(this->Kernel, this->Radius);
  return settings;
}

//------------------------------------------------------------------------------
// Announces the smallest box that holds all inputs before the data. Images announce their grids;
// other data have to be read for theirs. Unless all grids are known, nothing is announced here.
int vtkTransportBlend::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  announceSubExtents(outputVector->GetInformationObject(0));
  std::vector<NamedGrid> grids;
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputVector[port]->GetInformationObject(i);
      vtkDataObject* data = vtkDataObject::GetData(input);
      if (!data || vtkImageData::SafeDownCast(data))
      {
        grids.push_back({ this->AnnouncedDensityGrid(input, port), "" });
        continue;
      }
      // The information of other data has no extents.
      this->UpdateInputOnRanks(port, inputVector, outputVector, i);
      const auto blocks = gatherBlocks(vtkDataObject::GetData(input), this->BlocksAreInputs);
      requireSameNumber(blocks.All.size(), this->GetRanks());
      // The numbers are those that ReadInputs gives the same blocks, so that what is read for the
      // grid is kept for the run.
      for (const ConnectedInput& block : blocks.All)
      {
        const int number = static_cast<int>(grids.size());
        grids.push_back({ this->FindDensityGrid(block.Data, port, number), "" });
      }
    }
  }
  // The limit OfTheLargest keeps a fine spacing of one input from filling the box of another one.
  const bool areKnown = std::none_of(
    grids.begin(), grids.end(), [](const NamedGrid& grid) { return grid.Grid.IsEmpty(); });
  if (areKnown && !grids.empty())
  {
    announceDensity(commonGrid(grids, this->Dimensions, MostCells::OfTheLargest),
      outputVector->GetInformationObject(0),
      this->ResultArrayName.empty() ? nullptr : this->ResultArrayName.c_str());
  }
  return 1;
}

//------------------------------------------------------------------------------
// Reads all densities, in the order of ports, connections and blocks. Ranks must have the same
// number of them, because reading is collective. Returns no inputs if one of them has no points: a
// blend of the others would be wrong. `names` are those of ports in messages, nullptr for numbers.
std::vector<BlendInput> vtkTransportBlend::ReadInputs(vtkInformationVector** inputVector,
  const char* const* names, RectifiedTransport::Progress& progress)
{
  const ConnectedInputs connected =
    gatherInputs(inputVector, this->GetNumberOfInputPorts(), this->BlocksAreInputs);
  requireSameNumber(connected.All.size(), this->GetRanks());
  this->WarnOnFirstRank(describeSkipped(connected));
  std::vector<BlendInput> inputs;
  Parts parts(progress, static_cast<std::int64_t>(connected.All.size()));
  for (const ConnectedInput& one : connected.All)
  {
    inputs.emplace_back();
    BlendInput& input = inputs.back();
    const std::size_t number = inputs.size();
    input.Name = names
      ? names[number - 1]
      : "Input " + std::to_string(number) + " of " + std::to_string(connected.All.size());
    input.PositionName = names ? input.Name + "Position" : "";
    input.Density = withName(input.Name, [&]() {
      return this->ReadDensity(one.Data, parts[static_cast<std::int64_t>(number) - 1], one.Port,
        static_cast<int>(number) - 1);
    });
    if (!input.Density)
    {
      return {};
    }
    input.Density->SetInputName(input.Name);
  }
  return inputs;
}

//------------------------------------------------------------------------------
void vtkTransportBlend::BlendInputs(vtkInformationVector** inputVector,
  vtkInformationVector* outputVector, const BlendSettings& settings, const char* const* names,
  const std::vector<double>& weights)
{
  // The device is opened before the progress, which hands it on to the loops.
  DeviceUse device = this->BeginDevice();
  AlgorithmProgress progress(this, this->Threading, this->GetRanks(), &device);
  Stages stages(progress, { { "reading", 5 }, { "blend", 95 } });
  std::vector<BlendInput> inputs = this->ReadInputs(inputVector, names, stages["reading"]);
  if (inputs.empty())
  {
    return;
  }
  // Weights are checked after the inputs are read, because blocks decide how many inputs there are.
  const std::vector<double> normalized = normalizedWeights(weights, inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    inputs[i].Weight = normalized[i];
  }
  const BlendReport report =
    this->Blend->Run(inputs, settings, this->GetFlowCache(), stages["blend"], outputVector);
  this->EndDevice(device);
  this->WarnOnFirstRank(report.Steps);
  if (isWorthWarning(report.Moved, report.Particles))
  {
    this->WarnOnFirstRank(std::to_string(report.Moved) +
      (report.Moved == 1 ? " particle" : " particles") +
      " in empty cells moved to the nearest cell with mass (more NumberOfSteps may spare them "
      "that)");
  }
}

//------------------------------------------------------------------------------
void vtkTransportBlend::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "ParticlesPerCell: " << this->ParticlesPerCell << "\n";
  os << indent << "MassMode: " << this->GetMassModeAsString() << "\n";
  os << indent << "ResultArrayName: " << this->ResultArrayName << "\n";
  os << indent << "Kernel: " << this->GetKernelAsString() << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
}
VTK_ABI_NAMESPACE_END
