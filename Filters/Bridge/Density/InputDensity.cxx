// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/InputDensity.h"

#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Settings/ComponentChoice.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/Reading/DensityFailure.h"

#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport::Bridge
{

// What outputs record of the rules. An end without a bound gets the finite number that ValidRange
// has for it.
DensityReading readingBy(const DensityRules& rules, const std::string& arrayName, int components)
{
  return { arrayName, components, rules.Component, rules.Invert,
    { std::max(rules.Missing.Low, -Unbounded), std::min(rules.Missing.High, Unbounded) } };
}

void addReadings(vtkDataObject* output, const std::vector<DensityReading>& readings)
{
  // One value for each input, so that scripts can see how a result was made.
  vtkNew<vtkStringArray> names;
  names->SetName("DensityArrayName");
  vtkNew<vtkDoubleArray> ranges;
  ranges->SetName("DensityRange");
  // DensityRange has one component, as VTK's readers refuse the norms of tuples that overflow:
  // those of ranges without limits do.
  std::vector<double> components;
  std::vector<double> inverted;
  for (const DensityReading& reading : readings)
  {
    names->InsertNextValue(reading.ArrayName);
    components.push_back(reading.Component);
    inverted.push_back(reading.IsInverted ? 1.0 : 0.0);
    ranges->InsertNextValue(reading.Range[0]);
    ranges->InsertNextValue(reading.Range[1]);
  }
  output->GetFieldData()->AddArray(names);
  addFieldValues(output, "DensityComponent", components);
  addFieldValues(output, "DensityInverted", inverted);
  output->GetFieldData()->AddArray(ranges);
}

InputDensity::InputDensity(const std::string& name, const DensityRules& rules)
  : Rules(rules)
  , Name(name)
{
}

// A padded density reads its values as the inner one does, but its identity includes the margin and
// the rule for the margin's cells: tables of both differ. Some of its cells are empty.
InputDensity::InputDensity(const InputDensity& inner, const ImageGrid& grown,
  const GridSize<3>& margin, const EmptyRule& rule)
  : Geometry(grown)
  , Rules(inner.Rules)
  , Read(inner.Read)
  , Name(inner.Name)
  , MayBeEmpty(true)
  , Reading(inner.Reading)
{
  this->Reading.AddNumber(static_cast<std::uint64_t>(rule.Cells));
  this->Reading.AddNumbers(&rule.Value, 1);
  for (const std::int64_t cells : margin)
  {
    this->Reading.AddNumber(static_cast<std::uint64_t>(cells));
  }
}

InputDensity::~InputDensity() = default;

void InputDensity::SetForm(const ArrayForm& form, const std::vector<std::uint64_t>& times)
{
  // From here on Rules.Component is an index, Luminance or Magnitude, not Auto.
  this->Rules.Component = resolveComponent(this->Name, this->Rules.Component,
    automaticComponent(form.Type, form.Components), form.Components);
  this->Read = readingBy(this->Rules, this->NameOfArray(), form.Components);
  // Cell ghosts do not hide point values; point ghosts hide both.
  this->MayBeEmpty = this->Rules.Missing.Are() || form.HasPointGhosts ||
    (form.HasCellGhosts && !this->Geometry.IsOnPoints());
  // The identity of the tables: form and place of the values, and the sizes of the grid. Origin and
  // directions of the grid are no part of it, as the core works in index space.
  const GridSize<3> size = this->CellsInSpace();
  for (const std::int64_t number : { std::int64_t{ form.Type }, std::int64_t{ form.Components },
         std::int64_t{ this->Geometry.Dimension() }, size[0], size[1], size[2],
         std::int64_t{ this->Owner() }, std::int64_t{ form.HasPointGhosts },
         std::int64_t{ form.HasCellGhosts } })
  {
    this->Reading.AddNumber(static_cast<std::uint64_t>(number));
  }
  // Length, area or volume of a cell, by which the total mass is in physical units.
  const double measure = this->Geometry.CellMeasure();
  this->Reading.AddNumbers(&measure, 1);
  // Without empty cells what they count as is part of no density.
  DensityRules rules = this->Rules;
  rules.Empty = this->MayBeEmpty ? this->Rules.Empty : EmptyRule();
  this->Reading.AddRules(rules);
  for (const std::uint64_t time : times)
  {
    this->Reading.AddTime(time);
  }
}

DataIdentity InputDensity::Identity() const
{
  DataIdentity identity = this->Reading;
  identity.SetHasher([this](Progress& progress) { return this->Hash(progress); });
  return identity;
}

// Values may take gigabytes, so that they are hashed once, and only if times do not decide.
std::uint64_t InputDensity::Hash(Progress& progress) const
{
  if (!this->Hashed)
  {
    this->Hashed = this->Fingerprint(progress);
  }
  return *this->Hashed;
}

// Without a finite value, for example if all cells are empty, 0 stands for white.
double InputDensity::White() const
{
  return std::isfinite(this->Known.White.Value) ? this->Known.White.Value : 0.0;
}

// The axes that the grid has come first, so that a box of cells in 1D or 2D is one in space, too.
GridSize<3> InputDensity::CellsInSpace() const
{
  GridSize<3> cells = this->Geometry.Size<3>();
  std::fill(cells.begin() + this->Geometry.Dimension(), cells.end(), 1);
  return cells;
}

int InputDensity::Owner() const
{
  return this->Geometry.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
}

std::vector<std::string> InputDensity::Describe(const SuspectValues& values) const
{
  // The largest density may be what empty cells count as.
  if (this->Rules.Empty.Cells == EmptyCells::Value && this->Empty >= values.Found.Maximum)
  {
    return {};
  }
  return describeSuspect(values,
    { this->Name, this->Name, this->Name, this->Geometry.IsOnPoints() ? "points" : "cells",
      this->Geometry.NumberOfCells(), this->Rules.Invert, this->Rules.IsOfSeveral(),
      this->FillValues });
}

void InputDensity::ReportSuspect(const SuspectValues& values, Progress& progress)
{
  if (!this->Notify)
  {
    return;
  }
  std::vector<std::string> lines = this->Describe(values);
  for (std::string& line : lines)
  {
    line = this->InputName.empty() ? line : this->InputName + ": " + line;
  }
  DataIdentity content;
  if (!lines.empty()) // on all ranks, which describe the same values
  {
    content = this->Identity();
    content.Hash(progress);
  }
  // Also called without lines, so that the listener forgets what it has reported of other values.
  this->Notify(lines, content);
}

void InputDensity::ThrowInvalid(const DensitySummary& summary) const
{
  // A padded density passes on to the one inside, whose indices users know.
  DensitySummary own = summary;
  const InputDensity& source = this->SourceOf(own);
  throwInvalidDensity(source.Name, own, source.Rules.Missing, source.MayBeEmpty);
}

} // namespace RectifiedTransport::Bridge
