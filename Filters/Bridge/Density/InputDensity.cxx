// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/InputDensity.h"

#include "Bridge/Density/DensityFailure.h"
#include "Core/Parallel/Progress.h"

#include <cmath>
#include <cstring>

namespace RectifiedTransport
{

InputDensity::InputDensity(const std::string& name, const DensityRules& rules)
  : Rules(rules)
  , Name(name)
{
}

InputDensity::~InputDensity() = default;

void InputDensity::SetForm(const ArrayForm& form)
{
  const double measure = this->Geometry.CellMeasure();
  std::uint64_t measureBits = 0;
  std::memcpy(&measureBits, &measure, sizeof(measure));
  const GridSize<3> size = this->Geometry.Size<3>();
  const auto number = [](auto value) { return static_cast<std::uint64_t>(value); };
  this->Reading = { 0, number(form.Type), number(form.Components),
    number(this->Geometry.Dimension()), number(size[0]), number(size[1]), number(size[2]),
    number(this->Rules.Component + 2),
    number(this->Rules.Invert) + 2 * number(this->Rules.ClampNegative),
    number(this->Geometry.IsOnPoints()),
    number(form.HasPointGhosts) + 2 * number(form.HasCellGhosts), measureBits };
  this->MayBeBlank = form.HasPointGhosts || (form.HasCellGhosts && !this->Geometry.IsOnPoints());
}

const InputDensity::Content& InputDensity::GetContent(Progress& progress)
{
  if (this->Hashed == Content{})
  {
    this->Hashed = this->Reading;
    this->Hashed[0] = this->Fingerprint(progress);
  }
  return this->Hashed;
}

bool InputDensity::NeedsWhite() const
{
  return needsWhite(this->Rules, this->Components());
}

double InputDensity::White() const
{
  return std::isfinite(this->Known.White.Value) ? this->Known.White.Value : 0.0;
}

std::vector<std::string> InputDensity::Describe(const UnusualValues& values) const
{
  // Of several components it is the luminance.
  const bool isInverted =
    this->Rules.Invert && (this->Rules.Component >= 0 || this->Components() == 1);
  const double largest = values.Found.Maximum;
  return describeUnusual(values,
    { this->Name, this->Name, this->Name, this->Geometry.IsOnPoints() ? "points" : "cells",
      this->Geometry.NumberOfCells() },
    isInverted ? values.White.Value - largest : largest, this->Rules.Invert);
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
  throwInvalidDensity(this->Name, summary, this->MayBeBlank);
}

} // namespace RectifiedTransport
