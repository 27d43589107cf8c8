// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Plan/SharedFlow.h"

#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Parallel/Stages.h"

#include <cmath>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

namespace RectifiedTransport::Bridge
{

// The mass is the sum of the values times the measure of a cell. A density without mass, or with an
// infinite one, has no flow.
template <int D>
SharedFlow::SharedFlow(RectifiedFlow<D> flow, FlowTables tables, const InputDensity& density)
  : Flows(std::move(flow))
  , Kind(tables)
  , Mass(this->Flow<D>().Total() * density.Grid().CellMeasure())
{
  if (!(this->Mass > 0.0) || std::isinf(this->Mass))
  {
    DensitySummary found;
    found.Total = this->Mass;
    density.ThrowInvalid(found);
  }
  this->Values = density.Suspect();
  this->Values.Found = this->Flow<D>().Summary();
  this->Built.Modified();
}

template <int D>
std::shared_ptr<SharedFlow> SharedFlow::Make(InputDensity& density, FlowTables tables,
  std::shared_ptr<SharedFlow> previous, Progress& progress)
{
  // Old and new tables side by side would double the peak.
  std::optional<RectifiedFlow<D>> old;
  if (previous && tables == FlowTables::Whole && previous->HasFlow<D>())
  {
    old = std::move(*std::get_if<RectifiedFlow<D>>(&previous->Flows));
  }
  previous.reset();
  Stages stages(progress, { { "reading", 1 }, { "tables", 9 } });
  density.Prepare(tables, stages["reading"]);
  std::shared_ptr<SharedFlow> made;
  try
  {
    made = std::make_shared<SharedFlow>(old
        ? RectifiedFlow<D>(density.Source<D>(), std::move(*old), stages["tables"])
        : RectifiedFlow<D>(density.Source<D>(), tables, stages["tables"]),
      tables, density);
  }
  catch (const InvalidDensity& invalid)
  {
    density.ThrowInvalid(invalid.Summary());
  }
  catch (const std::bad_alloc& caught)
  {
    const GridSize<D> size = density.Grid().Size<D>();
    failOutOfMemory(caught,
      { "the tables of a density of " + describeSize<D>(size) + " cells",
        RectifiedFlow<D>::MemoryFor(size) });
  }
  density.ReleaseGathered(); // whole tables need no values
  return made;
}

void SharedFlow::Attach(InputDensity& density, Progress& progress)
{
  if (this->Kind == FlowTables::Tiled)
  {
    density.Prepare(this->Kind, progress);
    const auto set = [&](auto dimension) {
      constexpr int D = decltype(dimension)::value;
      if (auto* flow = std::get_if<RectifiedFlow<D>>(&this->Flows))
      {
        flow->SetDensity(density.Source<D>());
      }
    };
    set(std::integral_constant<int, 2>());
    set(std::integral_constant<int, 3>());
  }
}

template std::shared_ptr<SharedFlow> SharedFlow::Make<1>(
  InputDensity&, FlowTables, std::shared_ptr<SharedFlow>, Progress&);
template std::shared_ptr<SharedFlow> SharedFlow::Make<2>(
  InputDensity&, FlowTables, std::shared_ptr<SharedFlow>, Progress&);
template std::shared_ptr<SharedFlow> SharedFlow::Make<3>(
  InputDensity&, FlowTables, std::shared_ptr<SharedFlow>, Progress&);

} // namespace RectifiedTransport::Bridge
