// SPDX-License-Identifier: BSD-3-Clause
// Where the cells of a density lie: the affine map between the core's index space and physical
// space, through vtkImageData's own transform.
#ifndef RectifiedTransport_ImageGeometry_h
#define RectifiedTransport_ImageGeometry_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Splat/Splat.h"
#include "Core/Tables/Density.h"

#include <algorithm>
#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// The axes of index space are the image's axes of more than one point, in their order. Cell arrays
// have the image's cells; point arrays dual cells, which reach half a spacing beyond the bounds.
class ImageGeometry
{
public:
  ImageGeometry() = default;
  // Throws Failure if there is no axis, or if the cells have no measure.
  ImageGeometry(vtkImageData* image, bool onPoints);

  // Whether index space has the same size, and the same place in physical space.
  bool operator==(const ImageGeometry& other) const;

  int Dimension() const { return this->AxisCount; }
  std::int64_t NumberOfCells() const;
  // The length, area or volume of a cell.
  double CellMeasure() const { return this->Measure; }
  // The physical length of the domain's diagonal, were its axes at right angles.
  double Diagonal() const;
  // Whether the axes of a volume are left-handed.
  bool IsMirrored() const;
  // How far beyond the border a point may lie and not be outside: by more than single precision
  // may miss it.
  double BorderTolerance() const { return 1e-6 * this->Diagonal(); }

  template <int D>
  GridSize<D> Size() const
  {
    GridSize<D> size;
    for (int a = 0; a < D; ++a)
    {
      size[a] = this->Cells[a];
    }
    return size;
  }

  // The physical lengths of the domain's sides.
  template <int D>
  Point<D> Lengths() const
  {
    Point<D> lengths;
    for (int a = 0; a < D; ++a)
    {
      lengths[a] = this->Spacing[a] * static_cast<double>(this->Cells[a]);
    }
    return lengths;
  }

  // The sum is in vtkImageData's own order, so that a point of the domain is never outside its
  // bounds by rounding.
  template <int D>
  void ToPhysical(const double* index, double* x) const
  {
    double ijk[3] = { this->Fixed[0], this->Fixed[1], this->Fixed[2] };
    for (int a = 0; a < D; ++a)
    {
      ijk[this->Axis[a]] += index[a];
    }
    for (int r = 0; r < 3; ++r)
    {
      const double* m = this->Matrix[r];
      x[r] = m[0] * ijk[0] + m[1] * ijk[1] + m[2] * ijk[2] + m[3];
    }
  }

  // The nearest point of the (unbounded) line, plane or space that the axes span.
  template <int D>
  void ToIndex(const double* x, double* index) const
  {
    const double d[3] = { x[0] - this->Corner[0], x[1] - this->Corner[1], x[2] - this->Corner[2] };
    for (int a = 0; a < D; ++a)
    {
      const double* row = this->Inverse[a];
      index[a] = (row[0] * d[0] + row[1] * d[1] + row[2] * d[2]) / this->Spacing[a];
    }
  }

  // ToIndex, and how far a point may be beyond the border or off the line or plane of the image, as
  // the core reads it.
  template <int D>
  SplatMap<D> ToIndexMap() const
  {
    SplatMap<D> map;
    for (int a = 0; a < 3; ++a)
    {
      const double unit = a < D ? this->Spacing[a] : 1.0;
      map.Origin[a] = this->Corner[a];
      map.Tolerance[a] = this->BorderTolerance() / unit;
      for (int r = 0; r < 3; ++r)
      {
        map.Matrix[a][r] = (a < D ? this->Inverse[a][r] : this->Normal[a][r]) / unit;
      }
    }
    return map;
  }

  // The physical vector of a difference of indices.
  template <int D>
  void VectorToPhysical(const double* index, double* v) const
  {
    for (int r = 0; r < 3; ++r)
    {
      v[r] = 0.0;
      for (int a = 0; a < D; ++a)
      {
        v[r] += this->Matrix[r][this->Axis[a]] * index[a];
      }
    }
  }

  // Moves a point to the nearest one of the domain, axis by axis. Returns whether it was inside.
  template <int D>
  bool ClampToDomain(double* index) const
  {
    bool inside = true;
    for (int a = 0; a < D; ++a)
    {
      const double nearest = std::clamp(index[a], 0.0, static_cast<double>(this->Cells[a]));
      inside = inside && nearest == index[a];
      index[a] = nearest;
    }
    return inside;
  }

private:
  int AxisCount = 0;
  int Axis[3] = { 0, 1, 2 };
  std::int64_t Cells[3] = { 0, 0, 0 };
  double Fixed[3] = { 0.0, 0.0, 0.0 }; // the image's index at the corner where index space is 0
  double Matrix[3][4] = {};            // image index to physical
  double Corner[3] = { 0.0, 0.0, 0.0 };
  double Spacing[3] = { 0.0, 0.0, 0.0 };
  double Inverse[3][3] = {}; // physical offset to physical length along each axis
  double Normal[3][3] = {};  // from the axes' number on: unit vectors across the axes
  double Measure = 0.0;
};

} // namespace RectifiedTransport

#endif
