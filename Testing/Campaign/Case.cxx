// SPDX-License-Identifier: BSD-3-Clause
#include "Case.h"

#include "Downstream.h"
#include "FilterKind.h"
#include "Listener.h"

#include "vtkTrivialProducer.h"

#include <algorithm>

namespace Campaign
{

namespace
{

void connect(vtkAlgorithm* filter, const Inputs& inputs)
{
  for (std::size_t port = 0; port < inputs.size(); ++port)
  {
    filter->RemoveAllInputConnections(static_cast<int>(port));
    for (const Input& input : inputs[port])
    {
      if (input.Series)
      {
        filter->AddInputConnection(static_cast<int>(port), input.Series->GetOutputPort());
      }
      else if (input.Data)
      {
        filter->AddInputDataObject(static_cast<int>(port), input.Data);
      }
    }
  }
}

// Filters of VTK downstream keep the extent that was announced, which is that of one step.
bool changesGrid(const Inputs& inputs)
{
  for (const auto& port : inputs)
  {
    for (const Input& input : port)
    {
      for (const Input& step : input.Steps)
      {
        const int* first = vtkImageData::SafeDownCast(input.Steps[0].Data)->GetExtent();
        const int* extent = vtkImageData::SafeDownCast(step.Data)->GetExtent();
        const bool isSame =
          std::equal(first, first + 6, extent) && step.OnPoints == input.Steps[0].OnPoints;
        if (input.Series && !isSame)
        {
          return true;
        }
      }
    }
  }
  return false;
}

RandomSource randomOf(std::uint64_t seed, std::uint64_t number)
{
  return RandomSource(seed * 0x9e3779b97f4a7c15 + number * 0xd1342543de82ef95);
}

const FilterKind& drawKind(RandomSource& random)
{
  const auto last = static_cast<std::int64_t>(filterKinds().size()) - 1;
  return filterKinds()[static_cast<std::size_t>(random.Whole(0, last))];
}

class CaseRun
{
public:
  CaseRun(std::uint64_t seed, std::uint64_t number)
    : Random(randomOf(seed, number))
    , Kind(drawKind(this->Random))
    , Properties(this->Random)
  {
    this->Result.Filter = this->Kind.Name;
    this->Kind.DrawSettings(this->Properties);
    this->MakeInputs();
  }

  CaseResult Run()
  {
    this->Print(this->Properties.Describe());
    this->PrintInputs();
    this->Filter = this->Kind.New();
    connect(this->Filter, this->ConnectedInputs);
    this->Properties.Apply(this->Filter);
    const std::int64_t runs = this->Random.Of({ 1, 1, 2, 2, 3, 4 });
    for (std::int64_t i = 0; i < runs; ++i)
    {
      if (i > 0)
      {
        this->Change();
      }
      const bool disturbed = this->Random.Chance(0.1);
      if (disturbed)
      {
        this->RunDisturbed();
      }
      const Outcome before = this->Last;
      this->RunOnce();
      if (disturbed && !before.IsEmpty)
      {
        this->Same(before, "what a disturbed run leaves is whole");
      }
      // Of inputs that VTK itself turns down, what was there before stays.
      if (this->ArePlain && (disturbed || (i > 0 && this->Random.Chance(0.5))))
      {
        this->CompareFresh();
      }
    }
    this->RunDownstream();
    return this->Result;
  }

private:
  void MakeInputs()
  {
    this->ConnectedInputs = this->Kind.DrawInputs(this->Random, this->Properties);
    this->ArePlain = true;
    for (auto& port : this->ConnectedInputs)
    {
      for (Input& input : port)
      {
        drawUnusual(this->Random, input);
        this->ArePlain = this->ArePlain && input.IsPlain;
      }
    }
  }

  // Of the inputs, and of settings that are in their ranges.
  State Expect() const
  {
    const State state = this->Properties.IsOdd() ? State::Odd : State::Sound;
    return worse(
      this->ArePlain ? this->Kind.Expect(this->Filter, this->ConnectedInputs) : State::Open, state);
  }

  void Print(const std::string& text) { this->Result.Log += text + "\n"; }

  void PrintInputs()
  {
    for (std::size_t port = 0; port < this->ConnectedInputs.size(); ++port)
    {
      for (const Input& input : this->ConnectedInputs[port])
      {
        const char* const states[] = { "sound", "empty", "odd", "faulty", "open" };
        this->Print("  port " + std::to_string(port) + " (" +
          states[static_cast<int>(input.Condition)] + "): " + input.Text);
      }
    }
  }

  // Something else from one run to the next, or nothing.
  void Change()
  {
    if (this->Last.IsEmpty)
    {
      this->Filter->Modified(); // what has failed runs again only if it was changed
    }
    switch (this->Random.Whole(0, 4))
    {
      case 0:
      {
        const std::size_t before = this->Properties.Count();
        this->Kind.DrawSettings(this->Properties);
        this->Print("changed:" + this->Properties.Describe(before));
        this->Properties.Apply(this->Filter);
        break;
      }
      case 1:
      {
        const std::size_t before = this->Properties.Count();
        this->MakeInputs();
        this->Print("other inputs" + this->Properties.Describe(before));
        this->PrintInputs();
        connect(this->Filter, this->ConnectedInputs);
        this->Properties.Apply(this->Filter);
        break;
      }
      case 2:
      case 3:
        this->Print("written in place");
        for (auto& port : this->ConnectedInputs)
        {
          for (Input& input : port)
          {
            changeInPlace(this->Random, input);
          }
        }
        break;
      default:
        this->Print("run again");
        this->Filter->Modified();
    }
  }

  void RunOnce()
  {
    Findings findings;
    this->Last = update(this->Filter, {}, findings);
    this->Judge(this->Last, findings);
    this->Take(findings);
    this->Result.Digest = this->Result.Digest * 31 + this->Last.Digest;
    ++this->Result.Runs;
  }

  // By an abort or by too little memory; the next run is a new one.
  void RunDisturbed()
  {
    Disturbance disturbance;
    if (this->Random.Chance(0.7))
    {
      disturbance.AbortAt = static_cast<int>(this->Random.Whole(0, 12));
      this->Print("aborted at progress " + std::to_string(disturbance.AbortAt));
    }
    else
    {
      disturbance.Memory = this->Random.Whole(0, 1 << 20);
      this->Print("limited to " + std::to_string(disturbance.Memory) + " bytes more");
    }
    Findings findings;
    this->Filter->Modified();
    this->Last = update(this->Filter, disturbance, findings);
    const std::size_t errors = this->Last.Errors.size();
    if (this->Last.Aborted)
    {
      ++this->Result.Aborts;
      const bool sound = this->Properties.OutOfRange().empty() && this->Expect() == State::Sound;
      findings.That(errors == 0 || !sound, "an abort is no error");
    }
    this->Result.Limits += disturbance.Memory >= 0 && errors > 0 ? 1 : 0;
    findings.That(errors <= 1 || !this->ArePlain, "at most one error");
    findings.That(errors == 0 || this->Last.IsEmpty || !this->ArePlain, "an error leaves nothing");
    this->Take(findings);
    this->Filter->Modified();
  }

  void Same(const Outcome& other, const std::string& what)
  {
    Findings findings;
    findings.That(other.Digest == this->Last.Digest, what);
    this->Take(findings);
  }

  // A filter downstream requests what this one has made already.
  void RunDownstream()
  {
    if (this->Last.IsEmpty || !this->ArePlain || !this->Random.Chance(0.3) ||
      changesGrid(this->ConnectedInputs))
    {
      return;
    }
    const vtkSmartPointer<vtkAlgorithm> downstream = drawDownstream(this->Random, this->Filter);
    if (!downstream)
    {
      return;
    }
    this->Print(std::string("downstream: ") + downstream->GetClassName());
    Findings findings;
    const Outcome outcome = update(downstream, {}, findings);
    for (const std::string& text : outcome.Others)
    {
      findings.That(false, "something else said: " + text);
    }
    std::uint64_t now = this->Last.Errors.size();
    for (int port = 0; port < this->Filter->GetNumberOfOutputPorts(); ++port)
    {
      now = digest(this->Filter->GetOutputDataObject(port), now);
    }
    findings.That(now == this->Last.Digest, "what is downstream changes nothing");
    this->Take(findings);
    this->Result.Digest = this->Result.Digest * 31 + outcome.Digest;
    if (outcome.Errors.empty())
    {
      this->AbortBefore(downstream, outcome);
    }
  }

  // An abort leaves nothing to a filter that has read before; afterwards all is as it was.
  void AbortBefore(vtkAlgorithm* downstream, const Outcome& whole)
  {
    this->Filter->Modified();
    {
      const Listener aborting(this->Filter, static_cast<int>(this->Random.Whole(0, 6)));
      downstream->Update();
      this->Result.Aborts += aborting.HasAborted ? 1 : 0;
    }
    this->Filter->SetAbortExecute(0);
    this->Filter->Modified();
    Findings findings;
    const Outcome again = update(downstream, {}, findings);
    findings.That(again.Digest == whole.Digest, "after an abort what is downstream is as before");
    this->Take(findings);
  }

  // Whatever a filter has kept from run to run must not show.
  void CompareFresh()
  {
    const vtkSmartPointer<vtkAlgorithm> fresh = this->Kind.New();
    connect(fresh, this->ConnectedInputs);
    this->Properties.Apply(fresh);
    Findings findings;
    const Outcome other = update(fresh, {}, findings);
    this->Take(findings);
    this->Same(other, "another filter gives the same");
  }

  void Judge(const Outcome& outcome, Findings& findings)
  {
    const std::vector<Setting> wrong = this->Properties.OutOfRange();
    const State ofInputs = this->Expect();
    const bool areTooLarge = std::all_of(
      wrong.begin(), wrong.end(), [](const Setting& setting) { return setting.IsTooLarge; });
    const State expected = wrong.empty() || !this->ArePlain ? ofInputs
      : areTooLarge                                         ? worse(ofInputs, State::Faulty)
                                                            : State::Faulty;
    for (const std::string& text : outcome.Errors)
    {
      this->Print("  message: " + text);
    }
    this->Result.Errors += outcome.Errors.empty() ? 0 : 1;
    findings.That(outcome.Errors.size() <= 1 || !this->ArePlain, "at most one error");
    for (const std::string& text : outcome.Others)
    {
      findings.That(false, "something else said: " + text);
    }
    const bool failed = !outcome.Errors.empty();
    findings.That(!failed || outcome.IsEmpty || !this->ArePlain, "an error leaves nothing");
    findings.That(!failed || (expected != State::Sound && expected != State::Empty), "no error");
    findings.That(failed || expected != State::Faulty, "an error");
    findings.That(outcome.IsEmpty || expected != State::Empty, "an empty output");
    findings.That(failed || !outcome.IsEmpty || expected != State::Sound, "an output");
    if (failed && !wrong.empty() && ofInputs == State::Sound)
    {
      findings.That(std::any_of(wrong.begin(), wrong.end(),
                      [&](const Setting& setting) {
                        return outcome.Errors[0].find(setting.Name) != std::string::npos;
                      }),
        "the error names " + wrong[0].Name);
    }
    if (!failed && !outcome.IsEmpty && this->ArePlain)
    {
      this->Kind.Check(this->Filter, this->ConnectedInputs, findings);
    }
  }

  void Take(const Findings& findings)
  {
    for (const std::string& text : findings.All)
    {
      this->Print("  WRONG: " + text);
      this->Result.Findings.push_back(text);
    }
  }

  RandomSource Random;
  const FilterKind& Kind;
  Settings Properties;
  Inputs ConnectedInputs;
  bool ArePlain = true;
  vtkSmartPointer<vtkAlgorithm> Filter;
  Outcome Last;
  CaseResult Result;
};

} // namespace

std::string filterOfCase(std::uint64_t seed, std::uint64_t number)
{
  RandomSource random = randomOf(seed, number);
  return drawKind(random).Name;
}

CaseResult runCase(std::uint64_t seed, std::uint64_t number)
{
  return CaseRun(seed, number).Run();
}

} // namespace Campaign
