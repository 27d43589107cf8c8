// SPDX-License-Identifier: BSD-3-Clause
// The interface of a map between the uniform measure on a box and a density that moves points.
#ifndef RectifiedTransport_PointTransport_h
#define RectifiedTransport_PointTransport_h

#include "../Geometry/GridSize.h"
#include "../Geometry/Points.h"
#include "../Parallel/Context.h"
#include "FlowOptions.h"
#include "FlowSeeds.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// What some transports do not support.
enum class TransportUse
{
  Times, // positions between the times 0 and 1
  Cells  // the density's cells in which points end
};

// Points are in the index space of the density; cell i covers [i, i+1]. There are as many positions
// as seeds, and both may be in the same memory. Points outside the box are clamped to its border.
// All methods throw std::invalid_argument, std::bad_alloc and Cancelled.
template <int Dimension>
class PointTransport
{
public:
  virtual ~PointTransport() = default;

  virtual const GridSize<Dimension>& Size() const = 0;
  virtual bool Serves(TransportUse use) const = 0;

  // What NumberOfSteps 0 of the options means in a direction. Kept: other runs find it again at no
  // cost. Collective.
  virtual StepChoice ChooseSteps(const FlowOptions& options, FlowDirection direction,
    const Context& context = Context()) const = 0;

  // Moves points of time 0 (uniform) to time 1 (distributed like the density).
  virtual FlowReport Forward(const FlowSeeds<Dimension>& seeds, PointSpan<Dimension> positions,
    const FlowOptions& options = {}, const Context& context = Context()) const = 0;
  // Moves points of time 1 back to time 0: the inverse map, density to uniform.
  virtual FlowReport Backward(const FlowSeeds<Dimension>& points, PointSpan<Dimension> positions,
    const FlowOptions& options = {}, const Context& context = Context()) const = 0;
  // The positions at several times of [0,1], ascending, from one run: all times of a particle
  // together.
  virtual FlowReport ForwardAt(const FlowSeeds<Dimension>& seeds, const std::vector<double>& times,
    PointSpan<Dimension> positions, const FlowOptions& options = {},
    const Context& context = Context()) const = 0;
  // Forward, but writes for each point only the number, axis 0 fastest, of the density's cell with
  // mass in which it ends. For densities of isolated cells, which most particles miss at first:
  // fewer than 128 steps become up to 32 times as many in the first pass, and 0 means the fewest.
  virtual FlowReport ForwardToCells(const FlowSeeds<Dimension>& seeds, std::int64_t* cells,
    const FlowOptions& options = {}, const Context& context = Context()) const = 0;

protected:
  PointTransport() = default;
  PointTransport(PointTransport&&) = default;
  PointTransport& operator=(PointTransport&&) = default;
};

} // namespace RectifiedTransport

#endif
