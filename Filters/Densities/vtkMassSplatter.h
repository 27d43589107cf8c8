// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMassSplatter
 * @brief   spread the mass of points over the cells of an image: a density
 *
 * Each point adds its mass to the image's cells around it, by a kernel that is a product of one
 * kernel for each axis (Hockney and Eastwood, "Computer Simulation Using Particles", 1988, Section
 * 5-3). This is the inverse of sampling: it gives the density of the particles of
 * vtkTransportSampler or of any other points.
 *
 * Input 0 is the points, any vtkPointSet. Their masses are the point array that
 * `SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name)` chooses, with
 * one component of any numeric type, or text that holds numbers alone. Without a name, or with
 * "None" if there is no such array, each point has mass 1. Masses may be negative. Points that
 * vtkGhostType marks as duplicates or hidden have no mass. Input 1, optional, is the Reference, a
 * vtkImageData in 1D, 2D or 3D, with any origin, spacing, direction and extent; only its geometry
 * is used. Without it, the bounds of the points are cut into `Dimensions` cells. An axis along
 * which the points have no extent is no axis.
 *
 * Output: a vtkImageData with the array `Density` (double, active scalars): mass per length, area
 * or volume or, with `DivideByVolume` off, mass. It has the field data of the points,
 * `TotalMass`, the mass that the image holds (that of all points or, with `Boundary` Drop, the part
 * inside), and `OutsidePoints`, the number of points outside. With a Reference, the image has its
 * geometry. The values are cell data, or point data whose domain extends half a spacing beyond the
 * bounds. Without a Reference, the same values are cell data, or point data at the cells' centres.
 * An axis with one value is then no axis of these points, but the values remain per volume of the
 * cells.
 *
 * The values times the cells' measure sum to the mass of the points, to rounding. The centroid is
 * kept, to rounding, except with NearestCell and with kernels that cross the border.
 *
 * Points outside the domain (by more than a millionth of its diagonal; with a 2D image, also those
 * off its plane) are moved to the nearest point of the border or, with `Boundary` Drop, ignored. A
 * warning counts them if they are at least one in a thousand. An input without points gives an
 * image without mass if there is a Reference, else an empty image. NaN or infinite coordinates and
 * masses are errors. Without a Reference, points that are all at one position are an error, too.
 *
 * Cost: O(points * cells of the kernel + cells). Memory: 8 bytes a cell and 8 a point if there are
 * masses; with many threads and unordered points up to 6 more a point, for 16 million points at a
 * time. The result is bitwise the same for every number of threads: the shares of a cell are added
 * in the order of the points.
 *
 * If MPI ranks request one piece each, they run the filter together. Each rank gives its part of
 * the points and of the Reference, and gets the extent that is requested of it, bitwise as on one
 * rank. The shares are then added in the order of the integer point array `SeedId`, or else of the
 * global ids, if all ranks have them; else in the order of the ranks. A rank takes about 100 bytes
 * for each point that it gives or that reaches its cells. If all ranks have the same points, they
 * are one data set. Points of a mesh that several ranks have count once.
 *
 * @warning Without a Reference, the extent depends on the points. Their producer is therefore
 * updated in REQUEST_INFORMATION, which is then collective.
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

#include "vtkCollectiveAlgorithm.h"
#include "vtkImageData.h"
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;

class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkMassSplatter : public vtkCollectiveAlgorithm
{
public:
  static vtkMassSplatter* New();
  vtkTypeMacro(vtkMassSplatter, vtkCollectiveAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

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
   * Without a Reference: the number of values of the output along x, y and z, at least 1 each. An
   * axis along which the points have no extent has one. 0 0 0 (default): about as many cells as
   * points, nearly cubes, at most 128 along an axis.
   */
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /**
   * The field association of the output's values. Points (default): point data, on points at the
   * cells' centres (with a Reference: on its points), ready for contours and volume rendering.
   * Cells: cell data. The values are the same.
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
   * contains the point (on a face, the upper cell). TriangularShapedCloud: quadratically over 3
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
   * The standard deviation of the Gaussian, in cells, above 0 and at most 10000. Default 1. The
   * kernel is cut at 3 standard deviations and corrected to first order so that it keeps the
   * centroid. Up to a third of a cell it is CloudInCell.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * What happens to the part of a kernel beyond the border. Renormalize (default): it is
   * distributed over the cells inside, axis by axis. Drop: it is lost.
   */
  vtkSetMacro(Boundary, int);
  vtkGetMacro(Boundary, int);
  void SetBoundaryToRenormalize() { this->SetBoundary(RENORMALIZE); }
  void SetBoundaryToDrop() { this->SetBoundary(DROP); }
  const char* GetBoundaryAsString();
  ///@}

  ///@{
  /**
   * Whether the values are densities; else they are the masses of the image's cells. On by default.
   */
  vtkSetMacro(DivideByVolume, vtkTypeBool);
  vtkGetMacro(DivideByVolume, vtkTypeBool);
  vtkBooleanMacro(DivideByVolume, vtkTypeBool);
  ///@}

  /**
   * Set the image that gives the output its geometry (input 1, optional), as the output of another
   * filter.
   */
  void SetReferenceConnection(vtkAlgorithmOutput* reference)
  {
    this->SetInputConnection(1, reference);
  }

  /**
   * The same, as a data object.
   */
  void SetReferenceData(vtkDataObject* reference) { this->SetInputData(1, reference); }

  /**
   * The density.
   */
  vtkImageData* GetOutput() { return vtkImageData::SafeDownCast(this->GetOutputDataObject(0)); }

protected:
  vtkMassSplatter();
  ~vtkMassSplatter() override = default;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Dimensions[3] = { 0, 0, 0 };
  int Association = POINTS;
  int Kernel = CLOUD_IN_CELL;
  double Radius = 1.0;
  int Boundary = RENORMALIZE;
  vtkTypeBool DivideByVolume = true;

private:
  vtkMassSplatter(const vtkMassSplatter&) = delete;
  void operator=(const vtkMassSplatter&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
