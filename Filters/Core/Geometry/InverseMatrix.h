// SPDX-License-Identifier: BSD-3-Clause
// The inverse of the axes of an image.
#ifndef RectifiedTransport_InverseMatrix_h
#define RectifiedTransport_InverseMatrix_h

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace RectifiedTransport
{

// The adjugate over the determinant, which is exact for the identity; zero for a singular matrix.
// It adds as vtkMatrix3x3 does: Eigen's inverse rounds otherwise, and differently in its versions.
inline Eigen::Matrix<double, 3, 3, Eigen::RowMajor> inverseOf(
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>& matrix)
{
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> adjugate;
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d next = matrix.row((i + 1) % 3);
    adjugate.col(i) = next.cross(Eigen::Vector3d(matrix.row((i + 2) % 3)));
  }
  const double determinant =
    matrix(0, 0) * adjugate(0, 0) + matrix(1, 0) * adjugate(0, 1) + matrix(2, 0) * adjugate(0, 2);
  if (determinant == 0.0)
  {
    return Eigen::Matrix3d::Zero();
  }
  return adjugate / determinant;
}

} // namespace RectifiedTransport

#endif
