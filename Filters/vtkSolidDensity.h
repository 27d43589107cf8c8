// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSolidDensity
 * @brief   the fraction of each cell of an image that a closed surface encloses
 *
 * Input: a vtkPolyData whose polygons and triangle strips are a closed surface; lines and vertices
 * do not count. Output: a vtkImageData of cubic cells with the array `Density` (double, active
 * scalars), the covered fraction of each cell of the image from 0 to 1: a density for the filters
 * of this module, for contours and for volume rendering. The sum of Density times the volume of a
 * cell is the volume of the solid.
 *
 * The image covers the bounds of the polygons and a margin (Padding), with the surface in the
 * middle. Its axes are the coordinate axes.
 *
 * Values are exact but for rounding, however thin the solid is: volumes of prisms over the pieces
 * of the triangles in each cell, with their signs. Inside is where the winding number is not zero:
 * components that overlap are united, and a component within another one that is turned the other
 * way is a cavity, as vtkMassProperties counts it. Whether all is turned inside out does not
 * matter. A component whose polygons do not agree gets the orientation that most of its area has.
 * Only where components overlap, or pass through themselves, values are sampled, on Supersampling^2
 * lines along x through each cell.
 *
 * Polygons are cut into triangles and points of equal coordinates merged first. If edges are open
 * then, points that differ by less than 1e-9 of the longest side are merged, too, and of float
 * points those that differ by less than 4 rounding errors. Every edge must then be one of two
 * triangles, or of another even number, as where voxels touch along an edge: else an error counts
 * the open edges (of one triangle) and the non-manifold edges (of another odd number), and says how
 * to close the surface. Where triangles do not agree about an edge of four or more, inside is what
 * an odd number of crossings says. Polygons that are there twice count once, and two of opposite
 * directions cancel each other. Coordinates that are not finite, points without polygons and
 * surfaces that are not orientable are errors, too; no points give an empty output.
 *
 * Cost: O(cells + pieces of triangles in cells + crossings of lines), and linear in the points and
 * triangles before that. Memory: 8 bytes a cell; while it runs up to 72 bytes a point, 81 a
 * triangle, 8 more for each layer of cells that a triangle has a part in, and for each thread 40
 * for each cell of a layer.
 *
 * On several ranks of MPI the surface is gathered on each, which has the extent of the image that
 * is requested of it.
 *
 * @warning The extent follows from the surface, whose producer is therefore updated in
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

#include "vtkGuardedAlgorithm.h"

namespace RectifiedTransport
{
struct SolidDensity;
}

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkSolidDensity : public vtkGuardedAlgorithm
{
public:
  static vtkSolidDensity* New();
  vtkTypeMacro(vtkSolidDensity, vtkGuardedAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What Association may be.
   */
  enum AssociationType
  {
    POINTS = 0,
    CELLS = 1
  };

  ///@{
  /**
   * The number of cells along the longest side of the image, from 1; along the others as many as
   * cover the surface and its margin. Default 64.
   */
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * The square root of the number of lines through a cell of the image that find where components
   * overlap; 1 to 16, because the crossings of a layer of cells are held in memory. Default 2.
   */
  vtkSetMacro(Supersampling, int);
  vtkGetMacro(Supersampling, int);
  ///@}

  ///@{
  /**
   * The margin on each side of the surface, as a share of its longest side; finite, not negative.
   * Default 0.05.
   */
  vtkSetMacro(Padding, double);
  vtkGetMacro(Padding, double);
  ///@}

  ///@{
  /**
   * The field association of the values of the output. Points (default): point data, on points at
   * the cells' centres, ready for contours and volume rendering. Cells: cell data. The numbers
   * are the same.
   */
  vtkSetMacro(Association, int);
  vtkGetMacro(Association, int);
  void SetAssociationToPoints() { this->SetAssociation(POINTS); }
  void SetAssociationToCells() { this->SetAssociation(CELLS); }
  const char* GetAssociationAsString();
  ///@}

  /**
   * The image with the array Density.
   */
  vtkImageData* GetOutput();

protected:
  vtkSolidDensity();
  ~vtkSolidDensity() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Resolution;
  int Supersampling;
  double Padding;
  int Association;

private:
  RectifiedTransport::SolidDensity GetSolid();

  vtkSolidDensity(const vtkSolidDensity&) = delete;
  void operator=(const vtkSolidDensity&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
