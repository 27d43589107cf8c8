// SPDX-License-Identifier: BSD-3-Clause
// vtkTransportInterpolator as a source of times: they take the place of Parameter and stay away
// from the inputs.
#include "BlendTest.h"

#include "vtkImageAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

// A density that is another one at every time, and counts its runs. Without discrete steps it has a
// range.
class TimedDensity : public vtkImageAlgorithm
{
public:
  static TimedDensity* New();
  vtkTypeMacro(TimedDensity, vtkImageAlgorithm);
  Values Times{ 4.0, 6.0, 9.0 };
  bool HasSteps = true;
  int Runs = 0;
  double Asked = -1.0;

protected:
  TimedDensity() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* output = outputs->GetInformationObject(0);
    const int extent[6] = { 0, 12, 0, 10, 0, 0 };
    output->Set(Pipeline::WHOLE_EXTENT(), extent, 6);
    const double range[2] = { this->Times.front(), this->Times.back() };
    output->Set(Pipeline::TIME_RANGE(), range, 2);
    if (this->HasSteps)
    {
      output->Set(Pipeline::TIME_STEPS(), this->Times.data(), static_cast<int>(this->Times.size()));
    }
    return 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    ++this->Runs;
    vtkInformation* output = outputs->GetInformationObject(0);
    this->Asked =
      output->Has(Pipeline::UPDATE_TIME_STEP()) ? output->Get(Pipeline::UPDATE_TIME_STEP()) : -1.0;
    const auto seed = static_cast<vtkIdType>(this->Asked);
    vtkImageData::GetData(outputs)->ShallowCopy(
      makeDensity({ 12, 10, 1 }, true, [=](vtkIdType i) { return bumpy(i + 5 * seed); }));
    return 1;
  }
};
vtkStandardNewMacro(TimedDensity);

Values publishedTimes(vtkAlgorithm* filter, int port = 0)
{
  filter->UpdateInformation();
  vtkInformation* output = filter->GetOutputInformation(port);
  Values times(static_cast<std::size_t>(output->Length(Pipeline::TIME_STEPS())));
  if (!times.empty())
  {
    output->Get(Pipeline::TIME_STEPS(), times.data());
  }
  return times;
}

double dataTime(vtkDataObject* data)
{
  vtkInformation* information = data->GetInformation();
  return information->Has(vtkDataObject::DATA_TIME_STEP())
    ? information->Get(vtkDataObject::DATA_TIME_STEP())
    : -1.0;
}

Values densityAt(vtkTransportInterpolator* morph, double time)
{
  morph->UpdateTimeStep(time);
  return densityValues(morph);
}

void checkPublished(Checks& checks)
{
  auto morph = makeMorph(makeDensity({ 12, 10, 1 }, true, smoothDensity(12, 10)),
    makeDensity({ 12, 10, 1 }, true, otherDensity(12, 10)));
  CHECK(checks, publishedTimes(morph).empty());
  CHECK(checks, !morph->GetOutputInformation(0)->Has(Pipeline::TIME_RANGE()));
  morph->PublishTimeOn();
  for (const int port : { 0, 1 })
  {
    const Values times = publishedTimes(morph, port);
    CHECK(checks, times.size() == 11 && times.front() == 0.0 && times.back() == 1.0);
    CHECK(checks, times.size() == 11 && times[3] == 3 / 10.0);
    const double* range = morph->GetOutputInformation(port)->Get(Pipeline::TIME_RANGE());
    CHECK(checks, range && range[0] == 0.0 && range[1] == 1.0);
  }
  morph->SetNumberOfTimeSteps(2);
  CHECK(checks, publishedTimes(morph) == Values({ 0.0, 1.0 }));
  morph->PublishTimeOff();
  CHECK(checks, publishedTimes(morph).empty());
  CHECK(checks, !morph->GetOutputInformation(1)->Has(Pipeline::TIME_RANGE()));
}

void checkTime(Checks& checks)
{
  auto source = makeDensity({ 12, 10, 1 }, true, smoothDensity(12, 10));
  auto target = makeDensity({ 12, 10, 1 }, true, otherDensity(12, 10));
  auto plain = makeMorph(source, target);
  auto morph = makeMorph(source, target, 0.125);
  morph->PublishTimeOn();
  morph->SetNumberOfTimeSteps(3);

  // Without a request Parameter counts.
  plain->SetParameter(0.125);
  CHECK(checks, runDensity(morph) == runDensity(plain));
  const vtkMTimeType built = morph->GetTableBuildTime();

  // A request may lie between the steps, and outside.
  for (const double time : { 0.0, 0.5, 1.0, 0.3, -2.0, 7.0 })
  {
    const double t = std::clamp(time, 0.0, 1.0);
    plain->SetParameter(t);
    CHECK(checks, densityAt(morph, time) == runDensity(plain));
    CHECK(checks, particlePlaces(morph) == particlePlaces(plain));
    CHECK(checks, dataTime(morph->GetDensity()) == t && dataTime(morph->GetParticles()) == t);
    // A second request of the same time, for either output, does nothing.
    const vtkMTimeType made = morph->GetDensity()->GetMTime();
    const vtkMTimeType madeParticles = morph->GetParticles()->GetMTime();
    morph->UpdateTimeStep(time);
    morph->UpdateTimeStep(time, -1, 1, 0, nullptr);
    CHECK(checks, morph->GetDensity()->GetMTime() == made);
    CHECK(checks, morph->GetParticles()->GetMTime() == madeParticles);
  }
  CHECK(checks, morph->GetParameter() == 0.125);

  // Each output may be asked for a time.
  vtkNew<vtkInformationVector> requests;
  requests->SetNumberOfInformationObjects(2);
  requests->GetInformationObject(1)->Set(Pipeline::UPDATE_TIME_STEP(), 0.75);
  morph->Update(1, requests);
  plain->SetParameter(0.75);
  plain->Update();
  CHECK(checks, particlePlaces(morph) == particlePlaces(plain));
  CHECK(checks, dataTime(morph->GetParticles()) == 0.75);
  CHECK(checks, morph->GetTableBuildTime() == built);

  // Off again: Parameter counts, whatever time is asked for.
  morph->PublishTimeOff();
  plain->SetParameter(0.125);
  CHECK(checks, densityAt(morph, 0.75) == runDensity(plain));
  CHECK(checks, densityAt(morph, 0.5) == densityValues(plain));
  CHECK(checks, morph->GetTableBuildTime() == built);
}

// While it plays the inputs stay at their first time.
void checkInputs(Checks& checks, bool hasSteps)
{
  vtkNew<TimedDensity> source;
  vtkNew<TimedDensity> target;
  target->Times = { 0.5, 2.0 };
  source->HasSteps = target->HasSteps = hasSteps;
  vtkNew<vtkTransportInterpolator> morph;
  setSimplest(morph);
  morph->SetInputConnection(source->GetOutputPort());
  morph->SetTargetConnection(target->GetOutputPort());
  morph->PublishTimeOn();
  CHECK(checks, publishedTimes(morph).size() == 11);
  Values last;
  for (const double time : { 0.0, 0.4, 1.0 })
  {
    const Values found = densityAt(morph, time);
    CHECK(checks, found.size() == 120 && found != last);
    last = found;
  }
  CHECK(checks, source->Runs == 1 && source->Asked == 4.0);
  CHECK(checks, target->Runs == 1 && target->Asked == 0.5);

  // Another consumer has updated the source at another time; the morph's request is for its first.
  source->UpdateTimeStep(9.0);
  CHECK(checks, source->Asked == 9.0);
  densityAt(morph, 0.2);
  CHECK(checks, densityAt(morph, 1.0) == last);
  CHECK(checks, source->Asked == 4.0 && target->Runs == 1);

  // Off: a filter as others, with the times of its inputs.
  morph->PublishTimeOff();
  const int runs = source->Runs;
  if (hasSteps)
  {
    CHECK(checks, publishedTimes(morph) == Values({ 0.5, 2.0, 4.0, 6.0, 9.0 }));
  }
  densityAt(morph, 6.0);
  CHECK(checks, source->Asked == 6.0 && target->Asked == 6.0 && source->Runs == runs + 1);
  CHECK(checks, dataTime(morph->GetDensity()) == 6.0);
}

// The times of all inputs of a barycenter go upstream.
void checkBarycenter(Checks& checks)
{
  vtkNew<TimedDensity> first;
  vtkNew<TimedDensity> second;
  second->Times = { 0.5, 2.0 };
  vtkNew<vtkTransportBarycenter> barycenter;
  setSimplest(barycenter);
  barycenter->AddInputConnection(first->GetOutputPort());
  barycenter->AddInputConnection(second->GetOutputPort());
  CHECK(checks, publishedTimes(barycenter) == Values({ 0.5, 2.0, 4.0, 6.0, 9.0 }));
  Values last;
  for (const double time : { 4.0, 6.0 })
  {
    barycenter->UpdateTimeStep(time);
    CHECK(checks, first->Asked == time && second->Asked == time);
    CHECK(checks, dataTime(barycenter->GetDensity()) == time);
    CHECK(checks, densityValues(barycenter).size() == 120 && densityValues(barycenter) != last);
    last = densityValues(barycenter);
  }
}

} // namespace

int TestMorphTime(int, char*[])
{
  Checks checks;
  checkPublished(checks);
  checkTime(checks);
  checkInputs(checks, true);
  checkInputs(checks, false);
  checkBarycenter(checks);
  return checks.Result();
}
