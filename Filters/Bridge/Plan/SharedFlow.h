// SPDX-License-Identifier: BSD-3-Clause
// The flow of a density with its tables. Shared by all filters that read the same density.
#ifndef RectifiedTransport_SharedFlow_h
#define RectifiedTransport_SharedFlow_h

#include "Bridge/Density/InputDensity.h"
#include "Core/Flow/RectifiedFlow.h"

#include "vtkTimeStamp.h"

#include <memory>
#include <variant>

namespace RectifiedTransport::Bridge
{

class SharedFlow
{
public:
  // Makes tables of this kind, in the memory of `previous` if that has whole ones, which end.
  // Throws Failure, also if the total mass is not positive and finite, and Cancelled.
  template <int D>
  static std::shared_ptr<SharedFlow> Make(InputDensity& density, FlowTables tables,
    std::shared_ptr<SharedFlow> previous, Progress& progress);
  // Its tables, just made.
  template <int D>
  SharedFlow(RectifiedFlow<D> flow, FlowTables tables, const InputDensity& density);

  // What its tables know about the density, and the flow that they define.
  template <int D>
  const RectifiedFlow<D>& Flow() const
  {
    return std::get<RectifiedFlow<D>>(this->Flows);
  }
  template <int D>
  bool HasFlow() const
  {
    return std::holds_alternative<RectifiedFlow<D>>(this->Flows);
  }
  // Density times cell measure, summed.
  double TotalMass() const { return this->Mass; }
  const SuspectValues& Suspect() const { return this->Values; }
  FlowTables Tables() const { return this->Kind; }
  vtkMTimeType BuildTime() const { return this->Built.GetMTime(); }

  // For a flow with tiles: sets the density of the run, which has the same content.
  void Attach(InputDensity& density, Progress& progress);

private:
  std::variant<std::monostate, RectifiedFlow<1>, RectifiedFlow<2>, RectifiedFlow<3>> Flows;
  FlowTables Kind;
  double Mass;
  SuspectValues Values;
  vtkTimeStamp Built;
};

} // namespace RectifiedTransport::Bridge

#endif
