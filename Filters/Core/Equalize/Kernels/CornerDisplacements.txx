// SPDX-License-Identifier: BSD-3-Clause
// Moves of corners: those that fit fluxes, and projections on areas. Included by
// EqualizeKernels.txx.

// A corner's move u should carry the flux through each face at the corner: u . n = flux / |face|
// for the unit normals n, in the least squares sense. These are its normal equations (sum n n^T) u
// = sum n flux / |face|.
struct Normal2
{
  float XX = 0.0F;
  float XY = 0.0F;
  float YY = 0.0F;
  float X = 0.0F;
  float Y = 0.0F;
};

// Adds an edge whose normal (nx, ny) has the edge's length: n n^T / |n|^2, and n flux / |n|^2. The
// 1e-12 keeps edges without length from dividing by 0.
RT_INLINE void addEdge(float nx, float ny, float flux, Normal2& sum)
{
  const float square = nx * nx + ny * ny + 1e-12F;
  const float inverse = 1.0F / square;
  sum.XX += nx * nx * inverse;
  sum.XY += nx * ny * inverse;
  sum.YY += ny * ny * inverse;
  sum.X += nx * (flux * inverse);
  sum.Y += ny * (flux * inverse);
}

// Faces that are all parallel leave one direction free; this Tikhonov term chooses no move in it.
constexpr float regular = 1e-3F;

// The least squares move of a corner, from the four edges at it.
RT_INLINE void cornerMove2D(const CornerRow<2>& row, std::int64_t i, bool hasLeft, bool hasRight)
{
  const double* xb = row.Corners[0].X[0];
  const double* yb = row.Corners[0].X[1];
  const double* x = row.Corners[1].X[0];
  const double* y = row.Corners[1].X[1];
  const double* xa = row.Corners[2].X[0];
  const double* ya = row.Corners[2].X[1];
  const float* w0 = row.Weights[0];
  const float* w1 = row.Weights[1];
  const double* p = row.Potential;
  const std::int64_t s = row.Stride[1];
  Normal2 sum;
  // Upright edges, whose normal is to the right; left and right of them cells i - 1 and i.
  addEdge(static_cast<float>(y[i] - yb[i]), static_cast<float>(xb[i] - x[i]),
    w0[i - 1 - s] * static_cast<float>(p[i - s] - p[i - 1 - s]), sum);
  addEdge(static_cast<float>(ya[i] - y[i]), static_cast<float>(x[i] - xa[i]),
    w0[i - 1] * static_cast<float>(p[i] - p[i - 1]), sum);
  // Level edges, whose normal is upwards.
  if (hasLeft)
  {
    addEdge(static_cast<float>(y[i - 1] - y[i]), static_cast<float>(x[i] - x[i - 1]),
      w1[i - 1 - s] * static_cast<float>(p[i - 1] - p[i - 1 - s]), sum);
  }
  if (hasRight)
  {
    addEdge(static_cast<float>(y[i] - y[i + 1]), static_cast<float>(x[i + 1] - x[i]),
      w1[i - s] * static_cast<float>(p[i] - p[i - s]), sum);
  }
  // The solution of the 2 x 2 system by Cramer's rule.
  const float xx = sum.XX + regular;
  const float yy = sum.YY + regular;
  const float inverse = 1.0F / (xx * yy - sum.XY * sum.XY);
  row.Moves[0][i] = (sum.X * yy - sum.Y * sum.XY) * inverse;
  row.Moves[1][i] = (sum.Y * xx - sum.X * sum.XY) * inverse;
}

// The first and last corners lack a neighbour; between them the loop has no branches.
void rowMoves2D(const CornerRow<2>& row)
{
  cornerMove2D(row, 0, false, true);
#pragma omp simd
  for (std::int64_t i = 1; i < row.Cells; ++i)
  {
    cornerMove2D(row, i, true, true);
  }
  cornerMove2D(row, row.Cells, true, false);
}

// The same in 3D: six entries of the symmetric matrix and the right-hand side.
struct Normal3
{
  float XX = 0.0F;
  float XY = 0.0F;
  float XZ = 0.0F;
  float YY = 0.0F;
  float YZ = 0.0F;
  float ZZ = 0.0F;
  float X = 0.0F;
  float Y = 0.0F;
  float Z = 0.0F;
};

// Adds a face with area vector n.
RT_INLINE void addFace(const Vector3& n, float flux, Normal3& sum)
{
  const float square = squareOf(n) + 1e-12F;
  const float inverse = 1.0F / square;
  const float scaled = flux * inverse;
  sum.XX += n.X * n.X * inverse;
  sum.XY += n.X * n.Y * inverse;
  sum.XZ += n.X * n.Z * inverse;
  sum.YY += n.Y * n.Y * inverse;
  sum.YZ += n.Y * n.Z * inverse;
  sum.ZZ += n.Z * n.Z * inverse;
  sum.X += n.X * scaled;
  sum.Y += n.Y * scaled;
  sum.Z += n.Z * scaled;
}

// The least squares move of a corner, from the twelve faces at it.
RT_INLINE void cornerMove3D(const CornerRow<3>& row, std::int64_t i, bool hasLeft, bool hasRight)
{
  const PointRow<3>* r = row.Corners;
  const double* p = row.Potential;
  const std::int64_t s1 = row.Stride[1];
  const std::int64_t s2 = row.Stride[2];
  Normal3 sum;
  // Across axis 0: the four faces between rows; their cells i - 1 and i.
#pragma GCC unroll 2
  for (int b = 0; b < 2; ++b)
  {
#pragma GCC unroll 2
    for (int a = 0; a < 2; ++a)
    {
      const std::int64_t q = i - (1 - a) * s1 - (1 - b) * s2;
      const int at = a + 3 * b; // the row of the face's low corner
      addFace(halfCross(difference(r[at + 4], i, r[at], i), difference(r[at + 3], i, r[at + 1], i)),
        row.Weights[0][q - 1] * static_cast<float>(p[q] - p[q - 1]), sum);
    }
  }
#pragma GCC unroll 2
  for (int side = 0; side < 2; ++side)
  {
    if (side == 0 ? !hasLeft : !hasRight)
    {
      continue;
    }
    const std::int64_t low = i - 1 + side; // the cell along axis 0
#pragma GCC unroll 2
    for (int a = 0; a < 2; ++a)
    {
      // Across axis 1, rows (0, a - 1) and (0, a): below them cell (low, -1, a - 1).
      const std::int64_t q1 = low - (1 - a) * s2;
      const PointRow<3>& near1 = r[1 + 3 * a];
      const PointRow<3>& far1 = r[4 + 3 * a];
      addFace(
        halfCross(difference(far1, low + 1, near1, low), difference(near1, low + 1, far1, low)),
        row.Weights[1][q1 - s1] * static_cast<float>(p[q1] - p[q1 - s1]), sum);
      // Across axis 2, rows (a - 1, 0) and (a, 0).
      const std::int64_t q2 = low - (1 - a) * s1;
      const PointRow<3>& near2 = r[3 + a];
      const PointRow<3>& far2 = r[4 + a];
      addFace(
        halfCross(difference(far2, low + 1, near2, low), difference(far2, low, near2, low + 1)),
        row.Weights[2][q2 - s2] * static_cast<float>(p[q2] - p[q2 - s2]), sum);
    }
  }
  // Where the faces are nearly parallel, the determinant is far below its terms: floats lose it.
  const auto xy = static_cast<double>(sum.XY);
  const auto xz = static_cast<double>(sum.XZ);
  const auto yz = static_cast<double>(sum.YZ);
  const double xx = static_cast<double>(sum.XX + regular);
  const double yy = static_cast<double>(sum.YY + regular);
  const double zz = static_cast<double>(sum.ZZ + regular);
  // The adjugate of the symmetric matrix, whose product with the right-hand side is divided by the
  // determinant.
  const double cxx = yy * zz - yz * yz;
  const double cxy = xz * yz - xy * zz;
  const double cxz = xy * yz - xz * yy;
  const double cyy = xx * zz - xz * xz;
  const double cyz = xy * xz - xx * yz;
  const double czz = xx * yy - xy * xy;
  const double inverse = 1.0 / (xx * cxx + xy * cxy + xz * cxz);
  const auto x = static_cast<double>(sum.X);
  const auto y = static_cast<double>(sum.Y);
  const auto z = static_cast<double>(sum.Z);
  row.Moves[0][i] = static_cast<float>((cxx * x + cxy * y + cxz * z) * inverse);
  row.Moves[1][i] = static_cast<float>((cxy * x + cyy * y + cyz * z) * inverse);
  row.Moves[2][i] = static_cast<float>((cxz * x + cyz * y + czz * z) * inverse);
}

void rowMoves3D(const CornerRow<3>& row)
{
  cornerMove3D(row, 0, false, true);
#pragma omp simd
  for (std::int64_t i = 1; i < row.Cells; ++i)
  {
    cornerMove3D(row, i, true, true);
  }
  cornerMove3D(row, row.Cells, true, false);
}

// The change of area that a projection aims at: it shrinks no cell by more than a half, which could
// fold it.
RT_INLINE double boundedChange(double target, double area)
{
  const double change = target - area;
  const double least = area > 0.0 ? -0.5 * area : 0.0;
  return change > least ? change : least;
}

// Keeps cells without any extent from dividing by 0.
constexpr double leastGradient = 1e-20;
// Under-relaxation: a corner takes the sum of its cells' projections, up to 4 in 2D and 8 in 3D.
constexpr double relaxation2D = 0.5;
constexpr double relaxation3D = 0.3;

// Multipliers lambda = relaxation (target - area) / sum_c m_c |grad_c area|^2: moving each corner c
// by lambda m_c grad_c area changes the area by about what it lacks. In 2D the gradient by a corner
// is half of the other diagonal, turned by 90 degrees.
void rowMultipliers2D(const CellRow<2>& row, const float* const* mobilities, const double* areas,
  const float* targets, float* multipliers)
{
  const float* m0 = mobilities[0];
  const float* m1 = mobilities[1];
  const double* x0 = row.Corners[0].X[0];
  const double* y0 = row.Corners[0].X[1];
  const double* x1 = row.Corners[1].X[0];
  const double* y1 = row.Corners[1].X[1];
#pragma omp simd
  for (std::int64_t i = 0; i < row.Cells; ++i)
  {
    const double ax = x1[i + 1] - x0[i];
    const double ay = y1[i + 1] - y0[i];
    const double bx = x1[i] - x0[i + 1];
    const double by = y1[i] - y0[i + 1];
    const double square = 0.25 *
        (static_cast<double>(m0[i + 1] + m1[i]) * (ax * ax + ay * ay) +
          static_cast<double>(m0[i] + m1[i + 1]) * (bx * bx + by * by)) +
      leastGradient;
    multipliers[i] = static_cast<float>(
      relaxation2D * boundedChange(static_cast<double>(targets[i]), areas[i]) / square);
  }
}

// A corner's new move: the sum of its four cells' projections, lambda m grad area.
RT_INLINE void project2D(const ProjectedRow<2>& row, std::int64_t i, bool hasLeft, bool hasRight)
{
  const double* xb = row.Corners[0].X[0];
  const double* yb = row.Corners[0].X[1];
  const double* x = row.Corners[1].X[0];
  const double* y = row.Corners[1].X[1];
  const double* xa = row.Corners[2].X[0];
  const double* ya = row.Corners[2].X[1];
  const float* below = row.Multipliers[0];
  const float* above = row.Multipliers[1];
  float moveX = 0.0F;
  float moveY = 0.0F;
  if (hasLeft)
  {
    moveX += below[i - 1] * static_cast<float>(y[i - 1] - yb[i]);
    moveY -= below[i - 1] * static_cast<float>(x[i - 1] - xb[i]);
    moveX += above[i - 1] * static_cast<float>(ya[i] - y[i - 1]);
    moveY -= above[i - 1] * static_cast<float>(xa[i] - x[i - 1]);
  }
  if (hasRight)
  {
    moveX -= above[i] * static_cast<float>(ya[i] - y[i + 1]);
    moveY += above[i] * static_cast<float>(xa[i] - x[i + 1]);
    moveX -= below[i] * static_cast<float>(y[i + 1] - yb[i]);
    moveY += below[i] * static_cast<float>(x[i + 1] - xb[i]);
  }
  const float factor = 0.5F * row.Mobility[i];
  row.After[0][i] = row.Before[0][i] + factor * moveX;
  row.After[1][i] = row.Before[1][i] + factor * moveY;
}

// As rowMoves2D.
void rowProject2D(const ProjectedRow<2>& row)
{
  project2D(row, 0, false, true);
#pragma omp simd
  for (std::int64_t i = 1; i < row.Cells; ++i)
  {
    project2D(row, i, true, true);
  }
  project2D(row, row.Cells, true, false);
}

// The same in 3D, for the parallelepiped that has the cell's mean edges: the gradients of its
// volume are a quarter of the sum of three faces.
void rowMultipliers3D(const CellRow<3>& row, const float* const* mobilities, const double* areas,
  const float* targets, float* multipliers)
{
  const float* m0 = mobilities[0];
  const float* m1 = mobilities[1];
  const float* m2 = mobilities[2];
  const float* m3 = mobilities[3];
  const PointRow<3>* r = row.Corners;
#pragma omp simd
  for (std::int64_t i = 0; i < row.Cells; ++i)
  {
    Vector3 e0 = sumOfFour(difference(r[0], i + 1, r[0], i), difference(r[1], i + 1, r[1], i),
      difference(r[3], i + 1, r[3], i), difference(r[4], i + 1, r[4], i));
    Vector3 e1 = sumOfFour(difference(r[1], i, r[0], i), difference(r[1], i + 1, r[0], i + 1),
      difference(r[4], i, r[3], i), difference(r[4], i + 1, r[3], i + 1));
    Vector3 e2 = sumOfFour(difference(r[3], i, r[0], i), difference(r[3], i + 1, r[0], i + 1),
      difference(r[4], i, r[1], i), difference(r[4], i + 1, r[1], i + 1));
    // halfCross of four times the edges: eight times the faces. The squared gradient by a corner is
    // in the mean a sixteenth of the sum of the squared faces.
    const float mobility =
      ((m0[i] + m0[i + 1]) + (m1[i] + m1[i + 1])) + ((m2[i] + m2[i + 1]) + (m3[i] + m3[i + 1]));
    const float square = mobility / 1024.0F *
      (squareOf(halfCross(e0, e1)) + squareOf(halfCross(e1, e2)) + squareOf(halfCross(e2, e0)));
    multipliers[i] =
      static_cast<float>(relaxation3D * boundedChange(static_cast<double>(targets[i]), areas[i]) /
        (static_cast<double>(square) + leastGradient));
  }
}

// sum += factor a x b.
RT_INLINE void addCross(const Vector3& a, const Vector3& b, float factor, Vector3& sum)
{
  sum.X += factor * (a.Y * b.Z - a.Z * b.Y);
  sum.Y += factor * (a.Z * b.X - a.X * b.Z);
  sum.Z += factor * (a.X * b.Y - a.Y * b.X);
}

// The gradient of a cell's volume by its corner c is near a quarter of the outward faces of the
// tetrahedron that c's edges span, e1 x e2 + e2 x e0 + e0 x e1, with a minus sign where c is on the
// low sides. Each product of two edges belongs to the two cells on both sides.
RT_INLINE void project3D(const ProjectedRow<3>& row, std::int64_t i, bool hasLeft, bool hasRight)
{
  const PointRow<3>* r = row.Corners;
  const Vector3 none{ 0.0F, 0.0F, 0.0F };
  // Along each axis, forward differences below and above the corner.
  const Vector3 e0[2] = { hasLeft ? difference(r[4], i, r[4], i - 1) : none,
    hasRight ? difference(r[4], i + 1, r[4], i) : none };
  const Vector3 e1[2] = { difference(r[4], i, r[3], i), difference(r[5], i, r[4], i) };
  const Vector3 e2[2] = { difference(r[4], i, r[1], i), difference(r[7], i, r[4], i) };
  float m[2][2][2]; // by the sides along axes 2, 1 and 0
#pragma GCC unroll 2
  for (int b = 0; b < 2; ++b)
  {
#pragma GCC unroll 2
    for (int a = 0; a < 2; ++a)
    {
      m[b][a][0] = hasLeft ? row.Multipliers[a + 2 * b][i - 1] : 0.0F;
      m[b][a][1] = hasRight ? row.Multipliers[a + 2 * b][i] : 0.0F;
    }
  }
  Vector3 move = none;
#pragma GCC unroll 2
  for (int b = 0; b < 2; ++b)
  {
#pragma GCC unroll 2
    for (int a = 0; a < 2; ++a)
    {
      addCross(e1[a], e2[b], m[b][a][0] - m[b][a][1], move);
      addCross(e2[a], e0[b], m[a][0][b] - m[a][1][b], move);
      addCross(e0[a], e1[b], m[0][b][a] - m[1][b][a], move);
    }
  }
  const float factor = 0.25F * row.Mobility[i];
  row.After[0][i] = row.Before[0][i] + factor * move.X;
  row.After[1][i] = row.Before[1][i] + factor * move.Y;
  row.After[2][i] = row.Before[2][i] + factor * move.Z;
}

// As rowMoves3D.
void rowProject3D(const ProjectedRow<3>& row)
{
  project3D(row, 0, false, true);
#pragma omp simd
  for (std::int64_t i = 1; i < row.Cells; ++i)
  {
    project3D(row, i, true, true);
  }
  project3D(row, row.Cells, true, false);
}
