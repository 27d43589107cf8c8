// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Settings/FlowSettings.h"

#include "Bridge/Run/PropertyCheck.h"

#include <cmath>
#include <ostream>

namespace RectifiedTransport
{

namespace
{

const char* const IntegratorTexts[] = { "Multistep", "RungeKutta4", "Euler", "Adaptive" };
const char* const TableLookupTexts[] = { "Interpolated", "Nearest" };
const char* const FlowMapsTexts[] = { "Auto", "On", "Off" };

} // namespace

const char* FlowSettings::IntegratorText() const
{
  return choiceText(IntegratorTexts, this->Integrator);
}

const char* FlowSettings::TableLookupText() const
{
  return choiceText(TableLookupTexts, this->TableLookup);
}

const char* FlowSettings::FlowMapsText() const
{
  return choiceText(FlowMapsTexts, this->FlowMaps);
}

FlowOptions FlowSettings::Options() const
{
  requireChoice("Integrator", this->Integrator, IntegratorTexts);
  requireThat(this->NumberOfSteps >= 1 && this->NumberOfSteps <= FlowOptions::MaximumNumberOfSteps,
    "NumberOfSteps", this->NumberOfSteps, "from 1 to 10000");
  requireThat(this->Tolerance > 0.0 && std::isfinite(this->Tolerance), "Tolerance", this->Tolerance,
    "a positive number of cells");
  requireChoice("TableLookup", this->TableLookup, TableLookupTexts);
  requireChoice("FlowMaps", this->FlowMaps, FlowMapsTexts);
  FlowOptions options;
  options.Method = static_cast<RectifiedTransport::Integrator>(this->Integrator);
  options.NumberOfSteps = this->NumberOfSteps;
  options.Tolerance = this->Tolerance;
  options.Lookup = static_cast<RectifiedTransport::TableLookup>(this->TableLookup);
  options.Maps = static_cast<RectifiedTransport::FlowMaps>(this->FlowMaps);
  return options;
}

void FlowSettings::Print(std::ostream& os, vtkIndent indent) const
{
  os << indent << "Integrator: " << this->IntegratorText() << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "TableLookup: " << this->TableLookupText() << "\n";
  os << indent << "FlowMaps: " << this->FlowMapsText() << "\n";
}

} // namespace RectifiedTransport
