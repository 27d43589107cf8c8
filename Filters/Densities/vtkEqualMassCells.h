// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkEqualMassCells
 * @brief   divide a domain among sites into cells of equal mass
 *
 * Assigns every pixel of a domain to one of the given sites, equally many to each. Pixels are the
 * cells of the image Labels. The rectified flow of Do, Coeurjolly, Memari and Bonneel, "Linear-Time
 * Transport with Rectified Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147
 * (Section 4.2, Figure 5) maps the pixels to the sites. It goes from the uniform measure to a
 * density that has one unit of mass in the pixel of each site. Then pixels at the borders are
 * reassigned until the sites' cells are equal to one pixel. The cells resemble those of
 * semi-discrete optimal transport; their cost is an upper bound on the optimal one.
 *
 * With Shape Power, the sites' cells are those of semi-discrete optimal transport: the division
 * into equal masses with the least mean squared distance. They are a power diagram; Newton's method
 * finds its weights (Kitagawa, Merigot and Thibert, "Convergence of a Newton algorithm for
 * semi-discrete optimal transport", Journal of the European Mathematical Society 21(9), 2019,
 * doi:10.4171/JEMS/889). The cells are convex polygons whose areas are equal to 5e-7 of their mean.
 * A pixel belongs to the cell that contains its centre.
 *
 * With Measure Density, every site gets an equal share of the mass of a density on the domain. The
 * flow of the density, backward in time, takes the pixels and the sites to the uniform measure.
 * There the pixels flow to the sites as above. Then pixels are reassigned until the masses of the
 * sites' cells differ by at most the mass of the heaviest pixel. With Shape Power, the polygons
 * have exactly equal masses and the least mean squared distance over the mass.
 *
 * Input 0 is the sites, any vtkPointSet. Input 1, optional, is the domain. With Measure Uniform,
 * only its box is used. For a vtkImageData, that is its bounds in its own axes; if its values (the
 * active scalars, of points first, else any point array) are point data, half a spacing more on
 * each side. For other data sets and composites, it is their bounds. Without input 1, the domain is
 * the bounds of the sites, a tenth longer, about their centre. Sides of length 0 are no axes:
 * domains are 1D, 2D or 3D. The uniform measure has density 1: masses are lengths, areas or
 * volumes. With Measure Density, input 1 has the density (see vtkDensityAlgorithm), chosen with
 * SetInputArrayToProcess(0, 1, 0, ...). The pixels, of any number, cover its domain.
 *
 * Outputs:
 * - 0, `Labels`: a vtkImageData of the domain, with the cell arrays `SiteId` (active scalars), the
 *   index of each pixel's site, and `SiteColor` (unsigned char), a number that differs between
 *   adjacent sites (if more than 256 are needed, 255 may not). With Measure Density, pixels without
 *   mass have the SiteId -1; they are hidden by a ghost array;
 * - 1, `Sites`: the data set of input 0 with the point arrays `CellMass`, `CellCentroid` (3
 *   components) and `CellCost` of the sites' cells (the cell's share; the shares add up to the
 *   cost);
 * - 2, `Outlines`: a vtkPolyData of the borders of the sites' cells along the sides of pixels, with
 *   the cell array `SiteId`: lines in 2D, quads in 3D, vertices in 1D. Each site's cell has its
 *   whole border: a border between two cells is there twice;
 * - 3, `Polygons`: in 2D the sites' cells as polygons, a vtkPolyData with the cell arrays `SiteId`
 *   (active scalars), `SiteColor` and all arrays of Sites. With Shape Flow, they run along the
 *   sides of pixels, and a cell of several parts or with holes has several polygons. In 1D and 3D
 *   it is empty.
 *
 * All outputs have the field data `TransportCost`: the mean of |x - site|_p^q over the pixels'
 * centres x, an upper bound on W_p^q from the pixels' centres to the sites. With Shape Power,
 * masses, centroids and costs are integrals over the polygons, TransportCost is W_2^2 from the
 * uniform measure to the sites, Polygons are those polygons and Outlines their sides. With Measure
 * Density, masses, centroids and costs are those of the density: pixels are weighted by their mass,
 * and W_p^q is from the density. Further field data are `OutsideSites` and `SitesWithoutMass`, the
 * numbers of sites outside the domain and of those whose cells have no mass (below); a warning
 * counts each if they are at least one in a thousand.
 *
 * Sites in the same pixel share the mass of one cell, equally to the last bit. The cell's pixels
 * are divided into as many parts, equal to one pixel. Sites outside the domain get the cells of the
 * nearest points of its border; their cost is from their own
 * position. There must be at least as many pixels as sites. With Shape Power, only sites nearer to
 * each other than 1e-5 of the mean spacing share a cell: all except one are moved apart by that
 * distance, only for the cells. Sites outside the domain are used at their positions, and there may
 * be more sites than pixels. NaN or infinite coordinates are errors. Without a domain, sites that
 * are all at one point are an error, too.
 *
 * With Measure Density and Shape Flow, there must be a pixel with mass for each site. Sites that
 * the flow takes into the same pixel divide the mass of their cell into parts that are equal to a
 * pixel. The mass of a cell is that of its pixels. If one pixel has more than a share, some cells
 * may have no mass: their centroid is the site. With Shape Power, if the
 * sites are distributed very differently from the density, cells of equal mass may not be found;
 * this is an error.
 *
 * With several MPI ranks, rank 0 gathers all sites and the domain and does the work. Each rank gets
 * the extent of Labels that is requested of it. The other outputs are on rank 0.
 *
 * Cost: O(pixels * steps) and O(sites log sites). Where pixels flow to sites, a NumberOfSteps below
 * 128 is doubled until it is at least 128, at most five times; otherwise most pixels would miss the
 * sites. Tolerance is in pixels there. Memory: 8 bytes a pixel for the labels and, while they are
 * made, about 21, 34 and 33 more in 1D, 2D and 3D: 41 bytes a pixel, 0.7 GB at 256^3, 5.5 GB at
 * 512^3. Measure Density takes 24 and 32 bytes a pixel more in 2D and 3D, and the tables of the
 * density. Shape Power: O(sites^1.5) for each of about ten Newton steps, 1.4 kB a site, and
 * O(pixels) for the labels; with Measure Density 18 bytes a cell of the density. The labels are
 * kept until the sites, the domain, the density, Shape or, with Shape Flow, the integration change.
 *
 * @warning The extent of Labels depends on the domain, or without one on the sites. Their producer
 * is therefore updated in REQUEST_INFORMATION.
 *
 * \code{.cpp}
 * vtkNew<vtkEqualMassCells> cells;
 * cells->SetInputData(sites); // a vtkPolyData
 * cells->SetResolution(1024);
 * cells->Update();
 * vtkImageData* labels = cells->GetLabels();
 * \endcode
 *
 * @sa vtkFlowAlgorithm vtkDensityAlgorithm vtkTransportMap vtkTransportSampler
 */
#ifndef vtkEqualMassCells_h
#define vtkEqualMassCells_h

#include "vtkFlowAlgorithm.h"
#include "vtkImageData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro

#include <memory> // for std::unique_ptr

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;

class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkEqualMassCells : public vtkFlowAlgorithm
{
public:
  static vtkEqualMassCells* New();
  vtkTypeMacro(vtkEqualMassCells, vtkFlowAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What Measure may be.
   */
  enum MeasureType
  {
    UNIFORM = 0,
    DENSITY = 1
  };

  ///@{
  /**
   * What is divided equally among the sites. Uniform (default): the length, area or volume of the
   * domain. Density: the mass of the domain's density, input array 0 on port 1. Only then are
   * Component, InvertDensity, NegativeValues and DensityResolution used.
   */
  vtkSetMacro(Measure, int);
  vtkGetMacro(Measure, int);
  void SetMeasureToUniform() { this->SetMeasure(UNIFORM); }
  void SetMeasureToDensity() { this->SetMeasure(DENSITY); }
  const char* GetMeasureAsString();
  ///@}

  /**
   * What Shape may be.
   */
  enum ShapeType
  {
    SHAPE_FLOW = 0,
    SHAPE_POWER = 1
  };

  ///@{
  /**
   * Flow (default): the cells of the rectified flow, in one to three dimensions and for any cost.
   * Power: the cells of least cost, convex polygons of exactly equal area or mass. Power needs a
   * domain of two dimensions, NormExponent 2 and CostExponent 2.
   */
  vtkSetMacro(Shape, int);
  vtkGetMacro(Shape, int);
  void SetShapeToFlow() { this->SetShape(SHAPE_FLOW); }
  void SetShapeToPower() { this->SetShape(SHAPE_POWER); }
  const char* GetShapeAsString();
  ///@}

  ///@{
  /**
   * The number of pixels along the longest side of the domain; 0 (default) is 512 in 2D and 64 in
   * 3D. The numbers along the other sides make the pixels as near to cubes as possible. More than 8
   * million pixels are a warning, before they are made.
   */
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * The p of the cost |x - site|_p^q: the norm, at least 1, infinity for the maximum norm. Default
   * 2. The sites' cells do not depend on it. Shape Power needs 2.
   */
  vtkSetMacro(NormExponent, double);
  vtkGetMacro(NormExponent, double);
  ///@}

  ///@{
  /**
   * The q of the cost |x - site|_p^q: the power of the distance, above 0. Default 2. The sites'
   * cells do not depend on it. Shape Power needs 2.
   */
  vtkSetMacro(CostExponent, double);
  vtkGetMacro(CostExponent, double);
  ///@}

  /**
   * Set the domain (input 1, optional), as the output of another filter.
   */
  void SetDomainConnection(vtkAlgorithmOutput* domain) { this->SetInputConnection(1, domain); }

  /**
   * The same, as a data object.
   */
  void SetDomainData(vtkDataObject* domain) { this->SetInputData(1, domain); }

  ///@{
  /**
   * The outputs: the site of each pixel, the sites with the statistics of their cells, the borders
   * of these cells, and in 2D the cells as polygons.
   */
  vtkImageData* GetLabels() { return vtkImageData::SafeDownCast(this->GetOutputDataObject(0)); }
  vtkPointSet* GetSites() { return vtkPointSet::SafeDownCast(this->GetOutputDataObject(1)); }
  vtkPolyData* GetOutlines() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(2)); }
  vtkPolyData* GetPolygons() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(3)); }
  ///@}

protected:
  vtkEqualMassCells();
  ~vtkEqualMassCells() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void ShareOutputs(
    const RectifiedTransport::Ranks& ranks, vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Resolution = 0;
  double NormExponent = 2.0;
  double CostExponent = 2.0;
  int Shape = SHAPE_FLOW;
  int Measure = UNIFORM;

private:
  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;

  vtkEqualMassCells(const vtkEqualMassCells&) = delete;
  void operator=(const vtkEqualMassCells&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
