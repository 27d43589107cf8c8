// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Equalize/AreaCorrection.h"

#include "Core/Flow/FlowMapShape.h"
#include "Core/Parallel/Ranks.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <array>

namespace RectifiedTransport
{

namespace
{

// Corners a chunk of parallel loops.
constexpr std::int64_t grain = 1 << 13;

// The masses of a flow's cells, as a density: differences of the tables. Rounding makes these not
// exactly zero in empty cells, so HasMass decides there.
template <int Dimension>
class CellShares final : public DensityValues
{
public:
  explicit CellShares(const RectifiedFlow<Dimension>& flow)
    : Flow(flow)
  {
  }
  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      std::int64_t rest = first + i;
      Point<Dimension> low;
      Point<Dimension> high;
      Point<Dimension> centre;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        low[axis] = static_cast<double>(rest % this->Flow.Size()[axis]);
        high[axis] = low[axis] + 1.0;
        centre[axis] = low[axis] + 0.5;
        rest /= this->Flow.Size()[axis];
      }
      // A share is the integral of the density over the cell over the whole mass.
      values[i] = this->Flow.HasMass(centre) ? this->Flow.Share(low, high) : 0.0;
    }
  }

private:
  const RectifiedFlow<Dimension>& Flow;
};

// The place of corner number `corner`, axis 0 fastest, in index space.
template <int Dimension>
Point<Dimension> cornerAt(std::int64_t corner, const GridSize<Dimension>& size)
{
  Point<Dimension> place;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    place[axis] = static_cast<double>(corner % (size[axis] + 1));
    corner /= size[axis] + 1;
  }
  return place;
}

} // namespace

// The map back is the flow with these options.
template <int Dimension>
AreaCorrection<Dimension>::AreaCorrection(const RectifiedFlow<Dimension>& flow,
  const FlowOptions& options, const EqualizeOptions& equalize, const Context& context)
  : Size(flow.Size())
{
  this->Make(flow, equalize, context, [&](PointSpan<Dimension> points, const Context& stage) {
    flow.Backward(points, points, options, stage);
  });
}

// The map back is another one, such as the optimal map; the flow only gives the masses of the
// cells.
template <int Dimension>
AreaCorrection<Dimension>::AreaCorrection(const RectifiedFlow<Dimension>& flow,
  const PointTransport<Dimension>& map, const EqualizeOptions& equalize, const Context& context)
  : Size(flow.Size())
{
  this->Make(flow, equalize, context, [&](PointSpan<Dimension> points, const Context& stage) {
    map.Backward(points, points, stage);
  });
}

// Moves the corners of all cells back to the uniform measure by moveBack(points, context), in
// place, and equalizes the areas of their images. Cells' images should have area = mass.
template <int Dimension>
template <class MoveBack>
void AreaCorrection<Dimension>::Make(const RectifiedFlow<Dimension>& flow,
  const EqualizeOptions& equalize, const Context& context, const MoveBack& moveBack)
{
  // Each rank does all of it, so that the correction is the same everywhere without communication.
  Context alone = context;
  alone.Group = &SoloRanks::Get();
  Progress progress(alone);
  Stages stages(progress, { { "corners", 2 }, { "map", 58 }, { "moves", 2 }, { "areas", 38 } });
  const auto count = static_cast<std::int64_t>(numberOfCorners<Dimension>(this->Size));
  // Images of the corners, interleaved, in cells of the density's index space.
  LargeBuffer<double> corners(count * Dimension);
  const PointSpan<Dimension> images(corners.data(), count);
  stages["corners"].ForEach(count, grain, [&](std::int64_t i) {
    const Point<Dimension> place = cornerAt<Dimension>(i, this->Size);
    std::copy_n(place.data(), Dimension, images[i]);
  });
  moveBack(images, stages["map"]);

  // Moves are sums of the passes' moves, which start at zero.
  this->Moves = LargeBuffer<float>(count * Dimension);
  stages["moves"].For(count, grain, [&](std::int64_t first, std::int64_t last) {
    std::fill_n(this->Moves.data() + first * Dimension, (last - first) * Dimension, 0.0F);
  });
  this->Found = equalizeAreas<Dimension>(CellShares<Dimension>(flow), this->Size, 1.0, images,
    equalize, stages["areas"], this->Moves.data());
}

template <int Dimension>
FlowOptions AreaCorrection<Dimension>::Resolve(
  const RectifiedFlow<Dimension>& flow, FlowOptions options, const Context& context)
{
  const FlowOptions usual;
  // Options that give the same points must compare equal: steps are made explicit, and what the
  // integrator does not use gets its default.
  if (options.NumberOfSteps == 0 && options.Integrator != Integrator::Adaptive)
  {
    Context alone = context;
    alone.Group = &SoloRanks::Get();
    // Steps are chosen for the way back, which the corners take.
    options = flow.ChooseSteps(options, FlowDirection::Backward, alone).Of(options);
  }
  options.AreaTolerance = usual.AreaTolerance;
  options.LeastSteps = usual.LeastSteps;
  if (options.Integrator == Integrator::Adaptive)
  {
    // The adaptive integrator has no steps to choose, so any number serves that asks for no choice.
    options.NumberOfSteps = 1; // no measurement
  }
  else
  {
    options.Tolerance = usual.Tolerance;
  }
  options.Maps = takesFlowMaps(options) ? options.Maps : FlowMaps::Off;
  return options;
}

// Adds the move of a point of the density: the multilinear interpolant of the moves of its cell's
// corners, in cells.
template <int Dimension>
void AreaCorrection<Dimension>::Correct(const double* point, double* image) const
{
  std::array<std::int64_t, Dimension> cell;
  double rest[Dimension];
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const auto side = static_cast<double>(this->Size[axis]);
    // The cell that holds the point, clamped to the box, and the place in it from 0 to 1.
    const double x = std::min(std::max(point[axis], 0.0), side);
    cell[axis] = std::min(static_cast<std::int64_t>(x), this->Size[axis] - 1);
    rest[axis] = x - static_cast<double>(cell[axis]);
  }
  double move[Dimension] = {};
  for (int corner = 0; corner < 1 << Dimension; ++corner)
  {
    double weight = 1.0;
    std::int64_t number = 0;
    for (int axis = Dimension; axis-- > 0;)
    {
      const int isHigh = corner >> axis & 1;
      // Bit a of the corner's number says which side it is on along axis a.
      weight *= isHigh ? rest[axis] : 1.0 - rest[axis];
      number = number * (this->Size[axis] + 1) + cell[axis] + isHigh;
    }
    for (int axis = 0; axis < Dimension; ++axis)
    {
      move[axis] += weight * static_cast<double>(this->Moves.data()[number * Dimension + axis]);
    }
  }
  for (int axis = 0; axis < Dimension; ++axis)
  {
    image[axis] =
      std::min(std::max(image[axis] + move[axis], 0.0), static_cast<double>(this->Size[axis]));
  }
}

// The corners in doubles and their moves in floats, besides what equalizeAreas takes.
template <int Dimension>
double AreaCorrection<Dimension>::MemoryFor(const GridSize<Dimension>& size)
{
  constexpr double ofCorner = Dimension * (sizeof(double) + sizeof(float));
  return ofCorner * numberOfCorners<Dimension>(size) + equalizeAreasMemory<Dimension>(size);
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(AreaCorrection);

} // namespace RectifiedTransport
