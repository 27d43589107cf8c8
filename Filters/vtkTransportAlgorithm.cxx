// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportAlgorithm.h"

#include "Bridge/PropertyCheck.h"

VTK_ABI_NAMESPACE_BEGIN

namespace
{
const char* const IntegratorTexts[] = { "Multistep", "RungeKutta4", "Euler", "Adaptive" };
const char* const TableLookupTexts[] = { "Interpolated", "Nearest" };
const char* const ThreadingTexts[] = { "Auto", "VTK", "OpenMP", "Serial" };
}

//------------------------------------------------------------------------------
vtkTransportAlgorithm::vtkTransportAlgorithm()
  : Integrator(MULTISTEP)
  , NumberOfSteps(32)
  , Tolerance(0.01)
  , TableLookup(INTERPOLATED)
  , Threading(THREADING_AUTO)
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
  return 0;
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
