// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/Nodes/CostTransform.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace RectifiedTransport
{

namespace
{

constexpr int blockLines = 8; // are copied together: a cache line of each row of nodes
// Values of the first piece of work, after which its pace sizes the others.
constexpr std::int64_t firstSlice = std::int64_t{ 1 } << 19;

// What lines along an axis have in common: h^2 (i - j)^2 / 2 for all displacements, and what the
// intersections of parabolas need.
struct AxisCosts
{
  // `largest` bounds the magnitude of values: rounding errors of boundaries are in proportion to
  // it.
  AxisCosts(std::int64_t nodes, double spacing, double largest)
    : Nodes(static_cast<std::int32_t>(nodes))
    , Scale(1.0 / (spacing * spacing))
    // A boundary is rounded up a little early, by the values' error in squared cells: 4 ulps of the
    // largest one, at most an eighth of a node.
    , RoundUp(1.0 + std::min(0x1p-51 * largest * this->Scale, 0x1p-3))
    , Midpoints(nodes)
    , Parabolas(2 * nodes - 1)
  {
    double* midpoint = this->Midpoints.data();
    double* parabola = this->Parabolas.data() + (nodes - 1);
    for (std::int32_t i = 0; i < this->Nodes; ++i)
    {
      const double length = i;
      midpoint[i] = length + (this->RoundUp - 0.5);
      // The parabola h^2 d^2 / 2 at each displacement d from -(nodes - 1) on.
      parabola[i] = 0.5 * spacing * spacing * (length * length);
      parabola[-i] = parabola[i];
    }
  }

  // The cost of a displacement of d nodes is Parabola()[d], where d may be negative.
  const double* Parabola() const { return this->Parabolas.data() + (this->Nodes - 1); }

  std::int32_t Nodes;
  double Scale; // 1 / h^2: from values to squared cells
  // 1 for rounding a boundary up by truncation, and a little more. Boundaries that differ by
  // rounding must round alike: where a parabola is the lowest for many j, the c-transform of the
  // result has all of these boundaries at the same j.
  double RoundUp;
  LargeBuffer<double> Midpoints; // the place between each node and the one before, plus RoundUp

private:
  LargeBuffer<double> Parabolas;
};

// Writes the minima of Count lines, one after the other, from their starts (see LowerEnvelope). It
// is not inlined, so that all that the loop needs is in registers.
template <int Sign, int Count>
__attribute__((noinline)) void writeEnvelope(const double* values, const std::int32_t* starts,
  const double* costs, std::ptrdiff_t nodes, double* result)
{
  std::ptrdiff_t lowest[Count] = {};
  for (std::ptrdiff_t j = 0; j < nodes; ++j)
  {
    for (int line = 0; line < Count; ++line)
    {
      const std::ptrdiff_t start = starts[line * (nodes + 1) + j];
      lowest[line] = start > lowest[line] ? start : lowest[line];
      result[line * nodes + j] =
        costs[j - lowest[line]] + Sign * values[line * nodes + lowest[line]];
    }
  }
}

// The lower envelope of the parabolas a(i) + h^2 (i - j)^2 / 2 over the nodes j of a line: the
// one-dimensional generalized distance transform, in linear time (Felzenszwalb and Huttenlocher,
// "Distance Transforms of Sampled Functions", 2012). The parabola of a node has its vertex there.
//
// The parabola of a node y is below that of a node x < y from a boundary on, where they intersect.
// If the boundaries of consecutive nodes are in order, each j takes the last node whose boundary it
// has reached. Where a boundary comes before that of the node before, the parabola of this node is
// nowhere the lowest and is dropped. These are the nodes above the lower convex hull of
// a(i) + h^2 i^2 / 2, except that the hull is only as strict as the whole numbers j need: few lines
// have parabolas to drop.
class LowerEnvelope
{
public:
  explicit LowerEnvelope(const AxisCosts& costs)
    : Costs(costs)
    , Nodes(costs.Nodes)
    , Boundaries(costs.Nodes)
    , Before(costs.Nodes)
    , Starts(together * (std::int64_t{ costs.Nodes } + 1))
  {
  }

  // Transforms lines, one after the other, of finite values times Sign. `result` is other memory.
  template <int Sign>
  void Transform(const double* values, double* result, std::int64_t lines)
  {
    const std::ptrdiff_t nodes = this->Nodes;
    std::int64_t line = 0;
    for (; line + together <= lines; line += together)
    {
      this->TransformTogether<Sign, together>(values + line * nodes, result + line * nodes);
    }
    for (; line < lines; ++line)
    {
      this->TransformTogether<Sign, 1>(values + line * nodes, result + line * nodes);
    }
  }

  // The same for one line where infinite values have no parabola; `nodes` receives the node i of
  // each j, any one if all values are infinite.
  void Minimize(const double* values, double* result, std::int32_t* nodes)
  {
    const std::int32_t count = this->Nodes;
    std::int32_t* boundaries = this->Boundaries.data();
    std::int32_t before = -1;
    for (std::int32_t i = 0; i < count; ++i)
    {
      boundaries[i] = before < 0 ? 0 : count;
      if (values[i] < std::numeric_limits<double>::infinity())
      {
        if (before >= 0)
        {
          this->Insert<1>(values, i, before, this->Intersection<1>(values, before, i));
        }
        before = i;
      }
    }
    std::int32_t* starts = this->Starts.data();
    this->MarkStarts(starts);
    const double* costs = this->Costs.Parabola();
    std::int32_t lowest = 0;
    for (std::int32_t j = 0; j < count; ++j)
    {
      lowest = std::max(lowest, starts[j]);
      nodes[j] = lowest;
      result[j] = values[lowest] + costs[j - lowest];
    }
  }

private:
  // Lines at a time, as each step of a line waits for the one before.
  static constexpr int together = 2;

  static std::int32_t Rounded(double boundary, double most)
  {
    boundary = boundary > 0.0 ? boundary : 0.0;
    return static_cast<std::int32_t>(boundary < most ? boundary : most);
  }

  // The first j at which y's parabola is below that of x < y: a(y) + h^2 (y - j)^2 / 2 <= a(x) +
  // h^2 (x - j)^2 / 2 from j = (a(y) - a(x)) / (h^2 (y - x)) + (x + y) / 2 on, rounded up.
  template <int Sign>
  std::int32_t Intersection(const double* values, std::int32_t x, std::int32_t y) const
  {
    const double slope = (values[y] - values[x]) * (Sign * this->Costs.Scale) / (y - x);
    return Rounded(slope + 0.5 * (static_cast<double>(x) + y) + this->Costs.RoundUp, this->Nodes);
  }

  // The boundaries between all neighbours, where y - x = 1. Returns whether they are in order.
  template <int Sign>
  bool FindBoundaries(const double* values)
  {
    std::int32_t* boundaries = this->Boundaries.data();
    const double* midpoints = this->Costs.Midpoints.data();
    const double scale = Sign * this->Costs.Scale;
    const double most = this->Nodes;
    boundaries[0] = 0; // the first parabola begins at the first j
    std::int32_t i = 1;
    bool inOrder = true;
#ifdef __SSE2__
    // Compilers make no minima and maxima of vectors where numbers could be NaN.
    const auto boundariesOfTwo = [=](std::int32_t of) {
      const __m128d rise = _mm_sub_pd(_mm_loadu_pd(values + of), _mm_loadu_pd(values + of - 1));
      const __m128d at =
        _mm_add_pd(_mm_mul_pd(rise, _mm_set1_pd(scale)), _mm_loadu_pd(midpoints + of));
      return _mm_cvttpd_epi32(_mm_min_pd(_mm_max_pd(at, _mm_setzero_pd()), _mm_set1_pd(most)));
    };
    __m128i falls = _mm_setzero_si128();
    __m128i last = _mm_setzero_si128();
    for (; i + 4 <= this->Nodes; i += 4)
    {
      const __m128i four = _mm_unpacklo_epi64(boundariesOfTwo(i), boundariesOfTwo(i + 2));
      const __m128i before = _mm_or_si128(_mm_slli_si128(four, 4), _mm_srli_si128(last, 12));
      falls = _mm_or_si128(falls, _mm_cmplt_epi32(four, before));
      last = four;
      _mm_storeu_si128(reinterpret_cast<__m128i*>(boundaries + i), four);
    }
    inOrder = _mm_movemask_epi8(falls) == 0;
#endif
    for (; i < this->Nodes; ++i)
    {
      boundaries[i] = Rounded((values[i] - values[i - 1]) * scale + midpoints[i], most);
      inOrder = inOrder && boundaries[i] >= boundaries[i - 1];
    }
    return inOrder;
  }

  // Finds the envelopes of Count lines and then writes them in one loop, whose dependent steps
  // overlap.
  template <int Sign, int Count>
  void TransformTogether(const double* values, double* result)
  {
    const std::ptrdiff_t nodes = this->Nodes;
    for (int line = 0; line < Count; ++line)
    {
      this->FindEnvelope<Sign>(values + line * nodes, this->Starts.data() + line * (nodes + 1));
    }
    writeEnvelope<Sign, Count>(values, this->Starts.data(), this->Costs.Parabola(), nodes, result);
  }

  // Most lines are in order at once: those of a potential that is nearly c-concave.
  template <int Sign>
  void FindEnvelope(const double* values, std::int32_t* starts)
  {
    if (!this->FindBoundaries<Sign>(values))
    {
      this->DropParabolas<Sign>(values);
    }
    this->MarkStarts(starts);
  }

  // Repairs the boundaries that are out of order, as Graham's scan does for a convex hull: Before
  // is the stack of the envelope's nodes, as a linked list.
  template <int Sign>
  void DropParabolas(const double* values)
  {
    std::int32_t* before = this->Before.data();
    const std::int32_t* boundaries = this->Boundaries.data();
    std::iota(before, before + this->Nodes, -1);
    for (std::int32_t i = 1; i < this->Nodes; ++i)
    {
      if (boundaries[i] < boundaries[i - 1])
      {
        this->Insert<Sign>(values, i, i - 1, boundaries[i]);
      }
    }
  }

  // Lets the parabola of node i begin at `boundary`, after that of the node before. Drops those
  // that it hides.
  template <int Sign>
  void Insert(const double* values, std::int32_t i, std::int32_t before, std::int32_t boundary)
  {
    std::int32_t* boundaries = this->Boundaries.data();
    while (boundary < boundaries[before]) // not for the first one, whose boundary is 0
    {
      boundaries[before] = this->Nodes;
      before = this->Before.data()[before];
      boundary = this->Intersection<Sign>(values, before, i);
    }
    boundaries[i] = boundary;
    this->Before.data()[i] = before;
  }

  // Writes each node at the first j of its parabola. Of nodes with the same boundary the last one
  // stays, whose parabola is the lowest there.
  void MarkStarts(std::int32_t* starts) const
  {
    const std::int32_t nodes = this->Nodes;
    const std::int32_t* boundaries = this->Boundaries.data();
    std::fill_n(starts, nodes + 1, 0);
    for (std::int32_t i = 0; i < nodes; ++i)
    {
      starts[boundaries[i]] = i;
    }
  }

  const AxisCosts& Costs;
  std::int32_t Nodes;
  // The first j of each parabola; the number of nodes, where there is no j, if it is dropped.
  LargeBuffer<std::int32_t> Boundaries;
  LargeBuffer<std::int32_t> Before; // the node before each on the envelope
  LargeBuffer<std::int32_t> Starts; // the node whose parabola begins at j; 0 for the same as before
};

// Calls kernel(first, last) for ranges of lines that are large enough to pay for their buffers, and
// small enough that several threads get some.
template <class Kernel>
void forLines(const NodeLines& lines, Progress& progress, const Kernel& kernel)
{
  const std::int64_t nodes = lines.Nodes;
  const std::int64_t block = blockLines * nodes;
  const std::int64_t all = lines.Count * nodes;
  const std::int64_t blocks =
    std::max<std::int64_t>(1, std::min<std::int64_t>(all / 16, 1 << 16) / block);
  progress.For(
    all, blocks * block,
    [&](std::int64_t first, std::int64_t last) { kernel(first / nodes, last / nodes); },
    firstSlice);
}

// How many lines from one on, at most blockLines, are neighbours in memory.
int neighboursOf(const NodeLines& lines, std::int64_t line, std::int64_t last)
{
  const std::int64_t rest = lines.Stride - line % lines.Stride;
  return static_cast<int>(std::min({ std::int64_t{ blockLines }, last - line, rest }));
}

// Calls copy(place in lines one after the other, place in the grid) for all nodes of neighbouring
// lines. Lines along axes 1 and 2 are strided; copying them in blocks uses each cache line whole.
template <class Copy>
void forNodes(const NodeLines& lines, int count, const Copy& copy)
{
  const auto forCount = [&copy, nodes = lines.Nodes, stride = lines.Stride](auto some) {
    for (std::int64_t j = 0; j < nodes; ++j)
    {
      for (int line = 0; line < some; ++line)
      {
        copy(line * nodes + j, j * stride + line);
      }
    }
  };
  // The compiler unrolls the usual number.
  count == blockLines ? forCount(std::integral_constant<int, blockLines>()) : forCount(count);
}

template <class T>
void copyFromGrid(const T* grid, const NodeLines& lines, int count, T* to)
{
  forNodes(lines, count, [=](std::int64_t at, std::int64_t node) { to[at] = grid[node]; });
}

template <class T>
void copyToGrid(const T* from, const NodeLines& lines, int count, T* grid)
{
  forNodes(lines, count, [=](std::int64_t at, std::int64_t node) { grid[node] = from[at]; });
}

} // namespace

// phi^c(y) = min_x |x - y|^2 / 2 - phi(x) is separable: the minimum over x_0 of h_0^2 (i - j)^2 / 2
// - phi, then along each other axis of the result, O(nodes) in all (Jacobs and Leger 2020, section
// 4.1).
template <int Dimension>
void costTransform(
  const NodeGrid<Dimension>& grid, const double* from, double* to, Progress& progress)
{
  const double largest = grid.SquaredDiagonal();
  const NodeLines rows(grid, 0);
  const std::int64_t nodes = rows.Nodes;
  const AxisCosts rowCosts(nodes, grid.Spacing[0], largest);
  forLines(rows, progress, [&](std::int64_t first, std::int64_t last) {
    // Along axis 0 lines are contiguous and need no copies, unless they are transformed in place.
    LowerEnvelope envelope(rowCosts);
    if (from != to)
    {
      envelope.Transform<-1>(from + first * nodes, to + first * nodes, last - first);
      return;
    }
    LargeBuffer<double> scratch(blockLines * nodes);
    for (std::int64_t line = first; line < last; line += blockLines)
    {
      const std::int64_t count = std::min<std::int64_t>(blockLines, last - line);
      std::copy_n(from + line * nodes, count * nodes, scratch.data());
      envelope.Transform<-1>(scratch.data(), to + line * nodes, count);
    }
  });
  for (int axis = 1; axis < Dimension; ++axis)
  {
    const NodeLines lines(grid, axis);
    const AxisCosts costs(lines.Nodes, grid.Spacing[axis], largest);
    forLines(lines, progress, [&](std::int64_t first, std::int64_t last) {
      LowerEnvelope envelope(costs);
      LargeBuffer<double> scratch(2 * blockLines * lines.Nodes);
      double* in = scratch.data();
      double* out = in + blockLines * lines.Nodes;
      for (std::int64_t line = first; line < last;)
      {
        double* begin = to + lines.Begin(line);
        const int count = neighboursOf(lines, line, last);
        copyFromGrid(begin, lines, count, in);
        envelope.Transform<1>(in, out, count);
        copyToGrid(out, lines, count, begin);
        line += count;
      }
    });
  }
}

// The same minima with the nodes that attain them: along each axis the minimizer of a line's best
// node is that node's own minimizer along the axes before.
template <int Dimension>
void costMinimizers(
  const NodeGrid<Dimension>& grid, const double* from, std::int64_t* minimizers, Progress& progress)
{
  const double largest = grid.SquaredDiagonal();
  NodeValues values(grid.NumberOfNodes());
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const NodeLines lines(grid, axis);
    const std::int64_t nodes = lines.Nodes;
    const AxisCosts costs(nodes, grid.Spacing[axis], largest);
    forLines(lines, progress, [&](std::int64_t first, std::int64_t last) {
      LowerEnvelope envelope(costs);
      const auto size = static_cast<std::size_t>(blockLines * nodes);
      std::vector<double> in(size);
      std::vector<double> out(size);
      std::vector<std::int64_t> before(size);
      std::vector<std::int64_t> after(size);
      std::vector<std::int32_t> found(static_cast<std::size_t>(nodes));
      for (std::int64_t line = first; line < last;)
      {
        const std::int64_t begin = lines.Begin(line);
        const int count = neighboursOf(lines, line, last);
        if (axis == 0)
        {
          // Values are -phi; nodes without mass have infinity, and thus no parabola.
          std::transform(from + begin, from + begin + nodes, in.begin(), std::negate<>());
          for (std::int64_t j = 0; j < nodes; ++j)
          {
            before[static_cast<std::size_t>(j)] = begin + j;
          }
        }
        else
        {
          copyFromGrid(values.data() + begin, lines, count, in.data());
          copyFromGrid(minimizers + begin, lines, count, before.data());
        }
        for (int i = 0; i < count; ++i)
        {
          const std::int64_t offset = i * nodes;
          envelope.Minimize(in.data() + offset, out.data() + offset, found.data());
          for (std::int64_t j = 0; j < nodes; ++j)
          {
            after[static_cast<std::size_t>(offset + j)] =
              before[static_cast<std::size_t>(offset + found[static_cast<std::size_t>(j)])];
          }
        }
        copyToGrid(out.data(), lines, count, values.data() + begin);
        copyToGrid(after.data(), lines, count, minimizers + begin);
        line += count;
      }
    });
  }
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(costTransform);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(costMinimizers);

} // namespace RectifiedTransport
