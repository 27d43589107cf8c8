// SPDX-License-Identifier: BSD-3-Clause
// Transport Temporal Interpolator, of series and of inputs without time steps, which come out as
// they are.
#include "DrawnInputs.h"
#include "Kinds.h"
#include "OutputChecks.h"
#include "SeriesSource.h"

#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTransportTemporalInterpolator.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace Campaign
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;
using Temporal = vtkTransportTemporalInterpolator;

void drawTime(Settings& settings)
{
  const double time = settings.GetRandom().Of({ 0.0, 0.5, 0.5, 0.25, 1.0, 1.25, 1.25, 1.75, 2.0,
    2.5, 3.0, 0.999999, 1e-310, -7.0, 99.0, Infinity, -Infinity, NaN });
  settings.Add("Time", textOf(time), [=](vtkAlgorithm* filter) {
    filter->UpdateInformation(); // the first drops a time that was asked for before
    for (int port = 0; port < 2; ++port)
    {
      filter->GetOutputInformation(port)->Set(Pipeline::UPDATE_TIME_STEP(), time);
    }
  });
}

void drawTemporal(Settings& settings)
{
  settings.Draw<Temporal, int>("Method", &Temporal::SetMethod, { 0, 1 }, { -1, 2 }, 0.3);
  settings.Draw<Temporal, int>(
    "ResampleFactor", &Temporal::SetResampleFactor, { 0, 1, 5 }, { -1 }, 0.1);
  settings.Draw<Temporal, vtkTypeBool>(
    "TrackParticles", &Temporal::SetTrackParticles, { 0, 1 }, {}, 0.3);
  settings.Draw<Temporal, vtkTypeBool>(
    "AdvectArrays", &Temporal::SetAdvectArrays, { 0, 1 }, {}, 0.3);
  settings.Draw<Temporal, int>(
    "ParticlesPerCell", &Temporal::SetParticlesPerCell, { 1, 2, 4, 8 }, { 0, -1 }, 0.3);
  settings.Draw<Temporal, int>("Kernel", &Temporal::SetKernel, { 0, 1, 2, 3 }, { -1, 4 }, 0.3);
  settings.Draw<Temporal, double>("Radius", &Temporal::SetRadius, { 0.5, 1.0, 2.0 }, {}, 0.3);
  drawThreading<Temporal>(settings);
  drawDensitySettings(settings);
  if (settings.GetRandom().Chance(0.8))
  {
    drawTime(settings);
  }
}

// Another box or finer cells, as a reader may give that follows what moves.
void changeGrid(RandomSource& random, vtkImageData* image)
{
  double spacing[3];
  double origin[3];
  int extent[6];
  image->GetSpacing(spacing);
  image->GetOrigin(origin);
  image->GetExtent(extent);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double factor = random.Of({ 1.0, 0.5, 0.8 });
    origin[axis] += spacing[axis] * static_cast<double>(random.Whole(0, 2)) *
      (extent[2 * axis] < extent[2 * axis + 1] ? 1.0 : 0.0);
    spacing[axis] *= factor;
    if (extent[2 * axis] < extent[2 * axis + 1] && random.Chance(0.5))
    {
      extent[2 * axis + 1] += static_cast<int>(random.Whole(0, 3));
    }
  }
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetExtent(extent);
}

// The arrays of a step beside its density: some or all of the first one's, of the same type or not.
void drawOthersLike(RandomSource& random, vtkImageData* first, vtkImageData* image)
{
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = first->GetAttributes(owner);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = attributes->GetArray(i);
      const bool isOther = array && array != attributes->GetScalars() && array->GetName() &&
        std::string(array->GetName()) != "Values" &&
        std::string(array->GetName()) != vtkDataSetAttributes::GhostArrayName();
      if (!isOther || random.Chance(0.2))
      {
        continue;
      }
      std::string text;
      const auto drawn =
        drawArray(random, image->GetNumberOfElements(owner), array->GetNumberOfComponents(), text);
      const auto like = vtkSmartPointer<vtkDataArray>::Take(
        random.Chance(0.8) ? array->NewInstance() : drawn->NewInstance());
      like->DeepCopy(drawn);
      like->SetName(array->GetName());
      image->GetAttributes(owner)->AddArray(like);
    }
  }
}

Input drawStep(RandomSource& random, const Input& first)
{
  Input step;
  // What is wrong with the first one's array need not be wrong here.
  const bool isFaulty = first.Condition == State::Faulty || first.Condition == State::Empty;
  step.Condition = isFaulty ? State::Open : first.Condition;
  auto* like = vtkImageData::SafeDownCast(first.Data);
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->CopyStructure(like);
  std::string text = "as the first";
  if (random.Chance(0.15) && like->GetNumberOfPoints() > 0)
  {
    changeGrid(random, image);
    step.Worsen(State::Odd); // of a box that floating-point numbers hold just so
    text = "another grid";
  }
  step.Data = image;
  step.OnPoints = first.OnPoints != random.Chance(0.03);
  if (step.OnPoints != first.OnPoints)
  {
    step.Worsen(State::Odd);
  }
  const int owner = step.OnPoints ? vtkDataObject::POINT : vtkDataObject::CELL;
  drawOthersLike(random, like, image);
  if (random.Chance(0.02))
  {
    step.Worsen(State::Open);
    step.Describe(text + ", without a density");
    return step;
  }
  std::string values;
  step.Values = drawArray(random, image->GetNumberOfElements(owner), 1, values);
  step.Values->SetName("Values");
  if (random.Chance(0.08))
  {
    step.Values->Fill(0.0);
    values += ", without mass";
  }
  image->GetAttributes(owner)->SetScalars(step.Values);
  step.Describe(text + ", " + values);
  return step;
}

Inputs drawTemporalInputs(RandomSource& random, Settings& settings)
{
  Input input = drawDensityOn(random, settings, 0);
  if (random.Chance(0.2))
  {
    return { { input } };
  }
  const std::vector<double> times = random.Of<std::vector<double>>({ { 0.0, 1.0, 2.0, 3.0 },
    { 0.0, 1.0, 2.0, 3.0 }, { 0.0, 1.0, 1.0, 2.0 }, { 0.0, 0.0, 1.0, 1.0 }, { 2.0, 1.0, 0.0, 3.0 },
    { 1.0, 0.0, 1.5, 0.5 }, { NaN, 0.0, 1.0, 2.0 }, { 0.0, 1.0, Infinity, NaN },
    { 0.0, 1e-300, 1.0, 1e300 }, { -1.5e308, 1.5e308, 0.0, 1.0 }, { 0.0, 5e-324, 1.0, 2.0 } });
  const auto count = static_cast<std::size_t>(random.Of({ 1, 2, 2, 3, 3, 4 }));
  std::vector<SeriesStep> steps;
  input.Steps.push_back(input);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (i > 0)
    {
      input.Steps.push_back(drawStep(random, input.Steps[0]));
      input.Describe("\n    step " + std::to_string(i) + ": " + input.Steps[i].Text);
    }
    input.Times.push_back(times[i]);
    input.Describe("t = " + textOf(times[i]));
    steps.push_back({ times[i], input.Steps[i].Data });
  }
  input.Series = newSeries(steps);
  return { { input } };
}

// Two steps of a series, or one, and where between them a time is.
struct Moment
{
  std::vector<const Input*> Steps;
  double Part = 0.0;
  double Length = 0.0;
};

// An input that has no series is its only step.
Moment momentOf(vtkAlgorithm* filter, const Input& input)
{
  if (!input.Series)
  {
    return { { &input } };
  }
  std::vector<double> times = input.Times;
  times.erase(
    std::remove_if(times.begin(), times.end(), [](double t) { return !std::isfinite(t); }),
    times.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const auto stepAt = [&](double time) {
    const auto found = std::find(input.Times.begin(), input.Times.end(), time);
    return &input.Steps[static_cast<std::size_t>(found - input.Times.begin())];
  };
  if (times.size() < 2)
  {
    return { { times.empty() ? &input : stepAt(times[0]) } };
  }
  vtkInformation* output = filter->GetOutputInformation(0);
  const bool isAsked = output->Has(Pipeline::UPDATE_TIME_STEP());
  const double asked = isAsked ? output->Get(Pipeline::UPDATE_TIME_STEP()) : times[0];
  std::size_t second = 1;
  while (second + 1 < times.size() && times[second] <= asked)
  {
    ++second;
  }
  Moment moment;
  moment.Length = times[second] - times[second - 1];
  moment.Part = std::clamp((asked - times[second - 1]) / moment.Length, 0.0, 1.0);
  const bool chains = Temporal::SafeDownCast(filter)->GetTrackParticles() != 0;
  for (std::size_t i = chains ? 0 : second - 1; i <= second; ++i)
  {
    moment.Steps.push_back(stepAt(times[i]));
  }
  return moment;
}

// Of a series, steps may have no mass.
State stepState(vtkAlgorithm* filter, const Input& step, bool mayBeEmpty)
{
  const State state = densityState(filter, step);
  auto* reader = vtkDensityAlgorithm::SafeDownCast(filter);
  const bool isRead = step.Condition == State::Sound && step.Values &&
    reader->GetComponent() < step.Values->GetNumberOfComponents() && reader->GetComponent() >= -3;
  if (state != State::Faulty || !mayBeEmpty || !isRead)
  {
    return state;
  }
  bool isZero = true;
  for (vtkIdType i = 0; i < step.Values->GetNumberOfTuples(); ++i)
  {
    isZero = isZero && valueAt(filter, step, i) == 0.0;
  }
  // Negative values may be cut off, to none.
  return isZero                                                                 ? State::Sound
    : reader->GetNegativeValues() != vtkDensityAlgorithm::NEGATIVE_VALUES_ERROR ? State::Odd
                                                                                : state;
}

State expectTemporal(vtkAlgorithm* filter, const Inputs& inputs)
{
  vtkInformation* output = filter->GetOutputInformation(0);
  if (output->Has(Pipeline::UPDATE_TIME_STEP()) &&
    std::isnan(output->Get(Pipeline::UPDATE_TIME_STEP())))
  {
    return State::Faulty;
  }
  const Moment moment = momentOf(filter, inputs[0][0]);
  const bool mayBeEmpty =
    moment.Steps.size() > 1 && Temporal::SafeDownCast(filter)->GetTrackParticles() == 0;
  const bool isUsual = moment.Length == 0.0 || (moment.Length > 1e-200 && moment.Length < 1e200);
  State state = isUsual ? State::Sound : State::Odd;
  for (const Input* step : moment.Steps)
  {
    state = worse(state, stepState(filter, *step, mayBeEmpty));
  }
  return state;
}

void checkTemporal(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* temporal = Temporal::SafeDownCast(filter);
  vtkImageData* image = temporal->GetDensity();
  vtkPolyData* particles = temporal->GetParticles();
  requireFinitePoints(particles, findings);
  requireVertices(particles, findings);
  const vtkIdType count = particles->GetNumberOfPoints();
  vtkDataArray* mass = requireArray(particles->GetPointData(), "Mass", 1, count, findings);
  requireArray(particles->GetPointData(), "Velocity", 3, count, findings);
  const double total = requireField(image, "TotalMass", findings);
  findings.Near(requireField(particles, "TotalMass", findings), total, 0.0, "TotalMass of both");
  vtkDataArray* density = image->GetPointData()->GetScalars() ? image->GetPointData()->GetScalars()
                                                              : image->GetCellData()->GetScalars();
  findings.That(density != nullptr, "a density");
  if (!density || expectTemporal(filter, inputs) != State::Sound)
  {
    return;
  }
  const Moment moment = momentOf(filter, inputs[0][0]);
  const Input& last = *moment.Steps.back();
  const Input& before = moment.Steps.size() > 1 ? **(moment.Steps.end() - 2) : last;
  findings.Near(sumOf(mass), total, 1e-9, "sum of Mass");
  // Sums are rounded as parts of the larger of both masses.
  if (total == 0.0 || total > 1e-6 * std::max(massOf(filter, before), massOf(filter, last)))
  {
    findings.Near(sumOf(density) * cellMeasure(image), total, 1e-9, "sum of the density");
  }
  findings.Near(total,
    (1.0 - moment.Part) * massOf(filter, before) + moment.Part * massOf(filter, last), 1e-9,
    "TotalMass");
  if (temporal->GetTrackParticles() || (moment.Part > 0.0 && moment.Part < 1.0))
  {
    return;
  }
  const Input& step = moment.Part > 0.0 ? last : before;
  bool isSame = density->GetNumberOfTuples() == step.Values->GetNumberOfTuples();
  for (vtkIdType i = 0; isSame && i < density->GetNumberOfTuples(); ++i)
  {
    isSame = density->GetComponent(i, 0) == std::max(valueAt(filter, step, i), 0.0);
  }
  findings.That(isSame, "at a step its density");
}

void quickTemporal(RandomSource& random, vtkAlgorithm* filter)
{
  auto* temporal = Temporal::SafeDownCast(filter);
  temporal->SetParticlesPerCell(1);
  // At times the data are two steps of a series, the first one of plain values or both the same.
  vtkDataObject* data = filter->GetInputDataObject(0, 0);
  if (!data || random.Chance(0.4))
  {
    return;
  }
  vtkSmartPointer<vtkDataObject> first = data;
  if (vtkImageData::SafeDownCast(data) && random.Chance(0.5))
  {
    first = drawImage(random).Data;
  }
  filter->SetInputConnection(newSeries({ { 0.0, first }, { 1.0, data } })->GetOutputPort());
  temporal->SetTrackParticles(random.Chance(0.3));
  filter->UpdateInformation();
  filter->GetOutputInformation(0)->Set(
    Pipeline::UPDATE_TIME_STEP(), random.Of({ 0.0, 0.5, 0.5, 0.75, 1.0 }));
}

} // namespace

void addTemporalKinds(std::vector<FilterKind>& kinds)
{
  kinds.push_back({ "Temporal", make<Temporal>, drawTemporal, drawTemporalInputs, expectTemporal,
    checkTemporal, quickTemporal });
}

} // namespace Campaign
