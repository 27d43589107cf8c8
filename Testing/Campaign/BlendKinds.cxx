// SPDX-License-Identifier: BSD-3-Clause
// Morph Densities and Density Barycenter.
#include "DrawnInputs.h"
#include "Kinds.h"
#include "OutputChecks.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTransportBarycenter.h"
#include "vtkTransportInterpolator.h"

#include <algorithm>
#include <cmath>

namespace Campaign
{

namespace
{

using Blend = vtkTransportBlend;

// By choices that leave those of other settings as they are.
void drawName(Settings& settings)
{
  RandomSource before = settings.GetRandom();
  RandomSource random(before.Next() + 2);
  const std::string name = random.Of({ "", "", "", "rho" });
  settings.Add("ResultArrayName", name, [name](vtkAlgorithm* filter) {
    Blend::SafeDownCast(filter)->SetResultArrayName(name.c_str());
  });
}

void drawBlend(Settings& settings)
{
  settings.Draw<Blend, int>("ParticlesPerCell", &Blend::SetParticlesPerCell, { 0, 1, 2, 3, 4, 8 },
    { -1, std::numeric_limits<int>::min() });
  settings.Draw<Blend, int>("MassMode", &Blend::SetMassMode, { 0, 1, 2, 3 }, { -1, 4 });
  settings.Draw<Blend, int>("Kernel", &Blend::SetKernel, { 0, 1, 2, 3 }, { -1, 4 });
  settings.Draw<Blend, double>("Radius", &Blend::SetRadius, { 1e-300, 0.3, 1.0, 2.5 },
    { 0.0, -1.0, 10001.0, NaN, Infinity }, 0.3);
  drawFlowSettings<vtkTransportAlgorithm>(settings);
  drawTables<Blend>(settings);
  drawDevice<Blend>(settings);
  drawMethod<Blend>(settings);
  drawDensitySettings(settings);
  drawName(settings);
}

// The grid of the output. Images that are not alike may have a large box in common at a fine
// spacing: they never go without.
void drawDimensions(RandomSource& random, Settings& settings, const Inputs& inputs)
{
  bool alike = true;
  for (const auto& port : inputs)
  {
    for (const Input& input : port)
    {
      alike = alike && input.Condition != State::Odd;
    }
  }
  const int* like = vtkImageData::SafeDownCast(inputs[0][0].Data)->GetDimensions();
  int asked[3] = { 0, 0, 0 };
  const bool any = !alike || random.Chance(0.4);
  for (int a = 0; a < 3 && any; ++a)
  {
    asked[a] = like[a] > 1 ? random.Of({ 2, 5, 9, 12 }) : 0;
  }
  if (random.Chance(0.03))
  {
    asked[random.Whole(0, 2)] = random.Of({ -1, 1, 2147483647 });
  }
  const int x = asked[0];
  const int y = asked[1];
  const int z = asked[2];
  settings.Add("Dimensions", std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z),
    [=](vtkAlgorithm* filter) { Blend::SafeDownCast(filter)->SetDimensions(x, y, z); });
}

// The densities of all inputs; what Dimensions asks for may not be had.
State expectBlend(vtkAlgorithm* filter, const Inputs& inputs)
{
  const int* asked = Blend::SafeDownCast(filter)->GetDimensions();
  const bool isAsked = std::any_of(asked, asked + 3, [](int count) { return count != 0; });
  State state = isAsked ? State::Odd : State::Sound;
  for (const auto& port : inputs)
  {
    for (const Input& input : port)
    {
      state = worse(state, densityState(filter, input));
    }
  }
  return state;
}

// The bound, the gap and the slack, and the functional of a barycenter.
void checkBlendBound(vtkTransportBlend* blend, Findings& findings)
{
  vtkPolyData* particles = blend->GetParticles();
  const bool isOptimal = blend->GetMethod() == vtkTransportAlgorithm::OPTIMAL;
  const bool isBounded = isOptimal || blend->GetCertify();
  vtkDataArray* gap = particles->GetFieldData()->GetArray("OptimalityGap");
  vtkDataArray* slack = particles->GetPointData()->GetArray("Slack");
  findings.That((gap != nullptr) == isBounded, "a gap with a bound");
  findings.That((slack != nullptr) == isBounded, "Slack with a bound");
  if (gap && slack)
  {
    findings.That(gap->GetComponent(0, 0) >= 0.0, "the gap is not negative"); // may be infinite
    const double bound = requireField(particles, "TransportCostLowerBound", findings);
    findings.That(bound >= 0.0, "the bound is not negative");
    requireArray(particles->GetPointData(), "Slack", 1, particles->GetNumberOfPoints(), findings);
    findings.That(
      slack->GetNumberOfTuples() == 0 || slack->GetRange(0)[0] >= 0.0, "Slack is not negative");
  }
  if (vtkDataArray* functional = particles->GetFieldData()->GetArray("Functional"))
  {
    findings.That(isOptimal, "Functional with Optimal");
    for (vtkIdType i = 1; i < functional->GetNumberOfTuples(); ++i)
    {
      findings.That(functional->GetComponent(i, 0) < functional->GetComponent(i - 1, 0),
        "Functional decreases");
    }
  }
}

// The density by the name that is asked for, else by that of the inputs' arrays.
vtkDataArray* requireBlend(Blend* blend, Findings& findings)
{
  vtkImageData* image = blend->GetDensity();
  const int kind = image->GetPointData()->GetScalars() ? vtkDataObject::POINT : vtkDataObject::CELL;
  vtkDataArray* scalars = image->GetAttributes(kind)->GetScalars();
  const std::string asked = blend->GetResultArrayName();
  const char* name = asked.empty() && scalars ? scalars->GetName() : asked.c_str();
  return requireArray(
    image->GetAttributes(kind), name, 1, image->GetNumberOfElements(kind), findings);
}

void checkBlend(vtkAlgorithm* filter, const Inputs& inputs, const std::vector<double>& weights,
  Findings& findings)
{
  auto* blend = Blend::SafeDownCast(filter);
  vtkImageData* image = blend->GetDensity();
  vtkPolyData* particles = blend->GetParticles();
  const vtkIdType count = particles->GetNumberOfPoints();
  requireFinitePoints(particles, findings);
  requireVertices(particles, findings);
  const bool onPoints = image->GetPointData()->GetScalars() != nullptr;
  const vtkIdType values = onPoints ? image->GetNumberOfPoints() : image->GetNumberOfCells();
  const int each = blend->GetParticlesPerCell() > 0 ? blend->GetParticlesPerCell() : 4;
  findings.That(count == values * each, "ParticlesPerCell");
  checkBlendBound(blend, findings);
  vtkDataArray* density = requireBlend(blend, findings);
  vtkDataArray* mass = requireArray(particles->GetPointData(), "Mass", 1, count, findings);
  const double total = requireField(image, "TotalMass", findings);
  findings.Near(requireField(particles, "TotalMass", findings), total, 0.0, "TotalMass of both");
  if (expectBlend(filter, inputs) != State::Sound)
  {
    return;
  }
  findings.Near(sumOf(mass), total, 1e-9, "sum of Mass");
  findings.Near(sumOf(density) * cellMeasure(image), total, 1e-9, "sum of Density");
  double expected = blend->GetMassMode() == Blend::MASS_GEOMETRIC ? 1.0 : 0.0;
  std::size_t at = 0;
  for (const auto& port : inputs)
  {
    for (const Input& input : port)
    {
      if (blend->GetMassMode() == Blend::MASS_GEOMETRIC)
      {
        expected *= std::pow(massOf(filter, input), weights[at]);
      }
      else if (blend->GetMassMode() == Blend::MASS_LINEAR)
      {
        expected += massOf(filter, input) * weights[at];
      }
      ++at;
    }
  }
  const bool source = blend->GetMassMode() == Blend::MASS_SOURCE;
  const bool one = blend->GetMassMode() == Blend::MASS_NORMALIZE;
  findings.Near(total,
    source  ? massOf(filter, inputs[0][0])
      : one ? 1.0
            : expected,
    1e-9, "TotalMass");
}

//------------------------------------------------------------------------------
using Morph = vtkTransportInterpolator;
using Pipeline = vtkStreamingDemandDrivenPipeline;

void drawMorph(Settings& settings)
{
  settings.Draw<Morph, double>(
    "Parameter", &Morph::SetParameter, { 0.0, 0.2, 0.5, 1.0, 5e-324 }, { -0.1, 1.1, NaN });
  settings.Draw<Morph, vtkTypeBool>("PublishTime", &Morph::SetPublishTime, { 0, 1 }, {}, 0.2);
  settings.Draw<Morph, int>(
    "NumberOfTimeSteps", &Morph::SetNumberOfTimeSteps, { 2, 11, 1000 }, { 1, 1000001, -5 }, 0.2);
  RandomSource& random = settings.GetRandom();
  if (random.Chance(0.15))
  {
    const double time = random.Of({ 0.0, 0.3, 1.0, -5.0, 7.0, Infinity, -Infinity, NaN });
    settings.Add("Time", textOf(time), [=](vtkAlgorithm* filter) {
      filter->UpdateInformation(); // the first drops a time that was asked for before
      for (int port = 0; port < 2; ++port)
      {
        filter->GetOutputInformation(port)->Set(Pipeline::UPDATE_TIME_STEP(), time);
      }
    });
  }
  drawBlend(settings);
}

Inputs drawMorphInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(2);
  inputs[0] = { drawDensityOn(random, settings, 0) };
  inputs[1] = { drawPartner(random, inputs[0][0], settings) };
  drawChoice(random, settings, 1, 1, inputs[1][0]);
  drawDimensions(random, settings, inputs);
  return inputs;
}

bool hasTime(Morph* morph)
{
  return morph->GetPublishTime() &&
    morph->GetOutputInformation(0)->Has(Pipeline::UPDATE_TIME_STEP());
}

double timeOf(Morph* morph)
{
  return morph->GetOutputInformation(0)->Get(Pipeline::UPDATE_TIME_STEP());
}

State expectMorph(vtkAlgorithm* filter, const Inputs& inputs)
{
  auto* morph = Morph::SafeDownCast(filter);
  const bool none = hasTime(morph) && std::isnan(timeOf(morph));
  return worse(expectBlend(filter, inputs), none ? State::Faulty : State::Sound);
}

void checkMorph(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* morph = Morph::SafeDownCast(filter);
  const double t = hasTime(morph) ? std::clamp(timeOf(morph), 0.0, 1.0) : morph->GetParameter();
  checkBlend(filter, inputs, { 1.0 - t, t }, findings);
  vtkPolyData* particles = morph->GetParticles();
  for (const char* name : { "SourcePosition", "TargetPosition" })
  {
    requireArray(particles->GetPointData(), name, 3, particles->GetNumberOfPoints(), findings);
  }
}

//------------------------------------------------------------------------------
using Barycenter = vtkTransportBarycenter;

void setWeights(vtkAlgorithm* filter, const std::vector<double>& weights)
{
  auto* barycenter = Barycenter::SafeDownCast(filter);
  barycenter->SetNumberOfWeights(static_cast<int>(weights.size()));
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    barycenter->SetWeight(static_cast<int>(i), weights[i]);
  }
}

// The weights of the inputs where they are as they should be, else none.
std::vector<double> weightsOf(vtkAlgorithm* filter, std::size_t count)
{
  auto* barycenter = Barycenter::SafeDownCast(filter);
  std::vector<double> weights(count, 1.0 / static_cast<double>(count));
  if (barycenter->GetNumberOfWeights() == 0)
  {
    return weights;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    weights[i] = barycenter->GetWeight(static_cast<int>(i));
    sum += weights[i];
    if (!(weights[i] >= 0.0))
    {
      return {};
    }
  }
  if (barycenter->GetNumberOfWeights() != static_cast<int>(count) || !(sum > 0.0) ||
    !std::isfinite(sum))
  {
    return {};
  }
  for (double& weight : weights)
  {
    weight /= sum;
  }
  return weights;
}

Inputs drawBarycenterInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(1);
  inputs[0] = { drawDensityOn(random, settings, 0) };
  const std::int64_t others = random.Whole(0, 3);
  for (std::int64_t i = 0; i < others; ++i)
  {
    inputs[0].push_back(drawPartner(random, inputs[0][0], settings));
  }
  std::vector<double> weights;
  if (random.Chance(0.6))
  {
    const std::int64_t count = random.Chance(0.05) ? random.Whole(0, 6) : others + 1;
    for (std::int64_t i = 0; i < count; ++i)
    {
      weights.push_back(
        random.Chance(0.95) ? random.Of({ 0.0, 1.0, random.Unit() }) : drawExceptional(random));
    }
  }
  std::string text;
  for (const double weight : weights)
  {
    text += textOf(weight) + " ";
  }
  settings.Add("Weights", weights.empty() ? "none" : text,
    [weights](vtkAlgorithm* filter) { setWeights(filter, weights); });
  if (random.Chance(0.02))
  {
    settings.Add("Weights", "none, after ones that are refused", [](vtkAlgorithm* filter) {
      auto* barycenter = Barycenter::SafeDownCast(filter);
      barycenter->SetNumberOfWeights(std::numeric_limits<int>::max());
      barycenter->SetWeight(std::numeric_limits<int>::max(), 1.0);
      barycenter->SetNumberOfWeights(0);
    });
  }
  drawDimensions(random, settings, inputs);
  return inputs;
}

State expectBarycenter(vtkAlgorithm* filter, const Inputs& inputs)
{
  const State state = expectBlend(filter, inputs);
  return weightsOf(filter, inputs[0].size()).empty() ? worse(state, State::Odd) : state;
}

void checkBarycenter(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  const std::vector<double> weights = weightsOf(filter, inputs[0].size());
  if (!weights.empty())
  {
    checkBlend(filter, inputs, weights, findings);
  }
}

//------------------------------------------------------------------------------
void quickBlend(RandomSource&, vtkAlgorithm* filter)
{
  auto* blend = Blend::SafeDownCast(filter);
  blend->SetParticlesPerCell(1);
  blend->SetDimensions(4, 4, 4);
}

} // namespace

void addBlendKinds(std::vector<FilterKind>& kinds)
{
  kinds.push_back(
    { "Morph", make<Morph>, drawMorph, drawMorphInputs, expectMorph, checkMorph, quickBlend });
  kinds.push_back({ "Barycenter", make<Barycenter>, drawBlend, drawBarycenterInputs,
    expectBarycenter, checkBarycenter, quickBlend });
}

} // namespace Campaign
