// SPDX-License-Identifier: BSD-3-Clause
// Areas of the images of cells, and weights of their faces. Included by EqualizeKernels.txx.

// The area of a quadrilateral is half the cross product of its diagonals, exact for bilinear
// images.
void rowAreas2D(const CellRow<2>& row, double* areas)
{
  const double* x0 = row.Corners[0].X[0];
  const double* y0 = row.Corners[0].X[1];
  const double* x1 = row.Corners[1].X[0];
  const double* y1 = row.Corners[1].X[1];
#pragma omp simd
  for (std::int64_t i = 0; i < row.Cells; ++i)
  {
    areas[i] =
      0.5 * ((x1[i + 1] - x0[i]) * (y1[i] - y0[i + 1]) - (y1[i + 1] - y0[i]) * (x1[i] - x0[i + 1]));
  }
}

// The determinant of three vectors, the volume of their parallelepiped.
RT_INLINE double determinant(
  double ax, double ay, double az, double bx, double by, double bz, double cx, double cy, double cz)
{
  return ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx);
}

// The integral of the Jacobian determinant of a trilinear map. [k][j] are the rows of the corners.
// Twelve times it is a sum of three determinants of differences of corners (Grandy, Efficient
// Computation of Volume of Hexahedral Cells, 1997): a face is the mean of its two triangulations.
void rowAreas3D(const CellRow<3>& row, double* areas)
{
  const PointRow<3>& r00 = row.Corners[0];
  const PointRow<3>& r10 = row.Corners[1];
  const PointRow<3>& r01 = row.Corners[3];
  const PointRow<3>& r11 = row.Corners[4];
#pragma omp simd
  for (std::int64_t i = 0; i < row.Cells; ++i)
  {
    double d71[3];
    double d60[3];
    double d72[3];
    double d30[3];
    double d50[3];
    double d74[3];
    for (int a = 0; a < 3; ++a)
    {
      // Corner numbers: bit 0 along axis 0, bit 1 along axis 1, bit 2 along axis 2.
      const double c0 = r00.X[a][i];
      const double c1 = r00.X[a][i + 1];
      const double c2 = r10.X[a][i];
      const double c3 = r10.X[a][i + 1];
      const double c4 = r01.X[a][i];
      const double c5 = r01.X[a][i + 1];
      const double c6 = r11.X[a][i];
      const double c7 = r11.X[a][i + 1];
      d71[a] = c7 - c1;
      d60[a] = c6 - c0;
      d72[a] = c7 - c2;
      d30[a] = c3 - c0;
      d50[a] = c5 - c0;
      d74[a] = c7 - c4;
    }
    const double first = determinant(d71[0] + d60[0], d71[1] + d60[1], d71[2] + d60[2], d72[0],
      d72[1], d72[2], d30[0], d30[1], d30[2]);
    const double second = determinant(d60[0], d60[1], d60[2], d72[0] + d50[0], d72[1] + d50[1],
      d72[2] + d50[2], d74[0], d74[1], d74[2]);
    const double third = determinant(d71[0], d71[1], d71[2], d50[0], d50[1], d50[2],
      d74[0] + d30[0], d74[1] + d30[1], d74[2] + d30[2]);
    areas[i] = (first + second + third) / 12.0;
  }
}

// A weight is bounded: images may be degenerate, and the solution leads to the right areas whatever
// the weights are, as fluxes balance the missing areas.
constexpr float largestWeight = 8.0F;
constexpr float leastWeight = 1e-5F;
constexpr float leastSquare = 1e-6F; // least squared distance of centres, in squared cells

// w = |face| / |distance of the centres|, the conductance of the finite volume method, from their
// squares.
RT_INLINE float weightOf(float face, float distance)
{
  const float square = face / (distance > leastSquare ? distance : leastSquare);
  const float weight = __builtin_sqrtf(square);
  const float bounded = weight > leastWeight ? weight : leastWeight;
  return bounded < largestWeight ? bounded : largestWeight;
}

// The weights of the cells' upper faces along both axes. Centres are means of four corners, so that
// sums of differences are four times their distance, hence the factor 1/16.
void rowWeights2D(const CellRow<2>& row, float* const* weights)
{
  const std::int64_t cells = row.Cells;
  const double* x0 = row.Corners[0].X[0];
  const double* y0 = row.Corners[0].X[1];
  const double* x1 = row.Corners[1].X[0];
  const double* y1 = row.Corners[1].X[1];
  const double* x2 = row.Corners[2].X[0];
  const double* y2 = row.Corners[2].X[1];
  float* along0 = weights[0];
  float* along1 = weights[1];
#pragma omp simd
  for (std::int64_t i = 0; i < cells - 1; ++i)
  {
    const auto ex = static_cast<float>(x1[i + 1] - x0[i + 1]);
    const auto ey = static_cast<float>(y1[i + 1] - y0[i + 1]);
    const auto dx = static_cast<float>((x0[i + 2] - x0[i]) + (x1[i + 2] - x1[i]));
    const auto dy = static_cast<float>((y0[i + 2] - y0[i]) + (y1[i + 2] - y1[i]));
    along0[i] = weightOf(ex * ex + ey * ey, 0.0625F * (dx * dx + dy * dy));
  }
  // The last face along axis 0 is on the box's side.
  along0[cells - 1] = 0.0F;
#pragma omp simd
  for (std::int64_t i = 0; i < cells; ++i)
  {
    const auto ex = static_cast<float>(x1[i + 1] - x1[i]);
    const auto ey = static_cast<float>(y1[i + 1] - y1[i]);
    const auto dx = static_cast<float>((x2[i] - x0[i]) + (x2[i + 1] - x0[i + 1]));
    const auto dy = static_cast<float>((y2[i] - y0[i]) + (y2[i + 1] - y0[i + 1]));
    along1[i] = weightOf(ex * ex + ey * ey, 0.0625F * (dx * dx + dy * dy));
  }
}

// Sums of eight corners' differences are eight times the distance of the centres.
RT_INLINE float weightAcross(const Vector3& face, const Vector3& eightTimesDistance)
{
  return weightOf(squareOf(face), 0.015625F * squareOf(eightTimesDistance));
}

// In 3D a face's area vector is half the cross product of its diagonals.
void rowWeights3D(const CellRow<3>& row, float* const* weights)
{
  const std::int64_t cells = row.Cells;
  const PointRow<3>* r = row.Corners;
  float* along0 = weights[0];
  float* along1 = weights[1];
  float* along2 = weights[2];
#pragma omp simd
  for (std::int64_t i = 0; i < cells - 1; ++i)
  {
    const Vector3 face =
      halfCross(difference(r[4], i + 1, r[0], i + 1), difference(r[3], i + 1, r[1], i + 1));
    const Vector3 apart =
      sumOfFour(difference(r[0], i + 2, r[0], i), difference(r[1], i + 2, r[1], i),
        difference(r[3], i + 2, r[3], i), difference(r[4], i + 2, r[4], i));
    along0[i] = weightAcross(face, apart);
  }
  along0[cells - 1] = 0.0F;
#pragma omp simd
  for (std::int64_t i = 0; i < cells; ++i)
  {
    const Vector3 face =
      halfCross(difference(r[4], i + 1, r[1], i), difference(r[1], i + 1, r[4], i));
    const Vector3 apart =
      sumOfFour(difference(r[2], i, r[0], i), difference(r[2], i + 1, r[0], i + 1),
        difference(r[5], i, r[3], i), difference(r[5], i + 1, r[3], i + 1));
    along1[i] = weightAcross(face, apart);
  }
#pragma omp simd
  for (std::int64_t i = 0; i < cells; ++i)
  {
    const Vector3 face =
      halfCross(difference(r[4], i + 1, r[3], i), difference(r[4], i, r[3], i + 1));
    const Vector3 apart =
      sumOfFour(difference(r[6], i, r[0], i), difference(r[6], i + 1, r[0], i + 1),
        difference(r[7], i, r[1], i), difference(r[7], i + 1, r[1], i + 1));
    along2[i] = weightAcross(face, apart);
  }
}
