// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Overlap/Overlap.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

// Grid cells [First, Last] along an axis that share more than a face with [low, high].
struct CellRange
{
  std::int64_t First;
  std::int64_t Last;
};

CellRange cellsBetween(double low, double high)
{
  const double first = std::floor(low);
  return { static_cast<std::int64_t>(first),
    static_cast<std::int64_t>(std::max(std::ceil(high) - 1.0, first)) };
}

double determinant(const std::array<Point<1>, 2>& v)
{
  return v[1][0] - v[0][0];
}

double determinant(const std::array<Point<2>, 3>& v)
{
  return (v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[1][1] - v[0][1]) * (v[2][0] - v[0][0]);
}

double determinant(const std::array<Point<3>, 4>& v)
{
  double e[3][3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      e[i][a] = v[i + 1][a] - v[0][a];
    }
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
    e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
    e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

// Bisects the simplex at edges that cross planes between grid cells, until each part is in one grid
// cell.
template <int D>
class Bisection
{
public:
  explicit Bisection(const GridSlab<D>& slab)
    : Slab(slab)
  {
  }

  void Add(const LinearSimplex<D>& simplex, double measure) const
  {
    std::int64_t cell = 0;
    std::int64_t most = 0;
    int across = 0;
    double plane = 0.0;
    for (int a = D - 1; a >= 0; --a)
    {
      double low = simplex.Vertices[0][a];
      double high = low;
      for (std::size_t i = 1; i <= D; ++i)
      {
        low = std::min(low, simplex.Vertices[i][a]);
        high = std::max(high, simplex.Vertices[i][a]);
      }
      const CellRange cells = cellsBetween(low, high);
      const std::int64_t begin = a == D - 1 ? this->Slab.First : 0;
      const std::int64_t end = a == D - 1 ? this->Slab.Last : this->Slab.Size[a];
      if (cells.Last < begin || cells.First >= end)
      {
        return;
      }
      if (cells.Last - cells.First > most)
      {
        most = cells.Last - cells.First;
        across = a;
        plane = static_cast<double>(cells.First + (most + 1) / 2);
      }
      cell = cell * this->Slab.Size[a] + cells.First;
    }
    if (most > 0)
    {
      this->Divide(simplex, measure, across, plane);
      return;
    }
    double sum = 0.0;
    for (const double value : simplex.Values)
    {
      sum += value;
    }
    this->Slab.Sums[cell] += measure * sum / (D + 1);
  }

private:
  void Divide(const LinearSimplex<D>& simplex, double measure, int axis, double plane) const
  {
    std::size_t low = 0;
    std::size_t high = 0;
    for (std::size_t i = 1; i <= D; ++i)
    {
      low = simplex.Vertices[i][axis] < simplex.Vertices[low][axis] ? i : low;
      high = simplex.Vertices[i][axis] > simplex.Vertices[high][axis] ? i : high;
    }
    const Point<D>& a = simplex.Vertices[low];
    const Point<D>& b = simplex.Vertices[high];
    const double part = (plane - a[axis]) / (b[axis] - a[axis]);
    Point<D> between;
    for (int i = 0; i < D; ++i)
    {
      between[i] = a[i] + part * (b[i] - a[i]);
    }
    between[axis] = plane;
    const double value = simplex.Values[low] + part * (simplex.Values[high] - simplex.Values[low]);
    LinearSimplex<D> half = simplex;
    half.Vertices[high] = between;
    half.Values[high] = value;
    this->Add(half, measure * part);
    half = simplex;
    half.Vertices[low] = between;
    half.Values[low] = value;
    this->Add(half, measure * (1.0 - part));
  }

  const GridSlab<D>& Slab;
};

} // namespace

template <int D>
double measureOf(const LinearSimplex<D>& simplex)
{
  constexpr double simplicesOfBox = D == 3 ? 6.0 : D;
  return std::abs(determinant(simplex.Vertices)) / simplicesOfBox;
}

template <int D>
void addOverlaps(const LinearSimplex<D>& simplex, const GridSlab<D>& slab)
{
  const double measure = measureOf<D>(simplex);
  if (measure > 0.0)
  {
    Bisection<D>(slab).Add(simplex, measure);
  }
}

template <int D>
void addOverlaps(const MultilinearBox<D>& box, const GridSlab<D>& slab)
{
  // Ranges and counters of unused axes are of one cell.
  CellRange range[3] = { { 0, 0 }, { 0, 0 }, { 0, 0 } };
  std::int64_t step[3] = { 1, 0, 0 };
  for (int a = 0; a < D; ++a)
  {
    range[a] = cellsBetween(box.Low[a], box.High[a]);
    range[a].First = std::max<std::int64_t>(range[a].First, a == D - 1 ? slab.First : 0);
    range[a].Last = std::min(range[a].Last, (a == D - 1 ? slab.Last : slab.Size[a]) - 1);
    step[a] = a == 0 ? 1 : step[a - 1] * slab.Size[a - 1];
  }
  struct Share
  {
    double Length;
    double Upper; // the weight of the upper corners at its centre
  };
  const auto shareOf = [&box](int a, std::int64_t cell) {
    const double low = std::max(box.Low[a], static_cast<double>(cell));
    const double high = std::min(box.High[a], static_cast<double>(cell + 1));
    return Share{ high - low, (0.5 * (low + high) - box.Low[a]) / (box.High[a] - box.Low[a]) };
  };
  for (std::int64_t k = range[2].First; k <= range[2].Last; ++k)
  {
    const Share z = D > 2 ? shareOf(2, k) : Share{ 1.0, 0.0 };
    for (std::int64_t j = range[1].First; j <= range[1].Last; ++j)
    {
      const Share y = D > 1 ? shareOf(1, j) : Share{ 1.0, 0.0 };
      const double across = y.Length * z.Length;
      double ends[2];
      for (std::size_t x = 0; x < 2; ++x)
      {
        const auto at = [&](std::size_t upperY, std::size_t upperZ) {
          return box.Values[x + 2 * upperY + 4 * upperZ];
        };
        const auto alongY = [&](std::size_t upperZ) {
          return D > 1 ? at(0, upperZ) + y.Upper * (at(D > 1, upperZ) - at(0, upperZ))
                       : at(0, upperZ);
        };
        ends[x] = D > 2 ? alongY(0) + z.Upper * (alongY(D > 2) - alongY(0)) : alongY(0);
      }
      double* row = slab.Sums + j * step[1] + k * step[2];
      for (std::int64_t i = range[0].First; i <= range[0].Last; ++i)
      {
        const Share x = shareOf(0, i);
        row[i] += across * x.Length * (ends[0] + x.Upper * (ends[1] - ends[0]));
      }
    }
  }
}

template double measureOf(const LinearSimplex<1>&);
template double measureOf(const LinearSimplex<2>&);
template double measureOf(const LinearSimplex<3>&);
template void addOverlaps(const LinearSimplex<1>&, const GridSlab<1>&);
template void addOverlaps(const LinearSimplex<2>&, const GridSlab<2>&);
template void addOverlaps(const LinearSimplex<3>&, const GridSlab<3>&);
template void addOverlaps(const MultilinearBox<1>&, const GridSlab<1>&);
template void addOverlaps(const MultilinearBox<2>&, const GridSlab<2>&);
template void addOverlaps(const MultilinearBox<3>&, const GridSlab<3>&);

} // namespace RectifiedTransport
