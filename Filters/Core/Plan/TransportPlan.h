// SPDX-License-Identifier: BSD-3-Clause
// The map between two densities, by a flow or by the optimal map, with a bound of the least cost.
// The first density may be the uniform measure. All that moves points between densities is one of
// these; RectifiedFlow and OptimalMap are its solvers.
//
//   const auto end = [&](const DensitySource<2>& density) {
//     return PlanEnd<2>(PlacedDensity<2>{ density, { 0.0, 0.0 }, { 4.0, 3.0 } }); // in lengths
//   };
//   PlanOptions options;
//   options.IsOptimal = true;
//   const TransportPlan<2> plan(end(source), end(target), options);
//   plan.Forward(points, images);
//   plan.LowerBound();                        // of the cost, in squared lengths
//   plan.Warning();                           // why flows move the points; else empty
#ifndef RectifiedTransport_TransportPlan_h
#define RectifiedTransport_TransportPlan_h

#include "../Flow/PointTransport.h"
#include "../Flow/RectifiedFlow.h"
#include "../Geometry/ImageGrid.h"
#include "../OptimalMap/OptimalMap.h"
#include "../Tables/Density.h"

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace RectifiedTransport
{

struct PlanOptions
{
  // Points are moved by the optimal map, where it reaches the target; else by flows.
  bool IsOptimal = false;
  // With flows, too, there is a bound of the least cost.
  bool HasBound = false;
  FlowOptions Flow;
  OptimalMapOptions Optimal;

  bool NeedsMap() const { return this->IsOptimal || this->HasBound; }
};

// OptimalMapOptions::LeastIterations of a map between two densities that moves points, or that
// gives a bound alone.
constexpr int leastIterations(bool movesPoints)
{
  return movesPoints ? 4 : 1;
}

// A density at its place in a box, where plans begin and end.
template <int Dimension>
struct PlanEnd
{
  PlanEnd() = default;
  // The values must outlive the plan, or its map and flows must be there.
  explicit PlanEnd(const PlacedDensity<Dimension>& density);
  // Fills a grid. Lengths are in the LengthScale of the grid.
  static PlanEnd On(const ImageGrid& grid);
  // On a grid in the box of another one, whose axes have the same directions. Lengths are in the
  // LengthScale of the box.
  static PlanEnd In(const ImageGrid& box, const ImageGrid& grid);

  GridSize<Dimension> Size{};
  Point<Dimension> Low{}; // low corner of its box, in lengths
  Point<Dimension> High{};
  // Called where something has to be made: returns the density, which stays until Release.
  std::function<DensitySource<Dimension>(const Context&)> Read;
  std::function<void()> Release; // may be empty
  // The flow from the uniform measure on its box. Made when it is first needed, if it is empty.
  std::shared_ptr<const RectifiedFlow<Dimension>> Flow;
};

// Between two densities, flows go back from the source to the uniform measure, and on to the target
// from there: the points of the two unit boxes correspond (Section 3.4).
//
// Construction, and what moves points, is collective. Const members may run concurrently. Throws
// InvalidDensity, std::invalid_argument, std::bad_alloc and Cancelled.
template <int Dimension>
class TransportPlan final : public PointTransport<Dimension>
{
public:
  using Map = std::shared_ptr<const OptimalMap<Dimension>>;

  // From the uniform measure to a density. `map`: its optimal map, solved, if that exists already.
  TransportPlan(PlanEnd<Dimension> target, const PlanOptions& options,
    const Context& context = Context(), Map map = nullptr);
  // From one density to another.
  TransportPlan(PlanEnd<Dimension> source, PlanEnd<Dimension> target, const PlanOptions& options,
    const Context& context = Context(), Map map = nullptr);

  // Solves the map of a plan; without a source from the uniform measure. The densities are released
  // before it is solved.
  static Map Solve(const PlanEnd<Dimension>* source, const PlanEnd<Dimension>& target,
    const OptimalMapOptions& options, const Context& context = Context());
  // About the most bytes that a map takes, while it is solved and used.
  static double MemoryFor(const GridSize<Dimension>& source, const GridSize<Dimension>& target,
    const OptimalMapOptions& options = {}, const OptimalMapUse& use = {})
  {
    return OptimalMap<Dimension>::MemoryFor(source, target, options, use);
  }
  // The part of these bytes that samples take, while Forward moves them.
  static double MemoryForSamples(const GridSize<Dimension>& target, const OptimalMapUse& use)
  {
    return OptimalMap<Dimension>::MemoryForSamples(target, use);
  }

  // Whether the optimal map moves points; else flows do.
  bool IsOptimal() const { return this->Chosen.IsOptimal && this->Text.empty(); }
  // Why flows move the points of a plan that should be optimal; else empty.
  const std::string& Warning() const { return this->Text; }

  // The map that says what is optimal, by Slack and UpperBound; nullptr if there is none.
  const OptimalMap<Dimension>* Certificate() const { return this->Optimal.get(); }
  // No map between the two densities costs less, in squared lengths; 0 where no map was wanted.
  double LowerBound() const { return this->Bound; }

  // Where flows move points, makes those that are missing now, in the memory of the map: the bound
  // alone stays.
  void MakeFlows(const Context& context = Context());

  // The source's index space.
  const GridSize<Dimension>& Size() const override
  {
    return this->Ends[0] ? this->Ends[0]->Size : this->Ends[1]->Size;
  }
  const PlanEnd<Dimension>& Target() const { return *this->Ends[1]; }

  // Moves points with a report for each flow on their way, in the order of that way; one for the
  // optimal map.
  std::vector<FlowReport> Move(FlowDirection direction, const FlowSeeds<Dimension>& seeds,
    PointSpan<Dimension> positions, const Context& context = Context()) const;
  // These report the last flow on the way. Seeds that are samples (FlowSeeds::AsSamples) are moved
  // together by the optimal map, so that boxes of cells get their shares of them.
  FlowReport Forward(const FlowSeeds<Dimension>& seeds, PointSpan<Dimension> positions,
    const Context& context = Context()) const override;
  FlowReport Backward(const FlowSeeds<Dimension>& points, PointSpan<Dimension> positions,
    const Context& context = Context()) const override;
  // From the uniform measure by the flow, particles are where it takes them; else they move on
  // straight lines, in the target's index space.
  FlowReport ForwardAt(const FlowSeeds<Dimension>& seeds, const std::vector<double>& times,
    PointSpan<Dimension> positions, const Context& context = Context()) const override;

private:
  TransportPlan(std::array<std::optional<PlanEnd<Dimension>>, 2> ends, const PlanOptions& options,
    Map map, const Context& context);
  const RectifiedFlow<Dimension>& FlowOf(std::size_t end, const Context& context) const;
  std::vector<FlowReport> MoveByFlows(std::size_t from, const FlowSeeds<Dimension>& seeds,
    PointSpan<Dimension> positions, const Context& context) const;
  Point<Dimension> ToTarget(const Point<Dimension>& point) const;

  // Mutable, with the mutex: flows are made when they are first needed. There is no source if it is
  // the uniform measure.
  mutable std::array<std::optional<PlanEnd<Dimension>>, 2> Ends;
  mutable std::mutex Making;
  const PlanOptions Chosen;
  Map Optimal;
  double Bound = 0.0;
  std::string Text;
};

} // namespace RectifiedTransport

#endif
