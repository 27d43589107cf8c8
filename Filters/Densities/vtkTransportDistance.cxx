// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportDistance.h"

#include "Bridge/Blocks/ConnectedInputs.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Ensembles/DensityDistances.h"
#include "Bridge/Ranks/FieldBroadcast.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Pipeline/OutputInformation.h"
#include "Bridge/Run/Settings/IndexedList.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportDistance);

namespace
{
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;
using Pipeline = vtkStreamingDemandDrivenPipeline;

// The enumerations of the class index these.
const char* const DistanceMethodTexts[] = { "Linearized", "Certified" };
const char* const MassDifferenceTexts[] = { "Normalize", "Error" };

// This bounds the columns of the table of coordinates, which hosts display.
constexpr int MaximumNumberOfCoordinates = 100;
// Inputs that are not time steps have no time: NaN leaves the column Time out of the table.
constexpr double NoTime = std::numeric_limits<double>::quiet_NaN();

// The time steps that the input announces. A range of times without steps gives none: there is no
// finite number of densities to compare.
std::vector<double> stepsOf(vtkInformationVector* input)
{
  vtkInformation* info = input->GetInformationObject(0);
  const int count = info ? info->Length(Pipeline::TIME_STEPS()) : 0;
  const double* steps = count > 0 ? info->Get(Pipeline::TIME_STEPS()) : nullptr;
  return { steps, steps + count };
}
} // namespace

struct vtkTransportDistance::vtkInternals
{
  DensityDistances Distances;
  IndexedList<std::string> Names{ "input names", "number of a connection", "" };
  std::size_t Step = 0;       // the next time step, for OverTime
  bool HasAll = true;         // whether no input of this run is empty
  std::vector<double> Warned; // the masses of the last warning
};

//------------------------------------------------------------------------------
vtkTransportDistance::vtkTransportDistance()
  : Internals(new vtkInternals)
{
  this->AddDensityPort(PORT_PARTITIONED_DENSITY, PORT_SEVERAL_INPUTS);
  this->AddOutputPort("vtkTable");
  this->AddOutputPort("vtkTable");
  this->AddOutputPort("vtkTable");
}

//------------------------------------------------------------------------------
vtkTransportDistance::~vtkTransportDistance() = default;

//------------------------------------------------------------------------------
const char* vtkTransportDistance::GetMethodAsString()
{
  return choiceText(DistanceMethodTexts, this->Method);
}

//------------------------------------------------------------------------------
const char* vtkTransportDistance::GetMassDifferenceAsString()
{
  return choiceText(MassDifferenceTexts, this->MassDifference);
}

//------------------------------------------------------------------------------
void vtkTransportDistance::SetNumberOfInputNames(int count)
{
  this->Internals->Names.Resize(this, count);
}

//------------------------------------------------------------------------------
int vtkTransportDistance::GetNumberOfInputNames()
{
  return this->Internals->Names.Number();
}

//------------------------------------------------------------------------------
void vtkTransportDistance::SetInputName(int connection, const char* name)
{
  this->Internals->Names.Set(this, connection, name ? name : "");
}

//------------------------------------------------------------------------------
const char* vtkTransportDistance::GetInputName(int connection)
{
  return this->Internals->Names.At(connection).c_str();
}

//------------------------------------------------------------------------------
vtkIdType vtkTransportDistance::GetNumberOfSolutions()
{
  return static_cast<vtkIdType>(this->Internals->Distances.NumberOfSolutions());
}

//------------------------------------------------------------------------------
// OverTime takes a pass for each step; the passes begin again with the first one when the pipeline
// has changed.
int vtkTransportDistance::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->Internals->Step = 0;
  if (this->OverTime)
  {
    announceTimes(outputVector, {}, {}); // the tables are of all times
  }
  return 1;
}

//------------------------------------------------------------------------------
// Requests the step of this pass, after the superclass has requested the extents. Without OverTime
// the inputs keep the time that is requested downstream. Each pass reports an equal part of the
// progress.
int vtkTransportDistance::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int result = this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  const std::vector<double> steps =
    this->OverTime ? stepsOf(inputVector[0]) : std::vector<double>();
  const std::size_t step = this->Internals->Step;
  if (step < steps.size())
  {
    inputVector[0]->GetInformationObject(0)->Set(Pipeline::UPDATE_TIME_STEP(), steps[step]);
    const double part = 1.0 / static_cast<double>(steps.size());
    this->SetProgressShiftScale(static_cast<double>(step) * part, part);
  }
  else
  {
    this->SetProgressShiftScale(0.0, 1.0);
  }
  return result;
}

//------------------------------------------------------------------------------
int vtkTransportDistance::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireChoice("Method", this->Method, DistanceMethodTexts);
  requireChoice("MassDifference", this->MassDifference, MassDifferenceTexts);
  const std::string rule = "from 1 to " + std::to_string(MaximumNumberOfCoordinates);
  requireThat(
    this->NumberOfCoordinates >= 1 && this->NumberOfCoordinates <= MaximumNumberOfCoordinates,
    "NumberOfCoordinates", this->NumberOfCoordinates, rule.c_str());
  // Progress and abort are collective from here on: ranks throw Cancelled together.
  AlgorithmProgress progress(this, this->Threading, this->GetRanks());
  Stages stages(progress, { { "inputs", 50 }, { "pairs", 48 }, { "tables", 2 } });
  DensityDistances& distances = this->Internals->Distances;
  // The first pass forgets the densities of the last execution, but not their maps and pairs, which
  // are found again by the content of the densities.
  if (this->Internals->Step == 0)
  {
    distances.Begin(static_cast<DistanceMethod>(this->Method));
    this->Internals->HasAll = true;
  }
  // Reading adds the densities of this pass. More time steps make more passes, and the tables are
  // written in the last one.
  if (this->OverTime ? !this->AddStep(inputVector, stages["inputs"])
                     : !this->AddInputs(inputVector, stages["inputs"]))
  {
    this->RequestNextPass();
    return 1;
  }
  const std::vector<DistanceInput>& inputs = distances.Inputs();
  // A density without points, as after an abort upstream, has no distances: the tables are empty.
  if (!this->Internals->HasAll)
  {
    return 1;
  }
  if (inputs.size() < 2)
  {
    throw Failure("There is one density; distances need two or more (more inputs, or OverTime On "
                  "for the time steps of one)");
  }
  this->CheckMasses();
  const std::vector<DistancePair> pairs = distances.Find(stages["pairs"]);
  // All ranks have all pairs; the tables are on the first rank alone, and the field data on all.
  if (this->GetRanks().IsFirst())
  {
    writeDistances(inputs, pairs, vtkTable::GetData(outputVector, 0));
    writeBounds(inputs.size(), pairs, vtkTable::GetData(outputVector, 1));
    writeCoordinates(inputs, pairs, this->NumberOfCoordinates, stages["tables"],
      vtkTable::GetData(outputVector, 2));
  }
  broadcastFields(vtkTable::GetData(outputVector, 2)->GetFieldData(), this->GetRanks());
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportDistance::EndPasses()
{
  this->Internals->Step = 0;
}

//------------------------------------------------------------------------------
// Adds the densities of all connections and blocks, in their order. Ranks must agree on their
// number, because each of them takes part in reading every one. Always the last pass: returns true.
bool vtkTransportDistance::AddInputs(
  vtkInformationVector** inputVector, RectifiedTransport::Progress& progress)
{
  const ConnectedInputs connected = gatherInputs(inputVector, 1, true);
  requireSameNumber(connected.All.size(), this->GetRanks());
  this->WarnOnFirstRank(describeSkipped(connected));
  const std::string all = std::to_string(connected.All.size());
  Parts parts(progress, static_cast<std::int64_t>(connected.All.size()));
  for (std::size_t i = 0; i < connected.All.size() && this->Internals->HasAll; ++i)
  {
    const ConnectedInput& input = connected.All[i];
    // A block's own name goes before the name of its connection, which several blocks may share.
    const std::string number = std::to_string(i + 1);
    const std::string named = this->GetInputName(input.Connection);
    const std::string name = !input.Block.empty() ? input.Block : named;
    const std::string title =
      "Input " + number + " of " + all + (name.empty() ? "" : " (" + name + ")");
    this->Internals->HasAll = this->Add(input.Data, title, name.empty() ? "Input " + number : name,
      static_cast<int>(i), NoTime, parts[static_cast<std::int64_t>(i)]);
  }
  return true;
}

//------------------------------------------------------------------------------
// Adds the density of the time step of this pass. Returns whether it was the last one; the next
// execution then begins with the first step.
bool vtkTransportDistance::AddStep(
  vtkInformationVector** inputVector, RectifiedTransport::Progress& progress)
{
  const int connections = inputVector[0]->GetNumberOfInformationObjects();
  if (connections > 1)
  {
    throw Failure("OverTime is on, and there are " + std::to_string(connections) +
      " inputs; it takes the time steps of one (OverTime Off takes several inputs)");
  }
  const std::vector<double> steps = stepsOf(inputVector[0]);
  if (steps.size() < 2)
  {
    throw Failure("OverTime is on, and the input has " + std::string(steps.empty() ? "no" : "one") +
      " time step" + (steps.empty() ? "s" : "") +
      "; distances need two or more (OverTime Off takes several inputs)");
  }
  const std::size_t step = this->Internals->Step;
  const std::string name = "t = " + textOf(steps[step]);
  const std::string title = "Time step " + std::to_string(step + 1) + " of " +
    std::to_string(steps.size()) + " (" + name + ")";
  vtkDataObject* data = vtkDataObject::GetData(inputVector[0], 0);
  this->Internals->HasAll =
    this->Add(data, title, name, 0, steps[step], progress) && this->Internals->HasAll;
  this->Internals->Step = step + 1 < steps.size() ? step + 1 : 0;
  return this->Internals->Step == 0;
}

//------------------------------------------------------------------------------
// Reads one density and gives it to the distances, which may compute maps of those that wait, so
// that few densities are in memory at a time. Returns false for data without points. `number` tells
// the inputs apart for what vtkDensityAlgorithm keeps of each; the steps of a series share the
// number 0.
bool vtkTransportDistance::Add(vtkDataObject* data, const std::string& title,
  const std::string& name, int number, double time, RectifiedTransport::Progress& progress)
{
  Stages stages(progress, { { "input", 1 }, { "values", 1 }, { "maps", 8 } });
  std::optional<DistanceInput> input = withName(title, [&]() {
    const std::unique_ptr<InputDensity> density =
      this->ReadDensity(data, stages["input"], 0, number);
    if (density)
    {
      density->SetInputName(title);
    }
    return density ? std::optional(readDistanceInput(*density, stages["values"])) : std::nullopt;
  });
  if (!input)
  {
    return false;
  }
  input->Title = title;
  input->Name = name;
  input->Time = time;
  this->Internals->Distances.Add(std::move(*input), stages["maps"]);
  return true;
}

//------------------------------------------------------------------------------
// W2 is a distance between measures of equal mass. Each density is divided by its mass, of which
// the user learns where this changes more than rounding.
void vtkTransportDistance::CheckMasses()
{
  // Values that were rounded to single precision, by 6e-8 each, have masses that differ by less.
  constexpr double rounding = 1e-6;
  // A warning of less than one percent would only distract.
  constexpr double worthWarning = 0.01;
  const std::vector<DistanceInput>& inputs = this->Internals->Distances.Inputs();
  std::vector<double> masses;
  for (const DistanceInput& input : inputs)
  {
    masses.push_back(input.Mass);
  }
  const auto ends = std::minmax_element(masses.begin(), masses.end());
  const auto textOfMass = [&](std::vector<double>::const_iterator mass) {
    std::ostringstream number;
    number << *mass;
    return number.str() + " in " + inputs[static_cast<std::size_t>(mass - masses.begin())].Title;
  };
  const double excess = *ends.second / *ends.first - 1.0;
  const std::string text = "The masses of the densities differ: they are from " +
    textOfMass(ends.first) + " to " + textOfMass(ends.second);
  if (this->MassDifference == MASS_DIFFERENCE_ERROR && excess > rounding)
  {
    throw Failure(text + "; MassDifference Normalize divides each by its mass");
  }
  // The same masses get no second warning, as where only another property changes.
  if (excess > worthWarning && masses != this->Internals->Warned)
  {
    this->WarnOnFirstRank(text + "; each is divided by its mass");
  }
  this->Internals->Warned = masses;
}

//------------------------------------------------------------------------------
void vtkTransportDistance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->GetMethodAsString() << "\n";
  os << indent << "MassDifference: " << this->GetMassDifferenceAsString() << "\n";
  os << indent << "OverTime: " << (this->OverTime ? "On" : "Off") << "\n";
  os << indent << "NumberOfCoordinates: " << this->NumberOfCoordinates << "\n";
  os << indent << "NumberOfSolutions: " << this->GetNumberOfSolutions() << "\n";
  os << indent << "InputNames:";
  for (const std::string& name : this->Internals->Names.All)
  {
    os << " '" << name << "'";
  }
  os << (this->Internals->Names.All.empty() ? " automatic\n" : "\n");
}
VTK_ABI_NAMESPACE_END
