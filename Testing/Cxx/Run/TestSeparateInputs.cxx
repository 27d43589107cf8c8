// SPDX-License-Identifier: BSD-3-Clause
// Inputs that are several times of one source: each has its own, whatever was requested before, and
// the source runs no more often than it must.
#include "BlendTest.h"
#include "TestSource.h"
#include "TimesTest.h"
#include "WarpTest.h"

#include "vtkTable.h"
#include "vtkTransportMap.h"
#include "vtkTransportQuality.h"
#include "vtkVariant.h"

#include <optional>

namespace
{

constexpr int cellsAlong = 40;
constexpr double firstTime = 0.0;
constexpr double lastTime = 9.0;

// The centroid along x of the density at a time.
double placeAt(double time)
{
  return 5.0 + 3.0 * time;
}

vtkSmartPointer<vtkImageData> densityAt(double time)
{
  auto image = makeDensity({ cellsAlong, 8, 1 }, true, [=](vtkIdType i) {
    const double x = static_cast<double>(i % cellsAlong) + 0.5 - placeAt(time);
    return std::abs(x) < 2.0 ? 1.0 : 0.0;
  });
  image->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  return image;
}

// A density that moves along x, at whole times. `runs` gets the times that it is made for.
vtkSmartPointer<ImageSource> makeSeries(Times& runs)
{
  auto source = vtkSmartPointer<ImageSource>::New();
  source->Publish = [](vtkInformation* output) {
    const int extent[6] = { 0, cellsAlong, 0, 8, 0, 0 };
    output->Set(Pipeline::WHOLE_EXTENT(), extent, 6);
    Times times(10);
    std::iota(times.begin(), times.end(), firstTime);
    publishTimes(output, times);
  };
  source->Make = [&runs](vtkInformation* output) {
    const double asked = output->Has(Pipeline::UPDATE_TIME_STEP())
      ? output->Get(Pipeline::UPDATE_TIME_STEP())
      : firstTime;
    const double time = std::clamp(std::round(asked), firstTime, lastTime);
    runs.push_back(time);
    return densityAt(time);
  };
  return source;
}

// A filter of VTK's kind: the executive passes the requests of all its inputs together. Takes what
// it gets of each.
class JoinFilter : public vtkImageAlgorithm
{
public:
  static JoinFilter* New();
  vtkTypeMacro(JoinFilter, vtkImageAlgorithm);
  Values Places; // the centroids of the inputs at the last run

protected:
  JoinFilter() { this->SetNumberOfInputPorts(2); }
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
};
vtkStandardNewMacro(JoinFilter);

double placeOf(vtkImageData* image)
{
  vtkDataArray* density = image->GetCellData()->GetArray("Density");
  double mass = 0.0;
  double moment = 0.0;
  for (vtkIdType i = 0; density && i < density->GetNumberOfTuples(); ++i)
  {
    mass += density->GetTuple1(i);
    moment += density->GetTuple1(i) * (static_cast<double>(i % cellsAlong) + 0.5);
  }
  return moment / mass;
}

int JoinFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Places = { placeOf(vtkImageData::GetData(inputs[0])),
    placeOf(vtkImageData::GetData(inputs[1])) };
  vtkImageData::GetData(outputs)->ShallowCopy(vtkImageData::GetData(inputs[0]));
  return 1;
}

using Requests = std::vector<std::optional<double>>; // of times, or of none

void update(vtkAlgorithm* filter, const std::optional<double>& time)
{
  auto* pipeline = Pipeline::SafeDownCast(filter->GetExecutive());
  if (time)
  {
    filter->UpdateInformation();
    pipeline->GetOutputInformation(0)->Set(Pipeline::UPDATE_TIME_STEP(), *time);
  }
  filter->Update();
}

vtkSmartPointer<vtkTransportInterpolator> morphOf(vtkAlgorithm* source, vtkAlgorithm* target)
{
  auto morph = vtkSmartPointer<vtkTransportInterpolator>::New();
  morph->SetInputConnection(source->GetOutputPort());
  morph->SetTargetConnection(target->GetOutputPort());
  return morph;
}

// The centroids of a morph at its ends.
void checkEnds(Checks& checks, vtkTransportInterpolator* morph, const Requests& requests,
  double source, double target, int line)
{
  for (const auto& time : requests)
  {
    for (const double parameter : { 0.0, 1.0, 0.0 })
    {
      morph->SetParameter(parameter);
      update(morph, time);
      checks.Near(placeOf(morph->GetDensity()), placeAt(parameter == 0.0 ? source : target), 0.1,
        time ? "the centroid at the time" : "the centroid without a time", line);
    }
  }
}

const std::vector<Requests>& orders()
{
  static const std::vector<Requests> all{ { 0.0 }, { 9.0 }, { 5.0 }, { std::nullopt }, { 5.0, 5.0 },
    { 0.0, 9.0 }, { 9.0, 0.0 }, { std::nullopt, 5.0 }, { 5.0, std::nullopt },
    { 4.5, 9.0, 0.0, std::nullopt } };
  return all;
}

// From cold, in every order of requests.
void checkChosenTimes(Checks& checks)
{
  for (const Choice how : { Choice::One, Choice::Kept })
  {
    for (const Requests& requests : orders())
    {
      Times runs;
      auto series = makeSeries(runs);
      checkEnds(checks, morphOf(choose(series, how, 0.0), choose(series, how, 9.0)), requests, 0.0,
        9.0, __LINE__);
      auto between = choose(series, Choice::Pass);
      checkEnds(checks,
        morphOf(choose(choose(between, how, 7.0), Choice::Pass),
          choose(choose(between, how, 2.0), Choice::Pass)),
        requests, 7.0, 2.0, __LINE__);
    }
    Times runs;
    auto series = makeSeries(runs);
    checkEnds(checks, morphOf(choose(series, how, 3.0), choose(series, how, 3.0)),
      { 5.0, std::nullopt }, 3.0, 3.0, __LINE__);
  }
}

// How far the density goes from one time of the series to another.
void checkMap(Checks& checks)
{
  for (const Choice how : { Choice::One, Choice::Kept })
  {
    for (const Requests& requests : orders())
    {
      Times runs;
      auto series = makeSeries(runs);
      auto from = choose(series, how, 7.0);
      auto to = choose(series, how, 2.0);
      vtkNew<vtkTransportMap> map;
      map->SetInputConnection(from->GetOutputPort());
      map->SetTargetConnection(to->GetOutputPort());
      for (const auto& time : requests)
      {
        map->SetDirection(1 - map->GetDirection());
        update(map, time);
        const double way = std::sqrt(fieldValue(map->GetOutput(), "TransportCost"));
        CHECK_NEAR(checks, way, placeAt(7.0) - placeAt(2.0), 0.1);
        CHECK_NEAR(
          checks, placeOf(map->GetOutput()), placeAt(map->GetDirection() == 0 ? 7.0 : 2.0), 1e-6);
      }
    }
  }
}

// One input at the time of the pipeline, the other at one of its own.
void checkSourceItself(Checks& checks)
{
  for (const Choice how : { Choice::One, Choice::Kept })
  {
    for (const std::optional<double> time : Requests{ 0.0, 5.0, 9.0, std::nullopt })
    {
      Times runs;
      auto series = makeSeries(runs);
      auto chosen = choose(series, how, 7.0);
      checkEnds(checks, morphOf(series, chosen), { time }, time.value_or(0.0), 7.0, __LINE__);
      checkEnds(checks, morphOf(chosen, series), { time }, 7.0, time.value_or(0.0), __LINE__);
    }
  }
  for (const std::optional<double> time : Requests{ 0.0, 3.0, 9.0, std::nullopt })
  {
    Times runs;
    auto series = makeSeries(runs);
    const double now = time.value_or(0.0);
    checkEnds(checks, morphOf(series, choose(series, Choice::Shifted, 4.0)), { time }, now,
      std::min(9.0, now + 4.0), __LINE__);
  }
}

// While it plays the series stays at its first time, as each input sees it.
void checkPlay(Checks& checks)
{
  Times runs;
  auto series = makeSeries(runs);
  auto morph = morphOf(series, choose(series, Choice::Shifted, 6.0));
  morph->PublishTimeOn();
  for (const double time : { 1.0, 0.0, 0.5 })
  {
    update(morph, time);
    checks.Near(placeOf(morph->GetDensity()), placeAt(6.0 * time), 0.1, "the centroid", __LINE__);
  }
  CHECK(checks, runs == Times({ 6.0, 0.0 }));
}

// A change of the filter alone makes no data anew, and another time only those of that time.
void checkRuns(Checks& checks)
{
  Times runs;
  auto series = makeSeries(runs);
  auto morph = morphOf(series, choose(series, Choice::One, 7.0));
  update(morph, 0.0);
  CHECK(checks, runs == Times({ 7.0, 0.0 }));
  const vtkMTimeType built = morph->GetTableBuildTime();
  for (const double parameter : { 0.0, 0.25, 1.0 })
  {
    morph->SetParameter(parameter);
    update(morph, 0.0);
  }
  CHECK(checks, runs.size() == 2 && morph->GetTableBuildTime() == built);

  runs.clear();
  morph = morphOf(choose(series, Choice::Kept, 2.0), choose(series, Choice::Kept, 7.0));
  update(morph, 5.0);
  CHECK(checks, runs == Times({ 2.0, 5.0, 7.0, 5.0 })); // the filters of VTK run twice at first
  const vtkMTimeType first = morph->GetTableBuildTime();
  runs.clear();
  for (const double time : { 3.0, 4.0, 4.0 })
  {
    update(morph, time);
  }
  CHECK(checks, runs == Times({ 3.0, 4.0 }) && morph->GetTableBuildTime() == first);

  // Inputs that share a source at one time are made once.
  runs.clear();
  morph = morphOf(series, choose(series, Choice::Pass));
  update(morph, 6.0);
  CHECK(checks, runs == Times({ 6.0 }));
}

// Filters with data that another filter requested together, and mixed up.
void checkAfterOthers(Checks& checks)
{
  for (const Choice how : { Choice::One, Choice::Kept })
  {
    for (const double time : { 0.0, 5.0, 9.0 })
    {
      Times runs;
      auto series = makeSeries(runs);
      auto first = choose(choose(series, Choice::Pass), how, 1.0);
      auto second = choose(choose(series, Choice::Pass), how, 8.0);
      vtkNew<JoinFilter> join;
      join->SetInputConnection(0, first->GetOutputPort());
      join->SetInputConnection(1, second->GetOutputPort());
      update(join, time);
      auto morph = morphOf(first, second);
      checkEnds(checks, morph, { time }, 1.0, 8.0, __LINE__);
      runs.clear();
      morph->SetParameter(0.5);
      update(morph, time);
      CHECK(checks, runs.empty());
    }
  }
}

// Another consumer of the source gets the time that it requested.
void checkBesideOthers(Checks& checks)
{
  Times runs;
  auto series = makeSeries(runs);
  auto morph = morphOf(choose(series, Choice::One, 1.0), choose(series, Choice::Kept, 8.0));
  morph->SetParameter(0.0);
  vtkNew<JoinFilter> join;
  join->SetInputConnection(0, series->GetOutputPort());
  join->SetInputConnection(1, morph->GetOutputPort());
  for (const double time : { 5.0, 9.0, 0.0 })
  {
    update(join, time);
    checks.Near(join->Places[0], placeAt(time), 1e-9, "the source's centroid", __LINE__);
    checks.Near(join->Places[1], placeAt(1.0), 0.1, "the morph's centroid", __LINE__);
  }

  // Information that is asked for without a time requests none.
  series->UpdateTimeStep(5.0);
  morphOf(series, choose(series, Choice::One, 1.0))->UpdateInformation();
  runs.clear();
  series->Update();
  CHECK(checks, runs.empty());
}

// Three times of one source, and the source itself.
void checkBarycenter(Checks& checks)
{
  for (const Choice how : { Choice::One, Choice::Kept })
  {
    for (const double time : { 0.0, 6.0, 9.0 })
    {
      Times runs;
      auto series = makeSeries(runs);
      vtkNew<vtkTransportBarycenter> barycenter;
      const Values own{ 2.0, time, 8.0, 5.0 };
      for (const double chosen : own)
      {
        vtkSmartPointer<vtkAlgorithm> input = series;
        if (chosen != time)
        {
          input = choose(series, how, chosen);
        }
        barycenter->AddInputConnection(input->GetOutputPort());
      }
      for (int i = 0; i < 4; ++i)
      {
        for (int j = 0; j < 4; ++j)
        {
          barycenter->SetWeight(j, i == j ? 1.0 : 0.0);
        }
        update(barycenter, time);
        checks.Near(placeOf(barycenter->GetDensity()), placeAt(own[static_cast<std::size_t>(i)]),
          0.1, "the centroid", __LINE__);
      }
    }
  }
}

// Filters of points and a density, both made of one source: as of two sources.
template <class Filter>
void checkPoints(Checks& checks, const std::function<Values(Filter*)>& result)
{
  const auto run = [&](vtkAlgorithm* forPoints, vtkAlgorithm* forDensity) {
    vtkNew<Filter> filter;
    filter->SetInputConnection(0, forPoints->GetOutputPort());
    filter->SetInputConnection(1, forDensity->GetOutputPort());
    update(filter, 6.0);
    return result(filter);
  };
  for (const Choice how : { Choice::One, Choice::Kept })
  {
    Times runs;
    Times otherRuns;
    auto series = makeSeries(runs);
    auto other = makeSeries(otherRuns);
    const auto particles = [&](vtkAlgorithm* source) {
      auto sampler = vtkSmartPointer<vtkTransportSampler>::New();
      sampler->SetNumberOfParticles(50);
      sampler->SetInputConnection(choose(source, how, 2.0)->GetOutputPort());
      return sampler;
    };
    CHECK(checks, run(particles(series), series) == run(particles(series), other));
    CHECK(checks,
      run(particles(series), choose(series, how, 3.0)) ==
        run(particles(series), choose(other, how, 3.0)));
  }
}

void checkPointFilters(Checks& checks)
{
  checkPoints<vtkDensityEqualizingWarp>(
    checks, [](auto* warp) { return coordinates(warp->GetOutput()); });
  checkPoints<vtkTransportQuality>(checks, [](auto* quality) {
    vtkTable* table = quality->GetOutput();
    return Values{ table->GetValueByName(0, "DensityError").ToDouble(),
      table->GetValueByName(0, "InEmptyCells").ToDouble() };
  });
}

// What fails before an input is one error of the filter, and nothing is lost.
void checkFailure(Checks& checks)
{
  Times runs;
  auto series = makeSeries(runs);
  auto first = choose(series, Choice::One, 1.0);
  auto second = choose(series, Choice::One, 8.0);
  auto morph = morphOf(first, second);
  second->Fails = true;
  Messages upstream(second);
  Messages messages(morph);
  update(morph, 0.0);
  CHECK(checks, upstream.Errors.size() == 1);
  CHECK(checks, messages.IsOneError("Input port 1 could not be updated"));
  CHECK(checks, morph->GetDensity()->GetNumberOfPoints() == 0);
  second->Fails = false;
  second->Modified();
  checkEnds(checks, morph, { 0.0 }, 1.0, 8.0, __LINE__);
}

} // namespace

int TestSeparateInputs(int, char*[])
{
  return runChecks({ checkChosenTimes, checkMap, checkSourceItself, checkPlay, checkRuns,
    checkAfterOthers, checkBesideOthers, checkBarycenter, checkPointFilters, checkFailure });
}
