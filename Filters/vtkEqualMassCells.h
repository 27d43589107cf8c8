// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkEqualMassCells
 * @brief   divide a domain among sites into cells of equal mass
 *
 * Assigns every pixel of a domain to one of the given sites, equally many to each: the pixels,
 * which are the cells of the image Labels, are mapped to the sites by the rectified flow of Do,
 * Coeurjolly, Memari and Bonneel, "Linear-Time Transport with Rectified Flows", ACM Transactions on
 * Graphics 44(4), 2025, doi:10.1145/3731147 (Section 4.2, Figure 5), from the uniform measure to a
 * density that has one unit of mass in the pixel of each site. Pixels at the borders are then
 * reassigned until the sites' cells are equal to one pixel. The cells resemble those of
 * semi-discrete optimal transport, at a cost that is an upper bound on the optimal one.
 *
 * Input 0 is the sites, any vtkPointSet. Input 1 is optional: the domain, a vtkImageData of which
 * only the box is used: its bounds in its own axes, and where its values (the active scalars, of
 * points first, else any point array) are point data half a spacing more on each side, as of a
 * density. Without it the domain is the bounds of the sites, a tenth longer, about their centre.
 * Sides of no length are no axes: domains are 1D, 2D or 3D. The uniform measure has the density 1,
 * so that masses are lengths, areas or volumes.
 *
 * Outputs:
 * - 0, `Labels`: a vtkImageData of the domain, with the cell array `SiteId` (active scalars): the
 *   index of each pixel's site;
 * - 1, `Sites`: the data set of input 0 with the point arrays `CellMass`, `CellCentroid` (3
 *   components) and `CellCost` of the sites' cells (the cell's share of the cost: these add up to
 *   it);
 * - 2, `Outlines`: a vtkPolyData of the borders of the sites' cells along the sides of pixels, with
 *   the cell array `SiteId`: lines in 2D, quads in 3D, vertices in 1D. Each site's cell has its
 *   whole border, so that a border between two of them is there twice.
 *
 * Labels and Sites have the field data `TransportCost`: the mean of |x - site|_p^q over the pixels'
 * centres x, an upper bound on W_p^q from the pixels' centres to the sites.
 *
 * Sites in one pixel share the mass of one cell, equally to the last bit; the cell's pixels are
 * divided into as many parts, equal to one pixel. Sites outside of the domain get the cells of the
 * nearest points of its border, and a warning counts them; their cost is from their own position.
 * There must be at least as many pixels as sites. NaN or infinite coordinates, and sites that are
 * all at one point without a domain, are errors.
 *
 * Cost: O(pixels * steps), and O(sites log sites). Fewer than 128 steps are doubled up to five
 * times, because most pixels would miss the sites. Memory: 8 bytes a pixel for the labels and while
 * they are made about 21, 34 and 33 more in 1D, 2D and 3D: 41 bytes a pixel or 0.7 GB at 256^3, 5.5
 * GB at 512^3. The labels are kept until the sites, the domain or the integration change.
 *
 * @warning Without a domain the extent of Labels follows from the sites. The producer of the
 * domain, or else of the sites, is therefore updated in REQUEST_INFORMATION.
 *
 * \code{.cpp}
 * vtkNew<vtkEqualMassCells> cells;
 * cells->SetInputData(sites); // a vtkPolyData
 * cells->SetResolution(1024);
 * cells->Update();
 * vtkImageData* labels = cells->GetLabels();
 * \endcode
 *
 * @sa vtkTransportMap vtkTransportSampler
 */
#ifndef vtkEqualMassCells_h
#define vtkEqualMassCells_h

#include "vtkGuardedAlgorithm.h"
#include "vtkTransportProperties.h" // for the integration of the flow

#include <memory> // for std::unique_ptr

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;
class vtkImageData;
class vtkPointSet;
class vtkPolyData;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkEqualMassCells : public vtkGuardedAlgorithm
{
public:
  static vtkEqualMassCells* New();
  vtkTypeMacro(vtkEqualMassCells, vtkGuardedAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of pixels along the longest side of the domain, from 1; along the others as many as
   * make the pixels nearest to cubes. Default 512.
   */
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * p of the cost |x - site|_p^q: the norm; at least 1, infinity for the maximum norm. Default 2.
   * The sites' cells do not depend on it.
   */
  vtkSetMacro(NormExponent, double);
  vtkGetMacro(NormExponent, double);
  ///@}

  ///@{
  /**
   * q of the cost |x - site|_p^q: the power of the distance; above 0. Default 2. The sites' cells
   * do not depend on it.
   */
  vtkSetMacro(CostExponent, double);
  vtkGetMacro(CostExponent, double);
  ///@}

  // Fewer than 128 NumberOfSteps are doubled until there are that many, five times at most;
  // Tolerance is in pixels.
  vtkFlowPropertiesMacro();

public:
  ///@{
  /**
   * Set the domain (input 1, optional), as the output of another filter or as a data object.
   */
  void SetDomainConnection(vtkAlgorithmOutput* domain);
  void SetDomainData(vtkDataObject* domain);
  ///@}

  ///@{
  /**
   * The outputs: the site of each pixel, the sites with the statistics of their cells, and the
   * borders of these cells.
   */
  vtkImageData* GetLabels();
  vtkPointSet* GetSites();
  vtkPolyData* GetOutlines();
  ///@}

protected:
  vtkEqualMassCells();
  ~vtkEqualMassCells() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Resolution;
  double NormExponent;
  double CostExponent;

private:
  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;

  vtkEqualMassCells(const vtkEqualMassCells&) = delete;
  void operator=(const vtkEqualMassCells&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
