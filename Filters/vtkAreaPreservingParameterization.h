// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAreaPreservingParameterization
 * @brief   texture coordinates of a disk that preserve areas
 *
 * Input: a vtkPolyData, or a vtkUnstructuredGrid or vtkStructuredGrid of polygons. Its polygons and
 * triangle strips form a disk: one component with one boundary, without holes and handles, such as
 * a surface that was cut open. Outputs: the same surface with coordinates in the unit square for
 * every point, and the surface laid flat in that square. Each triangle's share of the square equals
 * its share of the surface.
 *
 * The method is that of Section 5.4 of Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport
 * with Rectified Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147. A conformal
 * map takes the surface to the square. Its density of area is transported to the uniform one, and
 * the points with it. The flow moves only the points; triangles stay straight between them. Polish
 * then corrects the areas: 95 % of the area within 3 %, no triangle flipped.
 *
 * Output 0, Surface, is a vtkPolyData with the points, cells and data of the input in their order,
 * and
 *
 * - point data `AreaPreserving` (2 components, float, active texture coordinates),
 *   `AreaPreservingExact` (the same in double) and `Conformal` (2 components, double): all in
 *   [0,1]^2, the boundary of the surface on the sides;
 * - cell data `AreaDistortion` (double: the triangle's share of the square divided by its share of
 *   the surface; 1 is best), `AngleDistortion` (double: the quotient of the singular values of the
 *   triangle's map; 1 if it keeps its shape, at most 1000), and `Flipped` (unsigned char: 1 if the
 *   triangle is turned over or has no area left). Cells that are not polygons or have no area get
 *   1, 1 and 0;
 * - field data `AreaDistortionRMS` (the root mean square of the deviation of AreaDistortion from 1,
 *   weighted by area), `AngleDistortionMean` (weighted by area) and `FlippedCount`.
 *
 * Output 1, Flat, has the same cells and data, and points (u, v, 0) by AreaPreservingExact. Normals
 * and tangents are those of the surface; their arrays are kept, but are not active, so that they do
 * not shade the flat mesh.
 *
 * The figures are those of AreaPreservingExact. The arrays replace arrays of the same names.
 * Polygons of more than three points and strips are cut into triangles with the cell data of the
 * polygon; global ids of cells are then dropped. Lines and vertices pass unchanged.
 *
 * If the surface is no disk otherwise, points in no polygon (their coordinates are 0 0) and
 * triangles without area are left out of the map, and points at the same position are merged, with
 * a warning that counts them. A cut whose points are duplicated stays a cut. Polygons with
 * inconsistent orientation are mapped with the orientation that most of the area has. A closed
 * surface, several components or boundaries, handles, and edges of more than two triangles are
 * errors that say which. An input without points gives empty outputs.
 *
 * With several MPI ranks the surface is gathered on rank 0, which has the outputs.
 *
 * Cost: O(points^1.5) for the conformal map, O(points + Resolution^2) for the rest. Memory: up to
 * 1350 bytes a point, and 40 bytes a cell of the grid.
 *
 * @warning On a nearly closed surface, with a short boundary, areas cannot be kept well. The
 * warning says how well they are kept.
 *
 * \code{.cpp}
 * vtkNew<vtkAreaPreservingParameterization> map;
 * map->SetInputConnection(reader->GetOutputPort());
 * map->Update();
 * vtkDataArray* coordinates = map->GetOutput()->GetPointData()->GetTCoords();
 * vtkPolyData* flat = map->GetFlat();
 * \endcode
 *
 * @sa vtkDensityEqualizingWarp vtkSolidDensity
 */
#ifndef vtkAreaPreservingParameterization_h
#define vtkAreaPreservingParameterization_h

#include "vtkDiskAlgorithm.h"

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORT_EXPORT vtkAreaPreservingParameterization : public vtkDiskAlgorithm
{
public:
  static vtkAreaPreservingParameterization* New();
  vtkTypeMacro(vtkAreaPreservingParameterization, vtkDiskAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of cells along both axes of the grid of the flow, 1 to 16384. Default 512.
   */
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Whether points are moved after the flow until triangles have their areas. Off: only the paper's
   * method. Default on.
   */
  vtkSetMacro(Polish, bool);
  vtkGetMacro(Polish, bool);
  vtkBooleanMacro(Polish, bool);
  ///@}

  /**
   * Output 1: the surface in the unit square. Output 0 is GetOutput.
   */
  vtkPolyData* GetFlat();

protected:
  vtkAreaPreservingParameterization();
  ~vtkAreaPreservingParameterization() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Resolution;
  bool Polish;

private:
  vtkAreaPreservingParameterization(const vtkAreaPreservingParameterization&) = delete;
  void operator=(const vtkAreaPreservingParameterization&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
