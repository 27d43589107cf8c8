// SPDX-License-Identifier: BSD-3-Clause
// The map of least squared distance between the uniform measure on a box and a density, or between
// two densities, with a certified bound, by the back-and-forth method of Jacobs and Leger, "A fast
// approach to optimal transport: the back-and-forth method", Numerische Mathematik 146, 2020,
// doi:10.1007/s00211-020-01154-8, from coarse to fine nodes.
//
//   DensityArray<2, float> source(density.data(), { 640, 480 });
//   OptimalMap<2> map(source, { 4.0, 3.0 });                // the sides of the box
//   map.Solve();
//   map.Forward(seeds, particles);
//   map.LowerBound();                                       // of the cost, in squared lengths
//
// Three claims, which must not be mixed:
// * LowerBound is certified, up to rounding: no map between the two densities costs less.
// * UpperBound is certified, too: it is the cost of a coupling with exactly these densities.
// * The map at points is near-optimal: its cost is close to LowerBound, but the masses of its image
//   differ a little from the target's: see MassError.
#ifndef RectifiedTransport_OptimalMap_h
#define RectifiedTransport_OptimalMap_h

#include "../Flow/PointTransport.h"
#include "../Tables/Density.h"

#include <cstdint>
#include <memory>

namespace RectifiedTransport
{

struct OptimalMapOptions
{
  // Iterations end when one raises the bound by less than a quarter of this part of it. > 0.
  double Tolerance = 1e-3;
  // Iterations on the finest nodes. At least 4 for a map; 0 and 1 serve for a bound alone.
  int LeastIterations = 4;
  int MostIterations = 20;
  // There is a node at each corner of the density's cells unless these would be more; then nodes
  // are as many times farther apart along each axis.
  double MostNodes = 0x1p24;
  // Takes the bound of twice as many nodes along each axis, if there are not too many then, without
  // iterations on them: its loss is a quarter.
  bool RefineBound = true;
  // Forward smooths the map and interpolates it between nodes before it corrects masses, and
  // Backward undoes that, near enough, in a fraction of the time. Else both solve for each image,
  // and both have corrected masses.
  bool InterpolatePoints = false;
  // Forward moves points so that the masses of their images agree with the target's. Without that,
  // images are those of the potential alone, and MassError is 0.
  bool CorrectMasses = true;
  // Takes fewer images of cells that have little mass, which bounds do without.
  bool ForBounds = false;
};

// What a map is wanted for besides points one by one: it takes memory.
struct OptimalMapUse
{
  double Samples = 0.0; // that Forward or Backward moves together, of all ranks
  bool OnSeveralRanks = false;
  bool UpperBound = false;
};

struct OptimalMapReport
{
  int Iterations = 0; // on the finest nodes
};

// A density on a part of the box in which two densities are.
template <int Dimension>
struct PlacedDensity
{
  DensitySource<Dimension> Source;
  Point<Dimension> Low; // low corner of its own box, in lengths
  Point<Dimension> High;
};

// Points of the source are in the index space of the source, images in that of the target. A map
// from the uniform measure has the index space of the density on both sides. Time 0 is the source,
// time 1 the target; between them points move on straight lines with constant speed.
//
// Construction reads the densities and is collective; all ranks then compute the same. Const
// members may run concurrently after Solve. Results have the same bits for every number of threads
// and ranks. Memory: see MemoryFor. Throws InvalidDensity, std::invalid_argument (options, sides),
// std::bad_alloc and Cancelled.
template <int Dimension>
class OptimalMap final : public PointTransport<Dimension>
{
public:
  // From the uniform measure on a box of these sides to a density that fills it.
  OptimalMap(const DensitySource<Dimension>& density, const Point<Dimension>& sides,
    const OptimalMapOptions& options = {}, const Context& context = Context());
  // From one density to another. The two have the same mass, whatever their values sum to.
  OptimalMap(const PlacedDensity<Dimension>& source, const PlacedDensity<Dimension>& target,
    const OptimalMapOptions& options = {}, const Context& context = Context());
  ~OptimalMap() override;
  OptimalMap(OptimalMap&&) noexcept;
  OptimalMap& operator=(OptimalMap&&) noexcept;

  // Must be called before what follows.
  void Solve(const Context& context = Context());

  const OptimalMapReport& Report() const;
  // The relative L2 error of the masses of blocks of 8^d of the target's cells in the image of
  // Forward. Above some hundredths the nodes do not resolve the target, for example lines of one
  // cell. Makes what the first Forward makes. Throws std::bad_alloc and Cancelled.
  double MassError(const Context& context = Context()) const;
  // Not above the least cost of any map or coupling of the densities; at least 0.
  double LowerBound() const;
  // Not below the least cost: the cost of a coupling along the map, or of one along the inverse map
  // if that is less. The second is tried only if the first is above `enough`, even without what it
  // costs that images lie between cells. Densities must have the same size and box.
  // Throws std::invalid_argument.
  double UpperBound(const Context& context = Context(), double enough = 0.0) const;
  // The slack of pairs of points and images: how much more they cost, halved, than the bound allows
  // for where they are. At least 0. Twice the mean over a map's pairs is its cost less LowerBound,
  // but for the error of the nodes.
  void Slack(ConstPointSpan<Dimension> points, ConstPointSpan<Dimension> images, double* slack,
    const Context& context = Context()) const;
  // At the nodes, of which there are NodeCells() + 1 along each axis, axis 0 fastest: x - grad of
  // it is the map. In squared lengths.
  const double* Potential() const;
  const GridSize<Dimension>& NodeCells() const;

  // About the most bytes that an object takes, for densities of these sizes: with Solve, a map in
  // one direction and this use of it.
  static double MemoryFor(const GridSize<Dimension>& source, const GridSize<Dimension>& target,
    const OptimalMapOptions& options = {}, const OptimalMapUse& use = {});
  // The part of these bytes that samples take beyond what a map has, while Forward moves them.
  static double MemoryForSamples(const GridSize<Dimension>& target, const OptimalMapUse& use);

  // The size of the source.
  const GridSize<Dimension>& Size() const override;
  // Nothing here takes steps: reports have 0 of them. Seeds that are samples (FlowSeeds::AsSamples)
  // are moved together, so that boxes of cells get their shares of them, and parts of cells nearly
  // so.
  FlowReport Forward(const FlowSeeds<Dimension>& seeds, PointSpan<Dimension> positions,
    const Context& context = Context()) const override;
  FlowReport Backward(const FlowSeeds<Dimension>& points, PointSpan<Dimension> positions,
    const Context& context = Context()) const override;
  FlowReport ForwardAt(const FlowSeeds<Dimension>& seeds, const std::vector<double>& times,
    PointSpan<Dimension> positions, const Context& context = Context()) const override;
  // Forward, but writes for each point only the number, axis 0 fastest, of the target's cell with
  // mass in which it ends.
  FlowReport ForwardToCells(const FlowSeeds<Dimension>& seeds, std::int64_t* cells,
    const Context& context = Context()) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace RectifiedTransport

#endif
