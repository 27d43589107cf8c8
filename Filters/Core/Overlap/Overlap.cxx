// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Overlap/Overlap.h"

#include "Core/Geometry/CutPolygon.h"
#include "Core/Geometry/SimplexDeterminant.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

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

// Where low and high are on one plane, it is the cell above.
CellRange cellsBetween(double low, double high)
{
  const double first = std::floor(low);
  return { static_cast<std::int64_t>(first),
    static_cast<std::int64_t>(std::max(std::ceil(high) - 1.0, first)) };
}

// The faces of a simplex of positive determinant, counterclockwise seen from outside.
constexpr std::size_t faceCorners[4][3] = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
constexpr std::size_t edgeCorners[3][2] = { { 0, 1 }, { 1, 2 }, { 2, 0 } };

// The area of a triangle's projection along axis 0, positive where its corners run
// counterclockwise.
double shadowOf(const CutPolygon& piece, int i, int j, int k)
{
  // Axes 1 and 2 are those across axis 0.
  const Corner& a = piece[i];
  const Corner& b = piece[j];
  const Corner& c = piece[k];
  return 0.5 * ((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]));
}

// The length of a segment's projection along axis 0.
double shadowOf(const CutPolygon& piece, int i, int j)
{
  return piece[j][1] - piece[i][1];
}

// Integrates f over the cells of one row of the grid after another, by the divergence theorem: the
// integral over a simplex is that of F n_0 over its faces, where F is the antiderivative of f along
// axis 0. Over a piece of a face within one cell stands a prism along axis 0, up to the end of the
// simplex. It adds to the piece's own cell the integral up to the cell's end, and to the later
// cells of the row that of f over the piece's projection ("shadow") along axis 0. With the sign of
// the face's side, these sum to the integral over the simplex. Faces along axis 0 have no shadow.
// The error is that of rounding.
template <int D>
class SimplexSweep
{
public:
  // `cells`: those of the grid that the simplex reaches, along each axis.
  SimplexSweep(
    const LinearSimplex<D>& simplex, const std::array<CellRange, D>& cells, const GridSlab<D>& slab)
    : Cells(cells)
    , Slab(slab)
    , Columns(cells[0].Last - cells[0].First + 1)
  {
    if (this->Columns + 2 > fewColumns)
    {
      this->ManySums.resize(static_cast<std::size_t>(this->Columns + 2));
      this->Sums = this->ManySums.data();
    }
    this->SetFunction(simplex);
    this->SetFaces(simplex);
  }

  // Cuts the faces by layers (3D), rows and columns; each layer and row starts from the whole
  // faces, so that slabs of different threads get the same pieces.
  void Run()
  {
    const CellRange& last = this->Cells[D - 1];
    const CellRange inSlab{ std::max(last.First, this->Slab.First),
      std::min(last.Last, this->Slab.Last - 1) };
    Polygons inLayer;
    for (std::size_t face = 0; face <= D; ++face)
    {
      inLayer[face] = &this->Faces[face];
    }
    if constexpr (D == 2)
    {
      this->AddRows(inLayer, inSlab, this->Slab.Sums);
    }
    else
    {
      for (std::int64_t layer = inSlab.First; layer <= inSlab.Last; ++layer)
      {
        std::array<CutPolygon, 2> parts[D + 1];
        for (std::size_t face = 0; face <= D; ++face)
        {
          inLayer[face] =
            &slabOf<2>(this->Faces[face], static_cast<double>(layer - last.First), parts[face]);
        }
        this->AddRows(inLayer, this->Cells[1],
          this->Slab.Sums + layer * this->Slab.Size[1] * this->Slab.Size[0]);
      }
    }
  }

private:
  using Polygons = std::array<const CutPolygon*, D + 1>; // polygons of the faces; segments in 2D

  static constexpr std::int64_t fewColumns = 16; // small simplices need no memory from the heap

  // What the pieces of faces add to one cell of a row, with the signs of their sides.
  struct CellSums
  {
    double Volume = 0.0;   // volume of prisms that begin in the cell, up to its end
    double Integral = 0.0; // over these
    double Shadows = 0.0;  // areas of the shadows of pieces that begin before the cell
    double Beyond = 0.0;   // the integral over these shadows, at 0 along axis 0
  };

  // Coordinates count from the first cell that is reached: small numbers round less.
  Corner Local(const Point<D>& x) const
  {
    Corner local{};
    for (std::size_t a = 0; a < D; ++a)
    {
      local[a] = x[a] - static_cast<double>(this->Cells[a].First);
    }
    return local;
  }

  // f(x) = Constant + Slope . x, by Cramer's rule: the slope along axis a is the determinant with
  // coordinate a replaced by the values, over that of the simplex.
  void SetFunction(const LinearSimplex<D>& simplex)
  {
    const double volume = determinant(simplex.Vertices);
    this->Side = volume > 0.0 ? -1.0 : 1.0;
    const Corner origin = this->Local(simplex.Vertices[0]);
    const auto range = std::minmax_element(simplex.Values.begin(), simplex.Values.end());
    this->Least = *range.first;
    this->Most = *range.second;
    this->Constant = simplex.Values[0];
    this->Slope = {};
    for (std::size_t a = 0; a < D && !this->IsConstant(); ++a)
    {
      std::array<Point<D>, D + 1> replaced = simplex.Vertices;
      // Differences to vertex 0 are taken in the determinant.
      for (std::size_t i = 0; i <= D; ++i)
      {
        replaced[i][a] = simplex.Values[i];
      }
      this->Slope[a] = determinant(replaced) / volume;
      this->Constant -= this->Slope[a] * origin[a];
    }
  }

  // The faces in local coordinates. One whose shadow is 0 adds nothing, and is emptied.
  void SetFaces(const LinearSimplex<D>& simplex)
  {
    for (const Point<D>& vertex : simplex.Vertices)
    {
      this->End = std::max(this->End, this->Local(vertex)[0]);
    }
    for (std::size_t face = 0; face <= D; ++face)
    {
      CutPolygon& polygon = this->Faces[face];
      for (std::size_t i = 0; i < D; ++i)
      {
        const std::size_t corner = D == 3 ? faceCorners[face][i] : edgeCorners[face][i];
        polygon.Add(this->Local(simplex.Vertices[corner]));
      }
      double shadow = 0.0;
      if constexpr (D == 2)
      {
        shadow = shadowOf(polygon, 0, 1);
      }
      else
      {
        shadow = shadowOf(polygon, 0, 1, 2);
      }
      if (shadow == 0.0)
      {
        polygon.Size = 0;
      }
    }
  }

  // Adds the rows of a layer. Parts do not depend on which rows are asked for: cutting begins at
  // the first row that the simplex reaches.
  void AddRows(const Polygons& faces, const CellRange& rows, double* layer)
  {
    PolygonSlabs<1> parts[D + 1];
    for (std::size_t face = 0; face <= D; ++face)
    {
      parts[face].Begin(*faces[face], 0.0);
    }
    for (std::int64_t row = this->Cells[1].First; row <= rows.Last; ++row)
    {
      // The range along axis 0 of the simplex in this row: only its faces bound it.
      double low = this->End;
      double high = 0.0;
      for (PolygonSlabs<1>& ofFace : parts)
      {
        const CutPolygon& part = ofFace.UpTo(static_cast<double>(row + 1 - this->Cells[1].First));
        if (row < rows.First || part.Size == 0)
        {
          continue;
        }
        // The faces' extent along axis 0 in this row.
        const std::array<double, 2> range = part.Range(0);
        low = std::min(low, range[0]);
        high = std::max(high, range[1]);
        forSlabs<0>(part, this->Columns,
          [this](std::int64_t column, const CutPolygon& piece) { this->AddPiece(column, piece); });
      }
      if (low < high)
      {
        this->FinishRow(cellsBetween(std::max(low, 0.0), high), layer + row * this->Slab.Size[0]);
      }
    }
  }

  // The function has one value: its integral is that times the volume.
  bool IsConstant() const { return !(this->Least < this->Most); }
  // The end of a cell, or of the simplex.
  double EndOf(std::int64_t column) const
  {
    return std::min(static_cast<double>(column + 1), this->End);
  }

  // Adds a piece of a face to its column; column -1 is before the first one.
  void AddPiece(std::int64_t column, const CutPolygon& piece)
  {
    const double end = this->EndOf(column);
    double lengths[CutPolygon::Most]; // distances of corners to the column's end
    double starts[CutPolygon::Most];  // the function at 0 along axis 0
    double means[CutPolygon::Most];   // means of the function from each corner to the end
    const bool isConstant = this->IsConstant();
    for (int i = 0; i < piece.Size; ++i)
    {
      const Corner& x = piece[i];
      lengths[i] = end - x[0];
      if (!isConstant)
      {
        starts[i] =
          this->Constant + this->Slope[1] * x[1] + (D > 2 ? this->Slope[D - 1] * x[2] : 0.0);
        means[i] = starts[i] + this->Slope[0] * (0.5 * (x[0] + end));
      }
    }
    CellSums sums;
    // The simplices of the piece, a fan. Over one, length and mean are linear, so that the
    // integral of their product is area / (D (D + 1)) times (sum of products + product of sums).
    const auto add = [&](auto... corner) {
      const double shadow = shadowOf(piece, corner...);
      // Sum over the corners.
      const double length = (lengths[corner] + ...);
      sums.Volume += shadow * length;
      sums.Shadows += shadow;
      if (!isConstant)
      {
        const double products = ((lengths[corner] * means[corner]) + ...);
        sums.Integral += shadow * (products + length * (means[corner] + ...));
        sums.Beyond += shadow * (starts[corner] + ...);
      }
    };
    if constexpr (D == 2)
    {
      if (piece.Size == 2)
      {
        add(0, 1);
      }
    }
    else
    {
      for (int i = 2; i < piece.Size; ++i)
      {
        add(0, i - 1, i);
      }
    }
    // The means over a (D - 1)-simplex with D corners: of a linear function (1 / D) sum of
    // values, of a product of two 1 / (D (D + 1)) (sum of products + product of sums).
    constexpr double ofOne = 1.0 / D;
    constexpr double ofTwo = 1.0 / (D * (D + 1));
    CellSums& next = this->Sums[column + 1];
    next.Shadows += this->Side * sums.Shadows;
    next.Beyond += this->Side * ofOne * sums.Beyond;
    if (column >= 0)
    {
      CellSums& own = this->Sums[column];
      own.Volume += this->Side * ofOne * sums.Volume;
      own.Integral += this->Side * ofTwo * sums.Integral;
    }
  }

  // Adds to the cells that the row's part of the simplex reaches; in others the sums are rounding
  // errors. `before` runs along the row: the volume of a cell is what its own prisms fill, plus its
  // length times the shadows before it.
  void FinishRow(const CellRange& reached, double* row)
  {
    CellSums before;
    const std::int64_t last = std::min(reached.Last, this->Columns - 1);
    if (reached.First > last)
    {
      return;
    }
    for (std::int64_t column = reached.First; column <= last; ++column)
    {
      const CellSums& sums = this->Sums[column];
      const auto begin = static_cast<double>(column);
      const double end = this->EndOf(column);
      before.Shadows += sums.Shadows;
      before.Beyond += sums.Beyond;
      const double volume = std::max(sums.Volume + (end - begin) * before.Shadows, 0.0);
      // The mean of f over the cell's length: the slope along axis 0 times its middle.
      const double slope = before.Shadows * this->Slope[0] * (0.5 * (begin + end));
      const double integral = sums.Integral + (end - begin) * (before.Beyond + slope);
      // The function of a simplex that is nearly flat may be very steep.
      row[this->Cells[0].First + column] +=
        std::max(this->Least * volume, std::min(integral, this->Most * volume));
    }
    // The sums are 0 again for the next row; two more than the last column's have been written.
    std::fill(this->Sums + reached.First, this->Sums + last + 3, CellSums());
  }

  const std::array<CellRange, D>& Cells;
  const GridSlab<D>& Slab;
  const std::int64_t Columns;
  std::array<CellSums, fewColumns> FewSums; // sums of a row: most simplices are small
  std::vector<CellSums> ManySums;
  CellSums* Sums = this->FewSums.data();
  std::array<CutPolygon, D + 1> Faces;
  double Side;  // sign of prisms over faces that run counterclockwise, seen against axis 0
  double Least; // least value of the function; Most is its largest
  double Most;
  double Constant;
  Point<D> Slope;
  double End = 0.0; // end of the simplex along axis 0, from the first cell
};

// The cells that a simplex reaches, which may be beyond the grid by one cell.
template <int D>
std::array<CellRange, D> cellsOf(const LinearSimplex<D>& simplex, const GridSlab<D>& slab)
{
  std::array<CellRange, D> cells;
  for (std::size_t a = 0; a < D; ++a)
  {
    double low = simplex.Vertices[0][a];
    double high = low;
    for (std::size_t i = 1; i <= D; ++i)
    {
      low = std::min(low, simplex.Vertices[i][a]);
      high = std::max(high, simplex.Vertices[i][a]);
    }
    // Far ones may exceed every integer.
    const auto beyond = static_cast<double>(slab.Size[a] + 1);
    cells[a] = cellsBetween(std::clamp(low, -1.0, beyond), std::clamp(high, -1.0, beyond));
  }
  return cells;
}

} // namespace

template <int D>
double measureOf(const LinearSimplex<D>& simplex)
{
  return std::abs(determinant(simplex.Vertices)) / simplicesOfBox<D>;
}

template <int D>
void addOverlaps(const LinearSimplex<D>& simplex, const GridSlab<D>& slab)
{
  const double measure = measureOf<D>(simplex);
  if (!(measure > 0.0))
  {
    return;
  }
  if constexpr (D == 1)
  {
    const std::size_t low = simplex.Vertices[0][0] < simplex.Vertices[1][0] ? 0 : 1;
    const std::size_t high = 1 - low;
    // In 1D, a simplex is a box.
    addOverlaps<1>(MultilinearBox<1>{ simplex.Vertices[low], simplex.Vertices[high],
                     { simplex.Values[low], simplex.Values[high] } },
      slab);
  }
  else
  {
    std::array<CellRange, D> cells = cellsOf<D>(simplex, slab);
    std::int64_t only = 0;
    bool isInOne = true;
    for (std::size_t a = D; a-- > 0;)
    {
      // From the last axis on, so that `only` is number = i_0 + size_0 (i_1 + size_1 i_2).
      CellRange& range = cells[a];
      isInOne = isInOne && range.First == range.Last;
      const std::int64_t begin = a == D - 1 ? slab.First : 0;
      const std::int64_t end = a == D - 1 ? slab.Last : slab.Size[a];
      if (range.Last < begin || range.First >= end)
      {
        return;
      }
      // The number of the only cell, if all axes have one cell.
      only = only * slab.Size[a] + range.First;
      range = { std::max<std::int64_t>(range.First, 0), std::min(range.Last, slab.Size[a] - 1) };
    }
    if (isInOne)
    {
      // The mean of a linear function over a simplex is that of its values at the vertices.
      const double sum = std::accumulate(simplex.Values.begin(), simplex.Values.end(), 0.0);
      slab.Sums[only] += measure * sum / (D + 1);
    }
    else
    {
      SimplexSweep<D>(simplex, cells, slab).Run();
    }
  }
}

template <int D>
// A multilinear function's integral over a box is the volume times its value at the centre, so that
// a weight at the centre of the overlap along each axis suffices.
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
  // The overlap with a cell along an axis.
  struct Share
  {
    double Length;
    double Upper; // weight of the upper corners at its centre
  };
  const auto shareOf = [&box](int a, std::int64_t cell) {
    const double low = std::max(box.Low[a], static_cast<double>(cell));
    const double high = std::min(box.High[a], static_cast<double>(cell + 1));
    return Share{ high - low, (0.5 * (low + high) - box.Low[a]) / (box.High[a] - box.Low[a]) };
  };
  for (std::int64_t k = range[2].First; k <= range[2].Last; ++k)
  {
    // Weights along the axes multiply, and so do lengths.
    const Share z = D > 2 ? shareOf(2, k) : Share{ 1.0, 0.0 };
    for (std::int64_t j = range[1].First; j <= range[1].Last; ++j)
    {
      const Share y = D > 1 ? shareOf(1, j) : Share{ 1.0, 0.0 };
      const double across = y.Length * z.Length;
      // The function at both ends of the row, at the overlap's centre along the other axes.
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
