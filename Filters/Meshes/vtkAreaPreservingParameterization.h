// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAreaPreservingParameterization
 * @brief   texture coordinates of a surface that preserve areas
 *
 * Input: a vtkPolyData, or a vtkUnstructuredGrid or vtkStructuredGrid of polygons. Its polygons and
 * triangle strips are a surface of any shape. Outputs: the surface with coordinates in the unit
 * square for every point, and the surface laid flat in that square. Each triangle's share of the
 * square equals its share of the surface.
 *
 * A disk, a component with one boundary and without holes and handles, fills the square. Other
 * surfaces are cut along short seams (see Seams; Gu, Gortler and Hoppe 2002,
 * doi:10.1145/566654.566589) until each component is a disk, and further to where the map would
 * squeeze areas, such as the tips of limbs. Each component has a square of its own in the unit
 * square, an atlas: the areas of these squares are in proportion to those of the components, and
 * between squares there is a margin. Points on seams are doubled. More than 8 small holes of a
 * component are not cut open: they shrink to 2 % of its square.
 *
 * The method is that of Section 5.4 of Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport
 * with Rectified Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147. A conformal
 * map takes the surface to the square; where seams make that one too uneven, an embedding by
 * weighted means does. Its density of area is transported to the uniform one, and the points with
 * it. The flow moves only the points; triangles stay straight between them. Polish
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
 * If the surface is cut or has several components, also the point data `PointIds` (vtkIdType: the
 * point of the input; the points of the input come first, in their order, then the copies on seams)
 * and the cell data `Component` (int: 0, 1 ...; -1 for cells that are not polygons or have no
 * area). AreaDistortion then compares with the area of all squares. Global ids of points are
 * dropped.
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
 * triangles without area are left out of the map, points at the same position are merged, and
 * triangles are cut at T-junctions (points of others within their sides), with a warning that
 * counts them. All parts of a triangle that is cut are cells with its data, in its place; a
 * triangle of three collinear points beside it is not in the output. A cut of a disk whose points
 * are duplicated stays a cut. A triangle with the points of one before counts once. Polygons with
 * inconsistent orientation are mapped with the orientation that most of the area of a component
 * has. Sheets that share an edge of more than two triangles are parted there. If Seams is None, a
 * closed surface, several components or boundaries, handles, and edges of more than two triangles
 * are errors that say which. An input without points gives empty outputs.
 *
 * With several MPI ranks the surface is gathered on rank 0, which has the outputs.
 *
 * Cost: O(points^1.5) for the conformal map, O(points + Resolution^2) for the rest. Memory: up to
 * 1350 bytes a point, and 40 bytes a cell of the grid.
 *
 * @warning On a nearly closed disk, with a short boundary, areas cannot be kept well. The warning
 * says how well they are kept.
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
#include "vtkPolyData.h"
#include "vtkRectifiedTransportMeshesModule.h" // for the export macro

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTMESHES_EXPORT vtkAreaPreservingParameterization : public vtkDiskAlgorithm
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
  vtkSetMacro(Polish, vtkTypeBool);
  vtkGetMacro(Polish, vtkTypeBool);
  vtkBooleanMacro(Polish, vtkTypeBool);
  ///@}

  /**
   * What Seams may be.
   */
  enum SeamsType
  {
    SEAMS_AUTO = 0,
    SEAMS_NONE = 1
  };

  ///@{
  /**
   * Whether surfaces that are no disks are cut along seams. Auto: they are. None: they are errors.
   * Disks have no seams. With seams or several components there can be no corners. Default Auto.
   */
  vtkSetMacro(Seams, int);
  vtkGetMacro(Seams, int);
  void SetSeamsToAuto() { this->SetSeams(SEAMS_AUTO); }
  void SetSeamsToNone() { this->SetSeams(SEAMS_NONE); }
  const char* GetSeamsAsString();
  ///@}

  /**
   * Output 1: the surface in the unit square. Output 0 is GetOutput.
   */
  vtkPolyData* GetFlat() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1)); }

protected:
  vtkAreaPreservingParameterization();
  ~vtkAreaPreservingParameterization() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Resolution = 512;
  vtkTypeBool Polish = true;
  int Seams = SEAMS_AUTO;

private:
  vtkAreaPreservingParameterization(const vtkAreaPreservingParameterization&) = delete;
  void operator=(const vtkAreaPreservingParameterization&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
