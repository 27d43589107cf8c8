// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMassSplatter
 * @brief   spread the mass of points over the cells of an image: a density
 *
 * Every point adds its mass to the image's cells around it, by a kernel that is a product of one
 * kernel for each axis (Hockney and Eastwood, "Computer Simulation Using Particles", 1988, Section
 * 5-3). This is the inverse of sampling: the density of the particles of vtkTransportSampler, or of
 * any others.
 *
 * Input 0 is the points, any vtkPointSet; they weigh by the point array that
 * `SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name)` chooses, of one
 * component and any numeric type; without a name, or with "None" where there is no such array, each
 * has the mass 1. Masses may be negative. Points that vtkGhostType marks as duplicates or hidden
 * have none. Input 1 is optional: the Reference, a vtkImageData of which only the geometry counts,
 * in 1D, 2D or 3D, with any origin, spacing, direction and extent. Without it the bounds of the
 * points are cut into `Dimensions` cells; an axis along which they are flat is no axis.
 *
 * Output: a vtkImageData with the array `Density` (double, active scalars): mass per length, area
 * or volume, or with `DivideByVolume` off mass; and beside the points' field data `TotalMass`, the
 * mass that the image holds: that of all points, or with `Boundary` Drop the part inside. With a
 * Reference the image has its geometry, and the values are cell data, or point data, whose domain
 * extends half a spacing beyond the bounds. Without, the same values are cell data, or point data
 * at the cells' centres. Such points have no axis where there is one value along it: the values
 * remain per volume of the cells.
 *
 * The values times the cells' measure sum to the points' mass, and the centroid is theirs, both to
 * rounding; for the centroid NearestCell and kernels that reach past the border are exceptions.
 *
 * Points outside of the domain (by more than a millionth of its diagonal; with a flat image, those
 * off its plane too) are moved to the nearest point of the border, or with `Boundary` Drop ignored;
 * a warning counts them. No points give an image without mass if there is a Reference, else an
 * empty one. NaN or infinite coordinates and masses, and points that are all in one place without a
 * Reference, are errors.
 *
 * Cost: O(points * cells of the kernel + cells). Memory: 8 bytes a cell, 8 a point if there are
 * masses; with many threads and points in no order up to 6 more a point, of 16 million at a time.
 * The result is the same to the last bit for every number of threads: the shares of a cell are
 * added in the order of the points.
 *
 * Where ranks of MPI request a piece each, all of them run the filter together: each gives its part
 * of points and Reference, and gets the extent that is requested of it, with the bits of one rank.
 * The shares are then added in the order of the point array `SeedId` of integers, or else of the
 * global ids, where all ranks have them; else of the ranks. A rank takes about 100 bytes for each
 * point that it gives or that reaches its cells. Points that are the same on all ranks are one data
 * set, and those of a mesh that several ranks have count once.
 *
 * @warning Without a Reference the extent follows from the points, whose producer is therefore
 * updated in REQUEST_INFORMATION, where the ranks meet, too.
 *
 * \code{.cpp}
 * vtkNew<vtkMassSplatter> splatter;
 * splatter->SetInputData(particles); // a vtkPolyData
 * splatter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Mass");
 * splatter->SetDimensions(64, 64, 64);
 * splatter->Update();
 * vtkImageData* density = splatter->GetOutput();
 * \endcode
 *
 * @sa vtkTransportSampler vtkTransportInterpolator
 */
#ifndef vtkMassSplatter_h
#define vtkMassSplatter_h

#include "vtkGuardedAlgorithm.h"

namespace RectifiedTransport
{
struct MassSplatter;
}

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;
class vtkDataArray;
class vtkImageData;
class vtkPointSet;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkMassSplatter : public vtkGuardedAlgorithm
{
public:
  static vtkMassSplatter* New();
  vtkTypeMacro(vtkMassSplatter, vtkGuardedAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What Association may be.
   */
  enum AssociationType
  {
    POINTS = 0,
    CELLS = 1
  };

  /**
   * What Kernel may be.
   */
  enum KernelType
  {
    CLOUD_IN_CELL = 0,
    NEAREST_CELL = 1,
    TRIANGULAR_SHAPED_CLOUD = 2,
    GAUSSIAN = 3
  };

  /**
   * What Boundary may be.
   */
  enum BoundaryType
  {
    RENORMALIZE = 0,
    DROP = 1
  };

  ///@{
  /**
   * The number of values of the output along x, y and z without a Reference, at least 1 each; one
   * along an axis on which the points are flat. Default 128 128 128.
   */
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /**
   * The field association of the values of the output. Points (default): point data, on points at
   * the cells' centres (with a Reference: on its points), ready for contours and volume rendering.
   * Cells: cell data. The numbers are the same.
   */
  vtkSetMacro(Association, int);
  vtkGetMacro(Association, int);
  void SetAssociationToPoints() { this->SetAssociation(POINTS); }
  void SetAssociationToCells() { this->SetAssociation(CELLS); }
  const char* GetAssociationAsString();
  ///@}

  ///@{
  /**
   * How the mass of a particle is spread over the image's cells (or dual cells) around it.
   * CloudInCell (default): linearly over 2 cells along each axis. NearestCell: into the cell that
   * contains the point (on a face, the upper one). TriangularShapedCloud: quadratically over 3
   * cells. Gaussian: as a Gaussian of the given Radius.
   */
  vtkSetMacro(Kernel, int);
  vtkGetMacro(Kernel, int);
  void SetKernelToCloudInCell() { this->SetKernel(CLOUD_IN_CELL); }
  void SetKernelToNearestCell() { this->SetKernel(NEAREST_CELL); }
  void SetKernelToTriangularShapedCloud() { this->SetKernel(TRIANGULAR_SHAPED_CLOUD); }
  void SetKernelToGaussian() { this->SetKernel(GAUSSIAN); }
  const char* GetKernelAsString();
  ///@}

  ///@{
  /**
   * The standard deviation of the Gaussian, in cells, above 0 and at most 10000. The kernel is cut
   * at 3 of them, and corrected to first order so that it keeps the centroid; up to a third of a
   * cell it is the CloudInCell. Default 1.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * What happens to the part of a kernel that is beyond the border: Renormalize (default)
   * distributes it over the cells inside, axis by axis; with Drop it is lost.
   */
  vtkSetMacro(Boundary, int);
  vtkGetMacro(Boundary, int);
  void SetBoundaryToRenormalize() { this->SetBoundary(RENORMALIZE); }
  void SetBoundaryToDrop() { this->SetBoundary(DROP); }
  const char* GetBoundaryAsString();
  ///@}

  ///@{
  /**
   * Whether the values are densities, or else the masses of the image's cells. On by default.
   */
  vtkSetMacro(DivideByVolume, vtkTypeBool);
  vtkGetMacro(DivideByVolume, vtkTypeBool);
  vtkBooleanMacro(DivideByVolume, vtkTypeBool);
  ///@}

  /**
   * Set the image whose geometry the output gets (input 1, optional), as the output of another
   * filter.
   */
  void SetReferenceConnection(vtkAlgorithmOutput* reference);

  /**
   * The same, as a data object.
   */
  void SetReferenceData(vtkDataObject* reference);

  /**
   * The density.
   */
  vtkImageData* GetOutput();

protected:
  vtkMassSplatter();
  ~vtkMassSplatter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Dimensions[3];
  int Association;
  int Kernel;
  double Radius;
  int Boundary;
  vtkTypeBool DivideByVolume;

private:
  RectifiedTransport::MassSplatter GetSplatter();
  vtkDataArray* FindMasses(vtkPointSet* points);

  vtkMassSplatter(const vtkMassSplatter&) = delete;
  void operator=(const vtkMassSplatter&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
