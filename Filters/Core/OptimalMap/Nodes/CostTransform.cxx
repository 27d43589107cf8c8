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
// changes between parabolas need.
struct AxisCosts
{
  // `largest` bounds the magnitude of values: rounding errors of changes are in proportion to it.
  AxisCosts(std::int64_t nodes, double spacing, double largest)
    : Nodes(static_cast<std::int32_t>(nodes))
    , Scale(1.0 / (spacing * spacing))
    // A change is rounded up a little early, by the error of the values in squared cells, 4 ulps of
    // the largest one, at most an eighth of a node.
    , Above(1.0 + std::min(0x1p-51 * largest * this->Scale, 0x1p-3))
    , Middles(nodes)
    , Ways(2 * nodes - 1)
  {
    double* middle = this->Middles.data();
    double* way = this->Ways.data() + (nodes - 1);
    for (std::int32_t i = 0; i < this->Nodes; ++i)
    {
      const double length = i;
      middle[i] = length + (this->Above - 0.5);
      // The parabola h^2 d^2 / 2 at each displacement d from -(nodes - 1) on.
      way[i] = 0.5 * spacing * spacing * (length * length);
      way[-i] = way[i];
    }
  }

  // The cost of a displacement of d nodes is OfWays()[d], where d may be negative.
  const double* OfWays() const { return this->Ways.data() + (this->Nodes - 1); }

  std::int32_t Nodes;
  double Scale; // 1 / h^2: from values to squared cells
  // 1 for rounding a change up by truncation, and a little more. Changes that differ by rounding
  // must round alike: where a parabola serves many j, the c-transform of the result has all of
  // these changes at the same j.
  double Above;
  LargeBuffer<double> Middles; // the place between each node and the one before, plus Above

private:
  LargeBuffer<double> Ways;
};

// Writes the minima of Count lines, one after the other, from their marks (see LineTransform). It
// is not inlined, so that all that the loop needs is in registers.
template <int Sign, int Count>
__attribute__((noinline)) void serve(const double* values, const std::int32_t* marks,
  const double* costs, std::ptrdiff_t nodes, double* result)
{
  std::ptrdiff_t serving[Count] = {};
  for (std::ptrdiff_t j = 0; j < nodes; ++j)
  {
    for (int line = 0; line < Count; ++line)
    {
      const std::ptrdiff_t mark = marks[line * (nodes + 1) + j];
      serving[line] = mark > serving[line] ? mark : serving[line];
      result[line * nodes + j] =
        costs[j - serving[line]] + Sign * values[line * nodes + serving[line]];
    }
  }
}

// The one-dimensional c-transform of lines of nodes, as a lower envelope of parabolas: finds for
// each j the i of the least a(i) + h^2 (i - j)^2 / 2 in linear time (Felzenszwalb and Huttenlocher,
// "Distance Transforms of Sampled Functions", 2012).
//
// A node y serves before a node x < y from a certain j on. Of consecutive nodes these changes need
// to be in order, and then each j takes the last node whose change it has reached. Where a change
// comes before that of the node before, this node serves nowhere and is dropped. These are the
// nodes above the lower convex hull of a(i) + h^2 i^2 / 2, except that the hull is only as strict
// as the whole numbers j need: few lines have nodes to drop.
class LineTransform
{
public:
  explicit LineTransform(const AxisCosts& costs)
    : Costs(costs)
    , Nodes(costs.Nodes)
    , Changes(costs.Nodes)
    , Before(costs.Nodes)
    , Marks(together * (std::int64_t{ costs.Nodes } + 1))
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

  // The same for one line where infinite values do not serve; `nodes` receives the node i of each
  // j, any one if all values are infinite.
  void Minimize(const double* values, double* result, std::int32_t* nodes)
  {
    const std::int32_t count = this->Nodes;
    std::int32_t* changes = this->Changes.data();
    std::int32_t before = -1;
    for (std::int32_t i = 0; i < count; ++i)
    {
      changes[i] = before < 0 ? 0 : count;
      if (values[i] < std::numeric_limits<double>::infinity())
      {
        if (before >= 0)
        {
          this->Place<1>(values, i, before, this->ChangeBetween<1>(values, before, i));
        }
        before = i;
      }
    }
    std::int32_t* marks = this->Marks.data();
    this->Mark(marks);
    const double* costs = this->Costs.OfWays();
    std::int32_t serving = 0;
    for (std::int32_t j = 0; j < count; ++j)
    {
      serving = std::max(serving, marks[j]);
      nodes[j] = serving;
      result[j] = values[serving] + costs[j - serving];
    }
  }

private:
  // Lines at a time, as each step of a line waits for the one before.
  static constexpr int together = 2;

  static std::int32_t Rounded(double change, double most)
  {
    change = change > 0.0 ? change : 0.0;
    return static_cast<std::int32_t>(change < most ? change : most);
  }

  // The first j at which y serves before x < y: a(y) + h^2 (y - j)^2 / 2 <= a(x) + h^2 (x - j)^2 /
  // 2 from j = (a(y) - a(x)) / (h^2 (y - x)) + (x + y) / 2 on, rounded up.
  template <int Sign>
  std::int32_t ChangeBetween(const double* values, std::int32_t x, std::int32_t y) const
  {
    const double slope = (values[y] - values[x]) * (Sign * this->Costs.Scale) / (y - x);
    return Rounded(slope + 0.5 * (static_cast<double>(x) + y) + this->Costs.Above, this->Nodes);
  }

  // The changes between all neighbours, where y - x = 1. Returns whether they are in order.
  template <int Sign>
  bool FindChanges(const double* values)
  {
    std::int32_t* changes = this->Changes.data();
    const double* middles = this->Costs.Middles.data();
    const double scale = Sign * this->Costs.Scale;
    const double most = this->Nodes;
    changes[0] = 0; // the first node serves from the first j on
    std::int32_t i = 1;
    bool inOrder = true;
#ifdef __SSE2__
    // Compilers make no minima and maxima of vectors where numbers could be NaN.
    const auto changesOfTwo = [=](std::int32_t of) {
      const __m128d ways = _mm_sub_pd(_mm_loadu_pd(values + of), _mm_loadu_pd(values + of - 1));
      const __m128d change =
        _mm_add_pd(_mm_mul_pd(ways, _mm_set1_pd(scale)), _mm_loadu_pd(middles + of));
      return _mm_cvttpd_epi32(_mm_min_pd(_mm_max_pd(change, _mm_setzero_pd()), _mm_set1_pd(most)));
    };
    __m128i falls = _mm_setzero_si128();
    __m128i last = _mm_setzero_si128();
    for (; i + 4 <= this->Nodes; i += 4)
    {
      const __m128i four = _mm_unpacklo_epi64(changesOfTwo(i), changesOfTwo(i + 2));
      const __m128i before = _mm_or_si128(_mm_slli_si128(four, 4), _mm_srli_si128(last, 12));
      falls = _mm_or_si128(falls, _mm_cmplt_epi32(four, before));
      last = four;
      _mm_storeu_si128(reinterpret_cast<__m128i*>(changes + i), four);
    }
    inOrder = _mm_movemask_epi8(falls) == 0;
#endif
    for (; i < this->Nodes; ++i)
    {
      changes[i] = Rounded((values[i] - values[i - 1]) * scale + middles[i], most);
      inOrder = inOrder && changes[i] >= changes[i - 1];
    }
    return inOrder;
  }

  // Marks Count lines and then serves them in one loop, whose dependent steps overlap.
  template <int Sign, int Count>
  void TransformTogether(const double* values, double* result)
  {
    const std::ptrdiff_t nodes = this->Nodes;
    for (int line = 0; line < Count; ++line)
    {
      this->MarkLine<Sign>(values + line * nodes, this->Marks.data() + line * (nodes + 1));
    }
    serve<Sign, Count>(values, this->Marks.data(), this->Costs.OfWays(), nodes, result);
  }

  // Most lines are in order at once: those of a potential that is nearly c-concave.
  template <int Sign>
  void MarkLine(const double* values, std::int32_t* marks)
  {
    if (!this->FindChanges<Sign>(values))
    {
      this->DropNodes<Sign>(values);
    }
    this->Mark(marks);
  }

  // Repairs the changes that are out of order, as Graham's scan does for a convex hull: Before is
  // the stack of nodes that still serve, as a linked list.
  template <int Sign>
  void DropNodes(const double* values)
  {
    std::int32_t* before = this->Before.data();
    const std::int32_t* changes = this->Changes.data();
    std::iota(before, before + this->Nodes, -1);
    for (std::int32_t i = 1; i < this->Nodes; ++i)
    {
      if (changes[i] < changes[i - 1])
      {
        this->Place<Sign>(values, i, i - 1, changes[i]);
      }
    }
  }

  // Lets node i serve from `change` on, after the node before. Drops those that it makes useless.
  template <int Sign>
  void Place(const double* values, std::int32_t i, std::int32_t before, std::int32_t change)
  {
    std::int32_t* changes = this->Changes.data();
    while (change < changes[before]) // not for the first one, whose change is 0
    {
      changes[before] = this->Nodes;
      before = this->Before.data()[before];
      change = this->ChangeBetween<Sign>(values, before, i);
    }
    changes[i] = change;
    this->Before.data()[i] = before;
  }

  // Writes each node at the first j that it serves. Of nodes with the same change the last one
  // stays, which is the one that serves there.
  void Mark(std::int32_t* marks) const
  {
    const std::int32_t nodes = this->Nodes;
    const std::int32_t* changes = this->Changes.data();
    std::fill_n(marks, nodes + 1, 0);
    for (std::int32_t i = 0; i < nodes; ++i)
    {
      marks[changes[i]] = i;
    }
  }

  const AxisCosts& Costs;
  std::int32_t Nodes;
  // The first j that each node serves; the number of nodes, where there is no j, if it is dropped.
  LargeBuffer<std::int32_t> Changes;
  LargeBuffer<std::int32_t> Before; // the node that serves before each
  LargeBuffer<std::int32_t> Marks;  // the node that serves from j on; 0 for the same as before
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
    LineTransform transform(rowCosts);
    if (from != to)
    {
      transform.Transform<-1>(from + first * nodes, to + first * nodes, last - first);
      return;
    }
    LargeBuffer<double> scratch(blockLines * nodes);
    for (std::int64_t line = first; line < last; line += blockLines)
    {
      const std::int64_t count = std::min<std::int64_t>(blockLines, last - line);
      std::copy_n(from + line * nodes, count * nodes, scratch.data());
      transform.Transform<-1>(scratch.data(), to + line * nodes, count);
    }
  });
  for (int axis = 1; axis < Dimension; ++axis)
  {
    const NodeLines lines(grid, axis);
    const AxisCosts costs(lines.Nodes, grid.Spacing[axis], largest);
    forLines(lines, progress, [&](std::int64_t first, std::int64_t last) {
      LineTransform transform(costs);
      LargeBuffer<double> scratch(2 * blockLines * lines.Nodes);
      double* in = scratch.data();
      double* out = in + blockLines * lines.Nodes;
      for (std::int64_t line = first; line < last;)
      {
        double* begin = to + lines.Begin(line);
        const int count = neighboursOf(lines, line, last);
        copyFromGrid(begin, lines, count, in);
        transform.Transform<1>(in, out, count);
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
      LineTransform transform(costs);
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
          // Values are -phi; nodes without mass have infinity, so that they never serve.
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
          transform.Minimize(in.data() + offset, out.data() + offset, found.data());
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

template void costTransform<1>(const NodeGrid<1>&, const double*, double*, Progress&);
template void costTransform<2>(const NodeGrid<2>&, const double*, double*, Progress&);
template void costTransform<3>(const NodeGrid<3>&, const double*, double*, Progress&);
template void costMinimizers<1>(const NodeGrid<1>&, const double*, std::int64_t*, Progress&);
template void costMinimizers<2>(const NodeGrid<2>&, const double*, std::int64_t*, Progress&);
template void costMinimizers<3>(const NodeGrid<3>&, const double*, std::int64_t*, Progress&);

} // namespace RectifiedTransport
