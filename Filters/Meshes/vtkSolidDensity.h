// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSolidDensity
 * @brief   the fraction of each cell of an image that a closed surface encloses
 *
 * Input: a vtkPolyData whose polygons and triangle strips are a closed surface; lines and vertices
 * are ignored. Output: a vtkImageData of cubic cells with the array `Density` (double, active
 * scalars), the covered fraction of each cell from 0 to 1: a density for the filters of this
 * module, for contours and for volume rendering. The sum of Density times the cell volume is the
 * volume of the solid.
 *
 * The image covers the bounds of the polygons and a margin (Padding), with the surface in the
 * middle. Its axes are the coordinate axes.
 *
 * Values are exact to rounding, however thin the solid is: they are sums of signed volumes of
 * prisms over the pieces of the triangles in each cell. Inside is where the winding number is not
 * zero: components that overlap are united, and a component inside another one with the opposite
 * orientation is a cavity, as in vtkMassProperties. It does not matter if the whole surface is
 * inside out. A component with inconsistent polygons gets the orientation that most of its area
 * has. Only where components overlap or intersect themselves are values sampled, on Supersampling^2
 * lines along x through each cell.
 *
 * Polygons are cut into triangles, and points with equal coordinates are merged. If edges are still
 * open, points that differ by less than 1e-9 of the longest side are merged, too; float points, if
 * they differ by less than 4 rounding errors. If edges are still open, triangles are cut at
 * T-junctions (points of others within their sides), if that closes the surface, with a warning
 * that counts them. Every edge must then belong to two triangles or another even number, for
 * example where voxels touch along an edge. Otherwise an error counts the open edges (one triangle)
 * and the non-manifold edges (another odd number) and says how to close the surface. If the
 * triangles at an edge of four or more have inconsistent orientation, inside is where the number of
 * crossings is odd. Duplicate polygons count once; two with opposite orientation cancel each other.
 * Coordinates that are not finite, points without polygons and surfaces that are not orientable are
 * errors, too. An input without points gives an empty output.
 *
 * Cost: linear in the points and triangles, then O(cells + pieces of triangles in cells + crossings
 * of lines). Memory: 8 bytes a cell; while it runs, up to 72 bytes a point, 81 a triangle, 8 more
 * for each layer of cells that a triangle crosses, and for each thread 40 for each cell of a layer.
 *
 * With several MPI ranks the surface is gathered on every rank. Each has the extent of the image
 * that is requested of it.
 *
 * @warning The extent depends on the surface. Its producer is therefore updated in
 * REQUEST_INFORMATION.
 *
 * \code{.cpp}
 * vtkNew<vtkSolidDensity> solid;
 * solid->SetInputConnection(reader->GetOutputPort());
 * solid->SetResolution(128);
 * solid->Update();
 * vtkImageData* image = solid->GetOutput();
 * \endcode
 *
 * @sa vtkTransportSampler vtkMassProperties
 */
#ifndef vtkSolidDensity_h
#define vtkSolidDensity_h

#include "vtkCollectiveAlgorithm.h"
#include "vtkImageData.h"
#include "vtkRectifiedTransportMeshesModule.h" // for the export macro

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTMESHES_EXPORT vtkSolidDensity : public vtkCollectiveAlgorithm
{
public:
  static vtkSolidDensity* New();
  vtkTypeMacro(vtkSolidDensity, vtkCollectiveAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of cells along the longest side of the image, at least 1. Default 64. Along the
   * other sides, as many as cover the surface and its margin.
   */
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * The square root of the number of sampling lines through a cell where components overlap: 1 to
   * 16, because the crossings of a layer of cells are held in memory. Default 2.
   */
  vtkSetMacro(Supersampling, int);
  vtkGetMacro(Supersampling, int);
  ///@}

  ///@{
  /**
   * The margin on each side of the surface, as a fraction of its longest side; finite, not
   * negative. Default 0.05.
   */
  vtkSetMacro(Padding, double);
  vtkGetMacro(Padding, double);
  ///@}

  ///@{
  /**
   * The field association of the output's values. Points (default): point data, on points at the
   * cells' centres, ready for contours and volume rendering. Cells: cell data. The values are the
   * same.
   */
  vtkSetMacro(Association, int);
  vtkGetMacro(Association, int);
  void SetAssociationToPoints() { this->SetAssociation(POINTS); }
  void SetAssociationToCells() { this->SetAssociation(CELLS); }
  const char* GetAssociationAsString();
  ///@}

  /**
   * What OpenSurfaces may be.
   */
  enum OpenSurfacesType
  {
    OPEN_SURFACES_ERROR = 0,
    OPEN_SURFACES_WINDING_NUMBER = 1
  };

  ///@{
  /**
   * What to do with a surface whose edges stay open. Error (default) counts them. WindingNumber:
   * inside is where the generalized winding number is a half or more (Jacobson, Kavan and
   * Sorkine-Hornung 2013); values are then sampled on the lines of Supersampling. Closed surfaces
   * give the same with both.
   */
  vtkSetMacro(OpenSurfaces, int);
  vtkGetMacro(OpenSurfaces, int);
  void SetOpenSurfacesToError() { this->SetOpenSurfaces(OPEN_SURFACES_ERROR); }
  void SetOpenSurfacesToWindingNumber() { this->SetOpenSurfaces(OPEN_SURFACES_WINDING_NUMBER); }
  const char* GetOpenSurfacesAsString();
  ///@}

  /**
   * The image with the array Density.
   */
  vtkImageData* GetOutput() { return vtkImageData::SafeDownCast(this->GetOutputDataObject(0)); }

protected:
  vtkSolidDensity();
  ~vtkSolidDensity() override = default;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Resolution = 64;
  int Supersampling = 2;
  double Padding = 0.05;
  int Association = POINTS;
  int OpenSurfaces = OPEN_SURFACES_ERROR;

private:
  vtkSolidDensity(const vtkSolidDensity&) = delete;
  void operator=(const vtkSolidDensity&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
