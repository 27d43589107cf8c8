// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/InputDensity.h"

#include "Bridge/Run/FieldValue.h"
#include "Bridge/Settings/ComponentChoice.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/Reading/DensityFailure.h"

#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace RectifiedTransport::Bridge
{

namespace
{

std::uint64_t bitsOf(double value)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(value));
  return bits;
}

template <class T>
std::uint64_t number(T value)
{
  return static_cast<std::uint64_t>(value);
}

} // namespace

DensityReading readingBy(const DensityRules& rules, const std::string& arrayName, int components)
{
  return { arrayName, components, rules.Component, rules.Invert,
    { std::max(rules.Missing.Low, -Unbounded), std::min(rules.Missing.High, Unbounded) } };
}

void addReadings(vtkDataObject* output, const std::vector<DensityReading>& readings)
{
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

InputDensity::InputDensity(const InputDensity& inner, const ImageGrid& grown,
  const GridSize<3>& margin, const EmptyRule& rule)
  : Geometry(grown)
  , Rules(inner.Rules)
  , Read(inner.Read)
  , Changed(inner.Changed)
  , Name(inner.Name)
  , MayBeEmpty(true)
  , Reading(inner.Reading)
{
  const GridSize<3> size = grown.Size<3>();
  std::copy(size.begin(), size.end(), this->Reading.begin() + 4);
  this->Reading[14] = number(rule.Cells);
  this->Reading[15] = bitsOf(rule.Value);
  constexpr int shift = 21;
  this->Reading[16] =
    number(margin[0]) + (number(margin[1]) << shift) + (number(margin[2]) << (2 * shift));
}

InputDensity::~InputDensity() = default;

void InputDensity::SetForm(const ArrayForm& form)
{
  this->Rules.Component = takenComponent(this->Name, this->Rules.Component,
    automaticComponent(form.Type, form.Components), form.Components);
  this->Read = readingBy(this->Rules, this->NameOfArray(), form.Components);
  const GridSize<3> size = this->Geometry.Size<3>();
  this->MayBeEmpty = this->Rules.Missing.Are() || form.HasPointGhosts ||
    (form.HasCellGhosts && !this->Geometry.IsOnPoints());
  // Without empty cells what they count as is part of no density.
  const EmptyRule rule = this->MayBeEmpty ? this->Rules.Empty : EmptyRule();
  this->Reading = { 0, number(form.Type), number(form.Components),
    number(this->Geometry.Dimension()), number(size[0]), number(size[1]), number(size[2]),
    number(this->Rules.Component),
    number(this->Rules.Invert) + 2 * number(this->Rules.ClampNegative) +
      4 * number(this->Rules.Missing.AreNaN),
    number(this->Geometry.IsOnPoints()),
    number(form.HasPointGhosts) + 2 * number(form.HasCellGhosts),
    bitsOf(this->Geometry.CellMeasure()), bitsOf(this->Rules.Missing.Low),
    bitsOf(this->Rules.Missing.High), number(rule.Cells), bitsOf(rule.Value), 0 };
}

DataIdentity InputDensity::Identity() const
{
  DataIdentity identity;
  std::for_each(this->Reading.begin() + 1, this->Reading.end(),
    [&](std::uint64_t number) { identity.AddNumber(number); });
  std::for_each(this->Changed.begin(), this->Changed.end(),
    [&](std::uint64_t time) { identity.AddTime(time); });
  identity.SetHasher([this](Progress& progress) { return this->GetContent(progress)[0]; });
  return identity;
}

const InputDensity::Content& InputDensity::GetContent(Progress& progress) const
{
  if (this->Hashed == Content{})
  {
    this->Hashed = this->Reading;
    this->Hashed[0] = this->Fingerprint(progress);
  }
  return this->Hashed;
}

double InputDensity::White() const
{
  return std::isfinite(this->Known.White.Value) ? this->Known.White.Value : 0.0;
}

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

std::vector<std::string> InputDensity::Describe(const UnusualValues& values) const
{
  // The largest density may be what empty cells count as.
  if (this->Rules.Empty.Cells == EmptyCells::Value && this->Empty >= values.Found.Maximum)
  {
    return {};
  }
  return describeUnusual(values,
    { this->Name, this->Name, this->Name, this->Geometry.IsOnPoints() ? "points" : "cells",
      this->Geometry.NumberOfCells(), this->Rules.Invert, this->Rules.IsOfSeveral(),
      this->FillValues });
}

void InputDensity::TellUnusual(const UnusualValues& values, Progress& progress)
{
  if (!this->Tell)
  {
    return;
  }
  std::vector<std::string> lines = this->Describe(values);
  for (std::string& line : lines)
  {
    line = this->InputName.empty() ? line : this->InputName + ": " + line;
  }
  // All ranks describe the same values.
  this->Tell(lines, lines.empty() ? Content{} : this->GetContent(progress));
}

void InputDensity::ThrowInvalid(const DensitySummary& summary) const
{
  DensitySummary own = summary;
  const InputDensity& source = this->SourceOf(own);
  throwInvalidDensity(source.Name, own, source.Rules.Missing, source.MayBeEmpty);
}

} // namespace RectifiedTransport::Bridge
