// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportAlgorithm.h"

#include "Bridge/FlowCache.h"
#include "Bridge/PropertyCheck.h"
#include "Bridge/SMPExecutor.h"
#include "Core/FlowOptions.h"

#include <cmath>

VTK_ABI_NAMESPACE_BEGIN

namespace
{
const char* const IntegratorTexts[] = { "Multistep", "RungeKutta4", "Euler", "Adaptive" };
const char* const TableLookupTexts[] = { "Interpolated", "Nearest" };
const char* const ThreadingTexts[] = { "Auto", "VTK", "OpenMP", "Serial" };
constexpr int MaximumNumberOfSteps = 10000;
} // namespace

struct vtkTransportAlgorithm::vtkInternals
{
  RectifiedTransport::FlowCache Cache;
};

//------------------------------------------------------------------------------
vtkTransportAlgorithm::vtkTransportAlgorithm(int densityPort)
  : vtkDensityAlgorithm(densityPort)
  , Integrator(MULTISTEP)
  , NumberOfSteps(32)
  , Tolerance(0.01)
  , TableLookup(INTERPOLATED)
  , Threading(THREADING_AUTO)
  , Internals(new vtkInternals)
{
}

//------------------------------------------------------------------------------
vtkTransportAlgorithm::~vtkTransportAlgorithm() = default;

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetIntegratorAsString()
{
  return RectifiedTransport::choiceText(IntegratorTexts, this->Integrator);
}

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetTableLookupAsString()
{
  return RectifiedTransport::choiceText(TableLookupTexts, this->TableLookup);
}

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetThreadingAsString()
{
  return RectifiedTransport::choiceText(ThreadingTexts, this->Threading);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkTransportAlgorithm::GetTableBuildTime()
{
  return this->Internals->Cache.BuildTime();
}

//------------------------------------------------------------------------------
RectifiedTransport::FlowCache& vtkTransportAlgorithm::GetFlowCache()
{
  return this->Internals->Cache;
}

//------------------------------------------------------------------------------
RectifiedTransport::FlowOptions vtkTransportAlgorithm::GetFlowOptions()
{
  using namespace RectifiedTransport;
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

//------------------------------------------------------------------------------
RectifiedTransport::Executor* vtkTransportAlgorithm::NewExecutor()
{
  RectifiedTransport::requireChoice("Threading", this->Threading, ThreadingTexts);
  return RectifiedTransport::makeExecutor(
    static_cast<RectifiedTransport::Threading>(this->Threading))
    .release();
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Integrator: " << this->GetIntegratorAsString() << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "TableLookup: " << this->GetTableLookupAsString() << "\n";
  os << indent << "Threading: " << this->GetThreadingAsString() << "\n";
  os << indent << "TableBuildTime: " << this->GetTableBuildTime() << "\n";
}
VTK_ABI_NAMESPACE_END
