// SPDX-License-Identifier: BSD-3-Clause
// How a filter integrates the flow, as its properties say it: checked, named and printed.
#ifndef RectifiedTransport_FlowSettings_h
#define RectifiedTransport_FlowSettings_h

#include "Core/Flow/FlowOptions.h"

#include "vtkIndent.h"
#include "vtkType.h"

#include <iosfwd>
#include <memory>

namespace RectifiedTransport
{

class Executor;

// The values are those of the enumerations in vtkTransportAlgorithm.
struct FlowSettings
{
  int Integrator;
  int NumberOfSteps;
  double Tolerance;
  int TableLookup;
  int Threading;

  // Of a filter that integrates nothing, but has loops for someone to run.
  static FlowSettings OfThreading(int threading) { return { 0, 1, 1.0, 0, threading }; }

  const char* IntegratorText() const;
  const char* TableLookupText() const;
  const char* ThreadingText() const;
  void Print(std::ostream& os, vtkIndent indent) const;

  // Throw Failure for what is out of range.
  FlowOptions Options() const;
  std::unique_ptr<Executor> MakeExecutor() const;
};

} // namespace RectifiedTransport

#endif
