// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAreaPreservingParameterization
 * @brief   texture coordinates of a disk that preserve areas
 *
 * Input: a vtkPolyData, or a vtkUnstructuredGrid or vtkStructuredGrid of polygons, whose polygons
 * and triangle strips are a disk: one component with one boundary, without holes and handles, as a
 * surface that was cut open. Output: the same surface
 * with coordinates in the unit square for every point, so that every triangle has the share of the
 * square that it has of the surface. The method is that of Section 5.4 of Do, Coeurjolly, Memari
 * and Bonneel, "Linear-Time Transport with Rectified Flows", ACM Transactions on Graphics 44(4),
 * 2025, doi:10.1145/3731147: a conformal map of the surface to the square, whose density of area is
 * then transported to the uniform one, and the points with it. As the flow moves points and
 * triangles stay straight between them, Polish improves the result until triangles have their
 * areas: 95 % of the area within 3 %, no triangle flipped.
 *
 * Output, a vtkPolyData with the points, cells and data of the input in their order, and
 *
 * - point data `AreaPreserving` (2 components, float, active texture coordinates),
 *   `AreaPreservingExact` (the same in double) and `Conformal` (2 components, double): all in
 *   [0,1]^2, the boundary of the surface on the sides;
 * - cell data `AreaDistortion` (double: the share of the area in the square by that of the
 *   surface's area, 1 where it is kept), `AngleDistortion` (double: the quotient of the singular
 *   values of the map of the triangle, 1 where it keeps its shape, at most 1000), and `Flipped`
 *   (unsigned char: 1 where a triangle is turned over, or has no area left); 1, 1 and 0 for cells
 *   that are no polygons or have no area;
 * - field data `AreaDistortionRMS` (the root mean square of the deviation of AreaDistortion from 1,
 *   weighted by area), `AngleDistortionMean` (weighted by area) and `FlippedCount`.
 *
 * All of them are of AreaPreservingExact; they replace arrays of the same names. Where there are
 * polygons of more than three points, or strips, these are cut into triangles, each with the cell
 * data of the polygon; global ids of cells are then dropped. Lines and vertices pass unchanged.
 *
 * Points that are in no polygon (their coordinates are 0 0) and triangles without area are left out
 * of the map, and points at one place merged, with a warning that counts them, where the surface is
 * no disk otherwise. A cut along which points are there twice stays a cut. Polygons that disagree
 * in their orientation are mapped with the one that most of the area has. Surfaces that are closed,
 * have several components, boundaries, handles or edges of more than two triangles are errors that
 * say which. No points give an empty output.
 *
 * On several ranks of MPI the surface is gathered on the first one, which has the output.
 *
 * Cost: O(points^1.5) for the conformal map, O(points + Resolution^2) for the rest. Memory: up to
 * 1350 bytes a point, and 40 bytes a cell of the grid.
 *
 * @warning A nearly closed surface, whose boundary is short, cannot be mapped with areas that are
 * near; the warning says how near they are.
 *
 * \code{.cpp}
 * vtkNew<vtkAreaPreservingParameterization> map;
 * map->SetInputConnection(reader->GetOutputPort());
 * map->Update();
 * vtkDataArray* coordinates = map->GetOutput()->GetPointData()->GetTCoords();
 * \endcode
 *
 * @sa vtkDensityEqualizingWarp vtkSolidDensity
 */
#ifndef vtkAreaPreservingParameterization_h
#define vtkAreaPreservingParameterization_h

#include "vtkGuardedAlgorithm.h"

#include <memory> // for std::unique_ptr

namespace RectifiedTransport
{
struct CornerSettings;
} // namespace RectifiedTransport

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkAreaPreservingParameterization : public vtkGuardedAlgorithm
{
public:
  static vtkAreaPreservingParameterization* New();
  vtkTypeMacro(vtkAreaPreservingParameterization, vtkGuardedAlgorithm);
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
   * Whether points are moved on after the flow until triangles have their areas. Off: the paper's
   * method alone. Default on.
   */
  vtkSetMacro(Polish, bool);
  vtkGetMacro(Polish, bool);
  vtkBooleanMacro(Polish, bool);
  ///@}

  ///@{
  /**
   * The points of the surface's boundary that become the corners of the unit square: four point
   * ids, of which the first goes to (0,0) and the others, in the order of the boundary, to (1,0),
   * (1,1) and (0,1). Without any (default) they are chosen. 1000000 at most.
   */
  void SetNumberOfCorners(int count);
  int GetNumberOfCorners();
  void ClearCorners() { this->SetNumberOfCorners(0); }
  ///@}

  ///@{
  /**
   * One of them. The list becomes as long as needed, with -1 for corners that are not set.
   */
  void SetCorner(int index, vtkIdType point);
  vtkIdType GetCorner(int index);
  ///@}

  /**
   * The surface with texture coordinates.
   */
  vtkPolyData* GetOutput();

protected:
  vtkAreaPreservingParameterization();
  ~vtkAreaPreservingParameterization() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Resolution;
  bool Polish;

private:
  std::unique_ptr<RectifiedTransport::CornerSettings> Corners;

  vtkAreaPreservingParameterization(const vtkAreaPreservingParameterization&) = delete;
  void operator=(const vtkAreaPreservingParameterization&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
