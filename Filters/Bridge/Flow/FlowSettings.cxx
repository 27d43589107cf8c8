// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/FlowSettings.h"

#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Run/SMPExecutor.h"

#include <cmath>
#include <ostream>

namespace RectifiedTransport
{

namespace
{

const char* const IntegratorTexts[] = { "Multistep", "RungeKutta4", "Euler", "Adaptive" };
const char* const TableLookupTexts[] = { "Interpolated", "Nearest" };
const char* const ThreadingTexts[] = { "Auto", "VTK", "OpenMP", "Serial" };
constexpr int MaximumNumberOfSteps = 10000;

} // namespace

const char* FlowSettings::IntegratorText() const
{
  return choiceText(IntegratorTexts, this->Integrator);
}

const char* FlowSettings::TableLookupText() const
{
  return choiceText(TableLookupTexts, this->TableLookup);
}

const char* FlowSettings::ThreadingText() const
{
  return choiceText(ThreadingTexts, this->Threading);
}

FlowOptions FlowSettings::Options() const
{
  requireChoice("Integrator", this->Integrator, IntegratorTexts);
  requireThat(this->NumberOfSteps >= 1 && this->NumberOfSteps <= MaximumNumberOfSteps,
    "NumberOfSteps", this->NumberOfSteps, "from 1 to 10000");
  requireThat(this->Tolerance > 0.0 && std::isfinite(this->Tolerance), "Tolerance", this->Tolerance,
    "a positive number of cells");
  requireChoice("TableLookup", this->TableLookup, TableLookupTexts);
  FlowOptions options;
  options.Method = static_cast<RectifiedTransport::Integrator>(this->Integrator);
  options.NumberOfSteps = this->NumberOfSteps;
  options.Tolerance = this->Tolerance;
  options.Lookup = static_cast<RectifiedTransport::TableLookup>(this->TableLookup);
  return options;
}

std::unique_ptr<Executor> FlowSettings::MakeExecutor() const
{
  requireChoice("Threading", this->Threading, ThreadingTexts);
  return makeExecutor(static_cast<RectifiedTransport::Threading>(this->Threading));
}

void FlowSettings::Print(std::ostream& os, vtkIndent indent) const
{
  os << indent << "Integrator: " << this->IntegratorText() << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "TableLookup: " << this->TableLookupText() << "\n";
  os << indent << "Threading: " << this->ThreadingText() << "\n";
}

} // namespace RectifiedTransport
