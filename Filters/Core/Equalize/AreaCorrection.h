// SPDX-License-Identifier: BSD-3-Clause
// A correction of the map from a density to the uniform measure: the corners of the density's cells
// are moved back along the map, equalizeAreas moves them further, and other points move as the
// corners of their cell do, interpolated.
#ifndef RectifiedTransport_AreaCorrection_h
#define RectifiedTransport_AreaCorrection_h

#include "../Flow/PointTransport.h"
#include "../Flow/RectifiedFlow.h"
#include "../Parallel/LargeBuffer.h"
#include "EqualizeAreas.h"

#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
class AreaCorrection
{
public:
  // Corrects a flow with whole tables. Not collective: every rank that calls it gets the same bits.
  // Throws std::invalid_argument, std::bad_alloc and Cancelled.
  AreaCorrection(const RectifiedFlow<Dimension>& flow, const FlowOptions& options,
    const EqualizeOptions& equalize = {}, const Context& context = Context());
  // The same for another map from the uniform measure to the flow's density.
  AreaCorrection(const RectifiedFlow<Dimension>& flow, const PointTransport<Dimension>& map,
    const EqualizeOptions& equalize = {}, const Context& context = Context());

  // Options for the correction and for the points: FlowMaps::Auto would choose by the number of
  // points, and the errors of a flow with maps are not those of one without.
  static FlowOptions OptionsFor(FlowOptions options)
  {
    options.Maps = options.Maps == FlowMaps::Auto ? FlowMaps::On : options.Maps;
    return options;
  }

  // Options of the same flow, the same for all that mean the same: what is not used has its
  // default. Chooses the steps, if they are to be chosen, in the progress of the context. Not
  // collective. Throws std::invalid_argument, std::bad_alloc and Cancelled.
  static FlowOptions Resolve(
    const RectifiedFlow<Dimension>& flow, FlowOptions options, const Context& context = Context());

  // `image` is where Backward of the map, with the same options, takes a point of the box: adds the
  // correction.
  void Correct(const double* point, double* image) const;

  const EqualizeReport& Report() const { return this->Found; }
  std::int64_t MemorySize() const { return this->Moves.bytes(); }
  // About the most bytes while it is made, besides a flow map, which the flow keeps.
  static double MemoryFor(const GridSize<Dimension>& size);

private:
  template <class MoveBack>
  void Make(const RectifiedFlow<Dimension>& flow, const EqualizeOptions& equalize,
    const Context& context, const MoveBack& moveBack);

  const GridSize<Dimension> Size;
  EqualizeReport Found;
  LargeBuffer<float> Moves; // moves of the corners, interleaved, in cells
};

} // namespace RectifiedTransport

#endif
