// SPDX-License-Identifier: BSD-3-Clause
// A crafted input through all filters, and what must not come of it.
#include "Crafted.h"

#include "CraftedFilters.h"
#include "Listener.h"
#include "Outcome.h"
#include "Watch.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkTransportSampler.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace Campaign
{

namespace
{

// Where the program is, should it end: run.py tells readers' ends from those of filters.
void announce(const std::string& what, const std::string& input)
{
  std::printf("# %s (%s)\n", what.c_str(), input.c_str());
  std::fflush(stdout);
}

bool isOwn(const char* name)
{
  for (const char* own :
    { "Displacement", "Density", "Mass", "SeedPosition", "TotalMass", "TransportCost", "CellMass",
      "CellCentroid", "CellCost", "Divergence", "JacobianDeterminant", "AreaPreserving",
      "Conformal", "SourcePosition", "TargetPosition", "DensityError", "MeanSpacing" })
  {
    if (name && std::string(name) == own)
    {
      return true;
    }
  }
  return false;
}

void requireFinite(vtkDataObject* output, Findings& findings)
{
  if (auto* set = vtkPointSet::SafeDownCast(output))
  {
    for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i)
    {
      double x[3];
      set->GetPoint(i, x);
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
      {
        findings.That(false, "point " + std::to_string(i) + " is not finite");
        break;
      }
    }
  }
  for (const int owner :
    { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::FIELD, vtkDataObject::ROW })
  {
    vtkFieldData* arrays = output->GetAttributesAsFieldData(owner);
    for (int k = 0; arrays && k < arrays->GetNumberOfArrays(); ++k)
    {
      vtkDataArray* array = arrays->GetArray(k);
      // NaN says that there is nothing to measure.
      const std::string name = array && array->GetName() ? array->GetName() : "";
      if (!array || !isOwn(array->GetName()) || name == "AreaErrorEstimate" ||
        name == "LargestBlockError")
      {
        continue;
      }
      for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
      {
        const int components = array->GetNumberOfComponents();
        if (!std::isfinite(array->GetComponent(i / components, static_cast<int>(i % components))))
        {
          findings.That(false, std::string(array->GetName()) + " is not finite");
          break;
        }
      }
    }
  }
}

class CraftedRun
{
public:
  CraftedRun(std::uint64_t seed, std::uint64_t number, const std::string& folder)
    : Random(seed * 0x9e3779b97f4a7c15 + number * 0xd1342543de82ef95 + 0x5851f42d4c957f2d)
    , Path(folder + "/crafted" + std::to_string(number))
  {
  }

  CaseResult Run()
  {
    this->Result.Filter = "crafted";
    this->Make(this->Text);
    this->Result.Log += this->Text + "\n";
    this->Clear();
    if (!this->Data)
    {
      this->Result.Log += "refused by the reader\n";
      return this->Result;
    }
    const Mass mass = this->IsSound ? integralOf(this->Data) : Mass();
    for (const CraftedFilter& filter : craftedFilters())
    {
      RandomSource own(this->Random.Next());
      if (filter.Takes == "vtkDataObject" || this->Data->IsA(filter.Takes.c_str()))
      {
        this->RunFilter(filter, own, mass);
      }
    }
    return this->Result;
  }

private:
  void Make(std::string& text)
  {
    const bool ofFile = this->Random.Chance(0.6);
    this->IsSound = this->Random.Chance(0.1);
    announce("making", ofFile ? "a file" : "an object");
    vtkNew<SilentWindow> window;
    vtkOutputWindow::SetInstance(window);
    this->Data = drawSoundObject(this->Random, text);
    const std::string file = ofFile ? writeFile(this->Random, this->Data, this->Path) : "";
    if (file.empty())
    {
      this->Result.Filter = "objects";
      for (std::int64_t i = this->IsSound ? 0 : this->Random.Of({ 1, 1, 2 }); i > 0; --i)
      {
        damage(this->Random, this->Data, text);
      }
      return;
    }
    this->Result.Filter = std::filesystem::path(file).extension().string();
    if (!this->IsSound)
    {
      damageFile(this->Random, file, text);
    }
    text += " in " + file;
    announce("reading", text);
    startWatch(5);
    this->Data = readFile(file);
    startWatch(60);
    this->Result.Input = digestOfArrays(this->Data, 1);
    this->IsSound = false; // a type of file may have nothing but points
  }

  // What was written: a file, and those of blocks beside it.
  void Clear() const
  {
    const std::filesystem::path path(this->Path);
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(path.parent_path(), ignored))
    {
      const std::string name = entry.path().filename().string();
      const std::string own = path.filename().string();
      if (name.compare(0, own.size() + 1, own + ".") == 0 || name == own)
      {
        std::filesystem::remove_all(entry.path(), ignored);
      }
    }
  }

  void RunFilter(const CraftedFilter& kind, RandomSource& random, const Mass& mass)
  {
    announce("running " + kind.Name, this->Text);
    const vtkSmartPointer<vtkAlgorithm> filter = newCrafted(kind, random, this->Data);
    Findings findings;
    const Outcome outcome = update(filter, {}, findings);
    ++this->Result.Runs;
    this->Result.Errors += outcome.Errors.empty() ? 0 : 1;
    this->Result.Digest = this->Result.Digest * 31 + outcome.Digest;
    this->Result.Log += kind.Name + "\n";
    for (const std::string& message : outcome.Errors)
    {
      this->Result.Log += "  message: " + message + "\n";
    }
    for (const std::string& message : outcome.Warnings)
    {
      this->Result.Log += "  warning: " + message + "\n";
    }
    findings.That(outcome.Errors.size() <= 1, "at most one error");
    findings.That(outcome.Errors.empty() || outcome.IsEmpty, "an error leaves nothing");
    for (const std::string& message : outcome.Others)
    {
      findings.That(false, "something else said: " + message);
    }
    if (outcome.Errors.empty())
    {
      for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
      {
        requireFinite(filter->GetOutputDataObject(port), findings);
      }
      this->CompareMass(filter, outcome, mass, findings);
    }
    for (const std::string& finding : findings.All)
    {
      this->Result.Log += "  WRONG: " + finding + "\n";
      this->Result.Findings.push_back(kind.Name + ": " + finding);
    }
  }

  // Of a sound object, the mass of its cell array is what VTK finds, or a warning says why not.
  void CompareMass(
    vtkAlgorithm* filter, const Outcome& outcome, const Mass& mass, Findings& findings) const
  {
    auto* sampler = vtkTransportSampler::SafeDownCast(filter);
    if (!mass.IsKnown || !sampler || !outcome.Warnings.empty() || sampler->GetInvertDensity() ||
      sampler->GetInputDataObject(0, 0) != this->Data || outcome.IsEmpty)
    {
      return;
    }
    vtkInformation* choice = sampler->GetInputArrayInformation(0);
    const bool byCells = choice && choice->Has(vtkDataObject::FIELD_NAME()) &&
      std::string(choice->Get(vtkDataObject::FIELD_NAME())) == "v";
    vtkDataArray* total = sampler->GetOutput()->GetFieldData()->GetArray("TotalMass");
    if (byCells && total)
    {
      findings.Near(total->GetComponent(0, 0), mass.Value, 2e-3, "TotalMass");
    }
  }

  RandomSource Random;
  std::string Path;
  std::string Text; // what the input is
  vtkSmartPointer<vtkDataObject> Data;
  bool IsSound = false;
  CaseResult Result;
};

} // namespace

CaseResult runCraftedCase(std::uint64_t seed, std::uint64_t number, const std::string& folder)
{
  return CraftedRun(seed, number, folder).Run();
}

} // namespace Campaign
