// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/LocalMap.h"

namespace RectifiedTransport
{

namespace
{

// Makes values ascending, each once.
void sortOnce(std::vector<std::int64_t>& values)
{
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

// Calls visit(row, column, k, i, j) for the k-th pair i >= j of a triangle's six coordinates if
// both are unknown. Only the lower triangle of the matrix is stored: row >= column.
template <class Visit>
void visitPairs(const TriangleUnknowns& unknowns, const Visit& visit)
{
  std::size_t k = 0;
  for (std::size_t i = 0; i < unknowns.size(); ++i)
  {
    for (std::size_t j = 0; j <= i; ++j, ++k)
    {
      if (unknowns[i] >= 0 && unknowns[j] >= 0)
      {
        visit(std::max(unknowns[i], unknowns[j]), std::min(unknowns[i], unknowns[j]), k, i, j);
      }
    }
  }
}

} // namespace

// A side of the square fixes one coordinate. Three points that are bound to the same value of it
// stay collinear, whatever the polish does.
bool isCollapsed(const DiskMesh& disk, const SquareMap& square, std::int64_t triangle)
{
  const std::int64_t* points = disk.Triangle(triangle);
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double first = square.Positions[static_cast<std::size_t>(points[0])][axis];
    // Bit 0 is for x, bit 1 for y; opposite sides have the same bit but other coordinates, 0 and 1.
    if (std::all_of(points, points + 3, [&](std::int64_t point) {
          const auto i = static_cast<std::size_t>(point);
          return (square.OnSides[i] >> axis & 1) != 0 && square.Positions[i][axis] == first;
        }))
    {
      return true;
    }
  }
  return false;
}

// The area that these miss bounds how well any polish can keep areas.
CollapsedTriangles findCollapsed(const DiskMesh& disk, const SquareMap& square)
{
  CollapsedTriangles collapsed;
  for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
  {
    if (isCollapsed(disk, square, t))
    {
      ++collapsed.Count;
      collapsed.AreaShare += disk.AreaShare(t);
    }
  }
  return collapsed;
}

// The inverse of the triangles' list of corners: by points, ascending triangles.
PointTriangles::PointTriangles(const DiskMesh& disk)
  : Disk(disk)
{
  this->Triangles.Fill(static_cast<std::size_t>(disk.NumberOfPoints()), [&](const auto& add) {
    for (std::int64_t corner = 0; corner < 3 * disk.NumberOfTriangles(); ++corner)
    {
      add(static_cast<std::size_t>(disk.Triangle(0)[corner]), corner / 3);
    }
  });
}

// The triangles of the part are all those with a point that may move: the energy of the others is
// constant. Their remaining corners are fixed.
LocalMap::LocalMap(const MapParts& parts, const std::vector<std::int64_t>& points,
  const std::vector<Point<2>>& positions)
{
  for (const std::int64_t point : points)
  {
    const auto about = parts.Triangles[point];
    this->Ids.insert(this->Ids.end(), about.begin(), about.end());
  }
  sortOnce(this->Ids);
  this->Points.reserve(3 * this->Ids.size());
  for (const std::int64_t id : this->Ids)
  {
    this->Points.insert(this->Points.end(), parts.Disk.Triangle(id), parts.Disk.Triangle(id) + 3);
  }
  // Local numbers of points are their ranks in the ascending ids, so that a binary search finds
  // them.
  sortOnce(this->Points);

  for (const std::int64_t point : this->Points)
  {
    const auto global = static_cast<std::size_t>(point);
    const bool isFree = std::binary_search(points.begin(), points.end(), point);
    const unsigned char sides = parts.Square.OnSides[global];
    // A point has 2 unknowns inside, 1 on a side (its place along it), 0 at a corner or if it is
    // fixed. -1 stands for a coordinate that is fixed.
    this->IsFree.push_back(isFree);
    this->UnknownsOf.emplace_back();
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const bool isUnknown = isFree && (sides >> axis & 1) == 0;
      this->UnknownsOf.back()[axis] = isUnknown ? this->Unknowns++ : -1;
    }
    this->Current.push_back(positions[global]);
  }
  for (const std::int64_t id : this->Ids)
  {
    std::array<int, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::int64_t point = parts.Disk.Triangle(id)[i];
      corners[i] = static_cast<int>(
        std::lower_bound(this->Points.begin(), this->Points.end(), point) - this->Points.begin());
    }
    this->Shares.push_back(parts.Disk.AreaShare(id));
    this->Corners.push_back(corners);
    this->Collapsed.push_back(isCollapsed(parts.Disk, parts.Square, id));
  }
}

// The system is sparse: each triangle has entries for its own six coordinates alone.
LocalSystem LocalMap::MakeSystem() const
{
  // The places of each triangle's six coordinates among the unknowns: x and y of corner 0, 1, 2.
  std::vector<TriangleUnknowns> triangles;
  triangles.reserve(this->Corners.size());
  for (const std::array<int, 3>& corners : this->Corners)
  {
    const auto of = [&](std::size_t i) {
      return this->UnknownsOf[static_cast<std::size_t>(corners[i])];
    };
    triangles.push_back({ of(0)[0], of(0)[1], of(1)[0], of(1)[1], of(2)[0], of(2)[1] });
  }
  return { std::move(triangles), this->Unknowns };
}

// A = ((b - a) x (c - a)) / 2 has the gradient by a corner of half the opposite side, turned by a
// quarter: dA/dx_i = -(y_to - y_from) / 2, dA/dy_i = (x_to - x_from) / 2.
TriangleVector LocalMap::AreaGradient(std::size_t triangle) const
{
  TriangleVector gradient;
  const std::array<int, 3>& corners = this->Corners[triangle];
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point<2>& from = this->Current[static_cast<std::size_t>(corners[(i + 1) % 3])];
    const Point<2>& to = this->Current[static_cast<std::size_t>(corners[(i + 2) % 3])];
    gradient[2 * i] = -0.5 * (to[1] - from[1]);
    gradient[2 * i + 1] = 0.5 * (to[0] - from[0]);
  }
  return gradient;
}

// Coordinates that are fixed do not move.
Point<2> LocalMap::MoveOf(int corner, const std::vector<double>& solution) const
{
  Point<2> move{ 0.0, 0.0 };
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const int unknown = this->UnknownsOf[static_cast<std::size_t>(corner)][axis];
    move[axis] = unknown >= 0 ? solution[static_cast<std::size_t>(unknown)] : 0.0;
  }
  return move;
}

// x + step d, clamped to the square: points inside must not pass its sides.
void LocalMap::Move(
  const std::vector<double>& solution, double step, std::vector<Point<2>>& moved) const
{
  moved.resize(this->Current.size());
  for (std::size_t corner = 0; corner < moved.size(); ++corner)
  {
    const Point<2> move = this->MoveOf(static_cast<int>(corner), solution);
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      moved[corner][axis] = std::clamp(this->Current[corner][axis] + step * move[axis], 0.0, 1.0);
    }
  }
}

// Only free points are written. Fixed ones may belong to another thread's region.
void LocalMap::Store(std::vector<Point<2>>& positions) const
{
  for (std::size_t corner = 0; corner < this->Points.size(); ++corner)
  {
    if (this->IsFree[corner])
    {
      positions[static_cast<std::size_t>(this->Points[corner])] = this->Current[corner];
    }
  }
}

LocalSystem::LocalSystem(std::vector<TriangleUnknowns> triangles, int unknowns)
  : Triangles(std::move(triangles))
  , Places(this->Triangles.size())
  , Matrix(unknowns, unknowns)
  , Right(unknowns)
{
  // The pattern in compressed columns: the rows of each column, ascending, each once.
  Bins<int> rows;
  rows.Fill(static_cast<std::size_t>(unknowns), [this](const auto& add) {
    for (const TriangleUnknowns& triangle : this->Triangles)
    {
      visitPairs(triangle,
        [&](int row, int column, auto...) { add(static_cast<std::size_t>(column), row); });
    }
  });
  std::vector<int> once;
  int* outer = this->Matrix.outerIndexPtr();
  outer[0] = 0;
  for (int column = 0; column < unknowns; ++column)
  {
    const auto all = rows[static_cast<std::size_t>(column)];
    const auto begin = once.insert(once.end(), all.begin(), all.end());
    std::sort(begin, once.end());
    once.erase(std::unique(begin, once.end()), once.end());
    outer[column + 1] = static_cast<int>(once.size());
  }
  const int count = outer[unknowns];
  this->Matrix.resizeNonZeros(count);
  std::copy_n(once.begin(), count, this->Matrix.innerIndexPtr());
  std::fill_n(this->Matrix.valuePtr(), count, InterruptibleReal(0.0));

  // A table of where each triangle's 21 products go makes the assembly of every step a mere
  // addition, without searches.
  const int* inner = this->Matrix.innerIndexPtr();
  for (std::size_t triangle = 0; triangle < this->Triangles.size(); ++triangle)
  {
    visitPairs(this->Triangles[triangle], [&](int row, int column, std::size_t k, auto...) {
      this->Places[triangle][k] = static_cast<int>(
        std::lower_bound(inner + outer[column], inner + outer[column + 1], row) - inner);
    });
  }
  // The fill-reducing order and the elimination tree depend on the pattern alone, which all steps
  // share.
  this->Factor.Analyze(this->Matrix);
}

void LocalSystem::Clear()
{
  std::fill_n(this->Matrix.valuePtr(), this->Matrix.nonZeros(), InterruptibleReal(0.0));
  this->Right.setZero();
}

void LocalSystem::Add(
  std::size_t triangle, const TriangleMatrix& matrix, const TriangleVector& right)
{
  const TriangleUnknowns& unknowns = this->Triangles[triangle];
  visitPairs(unknowns, [&](int, int, std::size_t k, std::size_t i, std::size_t j) {
    this->Matrix.valuePtr()[this->Places[triangle][k]] += matrix[i][j];
  });
  for (std::size_t i = 0; i < unknowns.size(); ++i)
  {
    if (unknowns[i] >= 0)
    {
      this->Right[unknowns[i]] += right[i];
    }
  }
}

void LocalSystem::Damp(double part)
{
  for (int column = 0; column < this->Matrix.cols(); ++column)
  {
    // The first value of a column of the lower triangle is that of the diagonal.
    InterruptibleReal& value = this->Matrix.valuePtr()[this->Matrix.outerIndexPtr()[column]];
    value *= 1.0 + part;
  }
}

bool LocalSystem::Solve(std::vector<double>& solution, Progress& progress)
{
  if (!this->Factor.Factorize(this->Matrix, progress))
  {
    return false;
  }
  const SparseCholesky::Vector found = this->Factor.Solve(this->Right);
  solution.resize(static_cast<std::size_t>(found.size()));
  std::transform(found.begin(), found.end(), solution.begin(),
    [](const InterruptibleReal& value) { return value.Value; });
  return true;
}

} // namespace RectifiedTransport
