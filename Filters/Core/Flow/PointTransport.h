// SPDX-License-Identifier: BSD-3-Clause
// The interface of maps between two measures on boxes. A map moves points. The first measure may
// be uniform.
#ifndef RectifiedTransport_PointTransport_h
#define RectifiedTransport_PointTransport_h

#include "../Geometry/GridSize.h"
#include "../Geometry/Points.h"
#include "../Parallel/Context.h"
#include "FlowOptions.h"
#include "FlowSeeds.h"

#include <vector>

namespace RectifiedTransport
{

// Points are in the index space of the density where they are; cell i covers [i, i+1]. The uniform
// measure has the index space of the other end. There are as many positions as seeds, and both may
// be in the same memory. Points outside the box are clamped to its border. All methods throw
// std::invalid_argument, std::bad_alloc and Cancelled.
template <int Dimension>
class PointTransport
{
public:
  virtual ~PointTransport() = default;

  // The index space in which Forward begins.
  virtual const GridSize<Dimension>& Size() const = 0;

  // Moves points of time 0 (the source) to time 1 (distributed like the target).
  virtual FlowReport Forward(const FlowSeeds<Dimension>& seeds, PointSpan<Dimension> positions,
    const Context& context = Context()) const = 0;
  // Moves points of time 1 back to time 0: the inverse map.
  virtual FlowReport Backward(const FlowSeeds<Dimension>& points, PointSpan<Dimension> positions,
    const Context& context = Context()) const = 0;
  // The positions at several times of [0,1], ascending, from one run: all times of a particle
  // together.
  virtual FlowReport ForwardAt(const FlowSeeds<Dimension>& seeds, const std::vector<double>& times,
    PointSpan<Dimension> positions, const Context& context = Context()) const = 0;

protected:
  PointTransport() = default;
  PointTransport(PointTransport&&) = default;
  PointTransport& operator=(PointTransport&&) = default;
};

} // namespace RectifiedTransport

#endif
